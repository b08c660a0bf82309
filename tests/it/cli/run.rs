//! `run`: rows and summary in the documented formats, with numbers that closed forms give.

use polyscene::scene::{Document, Motion};
use serde_json::Value;

use super::{BOUNCE, Bench, number, rows, scenes_folder};

/// When the ball of [`BOUNCE`] first lands, s: √(2·4.5/9.8).
fn first_landing() -> f64 {
    (2.0_f64 * 4.5 / 9.8).sqrt()
}

fn run(bench: &Bench, options: &[&str]) -> String {
    let outcome = bench.polyscene(&[&["run", "scene.xml"], options].concat());
    assert_eq!(outcome.code, 0, "{options:?}: {}", outcome.stderr);
    outcome.stdout
}

fn times(rows: &[Value]) -> Vec<f64> {
    rows.iter().map(|row| number(&row["t"])).collect()
}

#[test]
fn states_are_written_at_the_start_every_nth_step_and_the_end() {
    let bench = Bench::with_scene(BOUNCE);
    let states = rows(&run(&bench, &["--dt", "0.3", "--until", "1", "--every", "2", "--states", "-"]));
    assert_eq!(times(&states), [0.0, 2.0 * 0.3, 1.0]);
    // 60 · (1/60) must not leave a sliver of a step.
    let states = rows(&run(&bench, &["--dt", "1/60", "--until", "1", "--states", "-"]));
    assert_eq!(states.len(), 61);
    assert_eq!(times(&states)[59..], [59.0 * (1.0 / 60.0), 1.0]);
}

#[test]
fn a_state_row_is_the_motion() {
    let bench = Bench::with_scene(BOUNCE);
    let states = rows(&run(&bench, &["--dt", "0.5", "--until", "0.5", "--states", "-"]));
    assert_eq!(
        states[0].to_string(),
        r#"{"t":0.0,"bodies":[{"id":"7","x":[5.0,5.0,5.0],"v":[0.0,0.0,0.0],"state":"flight"}]}"#
            .parse::<Value>()
            .expect("JSON")
            .to_string()
    );
    let ball = &states[1]["bodies"][0];
    assert!((number(&ball["x"][1]) - (5.0 - 0.5 * 9.8 * 0.25)).abs() < 1e-12, "{ball}");
    assert!((number(&ball["v"][1]) + 9.8 * 0.5).abs() < 1e-12, "{ball}");
}

#[test]
fn an_event_row_is_the_impact() {
    let bench = Bench::with_scene(BOUNCE);
    let events = rows(&run(&bench, &["--dt", "0.25", "--until", "1.5", "--events", "-"]));
    assert_eq!(events.len(), 1);
    let (event, t) = (&events[0], first_landing());
    assert!((number(&event["t"]) - t).abs() < 1e-12, "{event}");
    let fixed = [
        ("seq", "1"),
        ("kind", r#""impact""#),
        ("a", r#""7""#),
        ("b", r#""9""#),
        ("group", "1"),
        ("dt_index", "4"),
    ];
    for (key, expected) in fixed {
        assert_eq!(event[key].to_string(), expected, "{key}");
    }
    let speed = 9.8 * t;
    for (key, expected) in [("vn_before", -speed), ("vn_after", speed), ("impulse", 2.0 * 2.0 * speed)] {
        assert!((number(&event[key]) - expected).abs() < 1e-11, "{key}: {event}");
    }
    // From the ball (the smaller UserID) to the floor, on the floor.
    for (key, expected) in [("normal", [0.0, -1.0, 0.0]), ("point", [5.0, 0.0, 5.0])] {
        for (axis, expected) in expected.into_iter().enumerate() {
            assert!((number(&event[key][axis]) - expected).abs() < 1e-12, "{key}: {event}");
        }
    }
}

#[test]
fn a_stands_before_b_in_user_id_order_and_repeated_ids_are_told_apart() {
    let bench = Bench::with_scene(&BOUNCE.replace(r#"UserID="9""#, r#"UserID="3""#));
    let event = &rows(&run(&bench, &["--dt", "1", "--until", "1", "--events", "-"]))[0];
    assert_eq!((&event["a"], &event["b"]), (&"3".into(), &"7".into()));
    assert!((number(&event["normal"][1]) - 1.0).abs() < 1e-12, "{event}");

    let bench = Bench::with_scene(&BOUNCE.replace(r#"UserID="9""#, r#"UserID="7""#));
    let event = &rows(&run(&bench, &["--dt", "1", "--until", "1", "--events", "-"]))[0];
    assert_eq!((&event["a"], &event["b"]), (&"7".into(), &"7#2".into()));
}

#[test]
fn the_summary_has_all_its_parts() {
    let bench = Bench::with_scene(BOUNCE);
    let text = run(&bench, &["--dt", "0.1", "--until", "2", "--json"]);
    assert_eq!(text.lines().count(), 1);
    let summary = &rows(&text)[0];
    assert_eq!(number(&summary["t"]), 2.0);
    assert_eq!(summary["steps"], 20);
    assert_eq!(summary["stopped"], Value::Null);
    assert_eq!(summary["events"]["impact"], 1);
    assert_eq!(summary["events"]["rest"], 0);
    assert!(number(&summary["wall_s"]) > 0.0);
    // m g y with y from the origin, whatever the split: 2 · 9.8 · 5 at the start.
    assert!((number(&summary["energy"]["total"]) - 98.0).abs() < 1e-10, "{summary}");
    for part in ["kinetic", "potential", "residual"] {
        assert!(summary["energy"][part].is_number(), "energy.{part}");
    }
    assert!(number(&summary["energy"]["residual"]).abs() < 1e-12, "{summary}");
    assert!(number(&summary["momentum"]["residual"]).abs() < 1e-12, "{summary}");
    assert_eq!(summary["momentum"]["value"].as_array().map(Vec::len), Some(3));
    assert!(number(&summary["max_overlap"]) < 1e-12, "{summary}");
    assert_eq!(summary["hash"].as_str().map(str::len), Some(16));
    assert_eq!(summary["plan"]["dynamic_bodies"], 1);
    assert!(summary["plan"]["left_out"].is_array(), "{summary}");
    assert_eq!(summary["warnings"].as_array().map(Vec::len), Some(0));
}

/// Symptom: only the window said that bodies had left the map. Expected: the summary counts them.
#[test]
fn a_summary_counts_the_bodies_outside_the_map() {
    // From x = 5 m at 4 m/s: over the edge of floor and map, at 10 m, after 1.25 s.
    let bench = Bench::with_scene(&BOUNCE.replace(r#"Velocity X="0""#, r#"Velocity X="4""#));
    for (until, count) in [("1", 0), ("4", 1)] {
        let summary = &rows(&run(&bench, &["--until", until, "--json"]))[0];
        assert_eq!(summary["outside_map"], count, "{summary}");
        let text = run(&bench, &["--until", until]);
        assert_eq!(text.contains("the map: 1 of 1 moving bodies"), count == 1, "{text}");
    }
}

#[test]
fn people_get_a_summary_when_nothing_else_goes_to_stdout() {
    let bench = Bench::with_scene(BOUNCE);
    let text = run(&bench, &["--dt", "0.1", "--until", "2", "--states", "states.jsonl"]);
    for word in
        ["1 impact", "energy", "residual", "momentum", "overlap", "plan", "left out", "times real time"]
    {
        assert!(text.contains(word), "{word} is missing:\n{text}");
    }
    assert_eq!(rows(&bench.read("states.jsonl")).len(), 21);
}

#[test]
fn the_final_scene_starts_where_the_run_ended() {
    let bench = Bench::with_scene(BOUNCE);
    run(&bench, &["--dt", "0.1", "--until", "1.3", "--final", "final.xml", "--states", "states.jsonl"]);
    let last = rows(&bench.read("states.jsonl")).pop().expect("a state");
    let ball = &last["bodies"][0];

    let document = Document::open(&bench.path("final.xml"));
    let scene = document.scene().expect("a sound scene");
    let body = scene.bodies.iter().find(|body| body.id == 7).expect("the ball");
    let Motion::Dynamic { velocity, .. } = body.motion else { panic!("the ball is dynamic") };
    for axis in 0..3 {
        assert_eq!(body.position[axis], number(&ball["x"][axis]));
        assert_eq!(velocity[axis], number(&ball["v"][axis]));
    }
    // Only the two lines that changed are new, in the file's own style.
    let written = bench.read("final.xml");
    let changed: Vec<&str> = written
        .lines()
        .zip(BOUNCE.lines())
        .filter(|(now, was)| now != was)
        .map(|(now, _)| now.trim())
        .collect();
    assert_eq!(written.lines().count(), BOUNCE.lines().count());
    assert_eq!(changed.len(), 2, "{changed:?}");
    assert!(changed[0].starts_with(r#"<Translation X="5" Y=""#) && changed[0].contains(','), "{changed:?}");
    assert!(changed[1].starts_with(r#"<InitialVelocity X="0" Y=""#), "{changed:?}");
}

#[test]
fn events_do_not_depend_on_the_step() {
    let thesis = scenes_folder().join("thesis-appendix-2.xml");
    let thesis = thesis.to_str().expect("UTF-8 paths");
    let bench = Bench::new();
    let events = |dt: &str| {
        let outcome = bench.polyscene(&["run", thesis, "--dt", dt, "--until", "5", "--events", "-"]);
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        let mut events = rows(&outcome.stdout);
        for event in &mut events {
            event.as_object_mut().expect("an object").remove("dt_index");
        }
        events
    };
    let coarse = events("1");
    assert!(coarse.len() >= 10, "{} events", coarse.len());
    for dt in ["1/60", "0.0137"] {
        assert_eq!(coarse, events(dt), "Δt = {dt}");
    }
}

#[test]
fn a_scene_with_errors_leaves_earlier_outputs_alone() {
    let bench = Bench::with_scene(&BOUNCE.replace("0,5", "-1"));
    bench.write("states.jsonl", "precious\n");
    let options =
        ["--dt", "0.1", "--until", "1", "--states", "states.jsonl", "--final", "final.xml", "--force"];
    let outcome = bench.polyscene(&[&["run", "scene.xml"], &options[..]].concat());
    assert_eq!(outcome.code, 1);
    assert!(outcome.stderr.contains("scene.xml:19:"), "{}", outcome.stderr);
    assert_eq!(bench.read("states.jsonl"), "precious\n");
    assert!(!bench.path("final.xml").exists());
}

#[test]
fn a_numerical_fault_stops_the_run_and_says_where() {
    // After 10 s and less the square of the speed is beyond what is reckoned with; the attractor makes it a field.
    let far = r#"<GravityPoint UserID="2"><Translation X="1" Y="1" Z="1" /><Gravity F32="1" /></GravityPoint></Forces>"#;
    let hopeless = BOUNCE.replace("</Forces>", far).replace(r#"<Gravity X="0""#, r#"<Gravity X="1E149""#);
    let bench = Bench::with_scene(&hopeless);
    let options = ["--dt", "1", "--until", "100", "--json", "--final", "final.xml"];
    let outcome = bench.polyscene(&[&["run", "scene.xml"], &options[..]].concat());
    assert_eq!(outcome.code, 3, "{}{}", outcome.stdout, outcome.stderr);
    assert!(
        outcome.stderr.contains("stopped at t = ") && outcome.stderr.contains(" s: body 7"),
        "{}",
        outcome.stderr
    );
    let summary = &rows(&outcome.stdout)[0];
    assert!(summary["stopped"].as_str().is_some_and(|why| why.contains("body 7")), "{summary}");
    assert!(!bench.path("final.xml").exists(), "the end was never reached");

    #[cfg(feature = "render")]
    {
        let outcome = bench.polyscene(&["render", "scene.xml", "-o", "picture.png", "--at", "100"]);
        assert_eq!(outcome.code, 3, "{}", outcome.stderr);
        assert!(outcome.stderr.contains(" s: body 7"), "{}", outcome.stderr);
        assert!(!bench.path("picture.png").exists(), "a picture of another time");
    }
}

#[test]
fn what_is_not_a_number_is_null() {
    // At the end the square of the speed is beyond f64.
    let bench = Bench::with_scene(&BOUNCE.replace("-9,8", "1E+149"));
    let summary = &rows(&run(&bench, &["--dt", "5e8", "--until", "1e9", "--json"]))[0];
    assert_eq!(summary["energy"]["kinetic"], Value::Null, "{summary}");
}

#[test]
fn methods_step_as_they_say() {
    let bench = Bench::with_scene(BOUNCE);
    for method in ["exact", "thesis", "fixed"] {
        let options = ["--dt", "0.1", "--until", "2", "--method", method];
        let summary: Value =
            serde_json::from_str(&run(&bench, &[&options[..], &["--json"]].concat())).unwrap();
        assert_eq!(summary["method"], method);
        assert_eq!(summary["work"]["given_up"], 0);
        let events = rows(&run(&bench, &[&options[..], &["--events", "-"]].concat()));
        let early = first_landing() - number(&events[0]["t"]);
        let allowed = if method == "exact" { 1e-12 } else { 1e-6 };
        assert!((-1e-12..=allowed).contains(&early), "{method}: {early}");
        assert_eq!(events.len(), 1, "{method}");
        let text = run(&bench, &options);
        assert!(text.contains(&format!("method {method}")), "{text}");
    }
}
