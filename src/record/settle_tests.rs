//! What may go wrong while a run is simulated again.

#![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec3;

use super::command::RunCommand;
use super::file::WriteRequest;
use super::frame::{Frame, RunState};
use super::publish::{Pace, bodies_looked_up, frame_of};
use super::recorder::RunRecorder;
use super::recording::BUDGET;
use super::run::Run;
use crate::scene::{Document, NodeKey, Scene};
use crate::sim::{Force, Method, SimEdit, Simulation, Subject};

/// No force, or one that is not a number.
#[derive(Debug, Default)]
struct Breakable(AtomicBool);

impl Force for Breakable {
    fn force(&self, _: &Subject<'_>) -> DVec3 {
        if self.0.load(Ordering::Relaxed) { DVec3::NAN } else { DVec3::ZERO }
    }

    fn potential(&self, _: &Subject<'_>) -> Option<f64> {
        Some(0.0)
    }
}

fn recorder(force: Option<Arc<Breakable>>) -> RunRecorder {
    let document = Document::from_bytes(include_bytes!("../../scenes/bounce.xml"));
    let scene = document.scene().unwrap().clone();
    let mut simulation = Simulation::new(&scene).unwrap();
    if let Some(force) = force {
        simulation.add_force(force).unwrap();
    }
    let mut recorder = RunRecorder::default();
    recorder.run = Some(Run::new(simulation, Arc::new(scene), BUDGET));
    recorder
}

fn frame(recorder: &mut RunRecorder) -> Frame {
    frame_of(recorder, 1, 1, Pace::default())
}

fn frame_after(recorder: &mut RunRecorder, command: RunCommand) -> Frame {
    recorder.command(command);
    while recorder.work(u32::MAX) {}
    frame(recorder)
}

/// Symptom: a step back that met a fault showed a frame of another time, and no fault.
/// Expected: the frame is faulted and has the reason; going back to the start still helps.
/// Cause: errors of the steps that are simulated again were dropped.
#[test]
fn a_fault_on_the_way_back_reaches_the_frame() {
    let force = Arc::new(Breakable::default());
    let mut recorder = recorder(Some(force.clone()));
    let forward = frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 3 });
    assert_eq!((forward.state, forward.fault), (RunState::Paused, None));

    force.0.store(true, Ordering::Relaxed);
    let back = frame_after(&mut recorder, RunCommand::StepBack);
    assert_eq!(back.state, RunState::Faulted);
    assert!(back.fault.is_some_and(|fault| fault.starts_with("at t = ")));

    force.0.store(false, Ordering::Relaxed);
    let reset = frame_after(&mut recorder, RunCommand::Reset);
    assert_eq!((reset.state, reset.fault, reset.time), (RunState::Paused, None, 0.0));
}

/// Symptom: a recording saved while its run came to a fault was not written, without a word. Expected: it is written, up to the
/// fault. Cause: a fault dropped all that waits.
#[test]
fn a_file_that_waits_is_written_at_a_fault() {
    let folder = tempfile::tempdir().unwrap();
    let force = Arc::new(Breakable::default());
    let mut recorder = recorder(Some(force.clone()));
    recorder.command(RunCommand::Step { dt: 0.01, count: 1000 });
    assert!(recorder.work(1));
    force.0.store(true, Ordering::Relaxed);
    recorder.command(RunCommand::Step { dt: 0.01, count: 1 });
    recorder.command(RunCommand::Write(Box::new(WriteRequest {
        path: folder.path().join("run.psrec"),
        scene_name: "bounce.xml".into(),
        scene: include_bytes!("../../scenes/bounce.xml").to_vec(),
        bookmarks: Vec::new(),
    })));
    while recorder.work(u32::MAX) {}
    let stopped = frame(&mut recorder);
    assert_eq!(stopped.state, RunState::Faulted);
    assert_eq!(stopped.written.unwrap().problem, None);
}

/// Symptom: a recorded edit that the simulation refused when run again was left out without a word.
/// Expected: the frame has the reason.
/// Cause: the result of applying a recorded edit was dropped.
#[test]
fn an_edit_refused_when_run_again_reaches_the_frame() {
    let mut recorder = recorder(None);
    frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 2 });
    let run = recorder.run.as_mut().unwrap();
    let unknown = SimEdit::Remove(NodeKey(u32::MAX.into()));
    let reason = run.simulation.apply(&unknown).unwrap_err().to_string();
    run.recording.note_edits(&run.simulation, vec![unknown]);
    run.recording.keyframes.drop_after_edits(0);
    frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 1 });

    let again = frame_after(&mut recorder, RunCommand::Seek { dt: 0.25, time: 0.4 });
    assert_eq!((again.state, again.complaint()), (RunState::Paused, None));
    let again = frame_after(&mut recorder, RunCommand::Seek { dt: 0.25, time: 0.6 });
    assert_eq!(again.state, RunState::Paused);
    let message = again.message.unwrap();
    assert!(message.contains("edit made at 0.5 s") && message.ends_with(reason.as_str()), "{message}");
}

/// Symptom: while a run went back, everything waited until it had arrived, for minutes in large scenes.
/// Expected: what was recorded is there at once; the simulation follows in portions of bounded work and can be sent
/// elsewhere on its way; what is shown then is the same.
/// Cause: going back simulated the whole way inside one command.
#[test]
fn going_back_is_at_once_and_the_simulation_follows_in_portions() {
    let mut recorder = recorder(None);
    let steps = |count| RunCommand::Step { dt: 0.25, count };
    let seventh = frame_after(&mut recorder, steps(7));
    let last = frame_after(&mut recorder, steps(1));
    assert!(last.event_count > 0, "{} events", last.event_count);

    recorder.command(RunCommand::StepBack);
    assert!(recorder.work(1), "there is more to simulate");
    let looked_up = frame(&mut recorder);
    assert_eq!((looked_up.state, looked_up.is_settled), (RunState::Paused, false));
    assert_eq!((looked_up.time, looked_up.dt_index, &looked_up.bodies), (1.75, 7, &seventh.bodies));
    assert_eq!((looked_up.event_count, &looked_up.events), (seventh.event_count, &seventh.events));
    assert_eq!((looked_up.energy, looked_up.ledger.len()), (None, last.ledger.len()));

    let on = frame_after(&mut recorder, steps(1));
    assert!(on.is_settled);
    assert_eq!((on.time, on.dt_index, &on.bodies), (last.time, last.dt_index, &last.bodies));
    assert_eq!((on.event_count, &on.events, on.energy), (last.event_count, &last.events, last.energy));
}

/// Symptom: an edit sent while a run went back was made somewhere on the way.
/// Expected: it is made where the way ends.
/// Cause: edits act at once on whatever state the simulation is in.
#[test]
fn an_edit_waits_until_the_simulation_is_there() {
    let mut recorder = recorder(None);
    let last = frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 8 });
    recorder.command(RunCommand::StepBack);
    assert!(recorder.work(1));
    let key = last.bodies[0].key;
    let frame = frame_after(&mut recorder, RunCommand::Edit(vec![SimEdit::Remove(key)]));
    assert_eq!((frame.time, frame.bodies.len() + 1), (1.75, last.bodies.len()));
}

/// A run that is no longer the one recorded is reported, with the time.
#[test]
fn a_divergence_is_reported() {
    let mut recorder = recorder(None);
    frame_after(&mut recorder, RunCommand::Step { dt: 0.25, count: 8 });
    let text = String::from_utf8_lossy(include_bytes!("../../scenes/bounce.xml")).into_owned();
    let document = Document::from_bytes(text.replace("Y=\"5\"", "Y=\"4.9\"").as_bytes());
    let lower = Simulation::new(document.scene().unwrap()).unwrap();
    recorder.run.as_mut().unwrap().recording.keyframes.exchange_first(&lower);
    let back = frame_after(&mut recorder, RunCommand::StepBack);
    let message = back.message.unwrap();
    assert!(message.contains("differs from its recording from t = "), "{message}");
}

/// The samples, each for some seconds or events.
fn samples() -> Vec<(String, Arc<Scene>)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files.filter(|path| path.extension().is_some_and(|ext| ext == "xml")).collect();
    files.sort();
    let scene = |path: &std::path::PathBuf| Document::open(path).scene().cloned();
    let named = files.iter().filter_map(|path| Some((path.display().to_string(), Arc::new(scene(path)?))));
    named.filter(|(_, scene)| scene.bodies.len() < 50).collect()
}

/// What is looked up has the bits of what is simulated again: at ticks, at events, between them, by every method.
#[test]
fn what_is_looked_up_is_what_is_simulated_again() {
    let mut compared = 0;
    for (name, scene) in samples() {
        for method in Method::ALL {
            let mut recorder = RunRecorder::default();
            recorder.command(RunCommand::Method(method));
            recorder.command(RunCommand::Load(scene.clone()));
            recorder.command(RunCommand::Step { dt: 1.0 / 50.0, count: 75 });
            (0..5_000).take_while(|_| recorder.work(1)).for_each(drop);
            recorder.command(RunCommand::Pause);
            let end = frame(&mut recorder);
            // Spread without a pattern: multiples of the golden ratio.
            let times = (1..=8).map(|nth| end.recorded.to * (0.618_033_988_75 * f64::from(nth)).fract());
            let seeks = times.map(|time| RunCommand::Seek { dt: 1.0, time });
            let events = end.ledger.iter_from(0).step_by(1 + end.ledger.len() / 8);
            let visits = events.map(|row| RunCommand::GoTo { event: row.event.seq });
            for command in seeks.chain(visits) {
                let what = format!("{name}, {}, {command:?}", method.name());
                recorder.command(command);
                recorder.work(1);
                let looked_up = bodies_looked_up(recorder.run.as_ref().unwrap());
                while recorder.work(u32::MAX) {}
                let settled = frame(&mut recorder);
                assert_eq!(settled.complaint(), None, "{what}");
                for (looked_up, settled) in looked_up.iter().zip(&settled.bodies) {
                    assert_eq!(looked_up, settled, "{what}");
                }
                assert_eq!(looked_up.len(), settled.bodies.len(), "{what}");
                compared += 1;
            }
        }
    }
    assert!(compared > 300, "{compared} moments");
}
