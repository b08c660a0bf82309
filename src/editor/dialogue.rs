//! What the session asks: questions to the user before something could be lost, and requests to the
//! window. Plain data, so that the guard of unsaved changes is tested without widgets.

use std::path::PathBuf;
use std::sync::Arc;

use super::Recovered;
use crate::import::ImportReport;
use crate::scene::{NumberStyle, shown_path};

/// What replaces or closes the document once nothing can be lost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Intent {
    New(NumberStyle),
    OpenPath(PathBuf),
    OpenSample(usize),
    Reload,
    /// A file of another program, without what cannot be here.
    ImportWithout(PathBuf),
    Restore(Recovered),
    Quit,
}

/// A question that blocks until it is answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// Text was typed and not applied, and `then` would lose it. `problem` says why it is no scene.
    UnappliedText { title: String, problem: Option<String>, then: Intent },
    /// The document has unsaved changes and `then` would lose them.
    UnsavedChanges { title: String, then: Intent },
    /// The file changed since it was read or written, and saving would lose that.
    ChangedOnDisk { path: PathBuf, then: Option<Intent> },
    /// Another program changed the file.
    Reload { title: String, changes: Vec<String>, unsaved: bool },
    /// A file of another program has what cannot be here.
    CannotImport { path: PathBuf, problem: String, more: usize },
    /// An earlier run ended with unsaved work.
    Recover(Recovered),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    Apply,
    Save,
    SaveAs,
    Overwrite,
    Discard,
    Restore,
    Later,
    LeaveOut,
    Reload,
    NotNow,
    Cancel,
}

/// What only the window can do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// Answered by [`super::Action::OpenPath`] or [`super::Action::DialogCancelled`].
    ChooseOpenPath,
    /// Answered by [`super::Action::SaveTo`] or [`super::Action::DialogCancelled`].
    ChooseSavePath {
        directory: Option<PathBuf>,
        file_name: String,
    },
    /// Answered by [`super::Action::SaveRecording`] or [`super::Action::DialogCancelled`].
    ChooseRecordingPath {
        file_name: String,
    },
    /// What became of a file of another program.
    ShowImport {
        title: String,
        report: Arc<ImportReport>,
    },
    /// Brings the text of the file to the front: there is something typed in it.
    ShowText,
    SetClipboard(String),
    /// Answered by [`super::Action::Paste`].
    ReadClipboard,
    Quit,
}

impl Question {
    pub fn title(&self) -> &'static str {
        match self {
            Self::UnappliedText { .. } => "Text not applied",
            Self::UnsavedChanges { .. } => "Unsaved changes",
            Self::ChangedOnDisk { .. } => "File changed on disk",
            Self::Reload { .. } => "Read the file again?",
            Self::CannotImport { .. } => "Not all can be imported",
            Self::Recover(_) => "Recover unsaved work",
        }
    }

    pub fn text(&self) -> String {
        match self {
            Self::UnappliedText { title, problem: None, .. } => {
                format!("What you typed in the text of “{title}” is not applied to the scene.")
            }
            Self::UnappliedText { title, problem: Some(problem), .. } => format!(
                "What you typed in the text of “{title}” cannot be applied yet, for it has errors:\n{problem}"
            ),
            Self::UnsavedChanges { title, .. } => format!("“{title}” has changes that are not saved."),
            Self::ChangedOnDisk { path, .. } => format!(
                "Another program changed or removed {} after it was opened here. Saving would replace what \
                 is there now.",
                shown_path(path)
            ),
            Self::Reload { title, changes, unsaved } => {
                let what = changes.iter().map(|change| format!("\n• {change}")).collect::<String>();
                let unsaved = if *unsaved {
                    "\nYour changes that are not saved go; Undo brings them back."
                } else {
                    ""
                };
                format!("Another program changed {title} on the disk:{what}{unsaved}")
            }
            Self::CannotImport { path, problem, more } => {
                let others = match more {
                    0 => String::new(),
                    1 => " and one thing more".to_owned(),
                    more => format!(" and {more} things more"),
                };
                format!("{}:{problem}{others}.", shown_path(path))
            }
            Self::Recover(found) => format!(
                "The last session ended without saving “{}” ({}). Restoring opens that work{}; the file itself \
                 is not touched until you save.",
                found.title(),
                found.age_text(),
                if found.has_draft() { ", with the text that was not applied" } else { "" }
            ),
        }
    }

    /// The safe answer comes first.
    pub fn answers(&self) -> &'static [Answer] {
        match self {
            Self::UnappliedText { problem: None, .. } => &[Answer::Apply, Answer::Discard, Answer::Cancel],
            Self::UnappliedText { problem: Some(_), .. } => &[Answer::Cancel, Answer::Discard],
            Self::UnsavedChanges { .. } => &[Answer::Save, Answer::Discard, Answer::Cancel],
            Self::ChangedOnDisk { .. } => &[Answer::SaveAs, Answer::Overwrite, Answer::Cancel],
            Self::Reload { unsaved: false, .. } => &[Answer::Reload, Answer::NotNow],
            Self::Reload { unsaved: true, .. } => &[Answer::NotNow, Answer::Reload],
            Self::CannotImport { .. } => &[Answer::Cancel, Answer::LeaveOut],
            Self::Recover(_) => &[Answer::Restore, Answer::Later, Answer::Discard],
        }
    }

    /// What Escape and closing the dialog mean.
    pub fn dismissal(&self) -> Answer {
        match self {
            Self::UnappliedText { .. }
            | Self::UnsavedChanges { .. }
            | Self::ChangedOnDisk { .. }
            | Self::CannotImport { .. } => Answer::Cancel,
            Self::Recover(_) => Answer::Later,
            Self::Reload { .. } => Answer::NotNow,
        }
    }
}

impl Answer {
    pub fn label(self) -> &'static str {
        match self {
            Self::Apply => "Apply",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::Overwrite => "Overwrite",
            Self::Discard => "Discard",
            Self::Restore => "Restore",
            Self::Later => "Ask later",
            Self::LeaveOut => "Open without it",
            Self::Reload => "Read it again",
            Self::NotNow => "Not now",
            Self::Cancel => "Cancel",
        }
    }
}
