//! `export`: the file or standard output, the report on standard error, and when nothing is written.

use super::{BOUNCE, Bench};

#[test]
fn the_scene_goes_to_the_output_and_the_report_to_standard_error() {
    let bench = Bench::with_scene(BOUNCE);
    let shown = bench.polyscene(&["export", "scene.xml", "--to", "mjcf"]);
    assert_eq!(shown.code, 0, "{}", shown.stderr);
    assert!(shown.stdout.contains("<mujoco"), "{}", shown.stdout);
    for line in ["kept: 1 sphere (7): ", "approximated: 2 restitutions (7, 9): ", "kept: 3 UserIDs: "] {
        assert!(shown.stderr.contains(line), "{}", shown.stderr);
    }
    let written = bench.polyscene(&["export", "scene.xml", "--to", "mjcf", "-o", "out.xml"]);
    assert_eq!((written.code, written.stdout.as_str()), (0, ""), "{}", written.stderr);
    assert_eq!((bench.read("out.xml"), written.stderr), (shown.stdout, shown.stderr));
}

#[test]
fn strict_writes_nothing_that_loses_something() {
    let bench = Bench::with_scene(BOUNCE);
    let refused = bench.polyscene(&["export", "scene.xml", "--to", "sdf", "-o", "out.sdf", "--strict"]);
    assert_eq!(refused.code, 1, "{}", refused.stderr);
    assert!(refused.stderr.contains("--strict: scene.xml was not written"), "{}", refused.stderr);
    assert!(!bench.path("out.sdf").exists());
    let lossless = ["export", "scene.xml", "--to", "polyphysics-1.0", "--strict"];
    let outcome = bench.polyscene(&lossless);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (0, BOUNCE), "{}", outcome.stderr);
}

#[test]
fn what_must_not_or_cannot_be_written_is_refused() {
    let bench = Bench::with_scene(BOUNCE);
    bench.write("bad.xml", BOUNCE.replace("0,5", "-1"));
    std::fs::create_dir(bench.path("folder")).expect("a folder");
    bench.write("old.sdf", "somebody's work");
    let cases: [(&[&str], i32, &str); 6] = [
        (&["scene.xml", "--to", "sdf", "-o", "old.sdf"], 2, "would overwrite old.sdf"),
        (&["scene.xml", "--to", "sdf", "-o", "./scene.xml"], 2, "would overwrite the scene"),
        (&["scene.xml", "--to", "sdf", "-o", "folder"], 2, "cannot write folder: it is a folder"),
        (&["scene.xml", "--to", "urdf"], 2, "polyphysics-1.0"),
        (&["bad.xml", "--to", "sdf", "-o", "out"], 1, "it has errors"),
        (&["missing.xml", "--to", "sdf", "-o", "out"], 1, "cannot be read"),
    ];
    for (arguments, code, hint) in cases {
        let outcome = bench.polyscene(&[&["export"], arguments].concat());
        assert_eq!((outcome.code, outcome.stdout.as_str()), (code, ""), "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(hint), "{arguments:?} should say {hint:?}: {}", outcome.stderr);
    }
    assert_eq!(bench.read("scene.xml"), BOUNCE);
    assert_eq!(bench.read("old.sdf"), "somebody's work");
    assert!(!bench.path("out").exists());
    let forced = bench.polyscene(&["export", "scene.xml", "--to", "sdf", "-o", "old.sdf", "--force"]);
    assert_eq!(forced.code, 0, "{}", forced.stderr);
    assert!(bench.read("old.sdf").contains("<sdf"));
}
