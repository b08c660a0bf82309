//! Scenes for other programs: one table of formats, each with its writer and a report of what it could not say.
//!
//! A new format is one file with a [`Format`] and one line in [`FORMATS`].

mod aspect;
mod axes;
mod contact;
mod csv;
mod error;
mod format;
mod gltf;
mod mesh;
mod mjcf;
mod motion;
mod names;
mod pairs;
mod polyphysics;
mod range;
mod report;
mod sdf;
mod slab;
mod usd;
mod xml;

pub use aspect::Aspect;
pub use contact::{restitution_of_damping, rolling_lever, rolling_of_lever};
pub use error::ExportError;
pub use format::{Exported, Format};
pub use motion::{Animation, Frames, Sample, When, with_state_of};
pub use report::{Report, ReportLine, Verdict};

/// All formats, in the order in which they are offered.
pub const FORMATS: &[Format] =
    &[mjcf::FORMAT, sdf::FORMAT, gltf::FORMAT, usd::FORMAT, csv::FORMAT, polyphysics::FORMAT];
