//! Numbers as people type them: `0,01`, `1/60`, `2*3`, `pi/6`, angles also as `30deg` or `30°`.

use std::f64::consts::PI;

/// How deep brackets and signs may nest; text from a clipboard can hold anything.
const DEEPEST: usize = 32;

/// Reads a number, or a sum, product or fraction of numbers, with comma or point.
/// `None` for anything else and for what is not finite.
pub fn parse_number(text: &str) -> Option<f64> {
    parse(text, false)
}

/// As [`parse_number`], in radians; numbers may be followed by `°` or `deg`.
pub fn parse_angle(text: &str) -> Option<f64> {
    parse(text, true)
}

fn parse(text: &str, angles: bool) -> Option<f64> {
    let mut reader = Reader { rest: text.trim(), angles };
    let value = reader.sum(0)?;
    (reader.rest.is_empty() && value.is_finite()).then_some(value)
}

struct Reader<'a> {
    rest: &'a str,
    angles: bool,
}

impl Reader<'_> {
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

    fn sum(&mut self, depth: usize) -> Option<f64> {
        let mut value = self.product(depth)?;
        loop {
            if self.takes("+") {
                value += self.product(depth)?;
            } else if self.takes("-") {
                value -= self.product(depth)?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self, depth: usize) -> Option<f64> {
        let mut value = self.factor(depth)?;
        loop {
            if self.takes("*") {
                value *= self.factor(depth)?;
            } else if self.takes("/") {
                value /= self.factor(depth)?;
            } else {
                return Some(value);
            }
        }
    }

    fn factor(&mut self, depth: usize) -> Option<f64> {
        if depth > DEEPEST {
            return None;
        }
        if self.takes("-") {
            return Some(-self.factor(depth + 1)?);
        }
        if self.takes("+") {
            return self.factor(depth + 1);
        }
        let value = if self.takes("(") {
            let value = self.sum(depth + 1)?;
            if !self.takes(")") {
                return None;
            }
            value
        } else if self.takes("pi") || self.takes("π") {
            PI
        } else {
            self.number()?
        };
        let in_degrees = self.angles && (self.takes("°") || self.takes("deg"));
        Some(if in_degrees { value.to_radians() } else { value })
    }

    /// Digits with at most one comma or point, and an exponent.
    fn number(&mut self) -> Option<f64> {
        let digits = |bytes: &[u8]| bytes.iter().take_while(|byte| byte.is_ascii_digit()).count();
        let bytes = self.rest.as_bytes();
        let mut length = digits(bytes);
        if matches!(bytes.get(length), Some(b'.' | b',')) {
            length += 1 + digits(&bytes[length + 1..]);
        }
        if matches!(bytes.get(length), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
            let exponent = digits(bytes.get(length + 1 + sign..).unwrap_or_default());
            length += if exponent > 0 { 1 + sign + exponent } else { 0 };
        }
        let (number, rest) = self.rest.split_at(length);
        self.rest = rest.trim_start();
        number.replace(',', ".").parse().ok()
    }
}
