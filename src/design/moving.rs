//! Moving the selection, bodies and forces alike.

use glam::DVec3;

use super::plan::Given;
use crate::scene::{BodyChange, Edit, ForceChange, ForceKind, NodeKey};

/// Moves what is selected and not locked.
pub fn moved(given: &Given<'_>, by: DVec3, locked: impl Fn(NodeKey) -> bool) -> Vec<Edit> {
    let bodies = given
        .bodies()
        .into_iter()
        .filter(|body| !locked(body.key))
        .map(|body| Edit::Body { key: body.key, change: BodyChange::Position(body.position + by) });
    let forces = given.forces().into_iter().filter(|force| !locked(force.key)).filter_map(|force| {
        let kind = shifted(force.kind, by)?;
        Some(Edit::Force { key: force.key, change: ForceChange::Kind(kind) })
    });
    bodies.chain(forces).collect()
}

/// A force elsewhere; `None` where it has no place.
pub(super) fn shifted(kind: ForceKind, by: DVec3) -> Option<ForceKind> {
    match kind {
        ForceKind::GravityPoint { position, intensity } => {
            Some(ForceKind::GravityPoint { position: position + by, intensity })
        }
        ForceKind::GravityPlane { position, acceleration } => {
            Some(ForceKind::GravityPlane { position: position + by, acceleration })
        }
        ForceKind::Drag { .. } => None,
    }
}
