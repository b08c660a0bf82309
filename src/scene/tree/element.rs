//! One element: its raw tags and its children.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use super::Children;
use crate::scene::NodeKey;
use crate::scene::read::ItemReading;

/// [`Element::at`] of an element that is not in the source.
pub(in crate::scene) const NO_PLACE: u32 = u32::MAX;

/// A piece of a document: a span of the source it was read from, or new text.
#[derive(Clone, Debug)]
pub(in crate::scene) enum Text {
    Source {
        start: u32,
        end: u32,
    },
    /// Behind one thin pointer: there are millions of texts, nearly all of them of the source.
    New(Arc<Box<str>>),
}

impl Text {
    pub fn get<'a>(&'a self, source: &'a str) -> &'a str {
        match self {
            Self::Source { start, end } => source.get(*start as usize..*end as usize).unwrap_or(""),
            Self::New(text) => text,
        }
    }

    pub fn empty() -> Self {
        Self::Source { start: 0, end: 0 }
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        Self::New(Arc::new(text.into_boxed_str()))
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Self::New(Arc::new(text.into()))
    }
}

#[derive(Clone, Debug)]
pub(in crate::scene) struct Element {
    pub key: NodeKey,
    /// Where it began in the source, in bytes; [`NO_PLACE`] if it was added since.
    pub at: u32,
    /// The start tag as written, or the whole tag of an empty element.
    pub open: Text,
    /// The end tag as written; empty if the element is one `<tag/>`.
    pub close: Text,
    pub children: Children,
    /// What a body or force means: read once, then shared by all versions that hold this very node.
    pub reading: OnceLock<Arc<ItemReading>>,
}

impl Element {
    /// The same element with another start tag, to be read anew.
    pub fn with_open(&self, open: String) -> Self {
        Self { open: open.into(), reading: OnceLock::new(), ..self.clone() }
    }

    /// The same element with other children, to be read anew.
    pub fn with_children(&self, children: Children) -> Self {
        Self { children, reading: OnceLock::new(), ..self.clone() }
    }
}

/// Hands out the keys of one document and all its versions, each once.
#[derive(Debug)]
pub(in crate::scene) struct Keys(AtomicU64);

impl Keys {
    pub fn starting_at(first: u64) -> Self {
        Self(AtomicU64::new(first))
    }

    pub fn fresh(&self) -> NodeKey {
        NodeKey(self.0.fetch_add(1, Ordering::Relaxed))
    }
}
