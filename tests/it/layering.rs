//! The rules of the source tree: layers import downwards only, files and functions stay short.

use std::fs;
use std::path::{Path, PathBuf};

/// Each layer and what it may import, besides itself. ARCHITECTURE.md says what each holds.
const LAYERS: [(&str, &[&str]); 13] = [
    ("random", &[]),
    ("scene", &[]),
    ("design", &["random", "scene"]),
    ("sim", &["random", "scene"]),
    ("record", &["scene", "sim"]),
    ("export", &["scene", "sim", "record"]),
    ("import", &["scene", "export"]),
    ("study", &["random", "scene", "sim", "record"]),
    ("view", &["scene", "design", "sim", "record", "study"]),
    ("render", &["scene", "sim", "record", "study", "view"]),
    ("editor", &["scene", "import", "design", "sim", "record", "study", "view"]),
    ("gui", &["scene", "export", "import", "design", "sim", "record", "study", "view", "render", "editor"]),
    ("cli", &["scene", "export", "import", "design", "sim", "record", "study", "view", "render"]),
];

/// What a layer must not name, because it knows nothing of it.
const STRANGERS: [(&str, &[&str]); 11] = [
    ("design", &["std::time", "std::fs", "egui", "glow", "three_d", "clap"]),
    ("export", &["std::time", "std::fs", "egui", "glow", "three_d", "clap"]),
    ("import", &["std::time", "std::fs", "egui", "glow", "three_d", "clap"]),
    ("scene", &["std::time", "egui", "glow", "three_d", "clap"]),
    ("sim", &["std::time", "std::fs", "egui", "glow", "three_d", "clap"]),
    ("record", &["egui", "glow", "three_d", "clap"]),
    ("study", &["egui", "glow", "three_d", "clap"]),
    ("view", &["egui", "glow", "three_d", "clap"]),
    ("render", &["egui", "clap"]),
    ("editor", &["egui", "glow", "three_d", "clap"]),
    ("cli", &["egui", "glow", "three_d"]),
];

const MAX_FILE_LINES: usize = 500;
const MAX_FN_LINES: usize = 60;
/// Panels are long lists of widgets; splitting them further hides the order on the screen.
const MAX_UI_FN_LINES: usize = 100;

/// Functions that may be longer, each with the reason.
const LONG_FUNCTIONS: [(&str, &str); 0] = [];

#[test]
fn layers_import_downwards_only() {
    let mut upward = Vec::new();
    for file in rust_files("src") {
        let Some(module) = module_path(&file) else { continue };
        let allowed = LAYERS
            .iter()
            .find(|(layer, _)| *layer == module[0])
            .unwrap_or_else(|| panic!("{}: `{}` is not in the table of layers", file.display(), module[0]))
            .1;
        for layer in imported_layers(&read(&file), module.len()) {
            if layer != module[0] && !allowed.contains(&layer.as_str()) {
                upward.push(format!("{}: {} imports {layer}", file.display(), module[0]));
            }
        }
    }
    assert!(upward.is_empty(), "upward imports:\n{}", upward.join("\n"));
}

#[test]
fn the_scan_sees_every_way_to_name_a_layer() {
    let cases = [
        ("use crate::gui::App;", &["gui"][..]),
        ("use crate::{scene::Body, sim};", &["scene", "sim"]),
        ("use crate::{\n    scene::{Body, view},\n    editor::Command,\n};", &["scene", "editor"]),
        ("let x = crate::view::camera();", &["view"]),
        ("use super::super::gui::App;", &["gui"]),
        ("use super::super::{editor, scene::Body};", &["editor", "scene"]),
        ("use super::gui::not_the_layer;", &[]),
        ("// use crate::gui::App;", &[]),
        ("/// See [`crate::gui::App`].", &[]),
    ];
    for (text, expected) in cases {
        assert_eq!(imported_layers(text, 2), expected, "in `{text}`");
    }
}

#[test]
fn layers_name_nothing_they_know_nothing_of() {
    let mut problems = Vec::new();
    for (layer, strangers) in STRANGERS {
        for file in rust_files(&format!("src/{layer}")) {
            let code = without_comments(&read(&file));
            for stranger in strangers.iter().filter(|stranger| code.contains(**stranger)) {
                problems.push(format!("{}: {layer} knows nothing of {stranger}", file.display()));
            }
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn files_open_with_their_subject_and_stay_short() {
    let mut problems = Vec::new();
    for file in rust_files("src").into_iter().chain(rust_files("tests")) {
        let text = read(&file);
        if !text.starts_with("//! ") {
            problems.push(format!("{}: the first line must be `//! ` and the subject", file.display()));
        }
        let lines = text.lines().count();
        if lines > MAX_FILE_LINES {
            problems.push(format!("{}: {lines} lines, at most {MAX_FILE_LINES}", file.display()));
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn functions_stay_short() {
    let mut problems = Vec::new();
    for file in rust_files("src") {
        let is_ui = module_path(&file).is_some_and(|module| module[0] == "gui");
        let limit = if is_ui { MAX_UI_FN_LINES } else { MAX_FN_LINES };
        for (name, lines) in functions(&read(&file)) {
            if lines > limit && !LONG_FUNCTIONS.iter().any(|(long, _)| *long == name) {
                problems.push(format!("{}: {name} has {lines} lines, at most {limit}", file.display()));
            }
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn function_lengths_are_counted() {
    let text = "impl A {\n    pub fn one(&self) -> u8 {\n        1\n    }\n\n    fn two(\n        x: u8,\n    ) -> u8 {\n        x\n    }\n}\n\nfn three() {}\n";
    let found = functions(text);
    assert_eq!(found, [("one".into(), 3), ("two".into(), 5), ("three".into(), 1)]);
}

/// `[layer, …]` of a file in a layer's folder; `None` for `lib.rs` and `main.rs`, which see all layers.
fn module_path(file: &Path) -> Option<Vec<String>> {
    let inside = file.strip_prefix(root().join("src")).ok()?.with_extension("");
    let mut module: Vec<String> = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if module.last().is_some_and(|last| last == "mod") {
        module.pop();
    }
    (!matches!(module[0].as_str(), "lib" | "main")).then_some(module)
}

/// The layers that a file names, by `crate::` or by enough `super::` to reach the crate's root.
fn imported_layers(text: &str, module_depth: usize) -> Vec<String> {
    let code = without_comments(text);
    let to_root = "super::".repeat(module_depth);
    let mut found = Vec::new();
    for prefix in ["crate::", &to_root] {
        for (at, _) in code.match_indices(prefix) {
            found.extend(path_heads(&code[at + prefix.len()..]));
        }
    }
    found.retain(|name| LAYERS.iter().any(|(layer, _)| layer == name));
    found
}

pub(super) fn without_comments(text: &str) -> String {
    text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// First names of the path, or of each path of the `{…}` group, that `text` starts with.
fn path_heads(text: &str) -> Vec<String> {
    let identifier = |text: &str| -> String {
        text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let Some(group) = text.strip_prefix('{') else { return vec![identifier(text)] };
    let (mut heads, mut depth) = (vec![identifier(group)], 0_usize);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => heads.push(identifier(&group[at + 1..])),
            _ => {}
        }
    }
    heads
}

/// Name and number of lines of each function, relying on rustfmt: it ends at a `}` indented as its head.
fn functions(text: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let Some(name) = function_name(line) else { continue };
        let indent = &line[..line.len() - line.trim_start().len()];
        let closing = format!("{indent}}}");
        let one_line = line.ends_with('}') || line.ends_with(';');
        let rest = lines[start..].iter().position(|line| one_line || **line == closing);
        found.push((name, rest.unwrap_or(0) + 1));
    }
    found
}

fn function_name(line: &str) -> Option<String> {
    let mut words = line.trim_start().split_inclusive([' ', '(', '<']);
    loop {
        match words.next()?.trim_end() {
            "fn" => return Some(words.next()?.trim_end_matches([' ', '(', '<']).into()),
            "pub" | "const" | "async" | "unsafe" | "pub(" | "crate)" | "super)" => {}
            _ => return None,
        }
    }
}

pub(super) fn rust_files(folder: &str) -> Vec<PathBuf> {
    let mut folders = vec![root().join(folder)];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a source folder") {
            let path = entry.expect("a folder entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

pub(super) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

pub(super) fn read(file: &Path) -> String {
    fs::read_to_string(file).expect("a source file")
}
