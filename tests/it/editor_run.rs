//! The session beside its runner: files that the runner writes, bookmarks in a run that has become another one.

use std::sync::Arc;

use polyscene::editor::{Action, Session, SessionCommand, TravelCommand};
use polyscene::record::{Frame, InlineRunner, Of, RunCommand, RunState, Runner as _, Written};
use polyscene::scene::{BodyChange, Document, Edit, Shape};
use polyscene::sim::SimEdit;

use super::editor_support::{Bench, SCENE};

/// Symptom: the second recording saved to one path, and a failure that happened twice, were told once.
/// Expected: each is told. Cause: what a frame says was compared by its text.
#[test]
fn every_written_file_is_told() {
    let mut bench = Bench::open();
    for problem in [None, Some("the disk is full".to_owned())] {
        for nth in 1..=2 {
            let written = Written { path: "run.psrec".into(), problem: problem.clone() };
            bench.show(|frame| frame.written = Some(Arc::new(written)));
            assert!(bench.notices().contains("run.psrec"), "the {nth}. with {problem:?}");
            bench.show(|_| {});
            assert_eq!(bench.notices(), "", "told once");
        }
    }
}

/// Symptom: a recording could be written over the scene, under another spelling of its path. Expected: refused, and nothing is
/// sent. Cause: the paths were compared as text.
#[test]
fn a_recording_does_not_replace_the_scene_under_another_name() {
    let mut bench = Bench::open();
    let folder = bench.folder.path().canonicalize().unwrap();
    std::fs::create_dir(folder.join("deeper")).unwrap();
    bench.act(Action::SaveRecording(folder.join("deeper/../scene.xml")));
    assert!(bench.notices().contains("is the scene itself"));
    assert!(bench.sent().is_empty());
    assert_eq!(std::fs::read_to_string(folder.join("scene.xml")).unwrap(), SCENE);
}

/// A run of [`SCENE`] with its first ball at another height, at the first event.
fn at_first_event(falls_from: &str) -> Arc<Frame> {
    let text = SCENE.replace(r#"<Translation X="3" Y="3" Z="3" />"#, falls_from);
    let document = Document::from_bytes(text.as_bytes());
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(document.scene().unwrap().clone())));
    runner.send(RunCommand::NextEvent { dt: 0.1, of: Of::All });
    runner.frame()
}

/// Symptom: after an edit a bookmark at an event led to whatever event has that number now. Expected: to the bookmark's time,
/// and to the event only where it is the same. Cause: events were told apart by their numbers alone.
#[test]
fn a_bookmark_leads_to_its_time_where_its_event_is_another_one() {
    let mut bench = Bench::open();
    bench.step();
    let like = |from: &Frame| {
        let from = from.clone();
        move |frame: &mut Frame| {
            let (revision, command) = (frame.revision, frame.command);
            *frame = Frame { revision, command, ..from };
        }
    };
    let (first, other) = (
        at_first_event(r#"<Translation X="3" Y="3" Z="3" />"#),
        at_first_event(r#"<Translation X="3" Y="2" Z="3" />"#),
    );
    let time = |frame: &Frame| frame.event(1).map(|row| row.event.time);
    assert_ne!(time(&first), time(&other));
    bench.show(like(&first));
    bench.run(SessionCommand::Travel(TravelCommand::AddBookmark));
    assert_eq!(bench.session.travel().bookmarks()[0].event, Some(1));
    bench.sent();
    bench.act(Action::GoToBookmark(0));
    assert_eq!(bench.sent(), ["GoTo { event: 1 }"]);
    assert!(bench.session.shown_event().is_some());
    bench.show(like(&other));
    assert!(bench.session.shown_event().is_none(), "it is not in this run");
    bench.act(Action::GoToBookmark(0));
    let sent = bench.sent();
    assert!(sent.len() == 1 && sent[0].starts_with("Seek"), "{sent:?}");
}

/// A recording of [`SCENE`] with an edit, as a file.
fn recording(bench: &Bench) -> std::path::PathBuf {
    let document = Document::from_bytes(SCENE.as_bytes());
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(document.scene().unwrap().clone())));
    runner.send(RunCommand::Seek { dt: 0.1, time: 0.5 });
    let key = runner.frame().bodies[0].key;
    runner.send(RunCommand::Edit(vec![SimEdit::Mass(key, 2.0)]));
    runner.send(RunCommand::Seek { dt: 0.1, time: 1.0 });
    let file = runner.recording("scene.xml", SCENE.as_bytes()).unwrap();
    bench.file("run.psrec", std::str::from_utf8(&file.to_bytes().unwrap()).unwrap())
}

/// Symptom: a recording opened while another scene played ran otherwise than recorded. Expected: all its commands reach the
/// runner together, and none is a pause. Cause: what is known of the scene before was taken for the new one, so that each command
/// began by ending a playing that had ended, and with it the commands before.
#[test]
fn a_recording_opened_while_a_scene_plays_is_run_whole() {
    let mut bench = Bench::open();
    let path = recording(&bench);
    bench.step();
    bench.show(|frame| frame.state = RunState::Playing);
    bench.act(Action::OpenPath(path));
    let sent = bench.sent();
    let [unload, load, method, script] = &sent[..] else { panic!("{sent:?}") };
    assert_eq!([unload, load, method], ["Unload", "Load", "Method(Exact)"]);
    assert!(script.starts_with("Script") && script.matches("Seek").count() == 2, "{script}");
    // The runner has not shown anything of it yet.
    bench.wait(std::time::Duration::from_secs(1));
    assert_ne!(bench.session.frame().state, RunState::Playing);
    bench.act(Action::SetSpeed(2.0));
    assert!(bench.sent().is_empty(), "nothing plays");
}

/// Symptom: a recording by another name was shown as a scene with errors of its text.
#[test]
fn a_recording_by_another_name_is_opened_as_one() {
    let mut bench = Bench::open();
    let path = recording(&bench).with_file_name("run.json");
    std::fs::rename(path.with_extension("psrec"), &path).unwrap();
    bench.act(Action::OpenPath(path));
    let sent = bench.sent();
    assert!(sent.last().is_some_and(|last| last.starts_with("Script")), "{sent:?}");
}

/// Symptom: of two steps asked for while a scene played, the first was lost. Expected: playing is ended once. Cause: the second
/// pause, sent before a frame showed the first, ended the step between.
#[test]
fn steps_asked_for_at_once_do_not_end_each_other() {
    let mut bench = Bench::open();
    bench.step();
    bench.show(|frame| frame.state = RunState::Playing);
    bench.run(SessionCommand::StepForward);
    bench.run(SessionCommand::StepForward);
    let sent = bench.sent();
    assert_eq!(sent.iter().filter(|command| *command == "Pause").count(), 1, "{sent:?}");
    assert_eq!((sent.len(), sent[0].as_str()), (3, "Pause"), "{sent:?}");
}

/// Symptom: a run that found no event showed "Not applied to the running simulation" and "Reset to apply". Expected: what it says,
/// each time, and nothing to apply. Cause: a frame had one field for faults, refused edits and messages, compared by its text.
#[test]
fn a_message_is_not_a_refused_edit() {
    let mut bench = Bench::open();
    bench.step();
    for _ in 0..2 {
        bench.show(|frame| frame.message = Some("no event within 100000 Δt".into()));
        assert_eq!(bench.notices(), "no event within 100000 Δt");
        assert!(!bench.session.needs_reset());
        assert!(bench.session.problems().is_empty());
    }
    for _ in 0..2 {
        bench.show(|frame| frame.refused = Some("no such body".into()));
        assert!(bench.notices().starts_with("Not applied to the running simulation: no such body"));
        assert!(bench.session.needs_reset());
    }
}

/// Symptom: an edit at the start, after Home, began another recording, and what was recorded was gone. Expected: it can be brought
/// back until a run is edited. Cause: the run was loaded anew as though it had not begun.
#[test]
fn what_was_recorded_before_an_edit_of_the_start_is_brought_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    std::fs::write(&path, SCENE).unwrap();
    let mut session = Session::new(Box::new(InlineRunner::new()));
    let now = std::time::Instant::now();
    let mut act = |action: Action| {
        session.perform(action);
        session.poll(now);
        (session.frame().clone(), session.scene().map(|scene| scene.bodies[1].key))
    };
    let run = |command| Action::Command(command);
    let home = || run(SessionCommand::Travel(TravelCommand::GoToBegin));
    let back = || run(SessionCommand::Travel(TravelCommand::BringBack));
    let (_, key) = act(Action::OpenPath(path));
    let moved = |x: f64| {
        let change = BodyChange::Position(glam::dvec3(x, 3.0, 3.0));
        Action::Edit { edit: Edit::Body { key: key.unwrap(), change }, gesture: None }
    };
    let recorded = (0..9).map(|_| act(run(SessionCommand::StepForward)).0).last().unwrap();
    assert!(recorded.recorded.to > 0.1 && !recorded.recorded.can_bring_back);
    assert!(act(home()).0.is_at_start());
    // Where the run has not gone on, a second edit keeps what the first one has kept.
    for x in [3.5, 4.0] {
        let (edited, _) = act(moved(x));
        assert_eq!((edited.recorded.to, edited.bodies[0].position.x), (0.0, x));
        assert!(edited.recorded.can_bring_back);
    }
    let (again, _) = act(back());
    assert_eq!((again.recorded.to, again.bodies[0].position.x), (recorded.recorded.to, 3.0));
    assert!(again.is_at_start() && !again.recorded.can_bring_back);
    let (end, _) = act(run(SessionCommand::Travel(TravelCommand::GoToEnd)));
    assert_eq!((end.time, &end.bodies), (recorded.time, &recorded.bodies));
    // The scene still has the edit: the run goes to its start as it is now.
    let (reset, _) = act(run(SessionCommand::Reset));
    assert_eq!(reset.bodies[0].position.x, 4.0);
    // And a run that goes on from an edited start is kept no less.
    act(run(SessionCommand::StepForward));
    act(home());
    assert!(act(moved(5.0)).0.recorded.can_bring_back);
    act(run(SessionCommand::StepForward));
    let lighter = Edit::Body { key: key.unwrap(), change: BodyChange::Mass(0.5) };
    let (live, _) = act(Action::Edit { edit: lighter, gesture: None });
    assert!(live.recorded.edits.len() == 1 && !live.recorded.can_bring_back, "until a run is edited");
}

/// A session whose runner simulates at once, with [`SCENE`] in a folder that lasts as long.
fn opened() -> (tempfile::TempDir, Session) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    std::fs::write(&path, SCENE).unwrap();
    let mut session = Session::new(Box::new(InlineRunner::new()));
    act(&mut session, Action::OpenPath(path));
    (folder, session)
}

fn act(session: &mut Session, action: Action) {
    session.perform(action);
    session.poll(std::time::Instant::now());
}

/// Symptom: before an edit, the past was drawn with the scene as edited since: balls stood on a floor that was not drawn, and
/// events named it by its number. Expected: what was there then. Cause: only moving bodies were drawn from the run.
#[test]
fn the_past_is_drawn_as_it_was() {
    let (_folder, mut session) = opened();
    let run = |command| Action::Command(command);
    let travel = |command| run(SessionCommand::Travel(command));
    let edit = |edit| Action::Edit { edit, gesture: None };
    let [floor, ball] = [0, 1].map(|nth| session.scene().unwrap().bodies[nth].key);
    // Keys and radii of what the views show.
    let drawn = |session: &Session| {
        let scene = session.scene_then().and_then(|then| session.drawn(&then));
        let scene = scene.or_else(|| session.document().scene_shared()).unwrap();
        let radius = scene.bodies.iter().find(|body| body.key == ball).map(|ball| ball.shape.clone());
        (scene.bodies.iter().any(|body| body.key == floor), radius.unwrap())
    };
    let has_floor = |session: &Session| drawn(session).0;
    for _ in 0..9 {
        act(&mut session, run(SessionCommand::StepForward));
    }
    assert!(session.scene_then().is_none() && has_floor(&session));
    act(&mut session, run(SessionCommand::StepBack));
    act(&mut session, run(SessionCommand::StepBack));
    let at = session.frame().time;
    act(&mut session, edit(Edit::Delete { keys: vec![floor] }));
    assert_eq!((session.frame().time, has_floor(&session)), (at, false), "from the edit on it is not there");
    assert_eq!(session.former_name(floor), Some("30"));
    act(&mut session, run(SessionCommand::StepForward));
    assert!(!has_floor(&session));
    for expected in [false, true] {
        act(&mut session, run(SessionCommand::StepBack));
        assert_eq!(has_floor(&session), expected, "t {}", session.frame().time);
    }
    assert!(!session.needs_reset());
    // Brought back, the run has the floor to its end, and the scene none.
    act(&mut session, travel(TravelCommand::BringBack));
    act(&mut session, travel(TravelCommand::GoToEnd));
    assert!(session.needs_reset() && has_floor(&session) && session.scene().unwrap().bodies.len() == 2);
    act(&mut session, run(SessionCommand::Undo));
    assert!(!session.needs_reset() && has_floor(&session) && session.scene_then().is_none());
    // A radius waits for the start, and is drawn as the run has it until then.
    let old = drawn(&session).1;
    let new = Shape::Sphere { radius: 0.25 };
    act(&mut session, edit(Edit::Body { key: ball, change: BodyChange::Shape(new.clone()) }));
    assert!(session.needs_reset());
    assert_eq!(drawn(&session).1, old);
    act(&mut session, run(SessionCommand::Reset));
    assert_eq!(drawn(&session).1, new);
}

/// Symptom: an edit in the past, before another one, dropped that from the run, while scene and views had it. Expected: from here
/// on the run is the scene's. Cause: only what was touched now was told to the run.
#[test]
fn an_edit_before_another_brings_the_run_in_line_with_the_scene() {
    let (_folder, mut session) = opened();
    let times = |session: &mut Session, count: usize, command: SessionCommand| {
        (0..count).for_each(|_| act(session, Action::Command(command)));
    };
    let [floor, ball] = [0, 1].map(|nth| session.scene().unwrap().bodies[nth].key);
    times(&mut session, 20, SessionCommand::StepForward);
    act(&mut session, Action::Edit { edit: Edit::Delete { keys: vec![floor] }, gesture: None });
    times(&mut session, 10, SessionCommand::StepBack);
    assert!(session.scene_then().is_some(), "the floor is still there");
    let heavier = Edit::Body { key: ball, change: BodyChange::Mass(5.0) };
    act(&mut session, Action::Edit { edit: heavier, gesture: None });
    assert!(session.scene_then().is_none() && !session.needs_reset());
    times(&mut session, 60, SessionCommand::StepForward);
    let fallen = session.frame().bodies.iter().find(|body| body.key == ball).unwrap().position.y;
    assert!(fallen < -0.5, "it falls where the floor was: {fallen} m");
}
