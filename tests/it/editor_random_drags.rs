//! Any mix of commands and drags: undo goes back to the file's bytes, redo to the end, and what is saved
//! reads the same.

use glam::DVec3;
use polyscene::editor::{Action, Addition, Drag, Gesture, SessionCommand};
use polyscene::scene::Document;
use polyscene::view::Pull;
use proptest::prelude::*;

use super::editor_support::Bench;
use crate::scene_edit::same_meaning;

const COMMANDS: [SessionCommand; 24] = [
    SessionCommand::Add(Addition::SphereDynamic),
    SessionCommand::Add(Addition::SphereStatic),
    SessionCommand::Add(Addition::Plane),
    SessionCommand::Add(Addition::GravityPlane),
    SessionCommand::Add(Addition::GravityPoint),
    SessionCommand::Add(Addition::Drag),
    SessionCommand::Undo,
    SessionCommand::Undo,
    SessionCommand::Redo,
    SessionCommand::Cut,
    SessionCommand::Copy,
    SessionCommand::Duplicate,
    SessionCommand::Delete,
    SessionCommand::SelectAll,
    SessionCommand::SelectNone,
    SessionCommand::Hide,
    SessionCommand::ShowAll,
    SessionCommand::Lock,
    SessionCommand::UnlockAll,
    SessionCommand::MakeIdsUnique,
    SessionCommand::StepForward,
    SessionCommand::NextEvent,
    SessionCommand::StepBack,
    SessionCommand::Reset,
];

/// One thing that a user does; `what` and `how` are any numbers.
fn act(bench: &mut Bench, what: usize, how: u8, gesture: u64) {
    let by = f64::from(how) / 16.0 - 8.0;
    let pull = match what.checked_sub(COMMANDS.len()) {
        None => return drop(bench.run(COMMANDS[what])),
        Some(0) => return choose(bench, how.into()),
        Some(1) => Pull::Move(DVec3::new(by, 0.25, -by)),
        Some(2) => Pull::Turn { axis: DVec3::Y, angle: by },
        Some(3) => Pull::Radius(by.abs() + 0.01),
        Some(4) => Pull::Sides { half: [by.abs() + 0.5, 1.0], shift: DVec3::X },
        Some(5) => Pull::Scale(by.abs() + 0.1),
        _ => Pull::Vector(DVec3::new(by, by, 0.0)),
    };
    let Some(drag) = Drag::of_selection(&bench.session, Gesture(gesture)) else { return };
    let drag = drag.each_by_itself(how.is_multiple_of(2));
    let pivot = drag.origin();
    bench.act(drag.pull(&pull, pivot));
    bench.act(drag.pull(&pull, pivot + DVec3::Z));
    // not every drag ends before the next thing begins
    if how.is_multiple_of(3) {
        bench.act(Action::EndGesture);
    } else if how.is_multiple_of(7) {
        bench.act(Action::AbandonGesture);
    }
}

/// Selects the n-th body or force.
fn choose(bench: &mut Bench, nth: usize) {
    let Some(scene) = bench.session.scene() else { return };
    let keys: Vec<_> =
        scene.bodies.iter().map(|body| body.key).chain(scene.forces.iter().map(|force| force.key)).collect();
    if let Some(key) = keys.get(nth % keys.len().max(1)) {
        bench.act(Action::ToggleSelected(*key));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn undo_goes_back_to_the_files_bytes_and_redo_to_the_end(
        steps in prop::collection::vec((0..COMMANDS.len() + 7, any::<u8>()), 1..60),
    ) {
        let mut bench = Bench::open();
        let start = bench.bytes();
        for (at, (what, how)) in steps.iter().enumerate() {
            act(&mut bench, *what, *how, at as u64);
        }
        bench.act(Action::EndGesture);
        while bench.session.redo_label().is_some() {
            bench.run(SessionCommand::Redo);
        }
        let end = bench.bytes();
        let again = Document::from_bytes(end.as_bytes());
        prop_assert!(same_meaning(bench.session.document(), &again), "saved, it reads otherwise");
        while bench.session.undo_label().is_some() {
            bench.run(SessionCommand::Undo);
        }
        prop_assert_eq!(bench.bytes(), start);
        prop_assert!(!bench.session.is_dirty());
        while bench.session.redo_label().is_some() {
            bench.run(SessionCommand::Redo);
        }
        prop_assert_eq!(bench.bytes(), end);
    }
}
