//! The document: what a scene file says, how it is read, edited and written. Knows nothing of time or pixels.

mod body_list;
mod compose;
mod contents;
mod declaration;
mod diagnostic;
mod document;
mod edit;
mod encoding;
mod euler;
mod foreign;
mod ids;
mod locate;
mod names;
mod number;
mod params;
mod parse;
mod read;
mod reread;
mod rules;
mod save;
mod schema;
mod source;
mod tree;
mod types;
mod viewpoint;
mod vocabulary;
mod write;
mod xml;

use diagnostic::shown;

pub use body_list::BodyList;
pub use contents::Scene;
pub use diagnostic::{Diagnostic, Severity, escaped, shown_path};
pub use document::Document;
pub use edit::{BodyChange, BodyCopy, Edit, EditError, Edited, ForceChange, Side, Touched};
pub use euler::euler_near;
pub use foreign::Foreign;
pub use names::Names;
pub use number::NumberStyle;
pub use params::{HEAP_OVERLAP, PARAMS, ParamInfo, SimParams};
pub use save::{
    FileId, FileStamp, canonical_target, check_writable, same_file, write_atomically, write_private,
};
pub use schema::schema;
pub use types::{Body, Force, ForceKind, Map, Motion, NodeKey, Roughness, Shape, rotation_matrix};
pub use viewpoint::Viewpoint;
pub use vocabulary::{AttributeInfo, Content, ElementInfo, Need, Part, Since, VOCABULARY, ValueKind};
pub use xml::XmlElement;
