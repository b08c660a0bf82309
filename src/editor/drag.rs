//! Changing the selection with the mouse: what a pull at a handle does to what was taken hold of, as one undo
//! point for the whole drag.

use std::collections::BTreeSet;

use glam::{DMat3, DVec3};

use super::edits::locked_keys;
use super::{Action, Gesture, Session};
use crate::design::{turn, turned};
use crate::scene::{Body, BodyChange, Edit, Force, ForceChange, ForceKind, NodeKey, Shape};
use crate::view::Pull;

/// A drag that began: what changes, and from what.
#[derive(Clone, Debug)]
pub struct Drag {
    gesture: Gesture,
    bodies: Vec<Body>,
    forces: Vec<Force>,
    /// Everything is turned about, and grows from, its own centre.
    each: bool,
}

impl Drag {
    /// Takes hold of the selection without what is locked. `None` when nothing is left to drag.
    pub fn of_selection(session: &Session, gesture: Gesture) -> Option<Self> {
        Self::of(session, session.selection().keys(), gesture)
    }

    /// Takes hold of these without what is locked. `None` when nothing is left to drag.
    pub fn of(session: &Session, keys: &[NodeKey], gesture: Gesture) -> Option<Self> {
        let scene = session.scene()?;
        let locked = locked_keys(scene);
        let keys: BTreeSet<NodeKey> = keys.iter().copied().collect();
        let chosen = |key: NodeKey| keys.contains(&key) && !locked.contains(&key);
        let drag = Self {
            gesture,
            each: false,
            bodies: scene.bodies.iter().filter(|body| chosen(body.key)).cloned().collect(),
            forces: scene
                .forces
                .iter()
                .filter(|f| chosen(f.key) && f.kind.position().is_some())
                .cloned()
                .collect(),
        };
        (!drag.bodies.is_empty() || !drag.forces.is_empty()).then_some(drag)
    }

    /// Takes hold of the map's sides.
    pub fn of_map(gesture: Gesture) -> Self {
        Self { gesture, bodies: Vec::new(), forces: Vec::new(), each: false }
    }

    /// Turned about, and growing from, the pivot of the pull, or each by itself.
    pub fn each_by_itself(self, each: bool) -> Self {
        Self { each, ..self }
    }

    /// The bodies as they were.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The forces with a place, as they were.
    pub fn forces(&self) -> &[Force] {
        &self.forces
    }

    /// Where everything began.
    pub fn places(&self) -> impl Iterator<Item = DVec3> {
        let bodies = self.bodies.iter().map(|body| body.position);
        bodies.chain(self.forces.iter().filter_map(|force| force.kind.position()))
    }

    /// Where the first of what moves began, for snapping and read-out.
    pub fn origin(&self) -> DVec3 {
        self.places().next().unwrap_or_default()
    }

    /// Everything changed as a pull says, from where the drag began; `pivot` is what is turned about, unless each
    /// is by itself.
    pub fn pull(&self, pull: &Pull, pivot: DVec3) -> Action {
        let mut edits = Vec::with_capacity(2 * self.bodies.len() + self.forces.len() + 1);
        for body in &self.bodies {
            let change = |change| Edit::Body { key: body.key, change };
            let pivot = if self.each { body.position } else { pivot };
            edits.extend(body_changes(body, pull, pivot).into_iter().map(change));
        }
        for force in &self.forces {
            let pivot = force.kind.position().filter(|_| self.each).unwrap_or(pivot);
            let kind = pulled(force.kind, pull, pivot);
            edits.push(Edit::Force { key: force.key, change: ForceChange::Kind(kind) });
        }
        if let Pull::Map(size) = pull {
            edits.push(Edit::MapSize(*size));
        }
        Action::Edit { edit: Edit::All(edits), gesture: Some(self.gesture) }
    }
}

fn body_changes(body: &Body, pull: &Pull, pivot: DVec3) -> Vec<BodyChange> {
    match pull {
        Pull::Move(offset) => vec![BodyChange::Position(body.position + *offset)],
        Pull::Turn { axis, angle } => turned(body, turn(*axis, *angle), pivot),
        Pull::Radius(radius) => vec![BodyChange::Shape(Shape::Sphere { radius: *radius })],
        Pull::Scale(factor) => grown(body, *factor, pivot),
        Pull::Sides { half: [half_x, half_y], shift } => {
            let shape = Shape::Plane { half_x: *half_x, half_y: *half_y };
            vec![BodyChange::Shape(shape), BodyChange::Position(body.position + *shift)]
        }
        Pull::Vector(velocity) if body.is_dynamic() => vec![BodyChange::Velocity(*velocity)],
        Pull::Vector(_) | Pull::Map(_) => Vec::new(),
    }
}

/// A body of another size, at its way from the pivot times the same factor. Mass and velocity stay.
fn grown(body: &Body, factor: f64, pivot: DVec3) -> Vec<BodyChange> {
    let shape = match body.shape {
        Shape::Sphere { radius } => Some(Shape::Sphere { radius: radius * factor }),
        Shape::Plane { half_x, half_y } => {
            Some(Shape::Plane { half_x: half_x * factor, half_y: half_y * factor })
        }
        Shape::Unbuilt { .. } => None,
    };
    let moves = body.position != pivot;
    let position = moves.then(|| BodyChange::Position(pivot + (body.position - pivot) * factor));
    shape.map(BodyChange::Shape).into_iter().chain(position).collect()
}

/// A force as a pull leaves it.
fn pulled(kind: ForceKind, pull: &Pull, pivot: DVec3) -> ForceKind {
    match (pull, kind) {
        (Pull::Move(offset), _) => kind.moved(*offset).unwrap_or(kind),
        (Pull::Scale(factor), _) => {
            let way = kind.position().map(|position| (position - pivot) * (factor - 1.0));
            way.and_then(|way| kind.moved(way)).unwrap_or(kind)
        }
        (Pull::Turn { axis, angle }, _) => turned_force(kind, turn(*axis, *angle), pivot),
        (Pull::Vector(acceleration), ForceKind::GravityPlane { position, .. }) => {
            ForceKind::GravityPlane { position, acceleration: *acceleration }
        }
        _ => kind,
    }
}

fn turned_force(kind: ForceKind, turn: DMat3, pivot: DVec3) -> ForceKind {
    let turned = |position: DVec3| pivot + turn * (position - pivot);
    match kind {
        ForceKind::GravityPoint { position, intensity } => {
            ForceKind::GravityPoint { position: turned(position), intensity }
        }
        ForceKind::GravityPlane { position, acceleration } => {
            ForceKind::GravityPlane { position: turned(position), acceleration: turn * acceleration }
        }
        ForceKind::Drag { .. } => kind,
    }
}
