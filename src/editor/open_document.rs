//! The open document with its undo, and the file it came from and goes to.

use std::path::{Path, PathBuf};

use super::copies::LastCopies;
use super::disk::DiskStamp;
use super::history::History;
use super::text_draft::TextDraft;
use super::trouble_list::TroubleList;
use super::verification::Verification;
use crate::scene::{Document, escaped};

pub(super) struct OpenDocument {
    pub history: History,
    pub file: OpenFile,
    /// The document as its file holds it, if it has one.
    pub saved: Option<Document>,
    /// The text that is typed and not applied.
    pub draft: Option<TextDraft>,
    /// How many drafts there were.
    pub drafts: u64,
    /// Grows with every document that replaces another.
    pub opened: u64,
    /// The comparison with the recording that it came from.
    pub verification: Option<Verification>,
    /// The copies made last.
    pub last_copies: Option<LastCopies>,
    /// What is wrong with the scene, by the document it was found in.
    pub troubles: TroubleList,
}

/// Where the document came from and goes to.
pub(super) struct OpenFile {
    pub path: Option<PathBuf>,
    pub title: String,
    /// What the file held when it was read or written.
    pub stamp: Option<DiskStamp>,
    /// What another program left there that was told to the user already.
    pub reported: Option<DiskStamp>,
}

impl OpenDocument {
    /// `saved` says whether the document is what its file holds.
    pub fn new(document: Document, file: OpenFile, saved: bool) -> Self {
        Self {
            saved: saved.then(|| document.clone()),
            history: History::new(document, saved),
            file,
            draft: None,
            drafts: 0,
            opened: 0,
            verification: None,
            last_copies: None,
            troubles: TroubleList::default(),
        }
    }

    /// Puts another document, with a history of its own, in this one's place.
    pub fn replace(&mut self, document: Document, file: OpenFile, saved: bool) {
        *self = Self { opened: self.opened + 1, ..Self::new(document, file, saved) };
    }
}

impl OpenFile {
    pub fn untitled(title: &str) -> Self {
        Self { path: None, title: title.to_owned(), stamp: None, reported: None }
    }

    pub fn at(path: &Path, stamp: Option<DiskStamp>) -> Self {
        let title = escaped(&path.file_name().unwrap_or(path.as_os_str()).to_string_lossy());
        Self { path: Some(path.to_owned()), title, stamp, reported: None }
    }
}
