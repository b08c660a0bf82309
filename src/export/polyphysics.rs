//! PolyPhysicsXml 1.0, for the tools of the library it comes from: the file itself, without what 1.1 added.

use super::aspect::Aspect;
use super::error::ExportError;
use super::format::{Exported, Format, Source};
use super::report::{Fate, Report, dropped, kept};
use crate::scene::{BodyChange, Edit, ForceKind, SimParams};

pub(super) const FORMAT: Format = Format {
    id: "polyphysics-1.0",
    name: "PolyPhysicsXml 1.0",
    extension: "xml",
    is_binary: false,
    moves: false,
    holds: "everything but drag, materials and settings of the solver; comments and spaces stay",
    write,
};

fn write(source: &Source<'_>) -> Result<Exported, ExportError> {
    let scene = source.scene;
    let drags = scene.forces.iter().filter(|force| matches!(force.kind, ForceKind::Drag { .. }));
    let drags: Vec<_> = drags.map(|force| force.key).collect();
    let named = scene.bodies.iter().filter(|body| body.material.is_some());
    let mut edits: Vec<_> =
        named.map(|body| Edit::Body { key: body.key, change: BodyChange::Material(None) }).collect();
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
        Aspect::Unbuilt | Aspect::Drag | Aspect::Materials | Aspect::Solver => {
            dropped("1.0 does not know it")
        }
    }
}
