//! One small file per rule of the reader in scenes/invalid, and what is said about each.

use std::fs;
use std::path::Path;

use polyscene::scene::Document;

#[test]
fn every_rule_has_a_file_and_a_clear_message() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/invalid");
    let mut files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect::<Vec<_>>();
    files.sort();
    let mut report = String::new();
    for file in files {
        let name = file.file_stem().unwrap().to_str().unwrap().to_owned();
        let document = Document::open(&file);
        assert_eq!(document.has_errors(), !name.starts_with("warning-"), "{name}");
        assert!(!document.diagnostics().is_empty(), "{name}");
        assert_eq!(document.to_bytes(), fs::read(&file).unwrap(), "{name} does not round-trip");
        report += &format!("{name}\n");
        for diagnostic in document.diagnostics() {
            assert!(diagnostic.position.is_some(), "{name}: {diagnostic}");
            report += &format!("  {diagnostic}\n");
        }
    }
    insta::assert_snapshot!(report);
}

#[test]
fn a_file_that_cannot_be_read_is_one_problem_without_a_place() {
    let missing = Document::open(Path::new("/nowhere/at-all.xml"));
    let [problem] = missing.diagnostics() else { panic!("one problem") };
    assert!(problem.is_error() && problem.position.is_none() && missing.scene().is_none());
    let folder = Document::open(Path::new(env!("CARGO_MANIFEST_DIR")));
    assert!(folder.has_errors());
}

#[test]
fn a_file_beyond_the_limit_is_refused_without_parsing_it() {
    let document = Document::from_bytes(&vec![0; (256 << 20) + 1]);
    let [problem] = document.diagnostics() else { panic!("one problem") };
    assert_eq!(problem.to_string(), "error: the file is larger than 256 MiB; divide the scene");
}

#[test]
fn a_flood_of_problems_is_counted_not_listed() {
    let bodies = "<SoftObject/><Unknown/>".repeat(3000);
    let map = r#"<Map><Size X="1" Y="1" Z="1"/><Tiles X="1" Y="1" Z="1"/></Map>"#;
    let text =
        format!("<PolyPhysicsXml Version=\"1.0\">{map}<Primitives>{bodies}</Primitives></PolyPhysicsXml>");
    let document = Document::from_bytes(text.as_bytes());
    let problems = document.diagnostics();
    assert_eq!(problems.len(), 2002);
    assert_eq!(problems[2000].to_string(), "error: and 5000 more errors");
    assert_eq!(problems[2001].to_string(), "warning: and 5000 more warnings");
    assert_eq!(document.scene().unwrap().bodies.len(), 3000);
}
