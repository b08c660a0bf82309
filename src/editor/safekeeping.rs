//! Unsaved work outlives a crash: when a copy is made and dropped, and when it is offered. The user's own file
//! is never touched.

use std::time::{Duration, Instant};

use super::dialogue::Question;
use super::recovered::{self, Recovered};
use super::text_draft::TextDraft;
use super::{Notice, Session};

/// Least time between two copies: what a crash may cost.
pub const INTERVAL: Duration = Duration::from_secs(3);

impl Session {
    /// Keeps a copy of unsaved work, at most every three seconds, and none of saved work.
    pub(super) fn keep_recovery(&mut self, now: Instant) {
        if !self.has_unsaved_work() {
            return self.kept.recovery.clear();
        }
        let state = self.state_to_keep();
        let too_soon =
            self.kept.recovery.last.is_some_and(|last| now.saturating_duration_since(last) < INTERVAL);
        if self.kept.recovery.copied == Some(state) || too_soon {
            return;
        }
        self.kept.recovery.last = Some(now);
        match self.write_recovery() {
            Ok(()) => {}
            Err(err) if !self.kept.recovery.failed => {
                self.kept.recovery.failed = true;
                self.talk.notices.push(Notice::warning(format!("Unsaved work cannot be kept safe: {err}")));
            }
            Err(_) => {}
        }
    }

    /// Whether a copy of unsaved work is due: [`Session::poll`] makes it when called later.
    pub fn wants_recovery_copy(&self) -> bool {
        self.has_unsaved_work()
            && self.kept.recovery.folder.is_some()
            && self.kept.recovery.copied != Some(self.state_to_keep())
    }

    /// Of the document, and of the text that is typed.
    fn state_to_keep(&self) -> (u64, u64) {
        (self.document_state(), self.doc.draft.as_ref().map_or(0, |draft| draft.revision))
    }

    pub(super) fn write_recovery(&mut self) -> std::io::Result<()> {
        let file = &self.doc.file;
        let draft = self.doc.draft.as_ref().map(TextDraft::text);
        let about = Recovered::now(file.path.clone(), file.title.clone(), file.stamp, draft.is_some());
        let bytes = self.document().to_bytes();
        self.kept.recovery.write(&bytes, draft, &about)?;
        self.kept.recovery.copied = Some(self.state_to_keep());
        Ok(())
    }

    /// The document is saved: a copy holds no more than text that is typed.
    pub(super) fn renew_recovery(&mut self) {
        if self.doc.draft.is_none() {
            self.forget_recovery();
        } else if self.write_recovery().is_err() {
            // the next turn tries again, and tells
            self.kept.recovery.last = None;
        }
    }

    /// Drops the copy of a document that was discarded or replaced.
    pub(super) fn forget_recovery(&mut self) {
        self.kept.recovery.clear();
    }

    /// Asks about the newest work that an earlier run left.
    pub(super) fn offer_recovery(&mut self) {
        let found = self.kept.recovery.folder.as_deref().map(recovered::find).unwrap_or_default();
        self.talk.question = found.into_iter().next().map(Question::Recover);
    }
}
