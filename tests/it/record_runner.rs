//! Runners: the Δt grid, stepping by event, going back, edits with their stamps, playing.

use std::sync::Arc;
use std::time::{Duration, Instant};

use polyscene::record::{
    Exceeded, Frame, InlineRunner, Limits, Of, RunCommand, RunState, Runner, ThreadRunner, Watch, advance,
};
use polyscene::scene::{Document, ForceKind, Scene};
use polyscene::sim::{EventKind, SimEdit, Simulation};

const DT: f64 = 1.0 / 60.0;

fn scene(name: &str) -> Scene {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    Document::open(&path).scene().expect("a sample scene").clone()
}

fn loaded(name: &str) -> InlineRunner {
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(scene(name))));
    runner
}

/// Everything about a frame that must be the same to the bit when the same point is reached again.
fn bits(frame: &Frame) -> (u64, u64, Vec<[u64; 6]>) {
    let bodies = frame.bodies.iter().map(|body| {
        let (x, v) = (body.position.to_array(), body.velocity.to_array());
        [x[0], x[1], x[2], v[0], v[1], v[2]].map(f64::to_bits)
    });
    (frame.time.to_bits(), frame.event_count, bodies.collect())
}

fn step(runner: &mut InlineRunner, count: u32) -> Arc<Frame> {
    runner.send(RunCommand::Step { dt: DT, count });
    runner.frame()
}

#[test]
fn ticks_are_products_of_the_step() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let frame = step(&mut runner, 300);
    assert_eq!(frame.time.to_bits(), (300.0 * DT).to_bits());
    assert_eq!((frame.dt_index, frame.open_step), (300, None));
    assert_eq!(frame.state, RunState::Paused);
}

#[test]
fn events_one_by_one_then_finish_is_one_step() {
    let mut whole = loaded("thesis-appendix-2.xml");
    whole.send(RunCommand::Step { dt: 1.0, count: 3 });
    let mut pieces = loaded("thesis-appendix-2.xml");
    while pieces.frame().event_count < whole.frame().event_count {
        pieces.send(RunCommand::NextEvent { dt: 1.0, of: Of::All });
        let frame = pieces.frame();
        let (start, end) = frame.open_step.expect("an event lies inside an open Δt");
        assert!(start <= frame.time && frame.time <= end);
        assert_eq!(frame.events.last().map(|row| row.event.seq), Some(frame.event_count));
    }
    pieces.send(RunCommand::FinishStep);
    assert_eq!(bits(&pieces.frame()), bits(&whole.frame()));
    assert!(whole.frame().event_count > 3, "the scene must have events for this test to mean anything");
}

#[test]
fn stepping_back_returns_to_every_tick_with_the_same_bits() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let mut seen = vec![bits(&runner.frame())];
    for _ in 0..400 {
        seen.push(bits(&step(&mut runner, 1)));
    }
    for expected in seen.iter().rev().skip(1) {
        runner.send(RunCommand::StepBack);
        assert_eq!(bits(&runner.frame()), *expected);
    }
    assert!(!runner.frame().can_step_back);
    runner.send(RunCommand::StepBack);
    assert_eq!(bits(&runner.frame()), seen[0], "there is nothing before the start");
    assert_eq!(bits(&step(&mut runner, 400)), seen[400]);
}

#[test]
fn event_back_returns_to_every_event() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let mut seen = Vec::new();
    for _ in 0..20 {
        runner.send(RunCommand::NextEvent { dt: 0.25, of: Of::All });
        seen.push(bits(&runner.frame()));
    }
    for expected in seen.iter().rev().skip(1) {
        runner.send(RunCommand::EventBack { of: Of::All });
        let frame = runner.frame();
        assert_eq!(bits(&frame), *expected);
        assert_eq!(frame.events.last().map(|row| row.event.seq), Some(frame.event_count));
        assert!(frame.open_step.is_some_and(|(start, end)| start <= frame.time && frame.time <= end));
    }
    for expected in &seen[1..] {
        runner.send(RunCommand::NextEvent { dt: 0.25, of: Of::All });
        assert_eq!(bits(&runner.frame()), *expected);
    }
}

#[test]
fn edits_are_replayed_at_their_stamps_and_a_new_one_makes_a_new_future() {
    let mut runner = loaded("thesis-appendix-2.xml");
    step(&mut runner, 100);
    let mut force = scene("thesis-appendix-2.xml").forces[0].clone();
    force.kind = ForceKind::GravityPlane {
        position: glam::DVec3::ZERO,
        acceleration: glam::DVec3::new(0.0, 2.0, 0.0),
    };
    let lighter = SimEdit::ChangeForce(Box::new(force));
    runner.send(RunCommand::Edit(vec![lighter]));
    assert_eq!(runner.frame().complaint(), None);
    let after = bits(&step(&mut runner, 100));
    assert_eq!(runner.frame().energy.and_then(|e| e.residual).map(|r| r.abs() < 1e-10), Some(true));
    for _ in 0..150 {
        runner.send(RunCommand::StepBack);
    }
    assert_eq!(bits(&step(&mut runner, 150)), after, "the edit is part of the run");

    for _ in 0..150 {
        runner.send(RunCommand::StepBack);
    }
    let body = scene("thesis-appendix-2.xml").bodies[0].key;
    let wall = runner.frame().bodies[0].key;
    assert_ne!(body, wall);
    runner.send(RunCommand::Edit(vec![SimEdit::Mass(wall, 3.0)]));
    assert_eq!(
        runner.frame().events.last().map(|row| row.event.kind),
        None,
        "an edit is handed out by the next step"
    );
    assert_ne!(bits(&step(&mut runner, 150)), after);
}

#[test]
fn an_edit_is_an_event_of_the_table() {
    let mut runner = loaded("bounce.xml");
    step(&mut runner, 10);
    let key = runner.frame().bodies[0].key;
    runner.send(RunCommand::Edit(vec![SimEdit::Mass(key, 2.5)]));
    let frame = step(&mut runner, 1);
    assert_eq!(frame.events.iter().map(|row| row.event.kind).collect::<Vec<_>>(), [EventKind::Edit]);
}

#[test]
fn a_refused_edit_says_why_and_changes_nothing() {
    let mut runner = loaded("bounce.xml");
    let before = bits(&step(&mut runner, 10));
    let key = runner.frame().bodies[0].key;
    runner.send(RunCommand::Edit(vec![SimEdit::Mass(key, -1.0)]));
    assert!(runner.frame().refused.as_deref().is_some_and(|why| why.contains("Weight")));
    assert_eq!(bits(&runner.frame()), before);
    // a frame may come only after the next command
    step(&mut runner, 1);
    assert!(runner.frame().refused.is_some() && runner.frame().message.is_none());
}

#[test]
fn playing_takes_whole_steps_and_falls_behind_rather_than_stretch_them() {
    let mut runner = loaded("bounce.xml");
    runner.send(RunCommand::Play { dt: 0.01, speed: 1.0, range: None });
    runner.tick(0.055);
    assert_eq!(runner.frame().dt_index, 5);
    assert_eq!(runner.frame().state, RunState::Playing);
    runner.tick(60.0);
    assert!(runner.frame().time < 0.2, "a minute's stall must not be made up for: {}", runner.frame().time);
    runner.send(RunCommand::Pause);
    let paused = bits(&runner.frame());
    runner.tick(1.0);
    assert_eq!(bits(&runner.frame()), paused);
}

#[test]
fn next_event_gives_up_where_nothing_happens() {
    let mut scene = scene("bounce.xml");
    scene.bodies.retain(polyscene::scene::Body::is_dynamic);
    scene.forces.clear();
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(scene)));
    runner.send(RunCommand::NextEvent { dt: 0.01, of: Of::All });
    assert_eq!(runner.frame().state, RunState::Paused);
    assert!(runner.frame().message.is_some());
}

#[test]
fn commands_without_a_simulation_are_harmless() {
    let mut runner = InlineRunner::new();
    for command in [
        RunCommand::Reset,
        RunCommand::StepBack,
        RunCommand::EventBack { of: Of::All },
        RunCommand::FinishStep,
        RunCommand::Pause,
        RunCommand::Step { dt: f64::NAN, count: 3 },
        RunCommand::Unload,
    ] {
        runner.send(command);
    }
    assert_eq!(runner.frame().state, RunState::Empty);
    let mut runner = loaded("bounce.xml");
    runner.send(RunCommand::Step { dt: 0.0, count: 1 });
    assert!(runner.frame().message.is_some());
    assert_eq!(runner.frame().time, 0.0);
}

#[test]
fn a_thread_reaches_the_same_state() {
    let expected = {
        let mut runner = loaded("thesis-appendix-2.xml");
        bits(&step(&mut runner, 600))
    };
    let mut runner = ThreadRunner::new(|| {}).expect("a thread");
    runner.send(RunCommand::Load(Arc::new(scene("thesis-appendix-2.xml"))));
    runner.send(RunCommand::Step { dt: DT, count: 600 });
    let deadline = Instant::now() + Duration::from_secs(60);
    while runner.frame().dt_index < 600 && Instant::now() < deadline {
        std::thread::yield_now();
    }
    assert_eq!(bits(&runner.frame()), expected);
}

/// Symptom: closing the window waited for ever when the simulation's thread was inside one long call.
/// Cause: the thread was joined. Expected: it is left alone after a moment.
#[test]
fn a_thread_inside_a_long_call_does_not_hold_up_whoever_drops_it() {
    const LONG: Duration = Duration::from_secs(5);
    let mut runner = ThreadRunner::new(|| std::thread::sleep(LONG)).expect("a thread");
    runner.send(RunCommand::Load(Arc::new(scene("bounce.xml"))));
    while runner.frame().state == RunState::Empty {
        std::thread::yield_now();
    }
    let since = Instant::now();
    drop(runner);
    assert!(since.elapsed() < Duration::from_secs(1), "it took {:?}", since.elapsed());
}

/// Commands that wait when a runner is dropped are not carried out any more.
#[test]
fn a_dropped_thread_forgets_what_waits() {
    let (told, frames) = std::sync::mpsc::channel();
    let mut runner = ThreadRunner::new(move || told.send(()).unwrap_or_default()).expect("a thread");
    let scene = scene("gas.xml");
    for _ in 0..10_000 {
        runner.send(RunCommand::Load(Arc::new(scene.clone())));
    }
    drop(runner);
    // The channel closes when the thread has ended.
    let since = Instant::now();
    while frames.recv_timeout(Duration::from_secs(1)).is_ok() {}
    assert_eq!(frames.recv_timeout(Duration::ZERO), Err(std::sync::mpsc::RecvTimeoutError::Disconnected));
    assert!(since.elapsed() < Duration::from_secs(5), "it took {:?}", since.elapsed());
}

/// A run that is stopped by a limit stands right after its last event and can go on, to the same bits.
#[test]
fn a_limited_run_stops_after_its_event_and_goes_on() {
    let scene = scene("thesis-appendix-2.xml");
    let mut whole = Simulation::new(&scene).expect("a sound scene");
    let mut parted = whole.clone();
    whole.begin(10.0);
    whole.finish(&mut |_, _| {}).expect("no fault");
    let mut events = 0;
    let watch = Watch::start(Limits { events: Some(5), wall: None });
    let mut last = 0.0;
    let stop = advance(&mut parted, 10.0, &watch, &mut events, &mut |_, event| last = event.time);
    assert_eq!((stop, events, parted.time()), (Ok(Some(Exceeded::Events(5))), 5, last));
    let free = Watch::start(Limits::default());
    assert_eq!(advance(&mut parted, 10.0, &free, &mut events, &mut |_, _| {}), Ok(None));
    assert_eq!(parted.hash(), whole.hash());
    let hurried = Watch::start(Limits { events: None, wall: Some(Duration::ZERO) });
    let stop = advance(&mut parted, 20.0, &hurried, &mut events, &mut |_, _| {});
    assert_eq!(stop, Ok(Some(Exceeded::Wall(Duration::ZERO))));
}
