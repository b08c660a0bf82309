//! Other programs and other windows on the open file: what they changed is told and offered, and read without stopping
//! what runs.

use std::path::Path;

use super::claim::Claim;
use super::dialogue::Question;
use super::disk::{DiskStamp, has_changed};
use super::disk_watch::DiskWatch;
use super::open_document::OpenFile;
use super::scene_changes::changes;
use super::text_draft::TextDraft;
use super::{Notice, Session};

impl Session {
    /// From now on the open file is looked at by itself; `wake` is called when a turn of the window should follow.
    pub fn watch_disk(&mut self, wake: impl Fn() + Send + 'static) {
        self.kept.watch = Some(DiskWatch::start(wake));
    }

    /// Once per turn of the window, unless something is going on that a question would disturb.
    pub(super) fn follow_disk(&mut self) {
        if self.talk.question.is_some() || self.open_gesture().is_some() {
            return;
        }
        let path = self.doc.file.path.as_deref();
        if self.kept.watch.as_ref().is_some_and(|watch| watch.has_changed(path)) {
            self.look_at_disk();
        }
    }

    /// Tells when another program removed the file, and offers to read it again when it changed it.
    pub(super) fn look_at_disk(&mut self) {
        let (Some(path), Some(stamp)) = (self.doc.file.path.clone(), self.doc.file.stamp) else { return };
        if !path.exists() {
            self.talk.notices.push(Notice::warning(format!("{} is gone from the disk", self.doc.file.title)));
            self.doc.history.mark_unsaved();
            self.doc.file.stamp = None;
        } else if has_changed(&path, stamp) && self.talk.question.is_none() {
            let now = DiskStamp::of(&path).ok();
            if std::mem::replace(&mut self.doc.file.reported, now) != now {
                self.offer_reload(&path);
            }
        }
    }

    fn offer_reload(&mut self, path: &Path) {
        let new = self.document().reopen(path);
        let changes = match (self.saved_document().unwrap_or(self.document()).scene(), new.scene()) {
            (Some(before), Some(after)) if !new.has_errors() => changes(before, after),
            _ => {
                let errors = new.diagnostics().iter().filter(|problem| problem.is_error());
                vec![errors.map(ToString::to_string).next().unwrap_or_default()]
            }
        };
        let (title, unsaved) = (self.doc.file.title.clone(), self.is_dirty());
        self.talk.question = Some(Question::Reload { title, changes, unsaved });
    }

    /// Reads the file again. A scene without errors takes the place of this one as one undo point, and bodies that did not
    /// change go on as they are.
    pub(super) fn reload(&mut self) {
        let Some(path) = self.doc.file.path.clone() else { return };
        self.settle();
        let stamp = DiskStamp::of(&path).ok();
        let new = self.document().reopen(&path);
        let before = self.scene().zip(new.scene()).filter(|_| !new.has_errors());
        let Some((before, after)) = before else {
            let draft = self.doc.draft.take().map(TextDraft::into_text);
            self.open(path);
            return self.keep_draft(draft);
        };
        let what = changes(before, after).join("; ");
        let touched = self.document().differences(&new);
        self.doc.saved = Some(new.clone());
        self.doc.history.push(new, "Reload".to_owned(), &touched, None);
        self.doc.history.mark_saved();
        self.doc.file = OpenFile::at(&path, stamp);
        self.renew_recovery();
        self.document_changed(&touched);
        self.talk.notices.push(Notice::info(format!("Read {} again: {what}", self.doc.file.title)));
    }

    /// Takes the open file for this window, and warns when another one has it.
    pub(super) fn claim_file(&mut self) {
        let (Some(path), Some(data)) = (self.doc.file.path.as_deref(), &self.kept.storage.data) else {
            self.kept.claim = None;
            return;
        };
        if self.kept.claim.as_ref().is_some_and(|claim| claim.is_of(path)) {
            return;
        }
        // the old one first: it may be the same file by another name
        self.kept.claim = None;
        let (claim, taken) = Claim::take(&data.join("open"), path);
        self.kept.claim = Some(claim);
        if taken {
            let text = format!(
                "{} is open in another window too. Save in one of them only; the other then offers to read it again.",
                self.doc.file.title
            );
            self.talk.notices.push(Notice::warning(text));
        }
    }
}
