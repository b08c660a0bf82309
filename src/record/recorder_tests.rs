//! What becomes of commands that wait: when a run is paused, ends on a fault or is replaced, and in a script.

#![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

use std::path::Path;
use std::sync::Arc;

use super::command::{Of, RunCommand};
use super::file::WriteRequest;
use super::frame::{Frame, RunState};
use super::publish::{Pace, frame_of};
use super::recorder::RunRecorder;
use crate::scene::{Document, NodeKey, Scene};
use crate::sim::{Method, SimEdit};

const BOUNCE: &[u8] = include_bytes!("../../scenes/bounce.xml");
const THESIS: &[u8] = include_bytes!("../../scenes/thesis-appendix-2.xml");
const GAS: &[u8] = include_bytes!("../../scenes/gas.xml");
const LONG: RunCommand = RunCommand::Step { dt: 0.01, count: 1_000_000 };

fn scene(bytes: &[u8]) -> Arc<Scene> {
    Arc::new(Document::from_bytes(bytes).scene().unwrap().clone())
}

fn loaded(bytes: &[u8]) -> RunRecorder {
    let mut recorder = RunRecorder::default();
    recorder.command(RunCommand::Load(scene(bytes)));
    recorder
}

fn frame(recorder: &mut RunRecorder) -> Frame {
    frame_of(recorder, 1, 1, Pace::default())
}

fn frame_when_done(recorder: &mut RunRecorder) -> Frame {
    while recorder.work(1) {}
    frame(recorder)
}

fn write_to(path: &Path) -> RunCommand {
    RunCommand::Write(Box::new(WriteRequest {
        path: path.to_owned(),
        scene_name: "bounce.xml".into(),
        scene: BOUNCE.to_vec(),
        bookmarks: Vec::new(),
    }))
}

fn mass(key: NodeKey, mass: f64) -> RunCommand {
    RunCommand::Edit(vec![SimEdit::Mass(key, mass)])
}

/// Symptom: a pause, also one before a step, lost the edits and files that waited, without a word: the document had the edit and
/// the run had not. Expected: only what moves the time is given up. Cause: a pause cleared everything.
#[test]
fn a_pause_keeps_the_edits_and_files_that_wait() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.psrec");
    let mut recorder = loaded(BOUNCE);
    let key = frame(&mut recorder).bodies[0].key;
    recorder.command(LONG);
    assert!(recorder.work(1));
    recorder.command(RunCommand::Step { dt: 0.01, count: 7 });
    recorder.command(mass(key, 3.0));
    recorder.command(write_to(&path));
    recorder.command(RunCommand::Pause);
    let paused = frame_when_done(&mut recorder);
    assert!(paused.time < 0.1, "it goes no further: {} s", paused.time);
    assert_eq!(paused.recorded.edits, [paused.time]);
    assert_eq!(paused.written.as_ref().map(|written| written.problem.clone()), Some(None));
    assert!(path.exists());
}

/// The same where the simulation is still on its way to what is shown.
#[test]
fn a_pause_keeps_an_edit_that_waits_for_the_simulation() {
    let mut recorder = loaded(BOUNCE);
    let key = frame(&mut recorder).bodies[0].key;
    recorder.command(RunCommand::Step { dt: 0.25, count: 8 });
    frame_when_done(&mut recorder);
    recorder.command(RunCommand::StepBack);
    assert!(recorder.work(1));
    recorder.command(mass(key, 3.0));
    recorder.command(RunCommand::Pause);
    let back = frame_when_done(&mut recorder);
    assert_eq!(
        (back.time, &back.recorded.edits[..], back.recorded.can_bring_back),
        (1.75, &[1.75][..], true)
    );
    recorder.command(RunCommand::Step { dt: 0.25, count: 1_000_000 });
    assert!(recorder.work(1));
    recorder.command(RunCommand::BringBack);
    recorder.command(RunCommand::Pause);
    let again = frame_when_done(&mut recorder);
    assert_eq!((again.recorded.to, again.recorded.edits.len()), (2.0, 0));
}

/// Symptom: whoever saved a recording and then opened another scene heard nothing of the file. Expected: that there is none.
/// Cause: what waits was dropped with the run.
#[test]
fn a_file_that_will_not_be_written_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.psrec");
    for end in [RunCommand::Load(scene(THESIS)), RunCommand::Unload, RunCommand::Reset] {
        let mut recorder = loaded(BOUNCE);
        recorder.command(LONG);
        assert!(recorder.work(1));
        recorder.command(write_to(&path));
        recorder.command(end.clone());
        let written = frame_when_done(&mut recorder).written.unwrap();
        assert!(written.path == path && written.problem.is_some(), "{end:?}");
        assert!(!path.exists());
    }
    let mut recorder = RunRecorder::default();
    recorder.command(write_to(&path));
    assert!(frame_when_done(&mut recorder).written.unwrap().problem.is_some(), "there is nothing to write");
}

fn script(key: NodeKey) -> [RunCommand; 5] {
    let seek = |time| RunCommand::Seek { dt: 0.05, time };
    [seek(1.0), mass(key, 9.0), seek(2.0), mass(key, 0.5), seek(4.0)]
}

/// Symptom: the edits of a recording that was opened in the window were made as soon as they came, on the way to where they belong.
/// Expected: the run is the same however the work is divided. Cause: an edit waits only for commands not begun.
#[test]
fn a_script_makes_its_edits_where_its_movements_lead() {
    let mut one_by_one = loaded(THESIS);
    let key = frame(&mut one_by_one).bodies[0].key;
    for command in script(key) {
        one_by_one.command(command);
        frame_when_done(&mut one_by_one);
    }
    let mut at_once = loaded(THESIS);
    at_once.command(RunCommand::Script(script(key).into()));
    let (expected, found) = (frame_when_done(&mut one_by_one), frame_when_done(&mut at_once));
    assert_eq!(found.recorded.edits, [1.0, 2.0]);
    assert_eq!((found.time, found.event_count, &found.bodies), (4.0, expected.event_count, &expected.bodies));
}

/// Symptom: a step asked for right after playing, while something else was still being worked on, was never made. Expected: it ends
/// playing, as it does when that has begun. Cause: playing took its turn first, and has no end.
#[test]
fn a_step_ends_playing_that_has_not_begun() {
    let mut recorder = loaded(BOUNCE);
    recorder.command(RunCommand::Step { dt: 0.01, count: 7 });
    recorder.command(RunCommand::Play { dt: 0.01, speed: 1.0, range: None });
    recorder.command(RunCommand::Step { dt: 0.01, count: 3 });
    let stepped = frame_when_done(&mut recorder);
    assert_eq!((stepped.state, stepped.dt_index), (RunState::Paused, 10));
}

/// An edit of a script belongs to the moment it names, and to no other.
#[test]
fn a_pause_ends_a_script() {
    let mut recorder = loaded(THESIS);
    let key = frame(&mut recorder).bodies[0].key;
    recorder.command(RunCommand::Script(script(key).into()));
    while recorder.work(1) && frame(&mut recorder).time < 1.5 {}
    recorder.command(mass(key, 2.0));
    recorder.command(RunCommand::Pause);
    let paused = frame_when_done(&mut recorder);
    assert!((1.5..2.0).contains(&paused.time), "{} s", paused.time);
    assert_eq!(paused.recorded.edits, [1.0, paused.time], "that of the user is made");
}

/// Symptom: playing backwards over a range that ended after all that was recorded came to the first Δt and stood there, “playing”,
/// for ever; and a range of which nothing was recorded any more was worked on without end. Expected: the range is as long as what is
/// recorded of it, and where that is nothing playing ends and says so.
#[test]
fn playing_over_a_range_keeps_to_what_is_recorded_of_it() {
    let mut recorder = loaded(BOUNCE);
    let dt = 0.1;
    recorder.command(RunCommand::Step { dt, count: 20 });
    frame_when_done(&mut recorder);
    let mut play = |speed: f64, range: (f64, f64)| {
        recorder.command(RunCommand::Seek { dt, time: 0.5 });
        recorder.command(RunCommand::Play { dt, speed, range: Some(range) });
        let mut times = Vec::new();
        for _ in 0..12 {
            assert!((0..1000).any(|_| !recorder.work(10)), "it comes to rest between two ticks of the clock");
            times.push(frame(&mut recorder).time);
            recorder.elapse(dt);
        }
        (frame(&mut recorder), times)
    };
    let (frame, times) = play(-1.0, (0.0, 10.0));
    assert_eq!((frame.state, frame.message), (RunState::Playing, None));
    assert!(times.iter().any(|time| *time > 1.5), "from the end of what is recorded again: {times:?}");
    for (speed, range) in [(-1.0, (5.0, 10.0)), (1.0, (-2.0, -1.0))] {
        let (frame, _) = play(speed, range);
        assert_eq!(frame.state, RunState::Paused);
        assert!(frame.message.is_some_and(|message| message.contains("nothing is recorded of the range")));
    }
}

/// Symptom: what an edit had replaced was kept whatever it took, beside a recording that took all of the memory. Expected: it counts,
/// and goes first.
#[test]
fn what_an_edit_replaced_counts_and_is_dropped_first() {
    for at in [0.0, 0.5] {
        let mut recorder = loaded(THESIS);
        let key = frame(&mut recorder).bodies[0].key;
        recorder.command(RunCommand::Step { dt: 0.01, count: 3000 });
        let before = frame_when_done(&mut recorder).recorded.bytes;
        recorder.command(RunCommand::Seek { dt: 0.01, time: at });
        frame_when_done(&mut recorder);
        if at > 0.0 {
            recorder.command(mass(key, 3.0));
        } else {
            recorder.command(RunCommand::LoadEdited { scene: scene(THESIS), keeps_run: true });
        }
        let edited = frame_when_done(&mut recorder).recorded;
        assert!(edited.can_bring_back && edited.bytes >= before, "{} bytes after {before}", edited.bytes);
        recorder.command(RunCommand::Budget(before / 2));
        let kept = frame_when_done(&mut recorder).recorded;
        assert!(!kept.can_bring_back && kept.bytes < before / 4, "{} bytes", kept.bytes);
        assert_eq!((kept.from, kept.to), (0.0, at), "nothing of the run itself was dropped");
    }
}

/// Symptom: in a long Δt each look back simulated again from its start. Expected: keyframes lie inside it too, with the same bits.
#[test]
fn a_long_step_has_keyframes_inside() {
    for method in [Method::Exact, Method::Thesis, Method::Fixed] {
        let mut recorder = RunRecorder::default();
        recorder.command(RunCommand::Method(method));
        recorder.command(RunCommand::Load(scene(GAS)));
        recorder.command(RunCommand::Step { dt: 40.0, count: 1 });
        frame_when_done(&mut recorder);
        let states: Vec<_> = recorder.run.as_ref().unwrap().recording.keyframes.states().collect();
        let inside = states.iter().filter(|(at, ..)| at.time % 40.0 != 0.0).count();
        assert!(inside > 0 || method != Method::Exact, "{inside} of {} keyframes", states.len());
        for (at, _, hash) in states.into_iter().rev() {
            recorder.command(RunCommand::Show(at));
            assert_eq!(frame_when_done(&mut recorder).complaint(), None, "{method:?} at {at:?}");
            assert_eq!(recorder.run.as_ref().unwrap().simulation.hash(), hash, "{method:?} at {at:?}");
        }
    }
}

/// Symptom: "next event" of a ball that flew away simulated 10 000 Δt. Expected: once it has left the map it says that nothing
/// follows.
#[test]
fn what_flies_away_has_no_next_event() {
    for (gravity, speed) in [("0", "1"), ("9.8", "0"), ("-9.8", "20")] {
        let bounce = std::str::from_utf8(BOUNCE).unwrap().replace("-9.8", gravity);
        let away = format!("<InitialVelocity X=\"{speed}\"");
        let mut recorder = loaded(bounce.replace("<InitialVelocity X=\"0\"", &away).as_bytes());
        recorder.command(RunCommand::NextEvent { dt: 0.1, of: Of::All });
        let frame = frame_when_done(&mut recorder);
        let message = frame.message.unwrap_or_default();
        assert!(message.contains("meets nothing"), "{gravity}, {speed}: {message} at {} s", frame.time);
        assert!(frame.recorded.to < 20.0, "{gravity}, {speed}: {} s were simulated", frame.recorded.to);
    }
}

/// Symptom: without gravity "next event" simulated 10 000 Δt of nothing. Expected: it says at once that nothing moves.
#[test]
fn where_nothing_moves_there_is_no_next_event() {
    let without = std::str::from_utf8(BOUNCE).unwrap().replace("-9.8", "0");
    let mut recorder = loaded(without.as_bytes());
    recorder.command(RunCommand::NextEvent { dt: 0.01, of: Of::All });
    let frame = frame_when_done(&mut recorder);
    assert!(frame.message.is_some_and(|message| message.contains("nothing moves")));
    assert_eq!((frame.time, frame.event_count), (0.0, 0));
    assert!(frame.recorded.to < 0.1, "{} s were simulated", frame.recorded.to);
}
