//! What the README shows of the command line is what the program prints.

use std::process::{Command, Stdio};

use super::outcome;

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
        // How quick it was differs from run to run.
        let timeless = |line: &&str| !line.starts_with("  speed ");
        let (printed, shown): (Vec<&str>, Vec<&str>) =
            (printed.filter(timeless).collect(), shown.into_iter().filter(timeless).collect());
        assert_eq!(printed, shown, "{command}");
        compared += 1;
    }
    assert!(compared >= 3, "only {compared} examples show output");
}
