//! `record` and `replay`: the same run again, and where it parts from what was recorded.

use super::{BOUNCE, Bench};

/// A bench with a recording of two seconds.
fn recorded() -> Bench {
    let bench = Bench::with_scene(BOUNCE);
    let made = bench.polyscene(&["record", "scene.xml", "--until", "2.5", "-o", "run.psrec"]);
    assert_eq!((made.code, made.stdout.as_str()), (0, ""), "{}", made.stderr);
    assert!(made.stderr.contains("2.5 s, 1 events"), "{}", made.stderr);
    bench
}

#[test]
fn a_recording_is_run_again_with_the_same_states() {
    let bench = recorded();
    std::fs::remove_file(bench.path("scene.xml")).expect("the recording holds the scene");
    let again = bench.polyscene(&["replay", "run.psrec", "--verify"]);
    assert_eq!(again.code, 0, "{}", again.stderr);
    assert!(again.stderr.contains("states are the same"), "{}", again.stderr);
    let at_event = bench.polyscene(&["replay", "run.psrec", "--to-event", "1", "--events", "-"]);
    assert_eq!(at_event.code, 0, "{}", at_event.stderr);
    assert!(at_event.stderr.contains(" at 0.95831484749"), "{}", at_event.stderr);
    assert_eq!(at_event.stdout.lines().count(), 1);
    assert!(at_event.stdout.contains("\"kind\":\"impact\""), "{}", at_event.stdout);
    let before = bench.polyscene(&["replay", "run.psrec", "--to", "0.5", "--events", "-"]);
    assert_eq!((before.code, before.stdout.as_str()), (0, ""), "{}", before.stderr);
}

/// Symptom: the recording was gone, replaced by its own events.
#[test]
fn a_recording_is_never_overwritten_by_its_events() {
    let bench = recorded();
    let before = std::fs::read(bench.path("run.psrec")).expect("it is there");
    let refused = bench.polyscene(&["replay", "run.psrec", "--events", "./run.psrec"]);
    assert_eq!(refused.code, 2, "{}", refused.stderr);
    assert!(refused.stderr.contains("would overwrite the recording"), "{}", refused.stderr);
    assert_eq!(std::fs::read(bench.path("run.psrec")).expect("it is there"), before);
}

#[test]
fn every_method_is_recorded() {
    let bench = Bench::with_scene(BOUNCE);
    for method in ["exact", "thesis", "fixed"] {
        let file = format!("{method}.psrec");
        let made = bench.polyscene(&[
            "record",
            "scene.xml",
            "--until",
            "1.23",
            "--dt",
            "0.05",
            "--method",
            method,
            "-o",
            &file,
        ]);
        assert_eq!(made.code, 0, "{}", made.stderr);
        let again = bench.polyscene(&["replay", &file, "--verify"]);
        assert_eq!(again.code, 0, "{method}: {}", again.stderr);
    }
}

#[test]
fn a_run_that_parts_from_its_recording_ends_with_3_and_says_where() {
    let bench = recorded();
    let text = bench.read("run.psrec");
    let last = text.rfind("\"hash\": \"").expect("a state") + 9;
    let other = if text.as_bytes()[last] == b'0' { "1" } else { "0" };
    bench.write("other.psrec", format!("{}{other}{}", &text[..last], &text[last + 1..]));
    let outcome = bench.polyscene(&["replay", "other.psrec", "--verify"]);
    assert_eq!(outcome.code, 3, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("the run parts from the recording after t = "), "{}", outcome.stderr);
    assert_eq!(bench.polyscene(&["replay", "other.psrec"]).code, 0, "nothing is compared unasked");
    bench.write("longer.psrec", text.replacen("\"event\": 1", "\"event\": 2", 1));
    let outcome = bench.polyscene(&["replay", "longer.psrec"]);
    assert!(matches!(outcome.code, 2 | 3), "{}: {}", outcome.code, outcome.stderr);
}

/// Symptom: the way to a checkpoint that lies before its event, or between two events, had no end.
#[test]
fn a_checkpoint_at_no_place_of_the_run_ends_the_comparing_with_its_line() {
    let bench = recorded();
    let text = bench.read("run.psrec");
    let at = text.find("\"checkpoints\"").expect("states");
    let (head, states) = text.split_at(at);
    let event = states.find("\"event\": 1").expect("one after the impact");
    let number = states[..event].matches("\"hash\"").count() + 1;
    let line = text[..at + event].lines().count() - 2;
    let (before, after) = states.split_at(event);
    let end = after.find('}').expect("its end");
    for (moment, code, expected) in [
        (
            "\"event\": 1, \"time\": 0.0, \"is_over\": true",
            3,
            "it is at no place of the run: event 1 at 0 s is not recorded",
        ),
        ("\"event\": 0, \"time\": 0.5, \"is_over\": false", 3, "what is shown does not come again"),
        (
            "\"event\": 1, \"time\": 2.6, \"is_over\": true",
            2,
            "and the end after event 1 at 2.5 s, which is before",
        ),
    ] {
        bench.write("moved.psrec", format!("{head}{before}{moment}{}", &after[end..]));
        let outcome = bench.polyscene(&["replay", "moved.psrec", "--verify", "--max-wall", "20"]);
        assert_eq!(outcome.code, code, "{moment}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(expected), "{moment}: {}", outcome.stderr);
        let place = format!("checkpoint {number}, line {line}: ");
        assert!(code == 2 || outcome.stderr.contains(&place), "{place}: {}", outcome.stderr);
    }
}

#[test]
fn what_is_no_recording_is_refused_with_its_reason() {
    let bench = recorded();
    let text = bench.read("run.psrec");
    bench.write("scene.psrec", BOUNCE);
    bench.write("newer.psrec", text.replacen("\"version\": 1", "\"version\": 7", 1));
    bench.write("cut.psrec", &text[..text.len() / 2]);
    bench.write("base64.psrec", text.replacen("\"scene\": \"", "\"scene\": \"*", 1));
    let mut broken: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    // an element that is not closed, in line 2
    broken["scene"] = "PFBvbHlQaHlzaWNzWG1sIFZlcnNpb249IjEuMCI+CjxNYXA+PC9Qb2x5UGh5c2ljc1htbD4K".into();
    bench.write("broken.psrec", broken.to_string());
    bench.write("method.psrec", text.replacen("\"exact\"", "\"guess\"", 1));
    bench.write("step.psrec", text.replacen("\"dt\": 0.0", "\"dt\": -0.0", 1));
    let cases = [
        ("scene.psrec", "not a recording: expected value at line 1 column 1; a recording (.psrec) is what"),
        ("newer.psrec", "version 7"),
        ("cut.psrec", "this recording cannot be read: EOF while parsing"),
        ("cut.psrec", "the file is damaged: record again (`polyscene record`), or ask for another copy"),
        ("base64.psrec", "not base64"),
        ("base64.psrec", "the file is damaged: record again"),
        ("broken.psrec", "its scene has errors: line 2, column "),
        ("broken.psrec", "the file is damaged: record again"),
        ("method.psrec", "no method “guess”"),
        ("step.psrec", "steps[0].dt is -0.0"),
        ("missing.psrec", "cannot read missing.psrec"),
    ];
    for (file, hint) in cases {
        let outcome = bench.polyscene(&["replay", file, "--verify"]);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{file}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(hint), "{file} should say {hint:?}: {}", outcome.stderr);
    }
    let beyond = bench.polyscene(&["replay", "run.psrec", "--to", "9"]);
    assert_eq!(beyond.code, 2, "{}", beyond.stderr);
    let kept = bench.polyscene(&["record", "scene.xml", "--until", "1", "-o", "run.psrec"]);
    assert_eq!(kept.code, 2, "{}", kept.stderr);
    assert_eq!(bench.read("run.psrec"), text);
}

/// Symptom: a recording that claims an end at 1.8e19 s was run for ever, and one with a Δt of 1e300 s was taken as it is.
#[test]
fn numbers_that_no_run_has_are_refused_by_the_name_of_their_field() {
    let bench = recorded();
    let good: serde_json::Value = serde_json::from_str(&bench.read("run.psrec")).expect("JSON");
    for (pointer, value, expected) in [
        ("/steps/0/dt", 1e300, "steps[0].dt is 1e300, and has to be above 0 and at most 1e9 s"),
        ("/steps/0/count", 0.0, "steps[0].count is 0, and has to be at least 1"),
        ("/checkpoints/0/at/time", -1.0, "checkpoints[0].at.time is -1.0, and has to be from 0 to 1e9 s"),
        ("/checkpoints/0/at/time", 1.8e19, "checkpoints[0].at.time is 1.8e19"),
        ("/end/time", 1.8e19, "end.time is 1.8e19, and has to be from 0 to 1e9 s"),
    ] {
        let mut bad = good.clone();
        let whole = pointer.ends_with("count");
        *bad.pointer_mut(pointer).expect(pointer) = if whole { 0_u64.into() } else { value.into() };
        bench.write("bad.psrec", bad.to_string());
        let outcome = bench.polyscene(&["replay", "bad.psrec"]);
        assert_eq!(outcome.code, 2, "{pointer}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(expected), "{pointer}: {}", outcome.stderr);
    }
}

/// What was recorded is what the scene does: the motion of a recording, looked up, is byte for byte that of its scene,
/// simulated.
#[test]
fn the_motion_of_a_recording_is_exported() {
    let bench = recorded();
    let motion = ["--to", "csv", "--from", "0.5", "--until", "2", "--fps", "30"];
    let export = |file: &str| {
        let outcome = bench.polyscene(&[&["export", file], &motion[..]].concat());
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        outcome.stdout
    };
    let simulated = export("scene.xml");
    assert!(simulated.lines().count() > 45, "{simulated}");
    assert_eq!(export("run.psrec"), simulated);

    let whole = bench.polyscene(&["export", "run.psrec", "--to", "gltf", "-o", "motion.glb"]);
    assert_eq!(whole.code, 0, "{}", whole.stderr);
    assert!(bench.path("motion.glb").exists());
    for (asked, expected) in [
        (&["--to", "csv", "--until", "9"][..], "recorded from 0 s to 2.5 s only"),
        (&["--to", "csv", "--at", "1"], "is a recording"),
        (&["--to", "mjcf"], "can hold it"),
    ] {
        let refused = bench.polyscene(&[&["export", "run.psrec"], asked].concat());
        assert_eq!((refused.code, refused.stdout.as_str()), (2, ""), "{}", refused.stderr);
        assert!(refused.stderr.contains(expected), "{}", refused.stderr);
    }
}

/// Symptom: “text stands outside the root element”, whoever was given one. Expected: what it is, and which verb takes it.
#[test]
fn a_recording_where_a_scene_is_meant_is_named() {
    let bench = recorded();
    for arguments in [
        &["run", "run.psrec", "--until", "1"][..],
        &["check", "run.psrec"],
        &["record", "run.psrec", "--until", "1", "-o", "again.psrec"],
    ] {
        let outcome = bench.polyscene(arguments);
        assert_eq!(outcome.code, 1, "{arguments:?}: {}", outcome.stderr);
        let said = format!("{}{}", outcome.stdout, outcome.stderr);
        assert!(
            said.contains("run.psrec: error: this is a recording, not a scene; `polyscene replay`"),
            "{said}"
        );
    }
}
