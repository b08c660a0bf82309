//! Outputs that can't or must not be written are refused before the work, in words about the file itself.

use super::{BOUNCE, Bench};

const RUN: [&str; 6] = ["run", "scene.xml", "--dt", "0.1", "--until", "1"];

/// Asks for a refusal that says `hint`.
fn refused(bench: &Bench, arguments: &[&str], hint: &str) {
    let outcome = bench.polyscene(arguments);
    assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
    assert!(outcome.stderr.contains(hint), "{arguments:?} should say {hint:?}: {}", outcome.stderr);
    assert!(!outcome.stderr.contains(".tmp"), "{arguments:?}: {}", outcome.stderr);
    assert_eq!(outcome.stdout, "", "{arguments:?}");
}

#[test]
fn one_file_spelt_in_two_ways_is_one_output() {
    let bench = Bench::with_scene(BOUNCE);
    let absolute = bench.path("y.o");
    for other in ["./y.o", ".//y.o", absolute.to_str().expect("UTF-8 paths")] {
        refused(&bench, &[&RUN[..], &["--events", "y.o", "--states", other]].concat(), "can't both write");
        refused(&bench, &[&RUN[..], &["--final", "y.o", "--states", other]].concat(), "can't both write");
    }
    assert!(!absolute.exists());
}

#[test]
fn a_last_state_that_cant_be_written_is_refused_before_the_run() {
    let bench = Bench::with_scene(BOUNCE);
    std::fs::create_dir(bench.path("folder")).expect("a folder");
    let cases = [
        ("folder", "can't write folder: it is a folder"),
        ("missing/final.xml", "the folder missing does not exist"),
        ("scene.xml/final.xml", "scene.xml is not a folder"),
    ];
    for (target, hint) in cases {
        // Rows appear as soon as the run begins.
        let outputs = ["--final", target, "--states", "states.jsonl"];
        refused(&bench, &[&RUN[..], &outputs].concat(), hint);
        assert!(!bench.path("states.jsonl").exists(), "{target}: the run began");
    }
    let left: Vec<_> = std::fs::read_dir(bench.path(".")).expect("the folder").collect();
    assert_eq!(left.len(), 2, "{left:?}");
}

#[cfg(unix)]
#[test]
fn the_last_state_may_go_to_the_null_device() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome = bench.polyscene(&[&RUN[..], &["--final", "/dev/null"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    use std::os::unix::fs::FileTypeExt as _;
    let kind = std::fs::metadata("/dev/null").expect("the null device").file_type();
    assert!(kind.is_char_device(), "it was replaced");
}

#[cfg(target_os = "linux")]
#[test]
fn the_last_state_may_go_into_an_open_pipe() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome = bench.polyscene(&[&RUN[..], &["--final", "/dev/stderr"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.ends_with("</PolyPhysicsXml>\n"), "{}", outcome.stderr);
}

#[cfg(target_os = "linux")]
#[test]
fn problems_that_cant_be_printed_are_told() {
    let bench = Bench::new();
    bench.write("bad.xml", BOUNCE.replace("0,5", "-1"));
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("the full device");
    let output = bench.command(&["check", "bad.xml"]).stdout(full).output().expect("the program starts");
    let outcome = super::outcome(output);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("can't write standard output"), "{}", outcome.stderr);
}

#[cfg(feature = "render")]
#[test]
fn a_picture_never_replaces_its_scene() {
    let bench = Bench::with_scene(BOUNCE);
    for out in ["scene.xml", "./scene.xml"] {
        refused(&bench, &["render", "scene.xml", "-o", out], "overwrite the scene");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("scene.xml", bench.path("link.png")).expect("a link");
        refused(&bench, &["render", "scene.xml", "-o", "link.png"], "overwrite the scene");
        refused(&bench, &["render", "link.png", "-o", "scene.xml"], "overwrite the scene");
    }
    assert_eq!(bench.read("scene.xml"), BOUNCE);
}

#[cfg(feature = "render")]
#[test]
fn a_picture_in_no_folder_is_refused_in_words() {
    let bench = Bench::with_scene(BOUNCE);
    refused(&bench, &["render", "scene.xml", "-o", "no/x.png"], "the folder no does not exist");
}
