//! The lossless tree: an immutable, ordered tree over the one source text. Nodes are shared between
//! versions of a document; an edit copies the nodes on the path from the root and nothing else.

mod children;
mod element;
pub(in crate::scene) mod tag;
mod view;

pub(in crate::scene) use children::{Child, Children, Splice};
pub(in crate::scene) use element::{Element, Kept, Keys, NO_PLACE, Text};
pub(in crate::scene) use view::{RawKind, View, raw_kind};
