//! What a document and all its later versions share: the text it was read from, how that becomes bytes,
//! and where things are in it.

use std::sync::{Arc, OnceLock};

use super::edit::Style;
use super::encoding::Encoding;
use super::tree::{Children, Keys};

#[derive(Debug)]
pub(super) struct Source {
    /// The file's text, without byte order mark; up to the fault if the bytes are no text.
    pub text: String,
    pub encoding: Encoding,
    /// The declaration names another encoding.
    pub contradiction: Option<String>,
    pub keys: Arc<Keys>,
    checkpoints: OnceLock<Vec<Checkpoint>>,
    style: OnceLock<Style>,
}

/// A place in the text whose line and column are known.
#[derive(Clone, Copy, Debug)]
struct Checkpoint {
    at: usize,
    line: u32,
    column: u32,
}

/// Bytes between checkpoints: what finding one place costs, also in a file of one line.
const CHECKPOINT_BYTES: usize = 1024;

impl Source {
    pub fn new(text: String, encoding: Encoding, contradiction: Option<String>, keys: Arc<Keys>) -> Self {
        let (checkpoints, style) = (OnceLock::new(), OnceLock::new());
        Self { text, encoding, contradiction, keys, checkpoints, style }
    }

    /// How the document is written, found in the first of its trees that is edited.
    pub fn style(&self, top: &Children) -> &Style {
        self.style.get_or_init(|| Style::of(top, &self.text))
    }

    /// Line and column in characters, from 1, of a byte offset.
    pub fn position(&self, at: usize) -> (u32, u32) {
        let at = self.text.floor_char_boundary(at);
        let checkpoints = self.checkpoints.get_or_init(|| checkpoints(&self.text));
        let next = checkpoints.partition_point(|checkpoint| checkpoint.at <= at);
        let from = checkpoints[..next].last().copied().unwrap_or(START);
        let end = from.advanced(&self.text[from.at..at]);
        (end.line, end.column)
    }
}

/// Line and column in characters, from 1, of a byte offset in a text.
pub(super) fn position_in(text: &str, at: usize) -> (u32, u32) {
    let end = START.advanced(&text[..text.floor_char_boundary(at)]);
    (end.line, end.column)
}

const START: Checkpoint = Checkpoint { at: 0, line: 1, column: 1 };

impl Checkpoint {
    fn advanced(self, text: &str) -> Self {
        let mut end = Self { at: self.at + text.len(), ..self };
        for c in text.chars() {
            if c == '\n' {
                end.line += 1;
                end.column = 1;
            } else {
                end.column += 1;
            }
        }
        end
    }
}

fn checkpoints(text: &str) -> Vec<Checkpoint> {
    let mut all = vec![START];
    let mut last = START;
    while last.at + CHECKPOINT_BYTES < text.len() {
        let next = text.ceil_char_boundary(last.at + CHECKPOINT_BYTES);
        last = last.advanced(&text[last.at..next]);
        all.push(last);
    }
    all
}
