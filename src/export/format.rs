//! What a format is, what its writer is given, and what it gives back.

use glam::DVec3;

use super::error::ExportError;
use super::motion::{Animation, Frames, When, looked_up, simulated};
use super::report::Report;
use crate::record::RecordedMotion;
use crate::scene::{Body, Document, ForceKind, Foreign, Scene};

/// One way to write a scene for another program.
#[derive(Debug)]
pub struct Format {
    /// As `--to` takes it.
    pub id: &'static str,
    pub name: &'static str,
    /// Of its files, without the dot.
    pub extension: &'static str,
    pub is_binary: bool,
    /// Whether it can hold motion, and not a start only.
    pub moves: bool,
    /// What it can hold, in a few words.
    pub holds: &'static str,
    pub(super) write: fn(&Source<'_>) -> Result<Exported, ExportError>,
}

impl Format {
    /// Writes the scene of a document. It must have one, without errors.
    pub fn export(&self, document: &Document) -> Result<Exported, ExportError> {
        self.written(document, None)
    }

    /// As [`Self::export`], at another time or with its motion. `go_on` hears how much of the simulation is done, from
    /// 0 to 1, and how many events there were, and ends it by `false`.
    pub fn export_when(
        &self,
        document: &Document,
        when: When,
        go_on: &mut dyn FnMut(f64, u64) -> bool,
    ) -> Result<Exported, ExportError> {
        if matches!(when, When::Motion(_)) && !self.moves {
            return Err(ExportError::NoMotion(self.name));
        }
        let (document, motion) = simulated(document, when, go_on)?;
        self.written(&document, motion.as_ref())
    }

    /// As [`Self::export`], with the motion between two times that a run of the document has recorded. `go_on` hears how much
    /// is done, from 0 to 1, and ends it by `false`.
    pub fn export_recorded(
        &self,
        document: &Document,
        motion: &RecordedMotion,
        frames: Frames,
        go_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Exported, ExportError> {
        if !self.moves {
            return Err(ExportError::NoMotion(self.name));
        }
        let (document, motion) = looked_up(document, motion, frames, go_on)?;
        self.written(&document, Some(&motion))
    }

    fn written(&self, document: &Document, motion: Option<&Animation>) -> Result<Exported, ExportError> {
        let scene = document.scene().filter(|_| !document.has_errors()).ok_or(ExportError::NoScene)?;
        (self.write)(&Source { document, scene, foreign: document.foreign(), motion })
    }
}

/// A written scene.
#[derive(Clone, Debug)]
pub struct Exported {
    pub bytes: Vec<u8>,
    pub report: Report,
}

/// What a writer is given.
pub(super) struct Source<'a> {
    pub document: &'a Document,
    pub scene: &'a Scene,
    pub foreign: Foreign,
    pub motion: Option<&'a Animation>,
}

impl Source<'_> {
    pub fn dynamic(&self) -> impl Iterator<Item = &Body> {
        self.scene.bodies.iter().filter(|body| body.is_dynamic())
    }

    /// The sum of all uniform gravities, m/s².
    pub fn gravity(&self) -> DVec3 {
        let one = |kind: &ForceKind| match *kind {
            ForceKind::GravityPlane { acceleration, .. } => acceleration,
            ForceKind::GravityPoint { .. } | ForceKind::Drag { .. } => DVec3::ZERO,
        };
        self.scene.forces.iter().map(|force| one(&force.kind)).sum()
    }

    /// The sum of all densities of air, kg/m³: drag is linear in it.
    pub fn air_density(&self) -> f64 {
        let one = |kind: &ForceKind| match *kind {
            ForceKind::Drag { density } => density,
            ForceKind::GravityPoint { .. } | ForceKind::GravityPlane { .. } => 0.0,
        };
        self.scene.forces.iter().map(|force| one(&force.kind)).sum()
    }
}
