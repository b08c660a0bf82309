//! What the documents show is true: the README's commands, the scene of the format's page.

use std::process::{Command, Stdio};

use polyscene::cli::examine;
use polyscene::scene::Document;
use polyscene::sim::Method;

use super::outcome;

const FORMAT: &str = include_str!("../../../docs/format.md");
const README: &str = include_str!("../../../README.md");

/// The commands of the README's console block, each with the lines that follow it.
fn examples() -> Vec<(&'static str, Vec<&'static str>)> {
    let block = README.split("```console\n").nth(1).and_then(|rest| rest.split("```").next());
    let mut examples: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in block.expect("a console block").lines().filter(|line| !line.is_empty()) {
        match (line.strip_prefix("$ "), examples.last_mut()) {
            (Some(command), _) => examples.push((command, Vec::new())),
            (None, Some((_, output))) => output.push(line),
            (None, None) => panic!("output before the first command: {line}"),
        }
    }
    examples
}

/// Whether a line stays the same from run to run and from version to version.
fn is_lasting(line: &&str) -> bool {
    !line.starts_with("  speed ") && !line.starts_with("  hash ")
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split([' ', ',', ':', ';', '[', ']', '(', ')'])
}

/// The same words, and the same numbers to six digits: the last bits are no promise between versions.
fn alike(one: &str, other: &str) -> bool {
    words(one).count() == words(other).count()
        && words(one).zip(words(other)).all(|(one, other)| match (one.parse::<f64>(), other.parse::<f64>()) {
            (Ok(one), Ok(other)) => (one - other).abs() <= 1e-6 * one.abs().max(1.0),
            _ => one == other,
        })
}

#[test]
fn the_examples_of_the_readme_print_what_it_shows() {
    let mut compared = 0;
    for (command, shown) in examples().into_iter().filter(|(_, shown)| !shown.is_empty()) {
        let (command, only_first) =
            command.strip_suffix(" | head -1").map_or((command, false), |c| (c, true));
        let output = Command::new(env!("CARGO_BIN_EXE_polyscene"))
            .args(command.split(' ').skip(1))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .stdin(Stdio::null())
            .output();
        let stdout = outcome(output.expect("the program starts")).stdout;
        let printed = stdout.lines().take(if only_first { 1 } else { usize::MAX });
        let (printed, shown): (Vec<&str>, Vec<&str>) =
            (printed.filter(is_lasting).collect(), shown.into_iter().filter(is_lasting).collect());
        assert_eq!(printed.len(), shown.len(), "{command} prints\n{stdout}");
        for (printed, shown) in printed.into_iter().zip(shown) {
            assert!(alike(printed, shown), "{command} prints\n{printed}\nand not\n{shown}");
        }
        compared += 1;
    }
    assert!(compared >= 3, "only {compared} examples show output");
}

#[test]
fn the_scene_of_the_formats_page_is_sound_and_uses_1_1() {
    let xml = FORMAT.split("```xml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a scene");
    let examined = examine(Document::from_bytes(xml.as_bytes()), Method::Exact);
    assert_eq!(examined.lines("format.md"), [""; 0]);
    assert!(examined.simulation.is_some());
    assert_eq!(examined.document.reasons_for_1_1().len(), 2, "drag and solver");
}
