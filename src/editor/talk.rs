//! What the session says: messages, the question that must be answered first, things for the window to do.

use super::Notice;
use super::dialogue::{Intent, Question, Request};

#[derive(Default)]
pub(super) struct Talk {
    pub notices: Vec<Notice>,
    pub question: Option<Question>,
    pub requests: Vec<Request>,
    /// What to do after the save that a file dialog is open for.
    pub after_save: Option<Intent>,
    /// Whether the session ends, with whatever is not saved.
    pub ends: bool,
    /// Whether the text that the clipboard is asked for goes where it came from.
    pub paste_in_place: bool,
}
