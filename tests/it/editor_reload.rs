//! Other programs and windows on the open file: changes are listed and offered, what runs goes on, nothing newer is lost.

use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use polyscene::editor::{Action, Answer, Question, SessionCommand};
use polyscene::scene::{BodyChange, ForceKind};

use super::editor_support::{Bench, BodyNumbers, SCENE};

/// The scene as another program might save it: heavier 7, weaker gravity, no 8, a new 9.
fn other() -> String {
    let seven = SCENE.find("<SoftObject UserID=\"7\"").expect("7");
    let (head, tail) = SCENE.split_at(seven);
    let tail = tail.replacen("<Weight F32=\"1\" />", "<Weight F32=\"4\" />", 1);
    let tail = tail.replacen("UserID=\"8\"", "UserID=\"9\"", 1);
    format!("{head}{tail}").replace("-9,8", "-1,6")
}

fn changed() -> Bench {
    let mut bench = Bench::open();
    bench.step();
    std::fs::write(bench.session.path().expect("a path"), other()).expect("the file");
    bench.act(Action::LookAtDisk);
    bench
}

#[test]
fn a_change_is_offered_with_what_is_different() {
    let bench = changed();
    let Some(question @ Question::Reload { unsaved: false, .. }) = bench.session.question() else {
        panic!("no offer")
    };
    for line in ["scene.xml", "• 7: mass", "• 8 removed", "• 9 added", "• 1: strength or place"] {
        assert!(question.text().contains(line), "{line} in {}", question.text());
    }
    assert_eq!(question.answers(), [Answer::Reload, Answer::NotNow]);
    let mut only_comment = Bench::open();
    let path = only_comment.session.path().expect("a path").to_owned();
    std::fs::write(path, SCENE.replace("the second", "another")).expect("the file");
    only_comment.act(Action::LookAtDisk);
    assert!(only_comment.session.question().expect("an offer").text().contains("comments, spaces"));
}

#[test]
fn what_did_not_change_goes_on_running() {
    let mut bench = changed();
    let (key, time) = (bench.key(7), bench.session.frame().time);
    bench.act(Action::Select(vec![key]));
    bench.act(Action::Answer(Answer::Reload));
    assert_eq!(bench.bytes(), other());
    let sent = bench.sent();
    assert!(sent.iter().all(|command| command.starts_with("Edit ")), "no new start: {sent:?}");
    assert_eq!(bench.session.frame().time, time);
    assert_eq!((bench.key(7), bench.session.selection().keys()), (key, &[key][..]));
    assert_eq!(bench.body(7).mass(), Some(4.0));
    assert!(
        matches!(bench.force(1).kind, ForceKind::GravityPlane { acceleration, .. } if acceleration.y == -1.6)
    );
    assert!(bench.session.needs_reset(), "a new moving body waits for the start");
    assert!(!bench.session.is_dirty() && bench.session.question().is_none());
    assert!(bench.notices().contains("8 removed"));
    // One undo point, and no key means two things.
    let nine = bench.key(9);
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.bytes(), SCENE);
    assert!(bench.session.is_dirty() && bench.key(8) != nine);
    bench.run(SessionCommand::Redo);
    assert_eq!((bench.bytes(), bench.session.is_dirty()), (other(), false));
}

#[test]
fn unsaved_work_is_not_lost_by_reading_again() {
    let mut bench = Bench::open();
    bench.change(7, BodyChange::Mass(7.0));
    let mine = bench.bytes();
    std::fs::write(bench.session.path().expect("a path"), other()).expect("the file");
    bench.act(Action::LookAtDisk);
    let Some(question @ Question::Reload { unsaved: true, .. }) = bench.session.question() else {
        panic!("no offer")
    };
    assert_eq!(question.answers()[0], Answer::NotNow, "the harmless answer is first");
    bench.act(Action::Answer(Answer::Reload));
    assert_eq!(bench.bytes(), other());
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.bytes(), mine);
}

#[test]
fn an_offer_is_made_once_for_each_change() {
    let mut bench = changed();
    bench.act(Action::Answer(Answer::NotNow));
    bench.act(Action::LookAtDisk);
    assert!(bench.session.question().is_none());
    assert!(bench.bytes() == SCENE && !bench.session.is_dirty());
    let path = bench.session.path().expect("a path").to_owned();
    std::fs::write(&path, other().replace("-1,6", "-3,7")).expect("the file");
    bench.act(Action::LookAtDisk);
    assert!(matches!(bench.session.question(), Some(Question::Reload { .. })));
    bench.act(Action::Answer(Answer::NotNow));
    // Saving still asks before it replaces what is newer.
    bench.change(7, BodyChange::Mass(5.0));
    bench.run(SessionCommand::Save);
    assert!(matches!(bench.session.question(), Some(Question::ChangedOnDisk { .. })));
}

#[test]
fn a_file_with_errors_is_shown_as_it_is_when_wanted() {
    let mut bench = Bench::open();
    let path = bench.session.path().expect("a path").to_owned();
    std::fs::write(&path, SCENE.replace("<Weight F32=\"1\" />", "<Weight F32=\"-1\" />")).expect("the file");
    bench.act(Action::LookAtDisk);
    let text = bench.session.question().expect("an offer").text();
    assert!(text.contains("must be greater than 0"), "{text}");
    bench.act(Action::Answer(Answer::Reload));
    assert!(bench.session.document().has_errors());
    std::fs::write(&path, SCENE).expect("the file");
    bench.act(Action::LookAtDisk);
    bench.act(Action::Answer(Answer::Reload));
    assert!(!bench.session.document().has_errors() && bench.bytes() == SCENE);
}

#[test]
fn a_window_that_is_only_looked_at_hears_of_a_change() {
    let mut bench = Bench::open();
    let (sender, woken) = channel();
    bench.session.watch_disk(move || sender.send(()).unwrap_or_default());
    bench.wait(Duration::ZERO);
    // The watch has seen the file as it is.
    std::thread::sleep(Duration::from_millis(2200));
    std::fs::write(bench.session.path().expect("a path"), other()).expect("the file");
    woken.recv_timeout(Duration::from_secs(20)).expect("the watch wakes the window");
    let since = Instant::now();
    while bench.session.question().is_none() && since.elapsed() < Duration::from_secs(10) {
        bench.wait(Duration::from_millis(10));
    }
    assert!(matches!(bench.session.question(), Some(Question::Reload { .. })));
}

#[test]
fn two_windows_on_one_file_tell() {
    let mut first = Bench::with_storage(tempfile::tempdir().expect("a folder"));
    let path = first.file("scene.xml", SCENE);
    first.act(Action::OpenPath(path.clone()));
    assert!(!first.notices().contains("another window"));
    // Its own file again is no second window.
    first.act(Action::OpenPath(path.clone()));
    assert!(!first.notices().contains("another window"));
    let mut second = first.second_window();
    second.act(Action::OpenPath(path.clone()));
    assert!(second.notices().contains("open in another window"));
    first.run(SessionCommand::New(polyscene::scene::NumberStyle::Point));
    let mut third = first.second_window();
    third.act(Action::OpenPath(path));
    assert!(!third.notices().contains("another window"), "free again: the second one never had it");
}

#[test]
fn a_vanished_folder_and_its_return_lose_nothing() {
    let mut bench = Bench::with_storage(tempfile::tempdir().expect("a folder"));
    let folder = bench.folder.path().join("work");
    std::fs::create_dir(&folder).expect("a folder");
    let path = folder.join("scene.xml");
    std::fs::write(&path, SCENE).expect("the file");
    bench.act(Action::OpenPath(path.clone()));
    bench.change(7, BodyChange::Mass(3.0));
    std::fs::remove_dir_all(&folder).expect("the folder goes");
    bench.notices();
    bench.act(Action::LookAtDisk);
    assert!(bench.notices().contains("gone from the disk"));
    bench.run(SessionCommand::Save);
    assert!(bench.notices().contains("cannot be saved"), "a clear message");
    assert!(bench.session.is_dirty() && bench.body(7).mass() == Some(3.0));
    bench.wait(Duration::from_secs(5));
    assert!(bench.folder.path().join("data/recovery").read_dir().expect("copies").count() > 0);
    std::fs::create_dir(&folder).expect("the folder is back");
    bench.run(SessionCommand::Save);
    assert!(std::fs::read_to_string(&path).expect("the file").contains("<Weight F32=\"3\" />"));
    assert!(!bench.session.is_dirty());
}
