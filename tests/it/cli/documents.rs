//! What the documents show is true: the README's commands, the scene of the format's page.

use std::path::Path;

use polyscene::cli::examine;
use polyscene::scene::Document;
use polyscene::sim::Method;

use super::{Bench, Outcome};

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

/// Without the figures of the wall clock, the only ones that differ from run to run.
fn lasting(line: &str) -> &str {
    if line.starts_with("  speed ") { "  speed …" } else { line }
}

/// Runs a command line of the README in a folder with the scenes that it names.
fn run(command: &str) -> Outcome {
    let bench = Bench::new();
    let arguments: Vec<&str> = command.split_whitespace().skip(1).take_while(|word| *word != "#").collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for scene in arguments.iter().filter(|word| word.starts_with("scenes/")) {
        let copy = bench.path(scene);
        std::fs::create_dir_all(copy.parent().expect("a folder")).expect("a folder in the temporary one");
        std::fs::copy(root.join(scene), copy).expect("a scene of the repository");
    }
    bench.polyscene(&arguments)
}

#[test]
fn the_examples_of_the_readme_print_what_it_shows() {
    let mut compared = 0;
    for (command, shown) in examples() {
        let (command, only_first) =
            command.strip_suffix(" | head -1").map_or((command, false), |c| (c, true));
        let outcome = run(command);
        assert!(outcome.code == 0 || command.contains("invalid"), "{command}: {}", outcome.stderr);
        if shown.is_empty() {
            continue;
        }
        let lines = outcome.stdout.lines().take(if only_first { 1 } else { usize::MAX });
        let printed: Vec<&str> = lines.map(lasting).collect();
        let shown: Vec<&str> = shown.into_iter().map(lasting).collect();
        assert_eq!(printed, shown, "{command} prints\n{}", outcome.stdout);
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
    assert_eq!(examined.document.reasons_for_1_1().len(), 6, "drag, friction of three kinds, spin, solver");
}
