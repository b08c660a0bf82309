//! Unsaved work outlives a crash: when a copy is made and dropped, and when it is offered. The user's own file
//! is never touched.

use std::time::{Duration, Instant};

use super::dialogue::Question;
use super::recovered::{self, Recovered};
use super::{Notice, Session};

/// Least time between two copies: what a crash may cost.
pub const INTERVAL: Duration = Duration::from_secs(3);

impl Session {
    /// Keeps a copy of unsaved work, at most every three seconds, and none of saved work.
    pub(super) fn keep_recovery(&mut self, now: Instant) {
        if !self.is_dirty() {
            return self.kept.recovery.clear();
        }
        let state = self.document_state();
        let too_soon =
            self.kept.recovery.last.is_some_and(|last| now.saturating_duration_since(last) < INTERVAL);
        if self.kept.recovery.copied == Some(state) || too_soon {
            return;
        }
        self.kept.recovery.last = Some(now);
        match self.write_recovery() {
            Ok(()) => self.kept.recovery.copied = Some(state),
            Err(err) if !self.kept.recovery.failed => {
                self.kept.recovery.failed = true;
                self.talk.notices.push(Notice::warning(format!("Unsaved work cannot be kept safe: {err}")));
            }
            Err(_) => {}
        }
    }

    /// Whether a copy of unsaved work is due: [`Session::poll`] makes it when called later.
    pub fn wants_recovery_copy(&self) -> bool {
        self.is_dirty()
            && self.kept.recovery.folder.is_some()
            && self.kept.recovery.copied != Some(self.document_state())
    }

    pub(super) fn write_recovery(&mut self) -> std::io::Result<()> {
        let about =
            Recovered::now(self.doc.file.path.clone(), self.doc.file.title.clone(), self.doc.file.stamp);
        let bytes = self.document().to_bytes();
        self.kept.recovery.write(&bytes, &about)
    }

    /// Drops the copy of a document that was saved, discarded or replaced.
    pub(super) fn forget_recovery(&mut self) {
        self.kept.recovery.clear();
    }

    /// Asks about the newest work that an earlier run left.
    pub(super) fn offer_recovery(&mut self) {
        let found = self.kept.recovery.folder.as_deref().map(recovered::find).unwrap_or_default();
        self.talk.question = found.into_iter().next().map(Question::Recover);
    }
}
