//! Scenes for other programs out of the window, and theirs into it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::dialogue::{Question, Request};
use super::open_document::OpenFile;
use super::{Notice, Outcome, Session};
use crate::import::{self, Imported};
use crate::scene::{Document, Edit, EditError, same_file, shown_path, write_atomically};

/// A file that was made and has no place yet.
#[derive(Clone, PartialEq, Eq)]
pub struct ExportedFile {
    /// Ending of its name, without the first dot.
    pub extension: &'static str,
    pub bytes: Arc<[u8]>,
}

impl std::fmt::Debug for ExportedFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes of {}", self.bytes.len(), self.extension)
    }
}

impl Session {
    /// The document with the places and velocities of this moment as its start.
    pub fn document_now(&self) -> Result<Document, EditError> {
        if self.shows_start() {
            return Ok(self.document().clone());
        }
        Ok(self.document().apply(&Edit::All(self.state_edits()))?.document)
    }

    /// Refuses to write something else over the scene's own file, however its path is spelt.
    pub(super) fn spare_own_file(&self, path: &Path) -> Result<(), String> {
        if self.path().is_some_and(|own| same_file(own, path)) {
            return Err(format!("{} is the scene itself: choose another name", shown_path(path)));
        }
        Ok(())
    }

    /// Writes an exported file where the user said. The scene's own file is not replaced.
    pub(super) fn write_export(&mut self, path: &Path, file: &ExportedFile) -> Outcome {
        let longer = PathBuf::from(format!("{}.{}", path.display(), file.extension));
        // no dialog has asked about the longer name, so it must not replace anything
        let path = if path.extension().is_none() && !longer.exists() { &longer } else { path };
        if let Err(reason) = self.spare_own_file(path) {
            return Outcome::Refused(reason);
        }
        match write_atomically(path, &file.bytes) {
            Ok(()) => self.talk.notices.push(Notice::info(format!("Exported {}", shown_path(path)))),
            Err(err) => {
                let text = format!("{} cannot be written: {err}", shown_path(path));
                self.talk.notices.push(Notice::error(text));
            }
        }
        Outcome::Done
    }

    /// Takes a file of another program as a new scene that is not saved yet. Asks before it leaves something out that
    /// cannot be here.
    pub(super) fn open_foreign(&mut self, path: &Path, foreign: &Document, leave_out: bool) {
        let Imported { document, report, problems, .. } = import::import(foreign, leave_out);
        let Some(document) = document else {
            let (count, name) = (problems.len(), shown_path(path));
            self.talk.question = match problems.first() {
                Some(first) if !leave_out => Some(Question::CannotImport {
                    path: path.to_owned(),
                    problem: first.to_string(),
                    more: count - 1,
                }),
                first => {
                    let text = first.map(ToString::to_string).unwrap_or_default();
                    self.talk.notices.push(Notice::error(format!("{name} cannot be imported: {text}")));
                    None
                }
            };
            return;
        };
        let title = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        self.replace(document, OpenFile::untitled(&title), false);
        self.remember(path);
        let title = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.talk.requests.push(Request::ShowImport { title, report: Arc::new(report) });
    }
}
