//! PolyPhysicsXml 1.0, for the tools of the library it comes from: the file itself, without what 1.1 added.

use glam::DVec3;

use super::aspect::Aspect;
use super::error::ExportError;
use super::format::{Exported, Format, Source};
use super::report::{Fate, Report, dropped, kept};
use crate::scene::{Body, BodyChange, Edit, ForceKind, Roughness, SimParams};

pub(super) const FORMAT: Format = Format {
    id: "polyphysics-1.0",
    name: "PolyPhysicsXml 1.0",
    extension: "xml",
    is_binary: false,
    moves: false,
    holds: "everything but drag, friction, spin, materials and settings of the solver; comments and spaces stay",
    write,
};

fn write(source: &Source<'_>) -> Result<Exported, ExportError> {
    let scene = source.scene;
    let drags = scene.forces.iter().filter(|force| matches!(force.kind, ForceKind::Drag { .. }));
    let drags: Vec<_> = drags.map(|force| force.key).collect();
    let mut edits: Vec<_> = scene.bodies.iter().flat_map(without_what_is_new).collect();
    if !drags.is_empty() {
        edits.push(Edit::Delete { keys: drags });
    }
    if scene.params != SimParams::default() {
        edits.push(Edit::Params(SimParams::default()));
    }
    let bytes = match &edits[..] {
        [] => source.document.to_bytes(),
        _ => source.document.apply(&Edit::All(edits))?.document.to_bytes(),
    };
    Ok(Exported { bytes, report: Report::of(source, fate) })
}

/// What takes the elements of 1.1 out of a body.
fn without_what_is_new(body: &Body) -> impl Iterator<Item = Edit> + use<> {
    let Roughness { friction, rolling, tangential } = body.roughness;
    let changes = [
        (body.material.is_some(), BodyChange::Material(None)),
        (friction != 0.0, BodyChange::Friction(0.0)),
        (rolling != 0.0, BodyChange::RollingFriction(0.0)),
        (tangential != 0.0, BodyChange::Tangential(0.0)),
        (body.spin != DVec3::ZERO, BodyChange::Spin(DVec3::ZERO)),
    ];
    let key = body.key;
    changes.into_iter().filter(|(is_set, _)| *is_set).map(move |(_, change)| Edit::Body { key, change })
}

fn fate(aspect: Aspect) -> Fate {
    match aspect {
        Aspect::Spheres
        | Aspect::Plates
        | Aspect::Masses
        | Aspect::Velocities
        | Aspect::Bounce
        | Aspect::Frictionless
        | Aspect::UniformGravity
        | Aspect::PointGravity
        | Aspect::UserIds
        | Aspect::ForceIds
        | Aspect::ForceLooks
        | Aspect::Map
        | Aspect::TimeSpeed
        | Aspect::Comments => kept(""),
        Aspect::Unknown => kept("as it is; other tools skip it or complain"),
        Aspect::BodyNames
        | Aspect::Groups
        | Aspect::Colors
        | Aspect::Hidden
        | Aspect::Locked
        | Aspect::Viewpoints => kept("in processing instructions, which other tools skip"),
        Aspect::Motion => dropped("it has a start only"),
        Aspect::Unbuilt
        | Aspect::Drag
        | Aspect::Friction
        | Aspect::RollingFriction
        | Aspect::Tangential
        | Aspect::Spins
        | Aspect::Materials
        | Aspect::Solver => dropped("1.0 does not know it"),
    }
}
