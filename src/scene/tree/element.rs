//! One element: its raw tags and its children.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use super::{Child, Children};
use crate::scene::read::ItemReading;
use crate::scene::{NodeKey, parse};

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
    inside: Inside,
    /// What a body or force means: read once, then shared by all versions that hold this very node.
    pub reading: OnceLock<Arc<ItemReading>>,
}

/// What stands between the tags: a list of children, or one piece of the source until somebody asks for the list. Bodies
/// are such pieces, for in a list each takes a kilobyte, which most of a hundred thousand need never.
#[derive(Clone, Debug)]
enum Inside {
    Listed(Children),
    Piece { start: u32, end: u32, listed: OnceLock<Box<Children>> },
}

/// What is inside an element, as it is kept.
pub(in crate::scene) enum Kept<'a> {
    Listed(&'a Children),
    /// As written.
    Piece(&'a str),
}

impl Element {
    /// An element as it was read, at a place of the source if that is kept.
    pub fn read(key: NodeKey, at: u32, tags: [Text; 2], children: Vec<Child>) -> Self {
        let ([open, close], inside) = (tags, Inside::Listed(children.into()));
        Self { key, at, open, close, inside, reading: OnceLock::new() }
    }

    /// The same with what is inside as one piece of the source.
    pub fn folded(self, piece: std::ops::Range<u32>) -> Self {
        let inside = Inside::Piece { start: piece.start, end: piece.end, listed: OnceLock::new() };
        Self { inside, ..self }
    }

    /// The children. The source is that of the document.
    pub fn children(&self, source: &str) -> &Children {
        match &self.inside {
            Inside::Listed(children) => children,
            Inside::Piece { start, end, listed } => {
                listed.get_or_init(|| Box::new(parse::inside(source, *start..*end)))
            }
        }
    }

    /// The same element with its children listed, for a moment: this one stays as it is kept.
    pub fn unfolded(self: &Arc<Self>, source: &str) -> Arc<Self> {
        match &self.inside {
            Inside::Piece { start, end, listed } if listed.get().is_none() => {
                Arc::new(self.with_children(parse::inside(source, *start..*end)))
            }
            _ => self.clone(),
        }
    }

    pub fn kept<'a>(&'a self, source: &'a str) -> Kept<'a> {
        match &self.inside {
            Inside::Listed(children) => Kept::Listed(children),
            Inside::Piece { start, end, listed } => match listed.get() {
                Some(children) => Kept::Listed(children),
                None => Kept::Piece(source.get(*start as usize..*end as usize).unwrap_or("")),
            },
        }
    }

    /// The same element with another start tag, to be read anew.
    pub fn with_open(&self, open: String) -> Self {
        Self { open: open.into(), reading: OnceLock::new(), ..self.clone() }
    }

    /// The same element with other children, to be read anew.
    pub fn with_children(&self, children: Children) -> Self {
        Self { inside: Inside::Listed(children), reading: OnceLock::new(), ..self.clone() }
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
