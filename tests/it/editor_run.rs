//! The session beside its runner: files that the runner writes, bookmarks in a run that has become another one.

use std::sync::Arc;

use polyscene::editor::{Action, SessionCommand, TravelCommand};
use polyscene::record::{Frame, InlineRunner, Of, RunCommand, Runner as _, Written};
use polyscene::scene::Document;

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

/// A run of [`SCENE`] that begins with an edit, at its third event.
fn at_third_event(falls_from: &str) -> Arc<Frame> {
    let text = SCENE.replace(r#"<Translation X="3" Y="3" Z="3" />"#, falls_from);
    let document = Document::from_bytes(text.as_bytes());
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(document.scene().unwrap().clone())));
    for _ in 0..3 {
        runner.send(RunCommand::NextEvent { dt: 0.1, of: Of::All });
    }
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
        at_third_event(r#"<Translation X="3" Y="3" Z="3" />"#),
        at_third_event(r#"<Translation X="3" Y="2" Z="3" />"#),
    );
    let time = |frame: &Frame| frame.event(3).map(|row| row.event.time);
    assert_ne!(time(&first), time(&other));
    bench.show(like(&first));
    bench.run(SessionCommand::Travel(TravelCommand::AddBookmark));
    assert_eq!(bench.session.travel().bookmarks()[0].event, Some(3));
    bench.sent();
    bench.act(Action::GoToBookmark(0));
    assert_eq!(bench.sent(), ["GoTo { event: 3 }"]);
    assert!(bench.session.shown_event().is_some());
    bench.show(like(&other));
    assert!(bench.session.shown_event().is_none(), "it is not in this run");
    bench.act(Action::GoToBookmark(0));
    let sent = bench.sent();
    assert!(sent.len() == 1 && sent[0].starts_with("Seek"), "{sent:?}");
}
