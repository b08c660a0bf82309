//! Undo covers the document alone, one point per finished gesture.

use std::time::Duration;

use glam::DVec3;
use polyscene::editor::{Action, Addition, Drag, Gesture, Outcome, SessionCommand};
use polyscene::scene::{Body, BodyChange, Edit, Motion, Shape};
use polyscene::view::Pull;

use super::editor_support::{Bench, BodyNumbers, SCENE};

fn x(value: f64) -> BodyChange {
    BodyChange::Position(DVec3::new(value, 3.0, 3.0))
}

#[test]
fn a_drag_is_one_point_and_the_next_drag_another() {
    let mut bench = Bench::open();
    for step in 1..=20 {
        bench.drag(7, x(3.0 + 0.01 * f64::from(step)), 1);
    }
    bench.act(Action::EndGesture);
    for step in 1..=20 {
        bench.drag(7, x(4.0 + 0.01 * f64::from(step)), 1);
    }
    bench.act(Action::EndGesture);
    assert_eq!(bench.body(7).position.x, 4.2);
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.body(7).position.x, 3.2);
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.body(7).position.x, 3.0);
    assert!(matches!(bench.run(SessionCommand::Undo), Outcome::Refused(_)));
}

#[test]
fn edits_without_a_gesture_or_of_another_one_are_points_of_their_own() {
    let mut bench = Bench::open();
    bench.drag(7, x(3.1), 1);
    bench.drag(7, x(3.2), 2);
    bench.change(7, x(3.3));
    bench.change(7, x(3.4));
    for expected in [3.3, 3.2, 3.1, 3.0] {
        bench.run(SessionCommand::Undo);
        assert_eq!(bench.body(7).position.x, expected);
    }
}

#[test]
fn escape_during_a_drag_leaves_no_trace() {
    let mut bench = Bench::open();
    bench.change(7, x(3.5));
    bench.drag(7, x(4.0), 1);
    bench.drag(7, x(5.0), 1);
    bench.act(Action::AbandonGesture);
    assert_eq!(bench.body(7).position.x, 3.5);
    assert_eq!(bench.session.redo_label(), None);
    assert_eq!(bench.session.undo_label(), Some("Move 7"));
    // with no drag going on it takes nothing back
    bench.act(Action::AbandonGesture);
    assert_eq!(bench.body(7).position.x, 3.5);
}

#[test]
fn undoing_everything_gives_back_the_files_bytes_and_a_clean_document() {
    let mut bench = Bench::open();
    assert!(!bench.session.is_dirty());
    bench.change(7, BodyChange::Mass(2.5));
    bench.change(8, BodyChange::Name(Some("heavy".into())));
    bench.edit(Edit::MapSize(DVec3::new(20.0, 10.0, 10.0)));
    bench.session.perform(Action::Select(vec![bench.key(7)]));
    bench.run(SessionCommand::Duplicate);
    bench.run(SessionCommand::Delete);
    bench.run(SessionCommand::Add(Addition::Drag));
    assert!(bench.session.is_dirty());
    let edited = bench.bytes();
    for _ in 0..6 {
        assert_eq!(bench.run(SessionCommand::Undo), Outcome::Done);
    }
    assert_eq!(bench.bytes(), SCENE);
    assert!(!bench.session.is_dirty());
    for _ in 0..6 {
        assert_eq!(bench.run(SessionCommand::Redo), Outcome::Done);
    }
    assert_eq!(bench.bytes(), edited);
    assert!(bench.session.is_dirty());
}

#[test]
fn saved_is_where_the_file_was_written_not_where_the_values_agree() {
    let mut bench = Bench::open();
    bench.change(7, BodyChange::Mass(2.0));
    bench.run(SessionCommand::Save);
    assert!(!bench.session.is_dirty());
    bench.change(7, BodyChange::Mass(3.0));
    bench.run(SessionCommand::Undo);
    assert!(!bench.session.is_dirty());
    bench.run(SessionCommand::Undo);
    assert!(bench.session.is_dirty(), "the file holds the change that was undone");
    bench.run(SessionCommand::Redo);
    assert!(!bench.session.is_dirty());
    // the saved state is no longer reachable
    bench.run(SessionCommand::Undo);
    bench.change(7, BodyChange::Mass(9.0));
    bench.run(SessionCommand::Undo);
    assert!(bench.session.is_dirty());
}

#[test]
fn a_drag_after_saving_in_its_middle_leaves_the_document_unsaved() {
    let mut bench = Bench::open();
    bench.drag(7, x(4.0), 1);
    bench.run(SessionCommand::Save);
    bench.drag(7, x(5.0), 1);
    assert!(bench.session.is_dirty());
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.body(7).position.x, 4.0);
    assert!(!bench.session.is_dirty());
}

#[test]
fn an_edit_that_changes_nothing_makes_no_point() {
    let mut bench = Bench::open();
    bench.change(7, BodyChange::Mass(1.0));
    bench.change(7, x(3.0));
    bench.edit(Edit::TimeSpeed(1.0));
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.session.undo_label(), None);
    assert!(!bench.session.is_dirty());
}

#[test]
fn a_refused_edit_changes_nothing_and_says_why() {
    let mut bench = Bench::open();
    let outcome = bench.change(7, BodyChange::Mass(-1.0));
    assert!(matches!(outcome, Outcome::Refused(_)), "{outcome:?}");
    assert_eq!(bench.body(7).mass(), Some(1.0));
    assert_eq!(bench.session.undo_label(), None);
    assert!(!bench.notices().is_empty());
}

#[test]
fn points_are_named_after_what_they_did() {
    let mut bench = Bench::open();
    let label = |bench: &Bench| bench.session.undo_label().unwrap_or_default().to_owned();
    bench.change(7, x(3.5));
    assert_eq!(label(&bench), "Move 7");
    bench.change(8, BodyChange::Name(Some("heavy".into())));
    assert_eq!(label(&bench), "Rename 8");
    bench.change(8, BodyChange::Bounce(0.25));
    assert_eq!(label(&bench), "Change bounce of heavy");
    bench.run(SessionCommand::SelectAll);
    bench.run(SessionCommand::Hide);
    assert_eq!(label(&bench), "Hide 4 objects");
}

#[test]
fn the_number_of_points_is_bounded() {
    let mut bench = Bench::open();
    for step in 1..=5000 {
        bench.change(7, BodyChange::Mass(1.0 + f64::from(step)));
    }
    let mut undone = 0;
    while bench.run(SessionCommand::Undo) == Outcome::Done {
        undone += 1;
    }
    assert_eq!(undone, 4096);
    assert_eq!(bench.body(7).mass(), Some(5001.0 - 4096.0));
}

#[test]
fn selection_follows_what_is_added_and_forgets_what_is_gone() {
    let mut bench = Bench::open();
    let seven = bench.key(7);
    bench.act(Action::Select(vec![seven]));
    bench.run(SessionCommand::Add(Addition::SphereDynamic));
    let added = bench.session.selection().primary().unwrap();
    assert_ne!(added, seven);
    bench.run(SessionCommand::Undo);
    assert!(bench.session.selection().is_empty(), "the new sphere is gone");
    bench.act(Action::Select(vec![seven]));
    bench.change(8, BodyChange::Mass(4.0));
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.session.selection().keys(), [seven], "undo leaves the rest of the selection alone");
    bench.run(SessionCommand::Delete);
    assert!(bench.session.selection().is_empty());
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.key(7), seven, "a body that comes back is the same body");
}

#[test]
fn camera_and_playback_are_no_edits() {
    let mut bench = Bench::open();
    bench.act(Action::SetDt("0,25".into()));
    bench.act(Action::SetSpeed(2.0));
    bench.step();
    bench.wait(Duration::from_secs(1));
    assert_eq!(bench.session.undo_label(), None);
    assert!(!bench.session.is_dirty());
}

#[test]
fn a_long_gesture_of_many_bodies_is_one_point_and_one_batch() {
    const BODIES: i64 = 1000;
    let mut bench = Bench::open();
    let ball = |id: i64| {
        let place = DVec3::new(id as f64 * 0.02, 1.0, 7.0);
        let body = Body::new(1000 + id, place, Motion::Static, Shape::Sphere { radius: 0.005 });
        Edit::AddBody(Box::new(body))
    };
    bench.edit(Edit::All((0..BODIES).map(ball).collect()));
    assert_eq!(bench.session.selection().len(), BODIES as usize, "what was added is selected");
    bench.step();
    let before = bench.bytes();
    let drag = Drag::of_selection(&bench.session, Gesture(1)).unwrap();
    for step in 1..=100 {
        let offset = DVec3::new(0.0, 0.01 * f64::from(step), 0.0);
        bench.act(drag.pull(&Pull::Move(offset), DVec3::ZERO));
    }
    assert_eq!(bench.sent(), [""; 0], "the simulation does not hear of every step");
    bench.act(Action::EndGesture);
    let sent = bench.sent();
    assert_eq!(sent.len(), 1, "{} commands", sent.len());
    assert_eq!(sent[0].matches("ChangeStatic").count(), BODIES as usize);
    assert_eq!(bench.body(1500).position.y, 2.0);
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.bytes(), before, "one undo takes all of it back");
    assert_eq!(bench.sent().len(), 1);
}
