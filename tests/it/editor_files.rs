//! Files: nothing is lost unasked, nothing is overwritten unasked, and a crash costs seconds.

use std::path::Path;
use std::time::Duration;

use polyscene::editor::{
    Action, Addition, Answer, Outcome, Question, Request, SAMPLES, SampleGroup, SessionCommand,
};
use polyscene::scene::BodyChange;

use super::editor_support::{Bench, BodyNumbers, SCENE};

const COMMA: SessionCommand = SessionCommand::New(polyscene::scene::NumberStyle::Comma);

fn dirty() -> Bench {
    let mut bench = Bench::open();
    bench.change(7, BodyChange::Mass(3.0));
    bench
}

#[test]
fn open_edit_save_changes_only_what_was_edited() {
    let mut bench = Bench::open();
    assert_eq!(bench.session.title(), "scene.xml");
    assert!(matches!(bench.run(SessionCommand::Save), Outcome::Refused(_)), "there is nothing to save");
    bench.change(7, BodyChange::Mass(3.0));
    assert_eq!(bench.run(SessionCommand::Save), Outcome::Done);
    let written = std::fs::read_to_string(bench.session.path().unwrap()).unwrap();
    assert_eq!(written, SCENE.replacen("<Weight F32=\"1\" />", "<Weight F32=\"3\" />", 1));
    assert!(!bench.session.is_dirty());
}

#[test]
fn a_scene_without_a_file_asks_where_to_save() {
    let mut bench = Bench::new();
    bench.run(COMMA);
    bench.run(SessionCommand::Add(Addition::SphereDynamic));
    bench.run(SessionCommand::Save);
    let requests = bench.session.take_requests();
    assert_eq!(requests, [Request::ChooseSavePath { directory: None, file_name: "Untitled.xml".into() }]);
    let path = bench.folder.path().join("mine");
    bench.act(Action::SaveTo(path));
    assert_eq!(bench.session.title(), "mine.xml", "a name without extension gets one");
    assert!(bench.folder.path().join("mine.xml").exists());
    assert!(!bench.session.is_dirty());
}

#[test]
fn a_name_without_extension_never_replaces_a_file_that_no_dialog_asked_about() {
    let mut bench = dirty();
    bench.file("other.xml", "precious");
    bench.run(SessionCommand::SaveAs);
    bench.act(Action::SaveTo(bench.folder.path().join("other")));
    assert_eq!(std::fs::read_to_string(bench.folder.path().join("other.xml")).unwrap(), "precious");
    assert_eq!(bench.session.title(), "other");
}

#[test]
fn what_would_lose_changes_asks_first() {
    let reload = SessionCommand::Reload;
    for command in [COMMA, SessionCommand::OpenSample(0), reload, SessionCommand::Quit] {
        let mut bench = dirty();
        bench.run(command);
        let question = bench.session.question().cloned().expect("a question");
        assert!(matches!(question, Question::UnsavedChanges { .. }));
        assert!(question.text().contains("scene.xml"));
        bench.act(Action::Answer(Answer::Cancel));
        assert!(bench.session.question().is_none());
        assert_eq!(bench.body(7).mass(), Some(3.0), "{command:?} went on although it was cancelled");
        assert!(bench.session.is_dirty());
        assert!(bench.session.take_requests().is_empty());
    }
    let mut bench = Bench::open();
    bench.run(SessionCommand::Quit);
    assert!(bench.session.question().is_none(), "nothing would be lost");
    assert_eq!(bench.session.take_requests(), [Request::Quit]);
}

#[test]
fn discard_goes_on_and_leaves_the_file_alone() {
    let mut bench = dirty();
    let path = bench.session.path().unwrap().to_owned();
    bench.run(SessionCommand::Reload);
    bench.act(Action::Answer(Answer::Discard));
    assert_eq!(bench.body(7).mass(), Some(1.0));
    assert_eq!(std::fs::read_to_string(path).unwrap(), SCENE);
    assert!(!bench.session.is_dirty());
}

#[test]
fn save_saves_and_then_goes_on() {
    let mut bench = dirty();
    let path = bench.session.path().unwrap().to_owned();
    bench.run(SessionCommand::Quit);
    bench.act(Action::Answer(Answer::Save));
    assert!(std::fs::read_to_string(path).unwrap().contains("<Weight F32=\"3\" />"));
    assert_eq!(bench.session.take_requests(), [Request::Quit]);
}

#[test]
fn save_of_a_scene_without_a_file_goes_on_after_the_dialog_or_not_at_all() {
    for (saved, expected) in [(true, vec![Request::Quit]), (false, vec![])] {
        let mut bench = Bench::new();
        bench.run(SessionCommand::Add(Addition::SphereStatic));
        bench.run(SessionCommand::Quit);
        bench.act(Action::Answer(Answer::Save));
        assert!(matches!(bench.session.take_requests()[..], [Request::ChooseSavePath { .. }]));
        let path = bench.folder.path().join("new.xml");
        bench.act(if saved { Action::SaveTo(path) } else { Action::DialogCancelled });
        assert_eq!(bench.session.take_requests(), expected);
        // the cancelled quit must not happen at a later save
        bench.run(SessionCommand::Add(Addition::Plane));
        bench.act(Action::SaveTo(bench.folder.path().join("later.xml")));
        assert!(bench.session.take_requests().is_empty());
    }
}

#[test]
fn a_save_that_fails_says_so_and_does_not_go_on() {
    let mut bench = dirty();
    bench.run(SessionCommand::SaveAs);
    bench.act(Action::SaveTo(bench.folder.path().join("missing/folder/scene.xml")));
    assert!(bench.notices().contains("cannot be saved"));
    assert!(bench.session.is_dirty());
    assert_eq!(bench.session.title(), "scene.xml");
}

#[test]
fn an_answer_that_was_not_offered_changes_nothing() {
    let mut bench = dirty();
    bench.run(SessionCommand::Quit);
    let question = bench.session.question().cloned();
    bench.act(Action::Answer(Answer::Overwrite));
    assert_eq!(bench.session.question().cloned(), question);
    bench.act(Action::Answer(Answer::Cancel));
    bench.act(Action::Answer(Answer::Discard));
    assert!(bench.session.take_requests().is_empty());
    assert!(bench.session.is_dirty());
}

#[test]
fn a_file_that_changed_on_disk_is_not_overwritten_unasked() {
    let mut bench = dirty();
    let path = bench.session.path().unwrap().to_owned();
    // same length, and perhaps the same date
    std::fs::write(&path, SCENE.replace("the second", "the SECOND")).unwrap();
    bench.run(SessionCommand::Save);
    assert!(matches!(bench.session.question(), Some(Question::ChangedOnDisk { .. })));
    assert!(std::fs::read_to_string(&path).unwrap().contains("SECOND"));
    bench.act(Action::Answer(Answer::Cancel));
    assert!(std::fs::read_to_string(&path).unwrap().contains("SECOND"));
    assert!(bench.session.is_dirty());
    bench.run(SessionCommand::Save);
    bench.act(Action::Answer(Answer::Overwrite));
    assert!(!std::fs::read_to_string(&path).unwrap().contains("SECOND"));
    assert!(!bench.session.is_dirty());
    bench.change(7, BodyChange::Mass(5.0));
    bench.run(SessionCommand::Save);
    assert!(bench.session.question().is_none(), "our own save is no change by another program");
}

/// Symptom: a file that another program removed and wrote anew was replaced without a question. Cause: what is gone was
/// forgotten, and then nothing could have changed.
#[test]
fn a_file_that_was_gone_for_a_while_is_not_overwritten_unasked() {
    let mut bench = dirty();
    let path = bench.session.path().unwrap().to_owned();
    std::fs::remove_file(&path).unwrap();
    bench.act(Action::LookAtDisk);
    assert!(bench.notices().contains("gone from the disk"));
    std::fs::write(&path, SCENE.replace("the second", "the SECOND")).unwrap();
    bench.run(SessionCommand::Save);
    assert!(matches!(bench.session.question(), Some(Question::ChangedOnDisk { .. })));
    assert!(std::fs::read_to_string(&path).unwrap().contains("SECOND"));
}

/// What is gone is written again without a question.
#[test]
fn a_file_that_is_gone_is_saved_again() {
    let mut bench = dirty();
    let path = bench.session.path().unwrap().to_owned();
    std::fs::remove_file(&path).unwrap();
    bench.act(Action::LookAtDisk);
    bench.run(SessionCommand::Save);
    assert!(bench.session.question().is_none() && path.exists());
}

#[test]
fn quitting_over_a_file_that_changed_asks_both_questions() {
    let mut bench = dirty();
    let path = bench.session.path().unwrap().to_owned();
    std::fs::write(&path, "something else").unwrap();
    bench.run(SessionCommand::Quit);
    bench.act(Action::Answer(Answer::Save));
    assert!(matches!(bench.session.question(), Some(Question::ChangedOnDisk { .. })));
    bench.act(Action::Answer(Answer::SaveAs));
    assert!(matches!(bench.session.take_requests()[..], [Request::ChooseSavePath { .. }]));
    bench.act(Action::SaveTo(bench.folder.path().join("copy.xml")));
    assert_eq!(bench.session.take_requests(), [Request::Quit]);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "something else");
}

#[test]
fn a_change_on_disk_is_told_once() {
    let mut bench = Bench::open();
    bench.act(Action::LookAtDisk);
    assert_eq!(bench.notices(), "");
    let path = bench.session.path().unwrap().to_owned();
    std::fs::write(&path, SCENE.replace("the second", "another")).unwrap();
    bench.act(Action::LookAtDisk);
    assert!(matches!(bench.session.question(), Some(Question::Reload { .. })));
    bench.act(Action::Answer(Answer::NotNow));
    bench.act(Action::LookAtDisk);
    assert!(bench.session.question().is_none());
    bench.run(SessionCommand::Reload);
    assert!(bench.bytes().contains("another"));
    std::fs::remove_file(&path).unwrap();
    bench.act(Action::LookAtDisk);
    assert!(bench.notices().contains("gone"));
    assert!(bench.session.is_dirty(), "what is nowhere on the disk is not saved");
    bench.run(SessionCommand::Save);
    assert!(path.exists());
}

#[test]
fn a_file_that_cannot_be_read_leaves_everything_as_it_was() {
    let mut bench = dirty();
    let state = bench.session.document_state();
    bench.run(SessionCommand::Undo);
    for path in [bench.folder.path().join("nowhere.xml"), bench.folder.path().to_owned()] {
        bench.act(Action::OpenPath(path));
        assert!(bench.notices().contains("cannot be opened"));
        assert_eq!(bench.session.title(), "scene.xml");
    }
    bench.run(SessionCommand::Redo);
    assert_eq!(bench.session.document_state(), state);
}

#[test]
fn a_file_with_errors_opens_and_shows_them() {
    for text in ["", "no xml at all", "<PolyPhysicsXml Version=\"1.0\"><Map>", "<Other/>"] {
        let mut bench = Bench::open();
        let path = bench.file("broken.xml", text);
        bench.act(Action::OpenPath(path));
        assert_eq!(bench.session.title(), "broken.xml", "{text}");
        assert!(bench.session.problems().iter().any(|p| p.severity == polyscene::scene::Severity::Error));
        for command in [
            SessionCommand::SelectAll,
            SessionCommand::Add(Addition::Plane),
            SessionCommand::Delete,
            SessionCommand::PlayPause,
        ] {
            assert!(matches!(bench.run(command), Outcome::Refused(_)), "{command:?} of {text:?}");
        }
        bench.wait(Duration::from_secs(60));
    }
}

#[test]
fn recent_files_are_newest_first_without_repeats_and_outlive_the_run() {
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    for name in ["a.xml", "b.xml", "a.xml"] {
        let path = bench.file(name, SCENE);
        bench.act(Action::OpenPath(path));
    }
    bench.act(Action::SetDt("1/200".into()));
    let Bench { session, folder, .. } = bench;
    drop(session);
    let mut again = Bench::with_storage(folder);
    let names: Vec<_> = again.session.settings().recent.iter().filter_map(|path| path.file_name()).collect();
    assert_eq!(names, ["a.xml", "b.xml"]);
    assert_eq!(again.session.playback().dt_text(), "1/200");
    again.run(SessionCommand::OpenRecent(1));
    assert_eq!(again.session.title(), "b.xml");
    assert!(matches!(again.run(SessionCommand::OpenRecent(7)), Outcome::Refused(_)));
}

#[test]
fn settings_that_make_no_sense_are_the_defaults() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir_all(folder.path().join("config")).unwrap();
    for text in ["", "{", "[1,2]", "{\"dt\":\"-5\",\"recent\":[],\"unknown\":1}"] {
        std::fs::write(folder.path().join("config/settings.json"), text).unwrap();
        let storage = super::editor_support::storage(folder.path());
        let runner = super::editor_support::FakeRunner::default();
        let session = polyscene::editor::Session::with_storage(Box::new(runner), storage);
        assert_eq!(session.playback().dt_text(), "1/60", "{text}");
    }
}

#[test]
fn every_scene_of_the_folder_is_a_sample_and_opens_without_errors() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    for (folder, group) in
        [(folder.clone(), SampleGroup::Introduction), (folder.join("hard"), SampleGroup::HardCase)]
    {
        let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let mut names: Vec<String> = files
            .filter(|path| path.extension().is_some_and(|extension| extension == "xml"))
            .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
            .collect();
        names.sort();
        let of_group = SAMPLES.iter().filter(|sample| sample.group == group);
        let mut samples: Vec<&str> = of_group.map(|sample| sample.id).collect();
        samples.sort_unstable();
        assert_eq!(samples, names);
    }
    for (index, sample) in SAMPLES.iter().enumerate() {
        let mut bench = Bench::new();
        bench.run(SessionCommand::OpenSample(index));
        assert!(!bench.session.document().has_errors(), "{}", sample.id);
        assert_eq!(bench.session.document().to_bytes(), sample.bytes);
        assert!(!bench.session.is_dirty());
        assert_eq!(bench.session.path(), None, "saving must not write over the program's own scene");
        bench.run(SessionCommand::Save);
        let file_name = format!("{}.xml", sample.id);
        assert_eq!(bench.session.take_requests(), [Request::ChooseSavePath { directory: None, file_name }]);
    }
}
