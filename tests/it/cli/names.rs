//! Names of files and what they hold, shown to a person: nothing in them steers the terminal or breaks a file.

use super::{BOUNCE, Bench};

/// Colours, a line break, a right-to-left mark and a line separator.
const HOSTILE: &str = "a\u{1b}[31m\u{7}\n\u{202e}b\u{2028}.xml";

fn assert_harmless(text: &str) {
    let bad = text.chars().find(|c| (c.is_control() && *c != '\n') || matches!(c, '\u{2028}' | '\u{202e}'));
    assert_eq!(bad, None, "{text:?}");
    assert!(!text.contains("m\n"), "the name breaks the line: {text:?}");
}

/// Symptom: raw escape codes of a file's name reached the terminal. Cause: only the lines of problems were
/// escaped, not the other messages.
#[cfg(unix)]
#[test]
fn a_hostile_file_name_is_escaped_in_every_message() {
    let bench = Bench::new();
    bench.write(HOSTILE, BOUNCE);
    let missing = format!("{HOSTILE}/x");
    let cases: [&[&str]; 10] = [
        &["check", "--method\u{1b}[31m", HOSTILE],
        &["run", HOSTILE, "--until", "\u{1b}[31m\u{202e}"],
        &["run", HOSTILE, "--until", "1"],
        &["run", HOSTILE, "--until", "1", "--states", HOSTILE],
        &["run", HOSTILE, "--until", "1", "--states", &missing],
        &["run", HOSTILE, "--until", "1", "--final", &missing],
        &["run", &missing, "--until", "1"],
        &["check", &missing, HOSTILE],
        &["hard-cases", "--case", "1", "--markdown", HOSTILE],
        &["study", HOSTILE, "--until", "1", "--repeat", "1", "--dt", "1/30", "--csv", &missing],
    ];
    for arguments in cases {
        let outcome = bench.polyscene(arguments);
        assert_harmless(&outcome.stdout);
        assert_harmless(&outcome.stderr);
    }
}

/// Symptom: control characters of the file's name stood in the SVG's title, which XML forbids.
#[cfg(unix)]
#[test]
fn a_diagram_of_a_hostile_file_name_is_well_formed() {
    let bench = Bench::new();
    bench.write(HOSTILE, BOUNCE);
    let study = ["study", HOSTILE, "--until", "1", "--repeat", "1", "--dt", "1/30", "--svg", "a.svg"];
    assert_eq!(bench.polyscene(&study).code, 0);
    let svg = bench.read("a.svg");
    assert_harmless(&svg);
    let mut reader = quick_xml::Reader::from_str(&svg);
    while reader.read_event().expect("well-formed XML") != quick_xml::events::Event::Eof {}
}

/// Symptom: U+2028 and U+202E of a scene's own text passed through in messages.
#[test]
fn hostile_text_of_a_scene_is_escaped_in_every_message() {
    let bench = Bench::new();
    bench.write("scene.xml", BOUNCE.replace("\"0,5\"", "\"\u{202e}5\u{2028}\u{200b}\""));
    let outcome = bench.polyscene(&["check", "scene.xml"]);
    assert_eq!(outcome.code, 1);
    assert_harmless(&outcome.stdout);
    assert!(outcome.stdout.contains("\\u{202e}5\\u{2028}\\u{200b}"), "{}", outcome.stdout);
}
