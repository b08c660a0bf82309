//! Edits of the document: each ends in one undo point and reaches the simulation.

use std::collections::BTreeSet;

use super::label::describe;
use super::{Gesture, Notice, Outcome, Session};
use crate::scene::{BodyChange, Edit, ForceChange, NodeKey, Scene};
use crate::sim::as_start;

impl Session {
    /// Applies an edit. Edits of one gesture in a row make one undo point; an edit that changes nothing
    /// makes none.
    pub(super) fn edit(&mut self, edit: &Edit, gesture: Option<Gesture>) -> Outcome {
        self.edit_as(edit, gesture, None)
    }

    /// As [`Self::edit`], under another name in the Edit menu.
    pub(super) fn edit_as(
        &mut self,
        edit: &Edit,
        gesture: Option<Gesture>,
        label: Option<String>,
    ) -> Outcome {
        if self.open_gesture() != gesture {
            self.settle();
        }
        let edited = match self.document().apply(edit) {
            Ok(edited) => edited,
            Err(err) => return Outcome::Refused(err.to_string()),
        };
        // bytes that mean the same change nothing
        let touched = match (self.scene(), edited.document.scene()) {
            (Some(before), Some(after)) => edited.touched.that_differs(before, after),
            _ => edited.touched,
        };
        if self.scene().is_some() && touched.is_empty() {
            return Outcome::Done;
        }
        let label = label.unwrap_or_else(|| describe(edit, self.scene()));
        // While a hand moves nobody asks for the text.
        let document = if gesture.is_none() { edited.document.written() } else { edited.document };
        self.doc.history.push(document, label, &touched, gesture);
        if !edited.added.is_empty() {
            self.selection.set(&edited.added);
        }
        self.document_changed(&touched);
        Outcome::Done
    }

    pub(super) fn undo(&mut self) {
        self.settle();
        if let Some(touched) = self.doc.history.undo() {
            self.document_changed(&touched);
        }
    }

    pub(super) fn redo(&mut self) {
        self.settle();
        if let Some(touched) = self.doc.history.redo() {
            self.document_changed(&touched);
        }
    }

    pub(super) fn abandon_gesture(&mut self) {
        if let Some(touched) = self.doc.history.abandon_gesture() {
            self.document_changed(&touched);
        }
    }

    /// Deletes the selection; locked items stay and are reported.
    pub(super) fn delete(&mut self) -> Outcome {
        let Some(scene) = self.scene() else { return Outcome::no_scene() };
        let protected = locked_keys(scene);
        let (locked, keys): (Vec<NodeKey>, Vec<NodeKey>) =
            self.selection.keys().iter().partition(|key| protected.contains(key));
        if keys.is_empty() {
            return Outcome::Refused("Locked: unlock it first".to_owned());
        }
        if !locked.is_empty() {
            self.talk.notices.push(Notice::warning(format!("{} locked objects were kept", locked.len())));
        }
        self.edit(&Edit::Delete { keys }, None)
    }

    pub(super) fn select_all(&mut self) {
        let Some(scene) = self.scene() else { return };
        let bodies = scene.bodies.iter().filter(|body| !body.hidden).map(|body| body.key);
        let forces = scene.forces.iter().filter(|force| !force.hidden).map(|force| force.key);
        let keys: Vec<NodeKey> = forces.chain(bodies).collect();
        self.selection.set(&keys);
    }

    pub(super) fn hide_selection(&mut self) -> Outcome {
        let keys = self.selection.keys().to_vec();
        let outcome = self.mark(&keys, &BodyChange::Hidden(true), &ForceChange::Hidden(true));
        self.selection.clear();
        outcome
    }

    pub(super) fn show_all(&mut self) -> Outcome {
        let keys = self.keys_where(|body| body.hidden, |force| force.hidden);
        self.mark(&keys, &BodyChange::Hidden(false), &ForceChange::Hidden(false))
    }

    pub(super) fn lock_selection(&mut self) -> Outcome {
        let keys = self.selection.keys().to_vec();
        self.mark(&keys, &BodyChange::Locked(true), &ForceChange::Locked(true))
    }

    pub(super) fn unlock_all(&mut self) -> Outcome {
        let keys = self.keys_where(|body| body.locked, |force| force.locked);
        self.mark(&keys, &BodyChange::Locked(false), &ForceChange::Locked(false))
    }

    /// Gives the bodies the one change and the forces the other.
    fn mark(&mut self, keys: &[NodeKey], of_body: &BodyChange, of_force: &ForceChange) -> Outcome {
        let Some(scene) = self.scene() else { return Outcome::no_scene() };
        let bodies = body_keys(scene);
        let edits = keys.iter().map(|key| {
            if bodies.contains(key) {
                Edit::Body { key: *key, change: of_body.clone() }
            } else {
                Edit::Force { key: *key, change: of_force.clone() }
            }
        });
        let edit = Edit::All(edits.collect());
        self.edit(&edit, None)
    }

    fn keys_where(
        &self,
        of_body: fn(&crate::scene::Body) -> bool,
        of_force: fn(&crate::scene::Force) -> bool,
    ) -> Vec<NodeKey> {
        let Some(scene) = self.scene() else { return Vec::new() };
        let bodies = scene.bodies.iter().filter(|body| of_body(body)).map(|body| body.key);
        let forces = scene.forces.iter().filter(|force| of_force(force)).map(|force| force.key);
        forces.chain(bodies).collect()
    }

    /// Writes the poses, velocities and spins of the frame into the document, as one undo point, and starts
    /// from them.
    pub(super) fn take_state_as_start(&mut self) -> Outcome {
        self.run.pause();
        if self.scene().is_none() {
            return Outcome::no_scene();
        }
        let edits = self.state_edits();
        let label = format!("Take state at {:.6} s as start", self.run.frame.time);
        let outcome = self.edit_as(&Edit::All(edits), None, Some(label));
        if outcome == Outcome::Done {
            self.reset();
        }
        outcome
    }

    /// What makes the poses and velocities of the frame those of the document.
    pub(super) fn state_edits(&self) -> Vec<Edit> {
        let Some(scene) = self.scene() else { return Vec::new() };
        let there = body_keys(scene);
        let mut edits = Vec::new();
        for now in self.run.frame.bodies.iter().filter(|now| there.contains(&now.key)) {
            let changes = as_start(now.position, now.velocity, now.turn);
            edits.extend(changes.map(|change| Edit::Body { key: now.key, change }));
        }
        edits
    }

    pub(super) fn has_scene(&self) -> Result<(), &'static str> {
        if self.scene().is_some() { Ok(()) } else { Err("the file has errors, see Problems") }
    }

    pub(super) fn has_selection(&self) -> Result<(), &'static str> {
        if self.selection.is_empty() { Err("nothing is selected") } else { Ok(()) }
    }

    pub(super) fn can_undo(&self) -> Result<(), &'static str> {
        if self.undo_label().is_some() { Ok(()) } else { Err("nothing was edited yet") }
    }

    pub(super) fn can_redo(&self) -> Result<(), &'static str> {
        if self.redo_label().is_some() { Ok(()) } else { Err("nothing was taken back") }
    }

    pub(super) fn has_hidden(&self) -> Result<(), &'static str> {
        let any = self.scene().is_some_and(|scene| {
            scene.bodies.iter().any(|body| body.hidden) || scene.forces.iter().any(|force| force.hidden)
        });
        if any { Ok(()) } else { Err("nothing is hidden") }
    }

    pub(super) fn has_locked(&self) -> Result<(), &'static str> {
        let any = self.scene().is_some_and(|scene| {
            scene.bodies.iter().any(|body| body.locked) || scene.forces.iter().any(|force| force.locked)
        });
        if any { Ok(()) } else { Err("nothing is locked") }
    }

    pub(super) fn has_repeated_ids(&self) -> Result<(), &'static str> {
        if self.scene().is_some_and(Scene::has_repeated_ids) { Ok(()) } else { Err("no UserID repeats") }
    }

    pub(super) fn can_take_state(&self) -> Result<(), &'static str> {
        self.can_reset()?;
        if self.shows_start() { Err("the simulation stands at its start") } else { Ok(()) }
    }
}

/// Bodies and forces that must not be moved or deleted.
pub(super) fn locked_keys(scene: &Scene) -> BTreeSet<NodeKey> {
    let bodies = scene.bodies.iter().filter(|body| body.locked).map(|body| body.key);
    bodies.chain(scene.forces.iter().filter(|force| force.locked).map(|force| force.key)).collect()
}

fn body_keys(scene: &Scene) -> BTreeSet<NodeKey> {
    scene.bodies.iter().map(|body| body.key).collect()
}
