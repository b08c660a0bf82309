//! Whom the edits of a recording's file name. Keys differ each time a scene is read; labels do not.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::error::RecordingError;
use crate::scene::{NodeKey, Scene, escaped};
use crate::sim::SimEdit;

/// A key of the edits with the body or force of the scene that it stands for. Keys without one are of what was added.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct NamedKey {
    key: NodeKey,
    is_body: bool,
    label: String,
}

/// The key that an edit is about.
fn key_of(edit: &mut SimEdit) -> &mut NodeKey {
    match edit {
        SimEdit::AddBody(body) | SimEdit::ChangeStatic(body) => &mut body.key,
        SimEdit::AddForce(force) | SimEdit::ChangeForce(force) => &mut force.key,
        SimEdit::Remove(key)
        | SimEdit::Bounce(key, _)
        | SimEdit::Roughness(key, _)
        | SimEdit::Mass(key, _) => key,
    }
}

/// Names those of the scene whom edits are about.
pub(super) fn names<'a>(scene: &Scene, edits: impl Iterator<Item = &'a SimEdit>) -> Vec<NamedKey> {
    let mut names: BTreeMap<NodeKey, NamedKey> = BTreeMap::new();
    for edit in edits {
        let key = *key_of(&mut edit.clone());
        let body = scene.bodies.iter().find(|body| body.key == key).map(|body| (true, &body.label));
        let force = scene.forces.iter().find(|force| force.key == key).map(|force| (false, &force.label));
        if let Some((is_body, label)) = body.or(force) {
            names.insert(key, NamedKey { key, is_body, label: label.to_string() });
        }
    }
    names.into_values().collect()
}

/// Gives the edits the keys that their bodies and forces have in `scene`; those that were added get keys of their own.
pub(super) fn with_keys_of(
    scene: &Scene,
    names: &[NamedKey],
    edits: impl Iterator<Item = SimEdit>,
) -> Result<Vec<SimEdit>, RecordingError> {
    let mut keys: BTreeMap<NodeKey, NodeKey> = BTreeMap::new();
    for name in names {
        let found = if name.is_body {
            scene.bodies.iter().find(|body| body.label == name.label).map(|body| body.key)
        } else {
            scene.forces.iter().find(|force| force.label == name.label).map(|force| force.key)
        };
        let what = if name.is_body { "body" } else { "force" };
        let missing = || RecordingError::Content(format!("its scene has no {what} {}", escaped(&name.label)));
        keys.insert(name.key, found.ok_or_else(missing)?);
    }
    let used = scene.bodies.iter().map(|body| body.key.0).chain(scene.forces.iter().map(|force| force.key.0));
    let mut next = used.max().unwrap_or(0);
    let renamed = edits.map(|mut edit| {
        let key = key_of(&mut edit);
        *key = *keys.entry(*key).or_insert_with(|| {
            next += 1;
            NodeKey(next)
        });
        edit
    });
    Ok(renamed.collect())
}
