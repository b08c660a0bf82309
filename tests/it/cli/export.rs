//! `export`: the file or standard output, the report on standard error, and when nothing is written.

use super::{BOUNCE, Bench};

#[test]
fn the_scene_goes_to_the_output_and_the_report_to_standard_error() {
    let bench = Bench::with_scene(BOUNCE);
    let shown = bench.polyscene(&["export", "scene.xml", "--to", "mjcf"]);
    assert_eq!(shown.code, 0, "{}", shown.stderr);
    assert!(shown.stdout.contains("<mujoco"), "{}", shown.stdout);
    // Symptom: the UserID of the force counted as kept.
    let lines = [
        "kept: 1 sphere (7): ",
        "approximated: 2 restitutions (7, 9): ",
        "kept: 2 UserIDs of bodies (7, 9): ",
        "not needed: 1 UserID of a force (1): ",
    ];
    for line in lines {
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

#[test]
fn a_later_state_and_the_motion_are_exported() {
    let bench = Bench::with_scene(BOUNCE);
    let later = bench.polyscene(&["export", "scene.xml", "--to", "polyphysics-1.0", "--at", "0.5"]);
    assert_eq!(later.code, 0, "{}", later.stderr);
    // 5 m − ½ g t² with 9.8 m/s², and −g t.
    assert!(later.stdout.contains("Y=\"3,775\"") && later.stdout.contains("Y=\"-4,9"), "{}", later.stdout);
    let motion = ["export", "scene.xml", "--to", "csv", "--until", "1", "--fps", "4"];
    let rows = bench.polyscene(&motion).stdout;
    assert_eq!(rows.lines().count(), 6, "{rows}");
    assert!(rows.lines().nth(3).is_some_and(|row| row.starts_with("0.5,7,,5,3.775")), "{rows}");
    for (arguments, code, hint) in [
        (&["--to", "mjcf", "--until", "1"][..], 2, "gltf, usd, csv can hold it"),
        (&["--to", "gltf", "--from", "2", "--until", "1"], 2, "must end after it begins"),
        (&["--to", "gltf", "--from", "2"], 2, "--until"),
        (&["--to", "gltf", "--at", "2", "--until", "3"], 2, "cannot be used with"),
        (&["--to", "csv", "--at", "-1"], 2, "--at must not be before"),
        (&["--to", "csv", "--at", "1e6", "--max-events", "20"], 4, "nothing was written"),
    ] {
        let outcome = bench.polyscene(&[&["export", "scene.xml", "-o", "out"], arguments].concat());
        assert_eq!(outcome.code, code, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(hint), "{arguments:?}: {}", outcome.stderr);
        assert!(!bench.path("out").exists(), "{arguments:?}");
    }
}

#[test]
fn a_scene_of_another_program_is_imported() {
    let bench = Bench::with_scene(BOUNCE);
    let sdf = ["export", "scene.xml", "--to", "sdf", "-o", "scene.sdf"];
    assert_eq!(bench.polyscene(&sdf).code, 0);
    let imported = bench.polyscene(&["import", "scene.sdf", "-o", "back.xml"]);
    assert_eq!((imported.code, imported.stdout.as_str()), (0, ""), "{}", imported.stderr);
    assert!(imported.stderr.contains("scene.sdf:") && imported.stderr.contains(": approximated: "));
    assert_eq!(bench.polyscene(&["check", "back.xml"]).code, 0);
    bench.write(
        "hinge.xml",
        "<mujoco><worldbody>\n<body><joint type='hinge'/><geom size='1'/></body></worldbody></mujoco>",
    );
    let refused = bench.polyscene(&["import", "hinge.xml", "-o", "new.xml"]);
    assert_eq!(refused.code, 1);
    assert!(
        refused.stderr.contains("hinge.xml:2:7: error: a joint that is not free cannot be imported"),
        "{}",
        refused.stderr
    );
    assert!(refused.stderr.contains("--leave-out") && !bench.path("new.xml").exists());
    let rest = bench.polyscene(&["import", "hinge.xml", "-o", "new.xml", "--leave-out"]);
    assert_eq!(rest.code, 0, "{}", rest.stderr);
    // with a pull that no run can go on with
    bench.write(
        "pull.xml",
        "<mujoco><option gravity='0 0 -1e300'/><worldbody>\n<body><freejoint/>\n<geom size='1'/></body></worldbody></mujoco>",
    );
    let pull = bench.polyscene(&["import", "pull.xml", "-o", "pulled.xml", "--leave-out"]);
    assert!(pull.code == 1 && !bench.path("pulled.xml").exists(), "{}", pull.stderr);
    assert!(pull.stderr.contains("pull.xml:3:1: error: body "), "{}", pull.stderr);
    assert!(pull.stderr.contains("pull.xml was not imported: the scene that comes of it"), "{}", pull.stderr);
    for arguments in [&["hinge.xml", "-o", "hinge.xml"][..], &["hinge.xml", "-o", "back.xml"], &["none.xml"]]
    {
        let outcome = bench.polyscene(&[&["import"], arguments].concat());
        assert!(outcome.code > 0 && outcome.stdout.is_empty(), "{arguments:?}: {}", outcome.stderr);
    }
    let strict = bench.polyscene(&["import", "scene.sdf", "--strict"]);
    assert_eq!((strict.code, strict.stdout.as_str()), (1, ""), "{}", strict.stderr);
}
