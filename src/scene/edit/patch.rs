//! The meaning of a document in which only bodies changed: that of the old one with these bodies exchanged.
//! Reading the whole anew gives the same and takes several times as long, which shows when bodies among a
//! hundred thousand are dragged.

use std::collections::BTreeMap;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::pen::Pen;
use crate::scene::Body;
use crate::scene::read::{ItemReading, Meaning};
use crate::scene::tree::Element;

/// Bodies that changed, by their place in the list: what they were and what they are.
pub(super) type Changes = BTreeMap<usize, (Arc<Element>, Arc<Element>)>;

/// The new meaning, or `None` if problems, ids or uses of format 1.1 could differ too.
pub(super) fn patched(pen: Pen<'_>, old: &Meaning, changes: &Changes) -> Option<Meaning> {
    let mut bodies = FxHashMap::default();
    for (before, now) in changes.values() {
        let [before, now] = [before, now].map(|node| ItemReading::kept_body(pen.view(node)));
        let quiet = before.problems.is_empty() && now.problems.is_empty();
        let same_uses = before.uses.iter().map(|used| used.0).eq(now.uses.iter().map(|used| used.0));
        if !(quiet && same_uses && before.id == now.id) {
            return None;
        }
        let body = now.body()?;
        bodies.insert(body.key, body);
    }
    let mut scene = old.scene.as_deref()?.clone();
    for old in &mut scene.bodies {
        if let Some(body) = bodies.remove(&old.key) {
            *old = Body { id: old.id, label: std::mem::take(&mut old.label), ..body.clone() };
        }
    }
    if !bodies.is_empty() {
        return None;
    }
    let (diagnostics, features) = (old.diagnostics.clone(), old.features.clone());
    Some(Meaning { scene: Some(Arc::new(scene)), diagnostics, features })
}
