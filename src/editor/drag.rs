//! Moving the selection with the mouse: positions follow the pointer, one undo point for the whole drag.

use std::collections::BTreeSet;

use glam::DVec3;

use super::edits::locked_keys;
use super::{Action, Gesture, Session};
use crate::scene::{BodyChange, Edit, Force, ForceChange, ForceKind, NodeKey};

/// A drag that began: what moves, and from where.
#[derive(Clone, Debug)]
pub struct Drag {
    gesture: Gesture,
    bodies: Vec<(NodeKey, DVec3)>,
    forces: Vec<(NodeKey, ForceKind)>,
}

impl Drag {
    /// Takes hold of the selection without what is locked. `None` when nothing is left to move.
    pub fn of_selection(session: &Session, gesture: Gesture) -> Option<Self> {
        Self::of(session, session.selection().keys(), gesture)
    }

    /// Takes hold of these without what is locked. `None` when nothing is left to move.
    pub fn of(session: &Session, keys: &[NodeKey], gesture: Gesture) -> Option<Self> {
        let scene = session.scene()?;
        let locked = locked_keys(scene);
        let keys: BTreeSet<NodeKey> = keys.iter().copied().collect();
        let chosen = |key: NodeKey| keys.contains(&key) && !locked.contains(&key);
        let bodies: Vec<_> = scene.bodies.iter().filter(|body| chosen(body.key)).collect();
        let forces: Vec<_> = scene.forces.iter().filter(|force| chosen(force.key)).collect();
        let drag = Self {
            gesture,
            bodies: bodies.into_iter().map(|body| (body.key, body.position)).collect(),
            forces: forces.into_iter().filter(|force| has_place(force)).map(|f| (f.key, f.kind)).collect(),
        };
        (!drag.bodies.is_empty() || !drag.forces.is_empty()).then_some(drag)
    }

    /// Where the first of what moves began, for snapping and read-out.
    pub fn origin(&self) -> DVec3 {
        let of_force = || self.forces.first().and_then(|(_, kind)| place(kind));
        self.bodies.first().map(|(_, from)| *from).or_else(of_force).unwrap_or_default()
    }

    /// Moves everything by `offset` metres from where the drag began.
    pub fn move_by(&self, offset: DVec3) -> Action {
        let bodies = self
            .bodies
            .iter()
            .map(|(key, from)| Edit::Body { key: *key, change: BodyChange::Position(*from + offset) });
        let forces = self
            .forces
            .iter()
            .map(|(key, kind)| Edit::Force { key: *key, change: ForceChange::Kind(moved(*kind, offset)) });
        Action::Edit { edit: Edit::All(bodies.chain(forces).collect()), gesture: Some(self.gesture) }
    }
}

fn has_place(force: &Force) -> bool {
    place(&force.kind).is_some()
}

fn place(kind: &ForceKind) -> Option<DVec3> {
    match kind {
        ForceKind::GravityPoint { position, .. } | ForceKind::GravityPlane { position, .. } => {
            Some(*position)
        }
        ForceKind::Drag { .. } => None,
    }
}

fn moved(mut kind: ForceKind, offset: DVec3) -> ForceKind {
    match &mut kind {
        ForceKind::GravityPoint { position, .. } | ForceKind::GravityPlane { position, .. } => {
            *position += offset;
        }
        ForceKind::Drag { .. } => {}
    }
    kind
}
