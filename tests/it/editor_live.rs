//! What an edit means for the simulation that runs, and what waits for a reset.

use std::time::Duration;

use glam::DVec3;
use polyscene::editor::{Action, Addition, Outcome, SessionCommand};
use polyscene::record::{BodyFrame, RunState};
use polyscene::scene::{BodyChange, Edit, ForceChange, ForceKind, SimParams};
use polyscene::sim::{BodyState, ContactState, Simulation};

use super::editor_support::{Bench, BodyNumbers};

fn at(x: f64) -> BodyChange {
    BodyChange::Position(DVec3::new(x, 3.0, 3.0))
}

fn weaker_gravity(bench: &Bench) -> Edit {
    let kind =
        ForceKind::GravityPlane { position: DVec3::splat(5.0), acceleration: DVec3::new(0.0, -1.6, 0.0) };
    Edit::Force { key: bench.force(1).key, change: ForceChange::Kind(kind) }
}

#[test]
fn opening_a_scene_loads_it() {
    let mut bench = Bench::new();
    assert_eq!(bench.sent(), ["Load"], "the empty scene");
    let path = bench.file("scene.xml", super::editor_support::SCENE);
    bench.act(Action::OpenPath(path));
    assert_eq!(bench.sent(), ["Unload", "Load"]);
}

#[test]
fn at_the_start_every_physical_edit_is_loaded_and_the_start_is_now() {
    let mut bench = Bench::open();
    bench.change(7, at(4.0));
    assert_eq!(bench.loaded().unwrap().bodies[1].position.x, 4.0);
    assert_eq!(bench.sent(), ["Load"]);
    bench.change(7, BodyChange::Mass(3.0));
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.sent(), ["Load", "Load"]);
    assert!(!bench.session.needs_reset());
}

#[test]
fn names_colours_and_what_is_hidden_do_not_touch_the_simulation() {
    let mut bench = Bench::open();
    for steps in 0..2 {
        bench.change(7, BodyChange::Name(Some(format!("ball {steps}"))));
        bench.change(7, BodyChange::Color(Some([200, 10, steps])));
        bench.change(8, BodyChange::Hidden(steps == 0));
        assert_eq!(bench.sent(), Vec::<String>::new());
        assert!(!bench.session.needs_reset());
        bench.step();
    }
}

#[test]
fn forces_statics_bounce_and_mass_apply_to_a_running_simulation() {
    let mut bench = Bench::open();
    bench.step();
    bench.edit(weaker_gravity(&bench));
    bench.change(7, BodyChange::Mass(3.0));
    bench.change(8, BodyChange::Bounce(0.75));
    bench.change(30, BodyChange::Bounce(0.5));
    bench.change(30, BodyChange::Position(DVec3::new(5.0, 1.0, 5.0)));
    bench.run(SessionCommand::Add(Addition::GravityPoint));
    bench.run(SessionCommand::Delete);
    bench.run(SessionCommand::Add(Addition::Plane));
    bench.run(SessionCommand::Delete);
    assert_eq!(
        bench.sent(),
        [
            "Edit ChangeForce",
            "Edit Mass",
            "Edit Bounce",
            "Edit Bounce",
            "Edit ChangeStatic",
            "Edit AddForce",
            "Edit Remove",
            "Edit AddBody",
            "Edit Remove",
        ]
    );
    assert!(!bench.session.needs_reset());
}

#[test]
fn the_core_takes_every_live_edit_and_then_equals_the_document() {
    let mut bench = Bench::open();
    let mut simulation = Simulation::new(bench.session.scene().unwrap()).unwrap();
    bench.step();
    simulation.begin(1.0 / 60.0);
    simulation.finish(&mut |_, _| {}).unwrap();
    let weaker = weaker_gravity(&bench);
    bench.edit(weaker);
    bench.change(7, BodyChange::Mass(3.0));
    bench.change(8, BodyChange::Bounce(0.75));
    bench.change(30, BodyChange::Bounce(0.5));
    bench.change(30, BodyChange::Rotation(DVec3::new(-1.5, 0.0, 0.0)));
    bench.run(SessionCommand::Add(Addition::GravityPoint));
    bench.run(SessionCommand::Add(Addition::Drag));
    bench.run(SessionCommand::Add(Addition::Plane));
    bench.act(Action::Select(vec![bench.key(8)]));
    bench.run(SessionCommand::Delete);
    let edits = bench.sent_edits();
    assert_eq!(edits.len(), 9);
    for edit in edits {
        simulation.apply(&edit).unwrap_or_else(|refused| panic!("{edit:?}: {refused}"));
    }
    assert!(!bench.session.needs_reset());
    assert_eq!((simulation.dynamic_count(), simulation.static_count()), (1, 2));
    // F = m g + attraction + drag, m and g as the document has them now
    let seven = simulation.find(bench.key(7)).unwrap();
    let state = simulation.state(seven).unwrap();
    let scene = bench.session.scene().unwrap();
    let expected: DVec3 = scene.forces.iter().map(|force| force_on(force.kind, state, 3.0, 0.5)).sum();
    assert!(
        simulation.total_force(seven).distance(expected) < 1e-12,
        "{} {expected}",
        simulation.total_force(seven)
    );
}

fn force_on(kind: ForceKind, state: BodyState, mass: f64, radius: f64) -> DVec3 {
    match kind {
        ForceKind::GravityPlane { acceleration, .. } => mass * acceleration,
        ForceKind::GravityPoint { position, intensity } => {
            let r = position - state.position;
            intensity * mass * r / r.length().powi(3)
        }
        ForceKind::Drag { density } => {
            let section = std::f64::consts::PI * radius * radius;
            -0.5 * 0.5 * density * section * state.velocity.length() * state.velocity
        }
    }
}

#[test]
fn undo_of_a_live_edit_is_a_live_edit() {
    let mut bench = Bench::open();
    bench.step();
    bench.change(7, BodyChange::Mass(3.0));
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.sent(), ["Edit Mass", "Edit Mass"]);
    assert!(!bench.session.needs_reset());
}

#[test]
fn poses_velocities_map_and_settings_wait_for_a_reset_and_undo_takes_the_badge_away() {
    let changes: [fn(&Bench) -> Edit; 6] = [
        |bench| Edit::Body { key: bench.key(7), change: at(4.0) },
        |bench| Edit::Body { key: bench.key(7), change: BodyChange::Velocity(DVec3::X) },
        |bench| Edit::Body { key: bench.key(7), change: BodyChange::Id(99) },
        |_| Edit::MapSize(DVec3::splat(20.0)),
        |_| Edit::MapTiles([5, 5, 5]),
        |_| Edit::Params(SimParams { rest_height: 1e-3, ..SimParams::default() }),
    ];
    for change in changes {
        let mut bench = Bench::open();
        bench.step();
        let edit = change(&bench);
        assert_eq!(bench.edit(edit.clone()), Outcome::Done);
        assert_eq!(bench.sent(), Vec::<String>::new(), "{edit:?}");
        assert!(bench.session.needs_reset(), "{edit:?}");
        let of_a_body = matches!(edit, Edit::Body { .. });
        assert!(!bench.session.waits_for_reset(bench.key(30)));
        let seven = bench.session.scene().unwrap().bodies[1].key;
        assert_eq!(bench.session.waits_for_reset(seven), of_a_body, "{edit:?}");
        bench.run(SessionCommand::Undo);
        assert!(!bench.session.needs_reset(), "{edit:?}");
        bench.run(SessionCommand::Redo);
        bench.run(SessionCommand::Reset);
        assert_eq!(bench.sent(), ["Load"], "a reset goes to the scene as it is edited");
        assert!(!bench.session.needs_reset());
    }
}

#[test]
fn a_new_dynamic_body_waits_for_the_start_and_a_deleted_one_goes_at_once() {
    let mut bench = Bench::open();
    bench.step();
    bench.run(SessionCommand::Add(Addition::SphereDynamic));
    let added = bench.session.selection().primary().unwrap();
    assert_eq!(bench.sent(), Vec::<String>::new());
    assert!(bench.session.needs_reset());
    assert!(!bench.session.is_running(added));
    // edits of what does not run yet are no edits of the run
    bench.edit(Edit::Body { key: added, change: BodyChange::Mass(7.0) });
    bench.edit(Edit::Body { key: added, change: BodyChange::Bounce(0.5) });
    assert_eq!(bench.sent(), Vec::<String>::new());
    bench.run(SessionCommand::Delete);
    assert!(!bench.session.needs_reset());
    bench.act(Action::Select(vec![bench.key(8)]));
    bench.run(SessionCommand::Delete);
    assert_eq!(bench.sent(), ["Edit Remove"]);
    assert!(!bench.session.needs_reset());
    bench.run(SessionCommand::Undo);
    assert!(bench.session.needs_reset(), "it was taken out of the run and comes back with the start");
    assert_eq!(bench.sent(), Vec::<String>::new());
}

#[test]
fn reset_loads_again_only_when_the_run_was_edited() {
    let mut bench = Bench::open();
    bench.step();
    bench.run(SessionCommand::Reset);
    assert_eq!(bench.sent(), ["Reset"]);
    bench.step();
    bench.change(7, BodyChange::Mass(3.0));
    bench.run(SessionCommand::Undo);
    bench.sent();
    bench.run(SessionCommand::Reset);
    assert_eq!(bench.sent(), ["Load"], "edits that were recorded must not come back");
}

#[test]
fn a_drag_reaches_the_simulation_when_it_ends_or_stands_still() {
    let mut bench = Bench::open();
    for step in 1..=10 {
        bench.drag(7, at(3.0 + 0.1 * f64::from(step)), 1);
        bench.wait(Duration::from_millis(16));
        assert_eq!(bench.sent(), Vec::<String>::new());
    }
    bench.wait(Duration::from_millis(200));
    assert_eq!(bench.loaded().unwrap().bodies[1].position.x, 4.0);
    assert_eq!(bench.sent(), ["Load"]);
    // standing still did not end the drag
    bench.drag(7, at(6.0), 1);
    bench.act(Action::EndGesture);
    assert_eq!(bench.sent(), ["Load"]);
    bench.wait(Duration::from_secs(1));
    assert_eq!(bench.sent(), Vec::<String>::new());
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.body(7).position.x, 3.0);
}

#[test]
fn a_step_during_a_drag_runs_what_is_seen() {
    let mut bench = Bench::open();
    bench.drag(7, at(4.0), 1);
    bench.run(SessionCommand::StepForward);
    let sent = bench.sent();
    assert_eq!(sent[0], "Load");
    assert!(sent[1].starts_with("Step"), "{sent:?}");
}

#[test]
fn stepping_back_to_the_start_lets_edits_load_again() {
    let mut bench = Bench::open();
    bench.step();
    bench.run(SessionCommand::StepBack);
    bench.change(7, at(4.0));
    assert!(bench.session.needs_reset(), "the frame does not show the start yet");
    bench.show(|frame| {
        frame.dt_index = 0;
        frame.time = 0.0;
    });
    assert!(bench.session.shows_start());
    bench.sent();
    bench.change(7, at(4.5));
    assert_eq!(bench.sent(), ["Load"]);
    assert!(!bench.session.needs_reset());
}

#[test]
fn a_stale_frame_of_the_start_does_not_hide_that_a_step_was_sent() {
    let mut bench = Bench::open();
    bench.run(SessionCommand::StepForward);
    bench.show(|frame| frame.state = RunState::Busy);
    assert!(!bench.session.shows_start());
    bench.sent();
    bench.change(7, at(4.0));
    assert_eq!(bench.sent(), Vec::<String>::new(), "loading would throw the step away");
}

#[test]
fn a_document_with_errors_is_not_run_and_can_be_put_right() {
    let mut bench = Bench::new();
    let text = super::editor_support::SCENE.replacen(
        "<Sphere><Radius F32=\"0,5\" /></Sphere>",
        "<Cylinder><Radius F32=\"0,5\" /><HalfHeight F32=\"1\" /></Cylinder>",
        1,
    );
    let path = bench.file("cylinder.xml", &text);
    bench.sent();
    bench.act(Action::OpenPath(path));
    assert_eq!(bench.sent(), ["Unload"]);
    assert!(bench.notices().contains("has 1 error"));
    assert!(matches!(bench.run(SessionCommand::StepForward), Outcome::Refused(_)));
    bench.act(Action::Select(vec![bench.key(7)]));
    assert_eq!(bench.run(SessionCommand::Delete), Outcome::Done);
    assert_eq!(bench.sent(), ["Load"]);
    assert_eq!(bench.run(SessionCommand::StepForward), Outcome::Done);
}

#[test]
fn an_edit_that_the_run_refuses_is_told_and_waits_for_the_start() {
    let mut bench = Bench::open();
    bench.step();
    bench.change(30, BodyChange::Bounce(0.5));
    bench.show(|frame| frame.refused = Some("no such body".into()));
    assert!(bench.session.needs_reset());
    assert!(bench.notices().contains("no such body"));
    bench.wait(Duration::from_secs(1));
    assert_eq!(bench.notices(), "", "told once");
}

#[test]
fn the_state_now_becomes_the_start_in_one_undo_point() {
    let mut bench = Bench::open();
    bench.step();
    let (seven, eight) = (bench.key(7), bench.key(8));
    bench.show(|frame| frame.bodies = vec![moved(seven, 1.0), moved(eight, 2.0)]);
    assert_eq!(bench.run(SessionCommand::TakeStateAsStart), Outcome::Done);
    assert_eq!(bench.loaded().unwrap().bodies[2].position, DVec3::splat(2.0));
    assert_eq!(bench.sent(), ["Pause", "Load"]);
    assert_eq!(bench.body(7).position, DVec3::splat(1.0));
    assert_eq!(bench.body(7).velocity(), Some(DVec3::new(0.0, -1.0, 0.0)));
    assert!(bench.session.shows_start() && !bench.session.needs_reset());
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.bytes(), super::editor_support::SCENE);
}

fn moved(key: polyscene::scene::NodeKey, to: f64) -> BodyFrame {
    BodyFrame {
        turn: None,
        key,
        position: DVec3::splat(to),
        velocity: DVec3::new(0.0, -to, 0.0),
        acceleration: DVec3::ZERO,
        force: DVec3::ZERO,
        kinetic: 0.0,
        contact: ContactState::Flight,
    }
}

#[test]
fn playing_takes_on_a_new_step_speed_and_time_speed() {
    let mut bench = Bench::open();
    bench.act(Action::SetDt("1/100".into()));
    bench.run(SessionCommand::PlayPause);
    assert_eq!(bench.sent(), ["Play { dt: 0.01, speed: 1.0, range: None }"]);
    bench.show(|frame| frame.state = RunState::Playing);
    bench.act(Action::SetDt("0,02".into()));
    bench.run(SessionCommand::Faster);
    bench.edit(Edit::TimeSpeed(0.25));
    assert_eq!(
        bench.sent(),
        [
            "Play { dt: 0.02, speed: 1.0, range: None }",
            "Play { dt: 0.02, speed: 2.0, range: None }",
            "Play { dt: 0.02, speed: 0.5, range: None }"
        ]
    );
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.sent(), ["Play { dt: 0.02, speed: 2.0, range: None }"]);
    bench.run(SessionCommand::PlayPause);
    assert_eq!(bench.sent(), ["Pause"]);
}

#[test]
fn a_step_or_a_reset_while_playing_stops_playing_first() {
    for command in [
        SessionCommand::StepForward,
        SessionCommand::NextEvent,
        SessionCommand::StepBack,
        SessionCommand::EventBack,
        SessionCommand::Reset,
    ] {
        let mut bench = Bench::open();
        bench.step();
        bench.show(|frame| frame.state = RunState::Playing);
        bench.run(command);
        let sent = bench.sent();
        assert_eq!((sent.len(), sent[0].as_str()), (2, "Pause"), "{command:?}: {sent:?}");
    }
}
