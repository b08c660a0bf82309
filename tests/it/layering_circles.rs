//! Files of one layer import each other in one direction: no circles. Types that two files need lie in a file below both.
//!
//! What is seen: `use` and paths in the code, followed through re-exports to the file that defines the item. What is
//! not: methods, which no path names.

use std::collections::{BTreeMap, BTreeSet};

use super::layering::{read, root, rust_files, without_comments};

/// An import that may close a circle: file, imported file, reason.
type Exception = (&'static str, &'static str, &'static str);

/// Layers whose files are held to it.
const LAYERS: [&str; 4] = ["design", "sim", "record", "editor"];

const EXCEPTIONS: [Exception; 0] = [];

#[test]
fn files_of_a_layer_do_not_import_each_other_in_circles() {
    let allowed: Vec<(&str, &str)> = EXCEPTIONS.iter().map(|(from, to, _)| (*from, *to)).collect();
    let (mut circles, mut needed) = (Vec::new(), BTreeSet::new());
    for layer in LAYERS.map(Layer::on_disk) {
        circles.extend(layer.circles(&allowed));
        needed.extend(allowed.iter().copied().filter(|pair| layer.imports().contains(pair)));
    }
    assert!(circles.is_empty(), "files that import each other in a circle:\n{}", circles.join("\n"));
    let gone: Vec<_> = allowed.iter().filter(|pair| !needed.contains(pair)).collect();
    assert!(gone.is_empty(), "exceptions for imports that are no longer there: {gone:#?}");
}

/// What it shows, the files with their texts, and the imports that must be found.
type ScanCase = (&'static str, &'static [(&'static str, &'static str)], &'static [&'static str]);

#[test]
fn the_scan_follows_paths_to_the_file_that_defines_the_item() {
    let cases: [ScanCase; 11] = [
        ("a path to a sibling", &[("x/a.rs", "use super::b::B;"), ("x/b.rs", "pub struct B;")], &["a b"]),
        (
            "a group, an alias and a glob",
            &[
                ("x/a.rs", "use super::{b::{self, B as C}, c::*};\nfn f(_: C) { b::f() }"),
                ("x/b.rs", "pub struct B;\npub fn f() {}"),
                ("x/c.rs", "pub const D: u8 = 0;"),
            ],
            &["a b", "a c"],
        ),
        (
            "a re-export leads to the child",
            &[
                ("x/mod.rs", "mod b;\npub(super) use b::B;"),
                ("x/a.rs", "use super::B;"),
                ("x/b.rs", "struct B;"),
            ],
            &["a b"],
        ),
        (
            "an item of mod.rs itself",
            &[("x/mod.rs", "mod b;\npub use b::B;\npub trait T {}"), ("x/b.rs", "use super::T;\nstruct B;")],
            &["b mod"],
        ),
        (
            "a re-export of a re-export",
            &[
                ("x/mod.rs", "pub use y::B;"),
                ("x/y/mod.rs", "mod b;\npub use b::B;"),
                ("x/y/b.rs", "pub struct B;"),
                ("x/a.rs", "use crate::x::B;"),
            ],
            &["a y/b"],
        ),
        (
            "a module that is imported, and what is used of it",
            &[("x/a.rs", "use super::b;\nfn f() { b::g() }"), ("x/b.rs", "pub(super) fn g() {}")],
            &["a b"],
        ),
        ("a module that is imported and not used", &[("x/a.rs", "use super::b;"), ("x/b.rs", "")], &[]),
        (
            "a path in the code",
            &[("x/a.rs", "fn f() -> u8 { crate::x::b::g() + super::b::H }"), ("x/b.rs", "pub fn g() {}")],
            &["a b"],
        ),
        (
            "what a function and a module are both called",
            &[
                ("x/mod.rs", "mod b;\nfn b() { b::g() }"),
                ("x/b.rs", "fn g() {}"),
                ("x/a.rs", "use super::b;"),
            ],
            &["a mod", "mod b"],
        ),
        (
            "comments, strings, unit tests and other layers",
            &[
                (
                    "x/a.rs",
                    "// super::b::B\nconst T: &str = \"use super::b::B;\"; // use super::b::B;\nuse crate::y::B;",
                ),
                ("x/b.rs", "struct B;\n#[cfg(test)]\nmod tests {\n    use super::super::a::T;\n}\n"),
            ],
            &[],
        ),
        (
            "unit tests in a file of their own",
            &[
                ("x/mod.rs", "mod a;\n#[cfg(test)]\nmod tests;\n\nuse a::B;\npub struct T;\nfn f(_: B) {}\n"),
                ("x/a.rs", "use super::T;\npub struct B;"),
            ],
            &["a mod", "mod a"],
        ),
    ];
    for (what, files, expected) in cases {
        let layer = Layer::new(files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())));
        let short = |file: &str| file.trim_start_matches("x/").trim_end_matches(".rs").to_owned();
        let found: Vec<String> =
            layer.imports().iter().map(|(from, to)| format!("{} {}", short(from), short(to))).collect();
        assert_eq!(found, expected, "{what}");
    }
}

#[test]
fn a_circle_is_found_over_several_files_and_opened_by_an_exception() {
    let files = [
        ("x/a.rs", "use super::b::B;\npub struct A;"),
        ("x/b.rs", "use super::c::C;\npub struct B;"),
        ("x/c.rs", "use super::a::A;\npub struct C;"),
        ("x/d.rs", "use super::a::A;"),
    ];
    let layer = Layer::new(files.map(|(file, text)| (file.to_owned(), text.to_owned())));
    let circles = layer.circles(&[]);
    assert_eq!(circles.len(), 1, "{circles:?}");
    assert!(circles[0].starts_with("x/a.rs, x/b.rs, x/c.rs:\n  x/a.rs imports x/b.rs"), "{}", circles[0]);
    assert_eq!(layer.circles(&[("x/c.rs", "x/a.rs")]), Vec::<String>::new());
}

/// The modules of a layer by their paths, such as `["sim", "motion", "law"]`.
struct Layer {
    modules: BTreeMap<Vec<String>, Module>,
}

#[derive(Default)]
struct Module {
    /// Below `src`.
    file: String,
    imports: Vec<Import>,
    /// Paths in the code, outside `use`.
    paths: Vec<Vec<String>>,
    /// Items that the file itself defines, without child modules.
    items: BTreeSet<String>,
}

struct Import {
    path: Vec<String>,
    /// What the file calls it.
    name: String,
    is_reexport: bool,
}

/// What a path names.
enum Target {
    /// An item, by the module that defines it.
    Item(Vec<String>),
    /// A module as a whole: what is used of it, other paths say.
    Module,
    /// Another layer or crate.
    Outside,
}

impl Layer {
    fn on_disk(layer: &str) -> Self {
        let src = root().join("src");
        let files = rust_files(&format!("src/{layer}"));
        let name = |file: &std::path::Path| {
            let parts = file.strip_prefix(&src).expect("a file below src").iter();
            parts.map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
        };
        Self::new(files.iter().map(|file| (name(file), read(file))))
    }

    /// From names below `src` and texts.
    fn new(files: impl IntoIterator<Item = (String, String)>) -> Self {
        let mut modules = BTreeMap::new();
        for (file, text) in files {
            let parts = file.trim_end_matches(".rs").split('/').filter(|part| *part != "mod");
            let path: Vec<String> = parts.map(str::to_owned).collect();
            // The folder is a module even where a test leaves out its mod.rs.
            modules.entry(path[..path.len() - 1].to_vec()).or_insert_with(Module::default);
            modules.insert(path, Module::parse(file, &text));
        }
        modules.remove(&Vec::new());
        Self { modules }
    }

    /// Each circle as its files and the imports between them, without those that are allowed.
    fn circles(&self, allowed: &[(&str, &str)]) -> Vec<String> {
        let mut imports = self.imports();
        imports.retain(|pair| !allowed.contains(pair));
        let files: BTreeSet<&str> = imports.iter().map(|(from, _)| *from).collect();
        let (mut circles, mut seen) = (Vec::new(), BTreeSet::new());
        for file in files {
            let ahead = reachable(&imports, file);
            let circle: BTreeSet<&str> =
                ahead.iter().copied().filter(|other| reachable(&imports, other).contains(file)).collect();
            if circle.is_empty() || !seen.insert(circle.clone()) {
                continue;
            }
            let inside = imports.iter().filter(|(a, b)| circle.contains(a) && circle.contains(b));
            let lines: Vec<String> = inside.map(|(from, to)| format!("  {from} imports {to}")).collect();
            let names: Vec<&str> = circle.into_iter().collect();
            circles.push(format!("{}:\n{}", names.join(", "), lines.join("\n")));
        }
        circles
    }

    /// Which file imports which other one of the layer.
    fn imports(&self) -> BTreeSet<(&str, &str)> {
        let mut found = BTreeSet::new();
        for (at, module) in &self.modules {
            let used = module.imports.iter().filter(|import| !import.is_reexport).map(|import| &import.path);
            for path in used.chain(&module.paths) {
                if let Target::Item(owner) = self.resolve(at, path)
                    && owner != *at
                {
                    found.insert((module.file.as_str(), self.modules[&owner].file.as_str()));
                }
            }
        }
        found
    }

    fn resolve(&self, from: &[String], path: &[String]) -> Target {
        let mut at = from.to_vec();
        for (nth, name) in path.iter().enumerate() {
            match name.as_str() {
                "crate" => at.clear(),
                "self" => {}
                "super" => {
                    at.pop();
                }
                _ => {
                    let child = [at.as_slice(), std::slice::from_ref(name)].concat();
                    let is_last = nth + 1 == path.len();
                    let Some(module) = self.modules.get(&at) else {
                        if at.is_empty() && self.modules.contains_key(&child) {
                            at = child;
                            continue;
                        }
                        return Target::Outside;
                    };
                    if self.modules.contains_key(&child) && !(is_last && module.items.contains(name)) {
                        at = child;
                        continue;
                    }
                    if module.items.contains(name) || name == "*" {
                        return Target::Item(at);
                    }
                    return match module.imports.iter().find(|import| import.name == *name) {
                        Some(import) if import.path.first() == Some(name) => Target::Outside,
                        Some(import) => self.resolve(&at, &[&import.path, &path[nth + 1..]].concat()),
                        // A name of another crate, or one made by a macro of the module.
                        None if nth == 0 => Target::Outside,
                        None => Target::Item(at),
                    };
                }
            }
        }
        Target::Module
    }
}

/// The files that one imports, also by way of others.
fn reachable<'a>(imports: &BTreeSet<(&'a str, &'a str)>, from: &str) -> BTreeSet<&'a str> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(file) = open.pop() {
        for (_, to) in imports.iter().filter(|(from, _)| *from == file) {
            if found.insert(*to) {
                open.push(to);
            }
        }
    }
    found
}

impl Module {
    fn parse(file: String, text: &str) -> Self {
        let tokens = tokens(&without_unit_tests(&without_comments(text)));
        let mut module = Self { file, ..Self::default() };
        let (mut at, mut depth) = (0, 0_usize);
        while let Some(token) = tokens.get(at) {
            match token.as_str() {
                "{" => depth += 1,
                "}" => depth = depth.saturating_sub(1),
                "use" => {
                    let is_reexport = at > 0 && matches!(tokens[at - 1].as_str(), "pub" | ")");
                    at += 1;
                    module.read_use(&tokens, &mut at, &[], is_reexport);
                }
                "fn" | "struct" | "enum" | "trait" | "type" | "const" | "static" | "union" if depth == 0 => {
                    module.items.extend(tokens.get(at + 1).filter(|name| is_name(name)).cloned());
                }
                "macro_rules" => module.items.extend(tokens.get(at + 2).cloned()),
                name if is_name(name) && tokens.get(at + 1).is_some_and(|next| next == "::") => {
                    let mut path = vec![name.to_owned()];
                    while tokens.get(at + 1).is_some_and(|next| next == "::")
                        && tokens.get(at + 2).is_some_and(|next| is_name(next))
                    {
                        path.push(tokens[at + 2].clone());
                        at += 2;
                    }
                    module.paths.push(path);
                }
                _ => {}
            }
            at += 1;
        }
        module
    }

    /// One path or `{…}` of paths; leaves `at` on what follows.
    fn read_use(&mut self, tokens: &[String], at: &mut usize, head: &[String], is_reexport: bool) {
        let mut path = head.to_vec();
        while let Some(token) = tokens.get(*at) {
            match token.as_str() {
                "::" => *at += 1,
                "{" => {
                    *at += 1;
                    while tokens.get(*at).is_some_and(|token| token != "}") {
                        self.read_use(tokens, at, &path, is_reexport);
                        *at += usize::from(tokens.get(*at).is_some_and(|token| token == ","));
                    }
                    *at += 1;
                    return;
                }
                name if is_name(name) || name == "*" => {
                    path.push(name.to_owned());
                    *at += 1;
                }
                _ => break,
            }
        }
        let alias = path.iter().position(|name| name == "as").map(|place| path.split_off(place));
        if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        let name = alias.as_ref().and_then(|alias| alias.last()).or(path.last()).cloned();
        self.imports.extend(name.map(|name| Import { path, name, is_reexport }));
    }
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_') && !matches!(token, "fn" | "in" | "mut")
}

/// Names, `::` and single other characters; a string or a character is one `"`.
fn tokens(code: &str) -> Vec<String> {
    let (mut found, mut rest) = (Vec::new(), code);
    while let Some(first) = rest.chars().next() {
        let length = literal_length(rest).unwrap_or_else(|| {
            if first.is_alphanumeric() || first == '_' {
                rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len())
            } else if rest.starts_with("::") {
                2
            } else {
                first.len_utf8()
            }
        });
        match first {
            '"' | '\'' => found.push("\"".to_owned()),
            _ if rest.starts_with("//") || first.is_whitespace() => {}
            _ => found.push(rest[..length].to_owned()),
        }
        rest = &rest[length..];
    }
    found
}

/// Length of the string, character or comment that the code starts with. A lifetime is none of them.
fn literal_length(code: &str) -> Option<usize> {
    if code.starts_with("//") {
        return Some(code.find('\n').unwrap_or(code.len()));
    }
    let quote = code.chars().next().filter(|first| matches!(first, '"' | '\''))?;
    let mut inside = code.char_indices().skip(1);
    while let Some((at, c)) = inside.next() {
        match c {
            '\\' => {
                inside.next();
            }
            _ if c == quote => return Some(at + 1),
            // A character is short: `'{'`, `'\u{1F5CB}'`.
            _ if quote == '\'' && !code[1..].starts_with('\\') && at > c.len_utf8() => return None,
            _ => {}
        }
    }
    None
}

/// Without `#[cfg(test)] mod tests { … }`, which sees its own file from inside.
fn without_unit_tests(code: &str) -> String {
    let Some((before, tests)) = code.split_once("#[cfg(test)]\nmod ") else { return code.to_owned() };
    // One in a file of its own is a line here.
    let is_line = tests.lines().next().is_some_and(|line| line.ends_with(';'));
    let end = if is_line { "\n" } else { "\n}\n" };
    let after = tests.split_once(end).map_or("", |(_, after)| after);
    format!("{before}{after}")
}
