//! Recordings as files: saving the run that is shown, and opening one to run it again.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::open_document::OpenFile;
use super::travel::Bookmark;
use super::verification::{Verification, Verified};
use super::{Notice, Request, Session};
use crate::record::{MOST_BYTES, NamedMoment, RecordingError, RecordingFile, RunCommand, WriteRequest};
use crate::scene::{Document, shown_path};

/// Ending of recordings.
const EXTENSION: &str = "psrec";

impl Session {
    pub(super) fn ask_for_recording_path(&mut self) {
        let stem =
            Path::new(&self.doc.file.title).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        self.talk.requests.push(Request::ChooseRecordingPath { file_name: format!("{stem}.{EXTENSION}") });
    }

    /// Writes the recording to the file that the user chose; the runner tells when it is done.
    pub(super) fn save_recording(&mut self, path: PathBuf) {
        self.settle();
        let with_extension = path.with_extension(EXTENSION);
        // no dialog has asked about the longer name, so it must not replace anything
        let path = if path.extension().is_none() && !with_extension.exists() { with_extension } else { path };
        if let Err(reason) = self.spare_own_file(&path) {
            return self.talk.notices.push(Notice::error(reason));
        }
        let Some(running) = &self.run.running else { return };
        let bookmark =
            |mark: &Bookmark| NamedMoment { name: mark.name.clone(), time: mark.time, event: mark.event };
        let request = WriteRequest {
            path,
            scene_name: self.doc.file.title.clone(),
            scene: running.document.to_bytes(),
            bookmarks: self.travel.bookmarks().iter().map(bookmark).collect(),
        };
        self.run.send(RunCommand::Write(Box::new(request)));
    }

    /// Opens the scene of a recording and makes its run again.
    pub(super) fn open_recording(&mut self, path: &Path) {
        let (file, document, commands) = match read(path) {
            Ok(parts) => parts,
            Err(problem) => {
                let text = format!("{} cannot be opened: {problem}", shown_path(path));
                return self.talk.notices.push(Notice::error(text));
            }
        };
        self.replace(document, OpenFile::untitled(&file.scene_name), true);
        if let Ok(method) = file.method() {
            self.run.set_method(method);
        }
        self.run.go_on(RunCommand::Script(commands.into()));
        let mark = |mark: NamedMoment| Bookmark { name: mark.name, time: mark.time, event: mark.event };
        self.travel.set_bookmarks(file.bookmarks.iter().cloned().map(mark).collect());
        let text = format!("Runs again what was recorded up to {:.6} s, and compares it", file.end.time);
        self.talk.notices.push(Notice::info(text));
        self.doc.verification = Some(Verification::start(file));
    }

    /// How the run of a recording that was opened compares with it; `None` for a scene.
    pub fn verified(&self) -> Option<Verified> {
        self.doc.verification.as_ref().map(Verification::state)
    }

    /// Once per turn of the window.
    pub(super) fn follow_verification(&mut self) {
        let notice = self.doc.verification.as_mut().and_then(Verification::take);
        self.talk.notices.extend(notice);
    }

    /// Gives a comparison up.
    pub(super) fn stop_verification(&mut self) {
        if let Some(verification) = &self.doc.verification {
            verification.stop();
        }
    }
}

fn read(path: &Path) -> Result<(RecordingFile, Document, Vec<RunCommand>), String> {
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    file.take(MOST_BYTES).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    let text = |error: RecordingError| error.to_string();
    let file = RecordingFile::read(&bytes).map_err(text)?;
    let document = file.document().map_err(text)?;
    let scene = RecordingFile::scene(&document).map_err(text)?;
    let commands = file.commands(&scene).map_err(text)?;
    Ok((file, document, commands))
}
