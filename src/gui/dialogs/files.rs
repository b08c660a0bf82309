//! The system's file dialogs, behind a trait so that tests never open one.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use crate::editor::{Action, ExportedFile};
use crate::gui::accuracy::Export;
use crate::gui::context::Message;

/// What a file dialog is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileRequest {
    Open,
    Save {
        directory: Option<PathBuf>,
        file_name: String,
    },
    /// What was made: a scene for another program, rows of the ledger.
    Made {
        /// Heading of the dialog.
        title: &'static str,
        file: ExportedFile,
        directory: Option<PathBuf>,
        file_name: String,
    },
    /// The run, for others to run it again.
    Recording {
        file_name: String,
    },
    /// Figures or diagrams of a study.
    Export {
        export: Export,
        file_name: String,
    },
}

impl FileRequest {
    /// What to do with the file chosen.
    pub fn message(&self, path: PathBuf) -> Message {
        match self {
            Self::Open => Message::Do(Action::OpenPath(path)),
            Self::Save { .. } => Message::Do(Action::SaveTo(path)),
            Self::Recording { .. } => Message::Do(Action::SaveRecording(path)),
            Self::Made { file, .. } => Message::Do(Action::WriteExport(path, file.clone())),
            Self::Export { export, .. } => Message::Export(*export, path),
        }
    }

    /// Endings of the files that may be chosen.
    pub fn extensions(&self) -> Vec<&'static str> {
        match self {
            Self::Open => vec!["xml", "psrec", "mjcf", "sdf", "world"],
            Self::Save { .. } => vec!["xml"],
            Self::Recording { .. } => vec!["psrec"],
            Self::Made { file, .. } => vec![file.extension],
            Self::Export { export, .. } => vec![export.extension()],
        }
    }

    /// Heading of the dialog.
    pub fn title(&self) -> &'static str {
        match self {
            Self::Open => "Open a scene",
            Self::Save { .. } => "Save the scene as",
            Self::Recording { .. } => "Save the recording as",
            Self::Made { title, .. } => title,
            Self::Export { .. } => "Export the study as",
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileAnswer {
    Chosen(PathBuf),
    Cancelled,
    /// There is no system dialog: the window shows its own.
    Unavailable,
}

/// Asks the user for a file, without blocking.
pub trait FileDialogs {
    fn ask(&mut self, ctx: &egui::Context, request: &FileRequest);

    /// The answer, once it is there.
    fn answer(&mut self) -> Option<FileAnswer>;
}

/// No system dialogs: the window's own is shown.
#[derive(Default)]
pub struct NoFileDialogs;

impl FileDialogs for NoFileDialogs {
    fn ask(&mut self, _ctx: &egui::Context, _request: &FileRequest) {}

    fn answer(&mut self) -> Option<FileAnswer> {
        Some(FileAnswer::Unavailable)
    }
}

/// An answer of nothing this soon means that there is no dialog, not that it was cancelled.
const TOO_SOON: Duration = Duration::from_millis(500);

/// The desktop's own dialogs, each on a thread of its own.
#[derive(Default)]
pub struct NativeFileDialogs {
    waiting: Option<(Instant, Receiver<Option<PathBuf>>)>,
}

impl FileDialogs for NativeFileDialogs {
    fn ask(&mut self, ctx: &egui::Context, request: &FileRequest) {
        let (sender, receiver) = channel();
        let (ctx, request) = (ctx.clone(), request.clone());
        std::thread::spawn(move || {
            let extensions = request.extensions();
            let dialog = rfd::FileDialog::new()
                .set_title(request.title())
                .add_filter(format!("*.{}", extensions.join(", *.")), &extensions);
            let chosen = match request {
                FileRequest::Open => dialog.pick_file(),
                FileRequest::Export { file_name, .. } | FileRequest::Recording { file_name } => {
                    dialog.set_file_name(file_name).save_file()
                }
                FileRequest::Save { directory, file_name }
                | FileRequest::Made { directory, file_name, .. } => {
                    let dialog = dialog.set_file_name(file_name);
                    match directory {
                        Some(directory) => dialog.set_directory(directory).save_file(),
                        None => dialog.save_file(),
                    }
                }
            };
            // the window may be gone by now
            let _ = sender.send(chosen);
            ctx.request_repaint();
        });
        self.waiting = Some((Instant::now(), receiver));
    }

    fn answer(&mut self) -> Option<FileAnswer> {
        let (since, receiver) = self.waiting.as_ref()?;
        let answer = match receiver.try_recv() {
            Ok(Some(path)) => FileAnswer::Chosen(path),
            Ok(None) if since.elapsed() < TOO_SOON => FileAnswer::Unavailable,
            Ok(None) => FileAnswer::Cancelled,
            Err(TryRecvError::Disconnected) => FileAnswer::Unavailable,
            Err(TryRecvError::Empty) => return None,
        };
        self.waiting = None;
        Some(answer)
    }
}
