//! The meaning of a document in which only a few bodies changed: that of the old one with these bodies
//! exchanged. Reading the whole anew gives the same and takes several times as long, which shows when a
//! body among a hundred thousand is dragged.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::pen::Pen;
use crate::scene::Body;
use crate::scene::read::{ItemReading, Meaning};
use crate::scene::tree::Element;

/// Bodies beyond which finding each in the scene would take longer than reading all.
const MOST_BODIES: usize = 16;

/// Bodies that changed, by their place in the list: what they were and what they are.
pub(super) type Changes = BTreeMap<usize, (Arc<Element>, Arc<Element>)>;

/// The new meaning, or `None` if problems, ids or uses of format 1.1 could differ too.
pub(super) fn patched(pen: Pen<'_>, old: &Meaning, changes: &Changes) -> Option<Meaning> {
    if changes.len() > MOST_BODIES {
        return None;
    }
    let mut bodies = Vec::with_capacity(changes.len());
    for (before, now) in changes.values() {
        let [before, now] = [before, now].map(|node| ItemReading::kept_body(pen.view(node)));
        let quiet = before.problems.is_empty() && now.problems.is_empty();
        let same_uses = before.uses.iter().map(|used| used.0).eq(now.uses.iter().map(|used| used.0));
        if !(quiet && same_uses && before.id == now.id) {
            return None;
        }
        bodies.push(now.body()?);
    }
    let mut scene = old.scene.as_deref()?.clone();
    for body in bodies {
        let place = scene.bodies.iter().position(|old| old.key == body.key)?;
        let old = &mut scene.bodies[place];
        *old = Body { id: old.id, label: std::mem::take(&mut old.label), ..body.clone() };
    }
    let (diagnostics, features) = (old.diagnostics.clone(), old.features.clone());
    Some(Meaning { scene: Some(Arc::new(scene)), diagnostics, features })
}
