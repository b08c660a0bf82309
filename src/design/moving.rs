//! Moving the selection, bodies and forces alike.

use glam::DVec3;

use super::plan::Given;
use crate::scene::{BodyChange, Edit, ForceChange, NodeKey};

/// Moves what is selected and not locked.
pub fn moved(given: &Given<'_>, by: DVec3, locked: impl Fn(NodeKey) -> bool) -> Vec<Edit> {
    let bodies = given
        .bodies()
        .into_iter()
        .filter(|body| !locked(body.key))
        .map(|body| Edit::Body { key: body.key, change: BodyChange::Position(body.position + by) });
    let forces = given.forces().into_iter().filter(|force| !locked(force.key)).filter_map(|force| {
        let kind = force.kind.moved(by)?;
        Some(Edit::Force { key: force.key, change: ForceChange::Kind(kind) })
    });
    bodies.chain(forces).collect()
}
