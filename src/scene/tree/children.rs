//! An ordered list of children in shared chunks: with a hundred thousand bodies, an edit of one copies
//! a chunk and not the list, and an undo history stays small.

use std::ops::Range;
use std::sync::Arc;

use super::{Element, Text};

/// Children per chunk: copying one and listing all chunks of 10^5 children cost about the same.
const CHUNK: usize = 256;

#[derive(Clone, Debug)]
pub(in crate::scene) enum Child {
    Element(Arc<Element>),
    /// Text, a comment, a processing instruction, a CDATA section or a reference, as written.
    Raw(Text),
}

impl Child {
    /// The element, if it is one.
    pub fn element(&self) -> Option<&Arc<Element>> {
        match self {
            Self::Element(element) => Some(element),
            Self::Raw(_) => None,
        }
    }
}

#[derive(Clone, Debug, Default)]
pub(in crate::scene) struct Children {
    chunks: Vec<Arc<[Child]>>,
}

impl Children {
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &Child> {
        self.chunks.iter().flat_map(|chunk| chunk.iter())
    }

    pub fn len(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.len()).sum()
    }

    pub fn get(&self, index: usize) -> Option<&Child> {
        let mut left = index;
        for chunk in &self.chunks {
            match chunk.get(left) {
                Some(child) => return Some(child),
                None => left -= chunk.len(),
            }
        }
        None
    }

    /// The list with the children of `range` replaced.
    pub fn splice(&self, range: Range<usize>, replacement: impl IntoIterator<Item = Child>) -> Self {
        let mut chunks = Vec::with_capacity(self.chunks.len() + 1);
        let mut replacement = Some(replacement);
        let mut open: Vec<Child> = Vec::new();
        let mut first = 0;
        for chunk in &self.chunks {
            let next = first + chunk.len();
            let untouched = next < range.start || (replacement.is_none() && first >= range.end);
            if untouched {
                close(&mut open, &mut chunks);
                chunks.push(chunk.clone());
            } else {
                let before = range.start.saturating_sub(first).min(chunk.len());
                let after = range.end.saturating_sub(first).min(chunk.len());
                open.extend_from_slice(&chunk[..before]);
                if range.start <= next {
                    open.extend(replacement.take().into_iter().flatten());
                }
                open.extend_from_slice(&chunk[after..]);
            }
            first = next;
        }
        open.extend(replacement.into_iter().flatten());
        close(&mut open, &mut chunks);
        Self { chunks }
    }
}

fn close(open: &mut Vec<Child>, chunks: &mut Vec<Arc<[Child]>>) {
    chunks.extend(Children::from(std::mem::take(open)).chunks);
}

impl From<Vec<Child>> for Children {
    fn from(children: Vec<Child>) -> Self {
        if children.len() <= CHUNK * 2 {
            let chunks = if children.is_empty() { Vec::new() } else { vec![Arc::from(children)] };
            return Self { chunks };
        }
        Self { chunks: children.chunks(CHUNK).map(Arc::from).collect() }
    }
}
