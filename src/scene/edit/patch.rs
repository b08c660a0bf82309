//! The meaning of a document in which only bodies changed: that of the old one with these bodies exchanged.
//! Reading the whole anew gives the same and takes several times as long, which shows when bodies among a
//! hundred thousand are dragged.

use std::collections::BTreeMap;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::BodyChange;
use super::pen::Pen;
use crate::scene::read::{Item, ItemReading, Meaning};
use crate::scene::tree::Element;
use crate::scene::{Body, Motion, Scene, Shape};

/// Bodies that changed, by their place in the list: what they were and what they are.
pub(super) type Changes = BTreeMap<usize, (Arc<Element>, Arc<Element>)>;

/// The new meaning, or `None` if problems, ids or uses of format 1.1 could differ too.
pub(super) fn patched(pen: Pen<'_>, old: &Meaning, changes: &Changes) -> Option<Meaning> {
    let mut bodies = FxHashMap::default();
    for (before, now) in changes.values() {
        let [before, now] = [before, now].map(|node| ItemReading::kept_body(pen.view(node)));
        let quiet = before.problems().is_empty() && now.problems().is_empty();
        let same_uses = before.uses().iter().map(|used| used.0).eq(now.uses().iter().map(|used| used.0));
        if !(quiet && same_uses && before.id == now.id) {
            return None;
        }
        let body = now.body()?;
        bodies.insert(body.key, body);
    }
    let before = old.scene.as_deref()?;
    let now = |old: &Arc<Body>| match bodies.remove(&old.key) {
        Some(body) if (body.id, &body.label) == (old.id, &old.label) => body.clone(),
        Some(body) => Arc::new(Body { id: old.id, label: old.label.clone(), ..(**body).clone() }),
        None => old.clone(),
    };
    let now = before.bodies.as_slice().iter().map(now).collect();
    let Scene { map, time_speed, params, ref forces, bodies: _ } = *before;
    let scene = Scene { map, time_speed, params, forces: forces.clone(), bodies: now };
    if !bodies.is_empty() {
        return None;
    }
    let (diagnostics, features) = (old.diagnostics.clone(), old.features.clone());
    Some(Meaning { scene: Some(Arc::new(scene)), diagnostics, features })
}

/// What a body means after a change of its numbers, known without reading its element again, which takes as long as
/// writing it. `None` where problems or uses of format 1.1 could come or go.
pub(super) fn reading_after(before: &ItemReading, change: &BodyChange) -> Option<ItemReading> {
    let Item::Body(body) = &before.item else { return None };
    // A problem may be about the very number.
    if !before.problems().is_empty() {
        return None;
    }
    let (motion, shape) = match (change, body.motion, &body.shape) {
        (BodyChange::Position(_) | BodyChange::Rotation(_), motion, shape) => (motion, shape),
        (&BodyChange::Mass(mass), Motion::Dynamic { velocity, .. }, shape) => {
            (Motion::Dynamic { mass, velocity }, shape)
        }
        (&BodyChange::Velocity(velocity), Motion::Dynamic { mass, .. }, shape) => {
            (Motion::Dynamic { mass, velocity }, shape)
        }
        (BodyChange::Shape(now @ Shape::Sphere { .. }), motion, Shape::Sphere { .. })
        | (BodyChange::Shape(now @ Shape::Plane { .. }), motion, Shape::Plane { .. }) => (motion, now),
        _ => return None,
    };
    let mut body = Body { motion, shape: shape.clone(), ..(**body).clone() };
    match *change {
        BodyChange::Position(position) => body.position = position,
        BodyChange::Rotation(rotation) => body.rotation = rotation,
        _ => {}
    }
    Some(before.with_body(body))
}
