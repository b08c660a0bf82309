//! Short messages to the user; the window shows each once, as a toast.

use crate::scene::escaped;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NoticeLevel {
    Info,
    Warning,
    Error,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    pub level: NoticeLevel,
    /// One line, fit to be shown.
    pub text: String,
}

impl Notice {
    pub fn info(text: impl Into<String>) -> Self {
        Self { level: NoticeLevel::Info, text: escaped(&text.into()) }
    }

    pub fn warning(text: impl Into<String>) -> Self {
        Self { level: NoticeLevel::Warning, text: escaped(&text.into()) }
    }

    pub fn error(text: impl Into<String>) -> Self {
        Self { level: NoticeLevel::Error, text: escaped(&text.into()) }
    }
}
