//! What panels send up: commands, and actions that carry data. [`super::Session::perform`] carries them out.

use std::path::PathBuf;
use std::sync::Arc;

use super::{Answer, ExportedFile, Gesture, Place, SessionCommand};
use crate::design::{Plan, Repair};
use crate::record::{EventRow, Goal};
use crate::scene::{Edit, NodeKey};
use crate::sim::Method;

#[derive(Clone, Debug)]
pub enum Action {
    Command(SessionCommand),
    /// Edits of the same gesture in a row are one undo point and reach the simulation when it ends.
    Edit {
        edit: Edit,
        gesture: Option<Gesture>,
    },
    /// The text of the whole file, edited by hand.
    ReplaceText(String),
    /// That text while it is typed; `None` once it is the document's again.
    KeepDraft(Option<Arc<str>>),
    /// The drag was dropped, the text field left.
    EndGesture,
    /// Escape during a drag: the document is again as it was before.
    AbandonGesture,

    Select(Vec<NodeKey>),
    AddToSelection(Vec<NodeKey>),
    ToggleSelected(NodeKey),
    SelectPlace(Place),
    /// Shows the place of an event in the views.
    ShowEvent(Option<Arc<EventRow>>),
    /// Goes to the event of this number, shows it and selects its bodies.
    GoToEvent(u64),

    /// To a time of the run, s: into what is recorded, or on to it.
    Seek(f64),
    RunUntil(Goal),
    /// What playing goes over again and again, s.
    SetRange(Option<(f64, f64)>),
    /// Bookmarks in the order of their times.
    GoToBookmark(usize),
    RenameBookmark(usize, String),
    RemoveBookmark(usize),
    /// Whether frames have the motion that is recorded now.
    ShareMotion(bool),
    /// MiB that the recording may take; `None` for the default.
    SetMemory(Option<f64>),

    /// Δt as typed.
    SetDt(String),
    /// Multiple of the scene's time speed.
    SetSpeed(f64),
    /// Another method than before goes back to the start.
    SetMethod(Method),

    /// Gives up comparing the run with the recording that was opened.
    StopVerification,

    /// A file was chosen, dropped on the window or named on the command line.
    OpenPath(PathBuf),
    /// The answer to [`super::Request::ChooseSavePath`].
    SaveTo(PathBuf),
    /// The answer to [`super::Request::ChooseRecordingPath`].
    SaveRecording(PathBuf),
    /// Where a scene for another program goes.
    WriteExport(PathBuf, ExportedFile),
    /// A file dialog was closed without an answer.
    DialogCancelled,
    Answer(Answer),
    /// Text from the clipboard.
    Paste(String),
    /// The same, where it came from.
    PasteInPlace(String),
    /// The n-th of [`crate::design::TOOLS`], which asks for nothing.
    UseTool(usize),
    /// What a tool made of the values that the window asked for.
    Apply(Plan),
    Repair(Repair),
    /// All that can be put right.
    RepairAll,
    /// The window got the keyboard back: other programs may have changed the file.
    LookAtDisk,
}
