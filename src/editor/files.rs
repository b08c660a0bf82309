//! Files: new, open, save, reload, and the guard that lets nothing be lost unasked.

use std::path::{Path, PathBuf};

use super::dialogue::{Answer, Intent, Question, Request};
use super::disk::{DiskStamp, has_changed};
use super::open_document::OpenFile;
use super::travel::Travel;
use super::{Notice, Outcome, Recovered, SAMPLES, Session};
use crate::import;
use crate::record::RecordingFile;
use crate::scene::{Document, shown_path};

impl Session {
    /// Does `intent`, after asking when it would lose text that is not applied or changes that are not saved.
    pub(super) fn ask_then(&mut self, intent: Intent) {
        self.settle();
        match self.question_of_draft(&intent) {
            Some(question) => self.talk.question = Some(question),
            None => self.ask_to_save_then(intent),
        }
    }

    /// A draft goes only once `intent` is done: until then all can be cancelled.
    fn ask_to_save_then(&mut self, intent: Intent) {
        if self.is_dirty() {
            self.talk.question =
                Some(Question::UnsavedChanges { title: self.doc.file.title.clone(), then: intent });
        } else {
            self.carry_on(intent);
        }
    }

    /// Takes the answer to the open question. One that the question does not offer changes nothing.
    pub(super) fn answer(&mut self, answer: Answer) -> Outcome {
        let offered =
            self.talk.question.as_ref().is_some_and(|question| question.answers().contains(&answer));
        if !offered {
            return Outcome::Done;
        }
        match (self.talk.question.take(), answer) {
            (Some(Question::UnappliedText { then, .. }), Answer::Apply) => {
                return self.apply_draft_then(then);
            }
            (Some(Question::UnappliedText { then, .. }), Answer::Discard) => self.ask_to_save_then(then),
            (Some(Question::UnsavedChanges { then, .. }), Answer::Save) => self.save(Some(then)),
            (Some(Question::UnsavedChanges { then, .. }), Answer::Discard) => self.carry_on(then),
            (Some(Question::ChangedOnDisk { path, then }), Answer::Overwrite) => self.write(&path, then),
            (Some(Question::ChangedOnDisk { then, .. }), Answer::SaveAs) => self.save_as(then),
            (Some(Question::Reload { .. }), Answer::Reload) => self.reload(),
            (Some(Question::CannotImport { path, .. }), Answer::LeaveOut) => {
                self.carry_on(Intent::ImportWithout(path));
            }
            (Some(Question::Recover(found)), Answer::Restore) => self.ask_then(Intent::Restore(found)),
            (Some(Question::Recover(found)), Answer::Discard) => {
                found.forget();
                self.offer_recovery();
            }
            // Cancel and Later: everything stays as it is
            _ => {}
        }
        Outcome::Done
    }

    pub(super) fn carry_on(&mut self, intent: Intent) {
        match intent {
            Intent::New(style) => self.replace(Document::new(style), OpenFile::untitled("Untitled"), true),
            Intent::OpenPath(path) => self.open(path),
            Intent::OpenSample(index) => match SAMPLES.get(index) {
                Some(sample) => {
                    self.replace(Document::from_bytes(sample.bytes), OpenFile::untitled(sample.id), true);
                }
                None => self.talk.notices.push(Notice::error("There is no such sample")),
            },
            Intent::Reload => self.reload(),
            Intent::ImportWithout(path) => self.open_foreign(&path, &Document::open(&path), true),
            Intent::Restore(found) => self.restore(&found),
            Intent::Quit => {
                self.talk.ends = true;
                self.forget_recovery();
                self.talk.requests.push(Request::Quit);
            }
        }
    }

    /// Opens a file. One that cannot be read leaves everything as it was; one with errors is shown with
    /// them.
    pub(super) fn open(&mut self, path: PathBuf) {
        let path = std::path::absolute(&path).unwrap_or(path);
        if path.extension().is_some_and(|extension| extension == "psrec") {
            return self.open_recording(&path);
        }
        let stamp = match readable(&path) {
            Ok(stamp) => stamp,
            Err(reason) => {
                let text = format!("{} cannot be opened: {reason}", shown_path(&path));
                return self.talk.notices.push(Notice::error(text));
            }
        };
        let document = Document::open(&path);
        // By another name than recordings have.
        if document.has_errors() && RecordingFile::is_meant(&document.to_bytes()) {
            return self.open_recording(&path);
        }
        if import::source_of(&document).is_some() {
            return self.open_foreign(&path, &document, false);
        }
        let unread =
            document.diagnostics().iter().find(|problem| problem.is_error() && problem.position.is_none());
        if let (None, Some(problem)) = (document.scene(), unread) {
            let text = format!("{} cannot be opened: {}", shown_path(&path), problem.message);
            return self.talk.notices.push(Notice::error(text));
        }
        let errors = document.diagnostics().iter().filter(|problem| problem.is_error()).count();
        self.replace(document, OpenFile::at(&path, Some(stamp)), true);
        self.remember(&path);
        if errors > 0 {
            let noun = if errors == 1 { "error" } else { "errors" };
            let text = format!("{} has {errors} {noun}, see Problems", self.doc.file.title);
            self.talk.notices.push(Notice::warning(text));
        }
    }

    pub(super) fn open_recent(&mut self, index: usize) -> Outcome {
        let Some(path) = self.kept.settings.recent.get(index).cloned() else {
            return Outcome::Refused("There is no such recent file".to_owned());
        };
        self.ask_then(Intent::OpenPath(path));
        Outcome::Done
    }

    fn restore(&mut self, found: &Recovered) {
        let bytes = match found.bytes() {
            Ok(bytes) => bytes,
            Err(err) => {
                return self.talk.notices.push(Notice::error(format!("The work cannot be restored: {err}")));
            }
        };
        let file = match &found.path {
            Some(path) => OpenFile::at(path, found.stamp),
            None => OpenFile::untitled(found.title()),
        };
        let in_file = found.path.as_deref().map(Document::open);
        let is_saved = in_file.as_ref().is_some_and(|saved| saved.to_bytes() == bytes);
        self.replace(Document::from_bytes(&bytes), file, is_saved);
        self.doc.saved = in_file;
        if let Some(draft) = found.draft() {
            self.keep_draft(Some(draft.into()));
            self.talk.requests.push(Request::ShowText);
        }
        // the old copy goes only when this run has its own
        match self.write_recovery() {
            Ok(()) => found.forget(),
            Err(err) => {
                self.talk.notices.push(Notice::warning(format!("Unsaved work cannot be kept safe: {err}")));
            }
        }
        self.talk.notices.push(Notice::info("Restored. Save to keep it."));
    }

    pub(super) fn replace(&mut self, document: Document, file: OpenFile, saved: bool) {
        self.forget_recovery();
        self.run.forget();
        if file.path.is_none() || file.path != self.doc.file.path {
            self.forget_method();
        }
        self.doc.replace(document, file, saved);
        self.selection.clear();
        self.travel = Travel::default();
        self.run.shown_event = None;
        self.talk.after_save = None;
        self.claim_file();
        self.sync();
    }

    /// Saves to the document's file, or asks where to; then does `then`.
    pub(super) fn save(&mut self, then: Option<Intent>) {
        self.settle();
        // A file that was gone for a while, or is known from a recovery alone, may be somebody else's now.
        let is_foreign =
            |path: &Path| self.doc.file.stamp.map_or_else(|| path.exists(), |stamp| has_changed(path, stamp));
        match self.doc.file.path.clone() {
            Some(path) if is_foreign(&path) => {
                self.talk.question = Some(Question::ChangedOnDisk { path, then });
            }
            Some(path) => self.write(&path, then),
            None => self.save_as(then),
        }
    }

    pub(super) fn save_as(&mut self, then: Option<Intent>) {
        self.talk.after_save = then;
        let directory = self.doc.file.path.as_deref().and_then(Path::parent).map(Path::to_owned);
        let name = self.doc.file.path.as_deref().and_then(Path::file_name);
        let title = name.map_or(self.doc.file.title.clone(), |name| name.to_string_lossy().into_owned());
        let file_name = if title.contains('.') { title } else { format!("{title}.xml") };
        self.talk.requests.push(Request::ChooseSavePath { directory, file_name });
    }

    /// Saves to the file that the user chose.
    pub(super) fn save_to(&mut self, path: PathBuf) {
        self.settle();
        let then = self.talk.after_save.take();
        let with_extension = path.with_extension("xml");
        // no dialog has asked about the longer name, so it must not replace anything
        let path = if path.extension().is_none() && !with_extension.exists() { with_extension } else { path };
        self.write(&path, then);
    }

    fn write(&mut self, path: &Path, then: Option<Intent>) {
        if let Err(err) = self.document().save(path) {
            let text = format!("{} cannot be saved: {err}", shown_path(path));
            return self.talk.notices.push(Notice::error(text));
        }
        self.doc.history.mark_saved();
        self.doc.saved = Some(self.document().clone());
        self.doc.file = OpenFile::at(path, DiskStamp::of(path).ok());
        self.renew_recovery();
        self.remember(path);
        self.claim_file();
        self.talk.notices.push(Notice::info(format!("Saved {}", self.doc.file.title)));
        if let Some(intent) = then {
            self.carry_on(intent);
        }
    }

    pub(super) fn remember(&mut self, path: &Path) {
        self.kept.settings.add_recent(path);
        self.store_settings();
    }

    /// Settings are a convenience: that they cannot be kept is reported, and stops nothing.
    pub(super) fn store_settings(&mut self) {
        if let Err(err) = self.kept.settings.store(&self.kept.storage) {
            self.talk.notices.push(Notice::warning(format!("Settings cannot be kept: {err}")));
        }
    }

    pub(super) fn can_save(&self) -> Result<(), &'static str> {
        if self.is_dirty() || self.doc.file.path.is_none() { Ok(()) } else { Err("everything is saved") }
    }

    pub(super) fn can_reload(&self) -> Result<(), &'static str> {
        if self.doc.file.path.is_some() { Ok(()) } else { Err("the scene has no file yet") }
    }
}

/// What a file holds, or why it is none that could be opened.
fn readable(path: &Path) -> Result<DiskStamp, String> {
    let about = std::fs::metadata(path).map_err(|err| err.to_string())?;
    if !about.is_file() {
        return Err("it is not a file".to_owned());
    }
    DiskStamp::of(path).map_err(|err| err.to_string())
}
