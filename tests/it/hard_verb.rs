//! The verb `hard-cases` through the real program: text, JSON, the table in a Markdown file, refusals.

use std::process::{Command, Output};

fn hard_cases(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_polyscene")).arg("hard-cases").args(arguments).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

#[test]
fn a_case_is_found_by_its_number_and_its_name() {
    let by_name = hard_cases(&["--case", "throw"]);
    assert_eq!(by_name.status.code(), Some(0), "{}", said(&by_name));
    assert!(said(&by_name).contains("Ballistic throw"), "{}", said(&by_name));
    assert!(!said(&by_name).contains("Elastic bounce"), "{}", said(&by_name));
    assert_eq!(hard_cases(&["--case", "1"]).stdout, by_name.stdout, "the same bits of every figure");
    let closing = String::from_utf8_lossy(&by_name.stderr).into_owned();
    assert!(closing.starts_with("polyscene: 1 case, 1 held, ") && closing.ends_with(" s\n"), "{closing}");
    let unknown = hard_cases(&["--case", "perpetual-motion"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(said(&unknown).contains("billiard"), "{}", said(&unknown));
}

#[test]
fn json_has_every_figure_at_every_step() {
    let output = hard_cases(&["--case", "bounce", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["dt"].as_array().unwrap().len(), 3);
    let figures = report["cases"][0]["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 4);
    for figure in figures {
        assert_eq!(figure["values"].as_array().unwrap().len(), 3, "{figure}");
        assert_eq!(figure["held"], true, "{figure}");
    }
}

#[test]
fn markdown_changes_only_what_stands_between_the_marks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.md");
    let name = path.to_str().unwrap();
    std::fs::write(&path, "no marks").unwrap();
    let refused = hard_cases(&["--case", "throw", "--markdown", name]);
    assert_eq!(refused.status.code(), Some(2), "{}", said(&refused));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "no marks");
    let (begin, end) = ("<!-- hard cases: begin -->\n", "<!-- hard cases: end -->");
    std::fs::write(&path, format!("before\n{begin}old\n{end}\nafter\n")).unwrap();
    let output = hard_cases(&["--case", "throw", "--markdown", name]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let written = std::fs::read_to_string(&path).unwrap();
    assert!(written.starts_with(&format!("before\n{begin}| # |")), "{written}");
    assert!(written.ends_with(&format!(" |\n{end}\nafter\n")), "{written}");
    assert!(written.contains("Ballistic throw") && !written.contains("old"), "{written}");
}
