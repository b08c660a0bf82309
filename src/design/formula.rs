//! Numbers as people type them: `0,01`, `1/60`, `sqrt(2)`, `pi/6`, angles also as `30deg` or `30°`; and formulas that
//! see the old value and the place in the selection: `=x+0.5*i`, `*2`, `+=0.1`, `rand(1,2)`.

use std::f64::consts::PI;

use crate::random::Random;

/// How deep brackets and signs may nest; text from a clipboard can hold anything.
const DEEPEST: usize = 32;

/// Bytes of a formula: each term of a sum lies one level deeper in the tree than the next, and a tree is walked by
/// recursion.
const LONGEST: usize = 1000;

/// What is typed, to be worked out for each of many.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    root: Node,
}

/// What a formula may look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// `x`
    pub old: f64,
    /// `i`, from 0
    pub index: usize,
    /// `n`
    pub count: usize,
}

#[derive(Clone, Debug, PartialEq)]
enum Node {
    Number(f64),
    Old,
    Index,
    Count,
    Negative(Box<Node>),
    Degrees(Box<Node>),
    Binary(char, Box<Node>, Box<Node>),
    Call(&'static Function, Vec<Node>),
    /// Low, high, seed, and what tells one from the other in a formula.
    Random(Box<[Node; 3]>, u64),
}

/// A function of one or two numbers.
#[derive(Debug)]
struct Function {
    name: &'static str,
    run: Run,
}

#[derive(Debug)]
enum Run {
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// Longer names first where one begins with another.
const FUNCTIONS: &[Function] = &[
    Function { name: "sqrt", run: Run::One(libm::sqrt) },
    Function { name: "sin", run: Run::One(libm::sin) },
    Function { name: "cos", run: Run::One(libm::cos) },
    Function { name: "tan", run: Run::One(libm::tan) },
    Function { name: "asin", run: Run::One(libm::asin) },
    Function { name: "acos", run: Run::One(libm::acos) },
    Function { name: "atan2", run: Run::Two(libm::atan2) },
    Function { name: "atan", run: Run::One(libm::atan) },
    Function { name: "exp", run: Run::One(libm::exp) },
    Function { name: "ln", run: Run::One(libm::log) },
    Function { name: "abs", run: Run::One(f64::abs) },
    Function { name: "floor", run: Run::One(f64::floor) },
    Function { name: "ceil", run: Run::One(f64::ceil) },
    Function { name: "round", run: Run::One(f64::round) },
    Function { name: "min", run: Run::Two(f64::min) },
    Function { name: "max", run: Run::Two(f64::max) },
    Function { name: "mod", run: Run::Two(f64::rem_euclid) },
];

impl Formula {
    /// Reads a formula; where `angles`, in radians, and numbers may be followed by `°`, `deg` or `rad`.
    pub fn parse(text: &str, angles: bool) -> Option<Self> {
        let text = text.trim();
        if text.len() > LONGEST {
            return None;
        }
        let assignment = ["+=", "-=", "*=", "/="].into_iter().find_map(|sign| {
            let rest = text.strip_prefix(sign)?;
            Some((sign.chars().next()?, rest))
        });
        let root = if let Some((sign, rest)) = assignment {
            Node::Binary(sign, Box::new(Node::Old), Box::new(Reader::all(rest, angles)?))
        } else if text.starts_with(['*', '/']) {
            // `*2` goes on behind the old value; a sign could not be told from one.
            Reader::all(&format!("x{text}"), angles)?
        } else {
            Reader::all(text.strip_prefix('=').unwrap_or(text), angles)?
        };
        Some(Self { root })
    }

    /// Whether it is the same number for all.
    pub fn is_constant(&self) -> bool {
        is_constant(&self.root)
    }

    /// Whether it draws random numbers, by whose seed.
    pub fn is_random(&self) -> bool {
        is_random(&self.root)
    }

    /// Its value; `None` where it is no finite number.
    pub fn value(&self, of: Instance) -> Option<f64> {
        Some(value(&self.root, of)).filter(|value| value.is_finite())
    }
}

fn children(node: &Node) -> Vec<&Node> {
    match node {
        Node::Number(_) | Node::Old | Node::Index | Node::Count => Vec::new(),
        Node::Negative(a) | Node::Degrees(a) => vec![a],
        Node::Binary(_, a, b) => vec![a, b],
        Node::Call(_, arguments) => arguments.iter().collect(),
        Node::Random(arguments, _) => arguments.iter().collect(),
    }
}

fn is_constant(node: &Node) -> bool {
    !matches!(node, Node::Old | Node::Index | Node::Count | Node::Random(..))
        && children(node).into_iter().all(is_constant)
}

fn is_random(node: &Node) -> bool {
    matches!(node, Node::Random(..)) || children(node).into_iter().any(is_random)
}

fn value(node: &Node, of: Instance) -> f64 {
    let value = |node: &Node| value(node, of);
    match node {
        Node::Number(number) => *number,
        Node::Old => of.old,
        Node::Index => of.index as f64,
        Node::Count => of.count as f64,
        Node::Negative(a) => -value(a),
        Node::Degrees(a) => value(a).to_radians(),
        Node::Binary(operator, a, b) => match operator {
            '+' => value(a) + value(b),
            '-' => value(a) - value(b),
            '*' => value(a) * value(b),
            '/' => value(a) / value(b),
            _ => libm::pow(value(a), value(b)),
        },
        Node::Call(Function { run: Run::One(run), .. }, arguments) => {
            arguments.first().map_or(f64::NAN, |a| run(value(a)))
        }
        Node::Call(Function { run: Run::Two(run), .. }, arguments) => match &arguments[..] {
            [a, b] => run(value(a), value(b)),
            _ => f64::NAN,
        },
        Node::Random(arguments, nth) => {
            let [low, high, seed] = &**arguments;
            let seed = value(seed).to_bits() ^ (of.index as u64).wrapping_mul(0x9E37_79B9) ^ (nth << 48);
            Random::new(seed).range(value(low), value(high))
        }
    }
}

struct Reader<'a> {
    rest: &'a str,
    angles: bool,
    /// Whether a comma parts arguments here, instead of being a decimal comma.
    commas_part: bool,
    randoms: u64,
}

impl Reader<'_> {
    /// A whole text.
    fn all(text: &str, angles: bool) -> Option<Node> {
        let mut reader = Reader { rest: text.trim(), angles, commas_part: false, randoms: 0 };
        let node = reader.sum(0)?;
        reader.rest.is_empty().then_some(node)
    }

    /// Goes on behind `word` and the spaces after it, if it comes next.
    fn takes(&mut self, word: &str) -> bool {
        match self.rest.strip_prefix(word) {
            Some(rest) => {
                self.rest = rest.trim_start();
                true
            }
            None => false,
        }
    }

    /// As `takes`, unless more letters or digits follow.
    fn takes_name(&mut self, name: &str) -> bool {
        let follows = self.rest.strip_prefix(name).and_then(|rest| rest.chars().next());
        !follows.is_some_and(|c| c.is_alphanumeric() || c == '_') && self.takes(name)
    }

    fn sum(&mut self, depth: usize) -> Option<Node> {
        let mut node = self.product(depth)?;
        loop {
            let operator = if self.takes("+") {
                '+'
            } else if self.takes("-") || self.takes("−") {
                '-'
            } else {
                return Some(node);
            };
            node = Node::Binary(operator, Box::new(node), Box::new(self.product(depth)?));
        }
    }

    fn product(&mut self, depth: usize) -> Option<Node> {
        let mut node = self.power(depth)?;
        loop {
            let operator = if self.takes("*") {
                '*'
            } else if self.takes("/") {
                '/'
            } else {
                return Some(node);
            };
            node = Node::Binary(operator, Box::new(node), Box::new(self.power(depth)?));
        }
    }

    /// `−x^2` is −(x²), as in mathematics.
    fn power(&mut self, depth: usize) -> Option<Node> {
        if depth > DEEPEST {
            return None;
        }
        if self.takes("-") || self.takes("−") {
            return Some(Node::Negative(Box::new(self.power(depth + 1)?)));
        }
        if self.takes("+") {
            return self.power(depth + 1);
        }
        let base = self.with_unit(depth)?;
        if self.takes("^") {
            return Some(Node::Binary('^', Box::new(base), Box::new(self.power(depth + 1)?)));
        }
        Some(base)
    }

    fn with_unit(&mut self, depth: usize) -> Option<Node> {
        let node = self.factor(depth)?;
        if self.angles && (self.takes("°") || self.takes_name("deg")) {
            return Some(Node::Degrees(Box::new(node)));
        }
        if self.angles {
            self.takes_name("rad");
        }
        Some(node)
    }

    fn factor(&mut self, depth: usize) -> Option<Node> {
        if self.takes("(") {
            let node = self.sum(depth + 1)?;
            return self.takes(")").then_some(node);
        }
        if self.takes("π") || self.takes_name("pi") {
            return Some(Node::Number(PI));
        }
        if self.takes_name("rand") {
            return self.random(depth);
        }
        if let Some(function) = FUNCTIONS.iter().find(|function| self.takes_name(function.name)) {
            let count = if let Run::One(_) = function.run { 1 } else { 2 };
            let arguments = self.arguments(depth, count)?;
            return (arguments.len() == count).then_some(Node::Call(function, arguments));
        }
        for (name, node) in [("x", Node::Old), ("i", Node::Index), ("n", Node::Count)] {
            if self.takes_name(name) {
                return Some(node);
            }
        }
        self.number()
    }

    /// `rand(low, high)` or `rand(low, high, seed)`.
    fn random(&mut self, depth: usize) -> Option<Node> {
        self.randoms += 1;
        let nth = self.randoms;
        let mut arguments = self.arguments(depth, 3)?;
        if arguments.len() == 2 {
            arguments.push(Node::Number(1.0));
        }
        Some(Node::Random(Box::new(arguments.try_into().ok()?), nth))
    }

    /// Up to `most` arguments in brackets, in which angles may be in degrees. A comma parts them unless there is but one
    /// or semicolons do.
    fn arguments(&mut self, depth: usize, most: usize) -> Option<Vec<Node>> {
        if depth > DEEPEST || !self.takes("(") {
            return None;
        }
        let outer = (self.angles, self.commas_part);
        let end = self.rest.find(')').unwrap_or(self.rest.len());
        self.angles = true;
        self.commas_part = most > 1 && !self.rest[..end].contains(';');
        let mut arguments = Vec::new();
        while arguments.len() < most {
            arguments.push(self.sum(depth + 1)?);
            let parted = self.takes(";") || (self.commas_part && self.takes(","));
            if !parted {
                break;
            }
        }
        (self.angles, self.commas_part) = outer;
        self.takes(")").then_some(arguments)
    }

    /// Digits with at most one comma or point, and an exponent.
    fn number(&mut self) -> Option<Node> {
        let digits = |bytes: &[u8]| bytes.iter().take_while(|byte| byte.is_ascii_digit()).count();
        let bytes = self.rest.as_bytes();
        let mut length = digits(bytes);
        let is_decimal = |byte: Option<&u8>| match byte {
            Some(b'.') => true,
            Some(b',') => !self.commas_part,
            _ => false,
        };
        if is_decimal(bytes.get(length)) {
            length += 1 + digits(&bytes[length + 1..]);
        }
        if matches!(bytes.get(length), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
            let exponent = digits(bytes.get(length + 1 + sign..).unwrap_or_default());
            length += if exponent > 0 { 1 + sign + exponent } else { 0 };
        }
        let (number, rest) = self.rest.split_at(length);
        self.rest = rest.trim_start();
        number.replace(',', ".").parse().ok().map(Node::Number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn work_out(text: &str, old: f64, index: usize) -> Option<f64> {
        Formula::parse(text, false)?.value(Instance { old, index, count: 4 })
    }

    #[test]
    fn formulas_see_the_old_value_and_the_place() {
        for (text, expected) in [
            ("2", 2.0),
            ("0,5", 0.5),
            ("=x+0.5*i", 4.0),
            ("x + 0,5 * i", 4.0),
            ("*2", 6.0),
            ("/ 2", 1.5),
            ("+=0.1", 3.1),
            ("-= 1", 2.0),
            ("*2+1", 7.0),
            ("*=2+1", 9.0),
            ("=i/(n-1)", 2.0 / 3.0),
            ("sqrt(2)^2", libm::sqrt(2.0) * libm::sqrt(2.0)),
            ("sqrt(2,25)", 1.5),
            ("sin(30°)", libm::sin(30f64.to_radians())),
            ("2*sin(pi/6 rad)", 2.0 * libm::sin(PI / 6.0)),
            ("max(1,2)", 2.0),
            ("max(1,5;2)", 2.0),
            ("-2^2", -4.0),
            ("2^3^2", 512.0),
            ("−3", -3.0),
            ("atan2(1, 1)*4", PI),
            ("mod(i, 2)", 0.0),
            ("1e-3", 1e-3),
        ] {
            let found = work_out(text, 3.0, 2);
            assert!(
                found.is_some_and(|found| (found - expected).abs() < 1e-15 * expected.abs())
                    || found == Some(expected),
                "{text}: {found:?}"
            );
        }
    }

    #[test]
    fn what_is_no_formula_is_refused() {
        for text in [
            "", "=", "abc", "1.234,5", "1e400", "30°", "max(1)", "sin", "sin 1", "rand(1)", "2 3", "((1)",
            "1/0", "x1", "pin",
        ] {
            assert_eq!(work_out(text, 1.0, 0), None, "{text}");
        }
        assert_eq!(Formula::parse(&"(".repeat(10_000), false), None);
        assert_eq!(Formula::parse(&"-".repeat(10_000), false), None);
        assert_eq!(Formula::parse(&"sin(".repeat(10_000), false), None);
        assert_eq!(Formula::parse(&format!("{}1", "1+".repeat(200_000)), false), None);
        assert_eq!(Formula::parse(&format!("{}1", "1*".repeat(200_000)), false), None);
    }

    #[test]
    fn random_numbers_are_the_same_for_the_same_seed() {
        let draw = |text, index| work_out(text, 0.0, index).unwrap();
        let first: Vec<f64> = (0..100).map(|index| draw("rand(1,2)", index)).collect();
        assert!(first.iter().all(|value| (1.0..2.0).contains(value)));
        let mean = first.iter().sum::<f64>() / 100.0;
        assert!((mean - 1.5).abs() < 0.1, "{mean}");
        assert_eq!(draw("rand(1, 2)", 7), draw("rand(1;2;1)", 7));
        assert_ne!(draw("rand(1,2)", 7), draw("rand(1,2,2)", 7));
        assert_ne!(draw("rand(1,2)-rand(1,2)", 7), 0.0);
        assert!(!Formula::parse("rand(1,2)", false).unwrap().is_constant());
        assert!(Formula::parse("2*pi", false).unwrap().is_constant());
    }
}
