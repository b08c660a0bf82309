//! The verb `everyday` through the real program: rows, failures with their commands, JSON, files, refusals.

use std::process::{Command, Output};

fn everyday(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_polyscene")).arg("everyday").args(arguments).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

const SMALL: [&str; 8] = ["--family", "tray,hall", "--n", "2,3", "--e", "0.5,1", "--until", "0.2"];

#[test]
fn a_row_for_each_family_and_size() {
    let output = everyday(&SMALL);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let text = said(&output);
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().take(4).collect()).collect();
    assert_eq!(
        rows,
        [
            ["family", "n", "scenes", "missed"],
            ["hall", "2", "2", "–"],
            ["hall", "3", "2", "–"],
            ["tray", "2", "2", "–"],
            ["tray", "3", "2", "–"],
        ],
        "{text}"
    );
}

#[test]
fn a_failure_comes_with_the_command_that_repeats_it() {
    let slow = ["--family", "gas", "--n", "100", "--e", "1", "--until", "1000", "--max-wall", "0.02"];
    let output = everyday(&slow);
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let text = said(&output);
    assert!(text.contains("1 stall"), "{text}");
    let command = "polyscene everyday --family gas --n 100 --e 1 --seed 1 --until 1000 --max-wall 0.02\n";
    assert!(text.contains(command), "{text}");
    assert!(text.contains("1 of 1 scenes miss a demand"), "{text}");
}

#[test]
fn json_has_every_scene_in_order_whatever_the_jobs() {
    let keys = |jobs: &str| -> Vec<String> {
        let output = everyday(&[&SMALL[..], &["--jobs", jobs, "--json"]].concat());
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(report["until"], 0.2);
        let scenes = report["scenes"].as_array().unwrap();
        assert!(scenes.iter().all(|scene| scene["missed"].as_array().unwrap().is_empty()), "{report}");
        scenes.iter().map(|scene| format!("{} {}", scene["command"], scene["events"])).collect()
    };
    assert_eq!(keys("1").len(), 8);
    assert_eq!(keys("1"), keys("3"));
}

#[test]
fn scenes_are_written_as_files_that_run() {
    let folder = tempfile::tempdir().unwrap();
    let name = folder.path().to_str().unwrap();
    let write = ["--family", "stack", "--n", "5", "--e", "0.3", "--seed", "7", "--write", name];
    let output = everyday(&write);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let path = folder.path().join("stack-5-0.3-7.xml");
    let refused = everyday(&write);
    assert!(refused.status.code() == Some(2) && said(&refused).contains("--force"), "{}", said(&refused));
    assert_eq!(everyday(&[&write[..], &["--force"]].concat()).status.code(), Some(0));
    let mut run = Command::new(env!("CARGO_BIN_EXE_polyscene"));
    let output = run.args(["run", "--until", "0.1"]).arg(path).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(said(&output).contains("5 dynamic"), "{}", said(&output));
}

#[test]
fn markdown_changes_only_what_stands_between_the_marks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.md");
    let name = path.to_str().unwrap();
    std::fs::write(&path, "no marks").unwrap();
    let arguments = [&SMALL[..], &["--markdown", name]].concat();
    let refused = everyday(&arguments);
    assert_eq!(refused.status.code(), Some(2), "{}", said(&refused));
    let (begin, end) = ("<!-- everyday scenes: begin -->\n", "<!-- everyday scenes: end -->");
    std::fs::write(&path, format!("before\n{begin}old\n{end}\nafter\n")).unwrap();
    assert_eq!(everyday(&arguments).status.code(), Some(0));
    let written = std::fs::read_to_string(&path).unwrap();
    assert!(written.starts_with(&format!("before\n{begin}| family |")), "{written}");
    assert!(written.ends_with(&format!(" |\n{end}\nafter\n")), "{written}");
    assert!(!written.contains("old"), "{written}");
}

#[test]
fn what_makes_no_scene_is_refused() {
    let cases: [(&[&str], &str); 4] = [
        (&["--family", "volcano"], "crate"),
        (&["--e", "1.5"], "from 0 to 1"),
        (&["--n", "0"], "--n"),
        (&["--write", "x", "--json"], "--json"),
    ];
    for (arguments, hint) in cases {
        let output = everyday(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(said(&output).contains(hint), "{arguments:?}: {}", said(&output));
    }
}
