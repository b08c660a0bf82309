//! Whole studies: exact comes out exact, wrong laws come out wrong, the horizon, cancelling, the files.

use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DVec3, dvec3};
use polyscene::scene::{ForceKind, Scene};
use polyscene::sim::{Method, Simulation};
use polyscene::study::{
    AXES, Candidate, Control, HorizonCause, Limits, Onto, PairImpact, RunFigures, StudyProgress, StudyReport,
    StudySettings, Truth, compare, csv, measure, run, seconds, svg, table,
};
use quick_xml::events::Event;

use crate::common::build::{Build, Shaped, ball, empty};
use crate::common::load::load;

/// Few Δt and timings, so that a test does not wait for figures it does not look at.
fn quick(until: f64) -> StudySettings {
    StudySettings {
        until,
        dts: vec![1.0 / 30.0, 1.0 / 120.0],
        repeat: 1,
        tolerances: vec![],
        ..StudySettings::default()
    }
}

fn study(scene: &Scene, settings: &StudySettings) -> StudyReport {
    let never = AtomicBool::new(false);
    run(scene, "a scene", settings, &mut Control::new(&never, &mut |_| ())).expect("a scene that runs")
}

fn exact(report: &StudyReport) -> &RunFigures {
    report.points.iter().find(|point| point.method == Method::Exact).expect("a point of exact")
}

#[test]
fn exact_is_exact_where_nothing_is_chaotic() {
    let throw = empty().gravity(-9.8).ball(1, dvec3(1.0, 2.0, 3.0), dvec3(4.0, 5.0, 0.5));
    let scenes = [
        ("throw", throw, 5.0, 1e-12),
        ("bounce", load("bounce.xml"), 20.0, 1e-9),
        ("cradle", load("cradle.xml"), 5.0, 1e-9),
        ("orbit", load("orbit.xml"), 20.0, 1e-8),
    ];
    for (name, scene, until, bound) in scenes {
        let report = study(&scene, &quick(until));
        assert_eq!(report.horizon.cause, HorizonCause::WholeRun, "{name}: {:?}", report.horizon);
        assert!((report.horizon.time - until).abs() < 1e-9 * until, "{name}: {:?}", report.horizon);
        let point = exact(&report);
        assert!(point.position_error.is_some_and(|error| error <= bound), "{name}: {point:?}");
        assert_eq!((point.missed, point.wrong), (Some(0), Some(0)), "{name}: {point:?}");
        assert!(point.worst_overlap <= 1e-9, "{name}: {point:?}");
        assert!(point.wall_per_s.is_some_and(|wall| wall > 0.0), "{name}: {point:?}");
        assert_eq!(report.points.len(), 5, "{name}: exact once, two methods twice");
    }
}

#[test]
fn a_finer_step_is_better_by_the_order_of_the_method() {
    let report = study(&load("orbit.xml"), &StudySettings { methods: vec![Method::Fixed], ..quick(10.0) });
    let [coarse, fine] = &report.points[..] else { panic!("two points: {:?}", report.points) };
    assert!(coarse.dt > fine.dt);
    // Verlet is of the second order: a quarter of the step, a sixteenth of the error.
    let gain = coarse.position_error.expect("compared") / fine.position_error.expect("compared");
    assert!((8.0..32.0).contains(&gain), "{gain}: {coarse:?} {fine:?}");
}

#[test]
fn horizon_of_the_thesis_scene_is_stated() {
    let settings = StudySettings { methods: vec![Method::Exact], ..quick(60.0) };
    let report = study(&load("thesis-appendix-2.xml"), &settings);
    assert_eq!(report.horizon.cause, HorizonCause::ReferenceError);
    assert!((15.0..27.0).contains(&report.horizon.time), "{:?}", report.horizon);
    assert!(report.horizon.error <= 1e-6, "{:?}", report.horizon);
    let point = exact(&report);
    assert_eq!((point.missed, point.wrong), (Some(0), Some(0)), "{point:?}");
    assert!(point.energy_residual.is_some_and(|residual| residual < 1e-10), "{point:?}");
    let stated = format!("horizon at {:.3} s", report.horizon.time);
    let statement = report.horizon_statement();
    assert!(statement.contains(&stated), "{stated} in: {statement}");
}

#[test]
fn wrong_laws_are_found_out() {
    let scene = load("bounce.xml");
    let settings = quick(10.0);
    let limits = Limits::of(&settings);
    let candidate = Candidate { method: Method::Exact, dt: None, tolerance: None, group_step: None };
    let never = AtomicBool::new(false);
    let mut silent = |_: &StudyProgress| ();
    let mut control = Control::new(&never, &mut silent);
    let truth = Truth::find(&scene, &limits.sample_times(&candidate), &settings, &mut control);
    let mut judged =
        |wrong: &Scene| measure(&candidate, wrong, &truth, &limits, &mut control).expect("a point");

    let right = judged(&scene);
    assert!(right.position_error < Some(1e-9) && right.missed == Some(0), "{right:?}");
    let mut heavier = scene.clone();
    for force in &mut heavier.forces {
        if let ForceKind::GravityPlane { acceleration, .. } = &mut force.kind {
            *acceleration *= 1.01;
        }
    }
    let heavier = judged(&heavier);
    assert!(heavier.position_error > Some(0.05), "{heavier:?}");
    assert!(heavier.follows_until < Some(1.0) && heavier.missed > Some(0), "{heavier:?}");
    let mut lossy = scene.clone();
    lossy.bodies.iter_mut().for_each(|body| body.bounce *= 0.99);
    assert!(judged(&lossy).position_error > Some(0.1));
    let mut hollow = scene.clone();
    hollow.bodies.retain(polyscene::scene::Body::is_dynamic);
    let hollow = judged(&hollow);
    assert_eq!((hollow.impacts, hollow.wrong), (0, Some(0)), "{hollow:?}");
    assert!(hollow.missed > Some(3) && hollow.first_difference.is_some(), "{hollow:?}");
}

#[test]
fn what_the_reference_does_not_know_is_left_to_the_invariants() {
    let scene =
        empty().gravity(-9.8).floor(1, 3.0).body(ball(2, dvec3(5.0, 0.5, 5.0), DVec3::ZERO).bounce(0.0));
    let report = study(&scene, &quick(1.0));
    assert_eq!(report.horizon.time, 0.0, "{:?}", report.horizon);
    let statement = report.horizon_statement();
    assert!(statement.starts_with("Not compared") && statement.contains("stay in contact"), "{statement}");
    let point = exact(&report);
    assert_eq!((point.position_error, point.missed, point.follows_until), (None, None, None), "{point:?}");
    assert!(point.energy_residual.is_some_and(|residual| residual < 1e-12), "{point:?}");
    svg(&report).expect("a picture without positions");
}

#[test]
fn tunnelling_is_a_missed_impact() {
    let scene = empty().ball(1, dvec3(5.0, 5.0, 2.0), dvec3(0.0, 0.0, 400.0)).plate(
        2,
        dvec3(5.0, 5.0, 8.0),
        DVec3::ZERO,
        2.0,
        2.0,
    );
    let report = study(&scene, &StudySettings { dts: vec![0.05], ..quick(0.1) });
    let (seen, thesis) = (exact(&report), &report.points[1]);
    assert_eq!((seen.impacts, seen.missed), (1, Some(0)), "{seen:?}");
    assert_eq!((thesis.method, thesis.impacts), (Method::Thesis, 0), "{thesis:?}");
    assert!(thesis.position_error > Some(1.0), "{thesis:?}");
}

#[test]
fn lists_of_impacts_are_told_apart() {
    let hit = |time, a, b| PairImpact { time, bodies: [a, b], onto: None };
    let reference = [hit(1.0, 0, 1), hit(2.0, 0, 1), hit(2.5, 1, 2), hit(3.0, 0, 1)];
    let late = [hit(1.0005, 1, 0), hit(2.0, 0, 1), hit(2.5, 2, 1), hit(2.9995, 0, 1)];
    assert_eq!(compare(&late, &reference, 4.0, 1e-3).first, None);
    let differing = [hit(1.0, 0, 1), hit(2.5, 1, 2), hit(2.7, 0, 2), hit(3.0, 0, 1), hit(9.0, 0, 1)];
    let found = compare(&differing, &reference, 4.0, 1e-3);
    assert_eq!((found.missed, found.wrong, found.first), (1, 1, Some(2.0)));
    // What lies beyond the end may be a partner, but is not counted.
    assert_eq!(compare(&[], &reference, 2.2, 1e-3).missed, 2);
}

/// Ball 0 comes down on the edge that walls 1 and 2 share: one list has both, another either.
#[test]
fn an_impact_on_the_edge_of_two_walls_is_one() {
    let onto =
        |time, wall, towards| PairImpact { time, bodies: [0, wall], onto: Some(Onto { ball: 0, towards }) };
    let down = dvec3(0.0, -1.0, 0.0);
    let (first, second) = (onto(1.0, 1, down), onto(1.0, 2, down));
    for (run, reference) in
        [(vec![first, second], vec![first]), (vec![first], vec![second]), (vec![second], vec![first, second])]
    {
        assert_eq!(compare(&run, &reference, 4.0, 1e-3).first, None, "{run:?} {reference:?}");
    }
    // From another side, and at another time.
    for other in [onto(1.0, 2, DVec3::X), onto(1.1, 2, down)] {
        assert_eq!(compare(&[first, other], &[first], 4.0, 1e-3).wrong, 1, "{other:?}");
    }
    // Another ball on the same wall.
    let beside = PairImpact { bodies: [3, 1], onto: Some(Onto { ball: 3, towards: down }), ..first };
    assert_eq!(compare(&[first, beside], &[first], 4.0, 1e-3).wrong, 1);
}

#[test]
fn cancelling_keeps_what_is_done() {
    let scene = load("bounce.xml");
    for (stage, points) in [("reference", 0..1), ("comparing thesis", 1..3), ("timing", 5..6)] {
        let cancel = AtomicBool::new(false);
        let mut last = 0.0;
        let mut watch = |progress: &StudyProgress| {
            assert!((last..=1.0).contains(&progress.part), "{last} {progress:?}");
            last = progress.part;
            cancel.fetch_or(progress.what.starts_with(stage), Ordering::Relaxed);
        };
        let report = run(&scene, "", &quick(10.0), &mut Control::new(&cancel, &mut watch)).expect("a report");
        assert!(report.cancelled && points.contains(&report.points.len()), "{stage}: {:?}", report.points);
        assert!(table(&report).contains("ancelled"), "{}", table(&report));
        svg(&report).expect("a picture of what there is");
    }
}

#[test]
fn heaps_are_studied_over_their_step() {
    let settings = StudySettings {
        methods: vec![Method::Exact],
        group_steps: vec![0.25, 1.0, 0.5],
        samples: 20,
        ..quick(0.5)
    };
    let scene = load("bin.xml");
    let own = Simulation::new(&scene).expect("it compiles").plan().group_step;
    let report = study(&scene, &settings);
    let steps: Vec<_> = report.points.iter().map(|point| point.group_step).collect();
    assert_eq!(steps, [None, Some(0.5 * own), Some(0.25 * own)], "the scene's own once");
    let overlaps: Vec<f64> = report.points.iter().map(|point| point.worst_overlap).collect();
    // What the solver allows is a share of the radius, 5 cm, whatever the step is.
    assert!(overlaps.iter().all(|overlap| (1e-6..5e-5).contains(overlap)), "{overlaps:?}");
    let residuals: Vec<_> = report.points.iter().map(|point| point.momentum_residual).collect();
    assert!(residuals[0] != residuals[1] && residuals[1] != residuals[2], "runs of their own: {residuals:?}");
    assert!(table(&report).contains(&seconds(0.25 * own)), "{}", table(&report));

    let nothing_rests = empty().ball(1, dvec3(1.0, 2.0, 3.0), dvec3(4.0, 5.0, 0.5));
    assert_eq!(study(&nothing_rests, &settings).points.len(), 1, "nothing can be stepped there");
}

#[test]
fn knobs_out_of_range_are_refused_by_name() {
    let good = StudySettings::default();
    let cases = [
        ("until", StudySettings { until: f64::NAN, ..good.clone() }),
        ("methods", StudySettings { methods: vec![], ..good.clone() }),
        ("dt", StudySettings { dts: vec![], ..good.clone() }),
        ("dt", StudySettings { dts: vec![11.0], ..good.clone() }),
        ("dt", StudySettings { dts: vec![1e-12], ..good.clone() }),
        ("tolerances", StudySettings { tolerances: vec![1.0], ..good.clone() }),
        ("group-steps", StudySettings { group_steps: vec![0.0], ..good.clone() }),
        ("repeat", StudySettings { repeat: 0, ..good.clone() }),
        ("samples", StudySettings { samples: 0, ..good.clone() }),
        ("agreement", StudySettings { agreement: -1.0, ..good.clone() }),
    ];
    assert_eq!(good.check(), Ok(()));
    for (name, settings) in cases {
        assert_eq!(settings.check().expect_err("refused").name, name);
    }
}

#[test]
fn csv_has_a_row_per_run_and_a_number_per_cell() {
    let report = study(&load("thesis-appendix-2.xml"), &quick(3.0));
    let text = csv(&report);
    let mut lines = text.lines();
    let heads: Vec<&str> = lines.next().expect("a head").split(',').collect();
    assert!(AXES.iter().all(|axis| heads.contains(&axis.id)), "{heads:?}");
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), report.points.len());
    for (row, point) in rows.iter().zip(&report.points) {
        assert_eq!(row.len(), heads.len(), "{row:?}");
        assert_eq!(row[0], point.method.name());
        for cell in row[1..].iter().filter(|cell| !cell.is_empty()) {
            assert!(cell.parse::<f64>().is_ok_and(f64::is_finite), "{cell} in {row:?}");
        }
        for axis in AXES {
            let at = heads.iter().position(|head| *head == axis.id).expect("a column");
            assert_eq!(row[at].parse().ok(), (axis.get)(point), "{}", axis.id);
        }
    }
}

#[test]
fn svg_is_well_formed_and_says_what_it_shows() {
    let mut report = study(&load("thesis-appendix-2.xml"), &quick(2.0));
    report.scene = "a < b & c.xml".into();
    let picture = svg(&report).expect("a picture");
    let mut reader = quick_xml::Reader::from_str(&picture);
    let mut said = String::new();
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Text(text) => said += &text,
            Event::GeneralRef(name) => said += &format!("&{};", &*name),
            Event::Eof => break,
            _ => said.push(' '),
        }
    }
    for axis in AXES.iter().filter(|axis| axis.is_drawn) {
        assert!(said.contains(axis.title), "{} in {said}", axis.title);
    }
    for label in
        ["a &lt; b &amp; c.xml", "exact", "thesis", "fixed", "1/30 s", "1/120 s", "wall time per simulated"]
    {
        assert!(said.contains(label), "{label} in {said}");
    }
}

#[test]
fn table_is_aligned_and_states_the_horizon() {
    let report = study(&load("bounce.xml"), &quick(2.0));
    let text = table(&report);
    assert!(text.contains(&report.horizon_statement()), "{text}");
    let head = text.lines().find(|line| line.starts_with("method")).expect("a head");
    let column = head.find("position").expect("a column") + "position".len();
    for name in ["exact", "thesis", "fixed"] {
        let row = text.lines().find(|line| line.starts_with(name)).expect("a row");
        // Δ and – take two and three bytes, but one place each.
        let cells: Vec<char> = row.chars().collect();
        let column = head[..column].chars().count();
        assert!(cells[column - 1].is_ascii_digit() && cells[column] == ' ', "{text}");
    }
}
