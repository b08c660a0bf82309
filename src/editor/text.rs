//! The text of the document by lines, and which of them belong to which body or force: what the XML pane shows.

use std::ops::Range;

use rustc_hash::FxHashMap;

use crate::scene::{Document, NodeKey};

/// A document as text.
#[derive(Clone, Debug, Default)]
pub struct DocumentText {
    text: String,
    /// Where each line begins, in bytes.
    starts: Vec<usize>,
    /// In order.
    places: Vec<(NodeKey, Range<usize>)>,
    /// Which of them is whose.
    of_key: FxHashMap<NodeKey, usize>,
    comments: Vec<Range<usize>>,
}

impl DocumentText {
    pub fn of(document: &Document) -> Self {
        let (text, places) = document.text_with_places();
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
        let starts = std::iter::once(0).chain(ends.filter(|end| *end < text.len())).collect();
        let comments = comments(&text);
        let of_key = places.iter().enumerate().map(|(at, (key, _))| (*key, at)).collect();
        Self { text, starts, places, of_key, comments }
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    pub fn line_count(&self) -> usize {
        self.starts.len()
    }

    /// A line without its end, and where it begins in bytes.
    pub fn line(&self, line: usize) -> (&str, usize) {
        let start = self.starts.get(line).copied().unwrap_or(self.text.len());
        let end = self.starts.get(line + 1).copied().unwrap_or(self.text.len());
        let text = self.text.get(start..end).unwrap_or_default();
        (text.trim_end_matches(['\n', '\r']), start)
    }

    fn line_at(&self, byte: usize) -> usize {
        self.starts.partition_point(|start| *start <= byte).saturating_sub(1)
    }

    /// Where a body or force stands, in bytes.
    pub fn place(&self, key: NodeKey) -> Option<Range<usize>> {
        let at = self.of_key.get(&key)?;
        self.places.get(*at).map(|(_, place)| place.clone())
    }

    /// The lines of a range of bytes.
    pub fn lines(&self, place: &Range<usize>) -> Range<usize> {
        self.line_at(place.start)..self.line_at(place.end.saturating_sub(1)) + 1
    }

    /// The body or force that a byte belongs to.
    pub fn key_at(&self, byte: usize) -> Option<NodeKey> {
        let next = self.places.partition_point(|(_, place)| place.start <= byte);
        let (key, place) = self.places.get(next.checked_sub(1)?)?;
        (byte < place.end).then_some(*key)
    }

    /// The bodies and forces that have a part of a line.
    pub fn keys_in_line(&self, line: usize) -> impl Iterator<Item = NodeKey> {
        let (text, start) = self.line(line);
        let end = start + text.len();
        let first = self.places.partition_point(|(_, place)| place.end <= start);
        let rest = self.places.get(first..).unwrap_or_default().iter();
        rest.take_while(move |(_, place)| place.start < end).map(|(key, _)| *key)
    }

    /// Whether a byte is inside a comment.
    pub fn is_comment(&self, byte: usize) -> bool {
        let next = self.comments.partition_point(|comment| comment.start <= byte);
        next.checked_sub(1).and_then(|at| self.comments.get(at)).is_some_and(|comment| byte < comment.end)
    }
}

fn comments(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut from = 0;
    while let Some(start) = text.get(from..).and_then(|rest| rest.find("<!--")).map(|at| from + at) {
        let rest = text.get(start..).and_then(|rest| rest.find("-->"));
        let end = rest.map_or(text.len(), |at| start + at + 3);
        found.push(start..end);
        from = end;
    }
    found
}
