//! Unsaved work outlives a run that ended without saving, and the user's file is never touched.

use std::path::PathBuf;
use std::time::Duration;

use polyscene::editor::{Action, Addition, Answer, Question, Request, SessionCommand};
use polyscene::scene::{BodyChange, NumberStyle};

use super::editor_support::{Bench, BodyNumbers, SCENE};

/// A run that edited a file and ended without saving.
fn crashed() -> (tempfile::TempDir, PathBuf) {
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    let path = bench.file("scene.xml", SCENE);
    bench.act(Action::OpenPath(path.clone()));
    bench.change(7, BodyChange::Mass(3.0));
    bench.wait(Duration::from_secs(1));
    let Bench { session, folder, .. } = bench;
    drop(session);
    (folder, path)
}

fn recovery_files(folder: &tempfile::TempDir) -> usize {
    std::fs::read_dir(folder.path().join("data/recovery")).map_or(0, Iterator::count)
}

#[test]
fn the_next_run_offers_the_work_and_restores_it_unsaved() {
    let (folder, path) = crashed();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), SCENE);
    let mut bench = Bench::with_storage(folder);
    let Some(question @ Question::Recover(_)) = bench.session.question().cloned() else { panic!("no offer") };
    assert!(question.text().contains("scene.xml"), "{}", question.text());
    bench.act(Action::Answer(Answer::Restore));
    assert_eq!(bench.body(7).mass(), Some(3.0));
    assert_eq!(bench.session.path(), Some(path.as_path()));
    assert!(bench.session.is_dirty());
    assert_eq!(std::fs::read_to_string(&path).unwrap(), SCENE);
    // it is safe again: a second crash loses nothing
    let Bench { session, folder, .. } = bench;
    drop(session);
    let mut bench = Bench::with_storage(folder);
    bench.act(Action::Answer(Answer::Restore));
    bench.run(SessionCommand::Save);
    assert!(std::fs::read_to_string(&path).unwrap().contains("<Weight F32=\"3\" />"));
    assert_eq!(recovery_files(&bench.folder), 0);
}

#[test]
fn restored_work_asks_before_it_replaces_a_file_that_changed_meanwhile() {
    let (folder, path) = crashed();
    std::fs::write(&path, "newer").unwrap();
    let mut bench = Bench::with_storage(folder);
    bench.act(Action::Answer(Answer::Restore));
    bench.run(SessionCommand::Save);
    assert!(matches!(bench.session.question(), Some(Question::ChangedOnDisk { .. })));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "newer");
}

#[test]
fn discard_forgets_the_work_and_later_keeps_it() {
    let (folder, _) = crashed();
    let mut bench = Bench::with_storage(folder);
    bench.act(Action::Answer(Answer::Later));
    assert!(bench.session.question().is_none());
    let Bench { session, folder, .. } = bench;
    drop(session);
    let mut bench = Bench::with_storage(folder);
    bench.act(Action::Answer(Answer::Discard));
    assert!(bench.session.question().is_none());
    assert_eq!(recovery_files(&bench.folder), 0);
}

#[test]
fn work_of_a_run_that_still_lives_is_not_offered() {
    let mut first = Bench::with_storage(tempfile::tempdir().unwrap());
    first.run(SessionCommand::Add(Addition::Plane));
    first.wait(Duration::from_secs(1));
    assert!(recovery_files(&first.folder) > 0);
    let runner = super::editor_support::FakeRunner::default();
    let storage = super::editor_support::storage(first.folder.path());
    let second = polyscene::editor::Session::with_storage(Box::new(runner), storage);
    assert!(second.question().is_none());
}

#[test]
fn nothing_is_kept_of_what_was_saved_discarded_or_undone() {
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    let path = bench.file("scene.xml", SCENE);
    bench.act(Action::OpenPath(path));
    let ends: [fn(&mut Bench); 3] = [
        |bench| drop(bench.run(SessionCommand::Undo)),
        |bench| drop(bench.run(SessionCommand::Save)),
        |bench| {
            bench.run(SessionCommand::Quit);
            bench.act(Action::Answer(Answer::Discard));
            assert_eq!(bench.session.take_requests(), [Request::Quit]);
        },
    ];
    for (index, end) in ends.into_iter().enumerate() {
        bench.change(7, BodyChange::Mass(3.0 + index as f64));
        bench.wait(Duration::from_secs(20));
        assert_eq!(recovery_files(&bench.folder), 3, "end {index}");
        end(&mut bench);
        if index < 2 {
            bench.wait(Duration::from_secs(20));
        }
        assert_eq!(recovery_files(&bench.folder), 0, "end {index}");
    }
}

#[test]
fn copies_are_made_at_most_every_ten_seconds_and_not_inside_a_drag() {
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    let path = bench.file("scene.xml", SCENE);
    bench.act(Action::OpenPath(path));
    let copy = |bench: &Bench| {
        let files = std::fs::read_dir(bench.folder.path().join("data/recovery")).ok()?;
        let xml = files.flatten().find(|entry| entry.path().extension().is_some_and(|e| e == "xml"))?;
        std::fs::read_to_string(xml.path()).ok()
    };
    bench.drag(7, BodyChange::Mass(2.0), 1);
    bench.wait(Duration::from_secs(30));
    assert_eq!(copy(&bench), None);
    bench.act(Action::EndGesture);
    bench.wait(Duration::from_secs(1));
    assert!(copy(&bench).unwrap().contains("<Weight F32=\"2\" />"));
    bench.change(7, BodyChange::Mass(4.0));
    bench.wait(Duration::from_secs(5));
    assert!(copy(&bench).unwrap().contains("<Weight F32=\"2\" />"));
    bench.wait(Duration::from_secs(6));
    assert!(copy(&bench).unwrap().contains("<Weight F32=\"4\" />"));
}

#[test]
fn a_folder_that_cannot_be_written_is_told_once_and_stops_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("data"), "a file where the folder should be").unwrap();
    let mut bench = Bench::with_storage(folder);
    bench.run(SessionCommand::Add(Addition::Plane));
    bench.wait(Duration::from_secs(20));
    assert!(bench.notices().contains("cannot be kept safe"));
    bench.run(SessionCommand::Add(Addition::Plane));
    bench.wait(Duration::from_secs(20));
    assert_eq!(bench.notices(), "");
}

/// Symptom: the recovery folder and the copies in it could be read by others, also those of a private scene.
#[cfg(unix)]
#[test]
fn nobody_else_reads_the_copies() {
    use std::os::unix::fs::PermissionsExt as _;
    let (folder, _) = crashed();
    let mode = |path: PathBuf| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
    let recovery = folder.path().join("data/recovery");
    assert_eq!(mode(recovery.clone()), 0o700);
    for entry in std::fs::read_dir(recovery).unwrap() {
        let path = entry.unwrap().path();
        assert_eq!(mode(path.clone()), 0o600, "{}", path.display());
    }
}

/// Symptom: of a scene whose name holds a byte that is no UTF-8 a copy was left that was never offered, and the
/// settings were not kept. Cause: JSON has no text for such a path, so writing it failed.
#[cfg(target_os = "linux")]
#[test]
fn a_name_that_is_no_utf8_is_kept_and_offered() {
    use std::os::unix::ffi::OsStrExt as _;
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    let path = bench.folder.path().join(std::ffi::OsStr::from_bytes(b"s\xFFc.xml"));
    std::fs::write(&path, SCENE).unwrap();
    bench.act(Action::OpenPath(path.clone()));
    bench.change(7, BodyChange::Mass(3.0));
    bench.wait(Duration::from_secs(1));
    assert_eq!(bench.notices(), "");
    let Bench { session, folder, .. } = bench;
    drop(session);
    let mut bench = Bench::with_storage(folder);
    assert_eq!(bench.session.settings().recent, std::slice::from_ref(&path));
    bench.act(Action::Answer(Answer::Restore));
    assert_eq!(bench.session.path(), Some(path.as_path()));
    bench.run(SessionCommand::Save);
    assert!(std::fs::read_to_string(&path).unwrap().contains("<Weight F32=\"3\" />"));
}

/// Symptom: text typed in the window was lost when it was closed, when another scene was opened, and by a crash. Cause: only
/// the pane knew of it.
#[test]
fn typed_text_is_asked_about_and_outlives_a_crash() {
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    let path = bench.file("scene.xml", SCENE);
    bench.act(Action::OpenPath(path.clone()));
    let text = SCENE.replace("-9,8", "-1,6");
    bench.act(Action::KeepDraft(Some(text.as_str().into())));
    assert!(!bench.session.is_dirty() && bench.session.has_unsaved_work());
    bench.wait(Duration::from_secs(1));
    for command in
        [SessionCommand::Quit, SessionCommand::OpenSample(0), SessionCommand::New(NumberStyle::Point)]
    {
        bench.run(command);
        assert!(matches!(bench.session.question(), Some(Question::UnappliedText { .. })), "{command:?}");
        bench.act(Action::Answer(Answer::Cancel));
        assert_eq!(bench.session.draft(), Some(&*text));
    }
    // saving the scene leaves the draft in the copy
    bench.change(7, BodyChange::Mass(3.0));
    bench.run(SessionCommand::Save);
    assert!(!bench.session.is_dirty());

    let Bench { session, folder, .. } = bench;
    drop(session);
    let mut bench = Bench::with_storage(folder);
    let question = bench.session.question().cloned().unwrap();
    assert!(question.text().contains("text that was not applied"), "{}", question.text());
    bench.act(Action::Answer(Answer::Restore));
    assert_eq!(bench.session.draft(), Some(&*text));
    assert_eq!((bench.session.is_dirty(), bench.session.path()), (false, Some(path.as_path())));
    assert!(bench.session.take_requests().contains(&Request::ShowText));

    bench.run(SessionCommand::Quit);
    bench.act(Action::Answer(Answer::Apply));
    assert!(matches!(bench.session.question(), Some(Question::UnsavedChanges { .. })));
    bench.act(Action::Answer(Answer::Save));
    assert_eq!(bench.session.take_requests(), [Request::Quit]);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    bench.wait(Duration::from_secs(20));
    assert_eq!(recovery_files(&bench.folder), 0);
}

#[test]
fn typed_text_with_errors_is_kept_until_it_is_discarded() {
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    bench.act(Action::KeepDraft(Some("<PolyPhysicsXml>".into())));
    bench.run(SessionCommand::OpenSample(0));
    let question = bench.session.question().cloned().unwrap();
    assert_eq!(question.answers(), [Answer::Cancel, Answer::Discard], "{}", question.text());
    bench.act(Action::Answer(Answer::Discard));
    assert_eq!((bench.session.draft(), bench.session.opened_count()), (None, 1));
}

/// Symptom: a window that was closed without saving, as its user said, asked again and again, and left a copy to recover.
/// Cause: what nobody wants any more still counted as not saved.
#[test]
fn what_was_discarded_for_quitting_is_neither_asked_for_nor_kept() {
    let mut bench = Bench::with_storage(tempfile::tempdir().unwrap());
    bench.run(SessionCommand::Add(Addition::Plane));
    bench.wait(Duration::from_secs(5));
    bench.run(SessionCommand::Quit);
    bench.act(Action::Answer(Answer::Discard));
    assert!(!bench.session.has_unsaved_work());
    bench.wait(Duration::from_secs(5));
    assert_eq!(recovery_files(&bench.folder), 0);
}
