//! Text of the whole file that was typed and not applied yet.

use std::sync::Arc;

pub(super) struct TextDraft {
    text: Arc<str>,
    /// Differs for every text of one document.
    pub revision: u64,
}

impl TextDraft {
    pub fn new(text: Arc<str>, revision: u64) -> Self {
        Self { text, revision }
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    pub fn into_text(self) -> Arc<str> {
        self.text
    }
}
