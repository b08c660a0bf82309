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
    chunks: Vec<Chunk>,
}

#[derive(Clone, Debug)]
struct Chunk {
    /// Index of its first child.
    start: usize,
    items: Arc<[Child]>,
}

impl Chunk {
    fn end(&self) -> usize {
        self.start + self.items.len()
    }
}

/// A range of children and what replaces it.
pub(in crate::scene) type Splice = (Range<usize>, Vec<Child>);

impl Children {
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &Child> + Clone {
        self.chunks.iter().flat_map(|chunk| chunk.items.iter())
    }

    pub fn len(&self) -> usize {
        self.chunks.last().map_or(0, Chunk::end)
    }

    pub fn get(&self, index: usize) -> Option<&Child> {
        let next = self.chunks.partition_point(|chunk| chunk.start <= index);
        let chunk = self.chunks.get(next.checked_sub(1)?)?;
        chunk.items.get(index - chunk.start)
    }

    /// The list with the children of one range replaced.
    pub fn splice(&self, range: Range<usize>, replacement: Vec<Child>) -> Self {
        self.splice_all(vec![(range, replacement)])
    }

    /// The list with several ranges replaced, which are in order and do not overlap.
    pub fn splice_all(&self, splices: Vec<Splice>) -> Self {
        let mut new = Builder::default();
        let mut splices = splices.into_iter().peekable();
        // How far the old list is copied or replaced.
        let mut done = 0;
        for chunk in &self.chunks {
            if done <= chunk.start && splices.peek().is_none_or(|(range, _)| range.start > chunk.end()) {
                new.share(&chunk.items);
                done = chunk.end();
                continue;
            }
            while let Some((range, replacement)) = splices.next_if(|(range, _)| range.start <= chunk.end()) {
                new.copy(chunk, done..range.start);
                new.open.extend(replacement);
                done = range.end;
            }
            new.copy(chunk, done..chunk.end());
            done = done.max(chunk.end());
        }
        for (_, replacement) in splices {
            new.open.extend(replacement);
        }
        new.close();
        new.list
    }
}

/// A list in the making: chunks, then loose children.
#[derive(Default)]
struct Builder {
    list: Children,
    open: Vec<Child>,
}

impl Builder {
    fn copy(&mut self, chunk: &Chunk, range: Range<usize>) {
        let from = range.start.max(chunk.start) - chunk.start;
        let to = range.end.clamp(chunk.start, chunk.end()) - chunk.start;
        if from < to {
            self.open.extend_from_slice(&chunk.items[from..to]);
        }
    }

    fn share(&mut self, items: &Arc<[Child]>) {
        self.close();
        self.push(items.clone());
    }

    fn close(&mut self) {
        let open = std::mem::take(&mut self.open);
        if open.len() > CHUNK * 2 {
            open.chunks(CHUNK).for_each(|items| self.push(items.into()));
        } else if !open.is_empty() {
            self.push(open.into());
        }
    }

    fn push(&mut self, items: Arc<[Child]>) {
        let start = self.list.len();
        // Nearly all lists have one chunk, and a Vec would make room for four.
        if self.list.chunks.is_empty() {
            self.list.chunks.reserve_exact(1);
        }
        self.list.chunks.push(Chunk { start, items });
    }
}

impl From<Vec<Child>> for Children {
    fn from(open: Vec<Child>) -> Self {
        let mut new = Builder { open, ..Builder::default() };
        new.close();
        new.list
    }
}
