//! The document: what a scene file says, how it is read, edited and written. Knows nothing of time or pixels.

mod diagnostic;
mod document;
mod params;
mod types;

pub use diagnostic::{Diagnostic, Severity};
pub use document::{BodyChange, Document, Edit, EditError, Edited, ForceChange, NumberStyle};
pub use params::{PARAMS, ParamInfo, SimParams};
pub use types::{Body, Force, ForceKind, Map, Motion, NodeKey, Scene, Shape, rotation_matrix};
