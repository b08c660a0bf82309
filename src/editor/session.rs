//! One user's work. Read it through `&Session`; change it through [`Session::perform`].

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use super::copies::LastCopies;
use super::dialogue::{Intent, Question, Request};
use super::disk::DiskStamp;
use super::history::History;
use super::live::differs;
use super::recovery::Recovery;
use super::trouble_list::TroubleList;
use super::{EditorSettings, Gesture, Notice, Playback, Selection, Storage};
use crate::record::{EventRow, Frame, Runner};
use crate::scene::{Document, NodeKey, Scene};

/// The document and everything around it.
pub struct Session {
    pub(super) history: History,
    pub(super) file: OpenFile,
    pub(super) selection: Selection,
    pub(super) playback: Playback,
    pub(super) settings: EditorSettings,
    pub(super) storage: Storage,
    pub(super) recovery: Recovery,
    pub(super) notices: Vec<Notice>,
    pub(super) question: Option<Question>,
    pub(super) requests: Vec<Request>,
    /// What to do after the save that a file dialog is open for.
    pub(super) after_save: Option<Intent>,
    pub(super) frame: Arc<Frame>,
    pub(super) shown_event: Option<Arc<EventRow>>,
    /// Number of an event to show as soon as a frame lists it.
    pub(super) awaited_event: Option<u64>,
    pub(super) opened: u64,
    pub(super) runner: Box<dyn Runner>,
    /// The scene that the runner runs; `None` when it has none.
    pub(super) running: Option<Running>,
    /// Whether a gesture's edits have not reached the runner yet.
    pub(super) unsynced: bool,
    /// The document state that was seen last while unsynced, and since when.
    pub(super) settling: Option<(u64, Instant)>,
    pub(super) last_poll: Option<Instant>,
    /// The copies made last.
    pub(super) last_copies: Option<LastCopies>,
    /// Whether the text that the clipboard is asked for goes where it came from.
    pub(super) paste_in_place: bool,
    /// What is wrong with the scene, by the document it was found in.
    pub(super) troubles: TroubleList,
}

/// Where the document came from and goes to.
pub(super) struct OpenFile {
    pub path: Option<std::path::PathBuf>,
    pub title: String,
    /// What the file held when it was read or written.
    pub stamp: Option<DiskStamp>,
    /// Whether the user knows that another program changed it.
    pub reported_change: bool,
}

pub(super) struct Running {
    pub(super) scene: Scene,
    /// Whether it was changed since it was loaded, so that going back to its start is not enough.
    pub(super) edited: bool,
    /// The document has changes that this run cannot take.
    pub(super) needs_reset: bool,
}

impl Session {
    pub fn document(&self) -> &Document {
        self.history.document()
    }

    /// What the document means; `None` while it has errors that leave no scene.
    pub fn scene(&self) -> Option<&Scene> {
        self.document().scene()
    }

    /// The picture of the simulation that this turn of the window shows; changes in [`Self::poll`] only.
    pub fn frame(&self) -> &Arc<Frame> {
        &self.frame
    }

    pub fn path(&self) -> Option<&Path> {
        self.file.path.as_deref()
    }

    /// File name, or what to call a scene without a file.
    pub fn title(&self) -> &str {
        &self.file.title
    }

    /// Whether the document differs from its file.
    pub fn is_dirty(&self) -> bool {
        self.history.is_dirty()
    }

    /// Grows with every document that replaces another: opened, restored or new.
    pub fn opened_count(&self) -> u64 {
        self.opened
    }

    /// Grows or changes with every change of the document: equal means the very same document.
    pub fn document_state(&self) -> u64 {
        self.history.state()
    }

    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    pub fn playback(&self) -> &Playback {
        &self.playback
    }

    pub fn settings(&self) -> &EditorSettings {
        &self.settings
    }

    /// The event whose place the views show.
    pub fn shown_event(&self) -> Option<&Arc<EventRow>> {
        self.shown_event.as_ref()
    }

    /// What must be answered before anything else.
    pub fn question(&self) -> Option<&Question> {
        self.question.as_ref()
    }

    /// Things for the window to do, each once.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }

    /// Messages to show, each once.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.notices)
    }

    /// What undo would take back, such as `Move 5853`.
    pub fn undo_label(&self) -> Option<&str> {
        self.history.undo_label()
    }

    /// What redo would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.history.redo_label()
    }

    /// The drag or typing that goes on.
    pub fn open_gesture(&self) -> Option<Gesture> {
        self.history.open_gesture()
    }

    /// Whether the document has changes that the running simulation takes on only at a reset.
    pub fn needs_reset(&self) -> bool {
        self.running.as_ref().is_some_and(|running| running.needs_reset)
    }

    /// Whether a view should place dynamic bodies where the document says: at the start, where dragging
    /// a body must show at once. Elsewhere they are where the frame says.
    pub fn shows_start(&self) -> bool {
        self.playback.is_at_start()
    }

    /// Whether the running simulation knows a body or force; those added later wait for a reset.
    pub fn is_running(&self, key: NodeKey) -> bool {
        self.running.as_ref().is_some_and(|running| {
            running.scene.bodies.iter().any(|body| body.key == key)
                || running.scene.forces.iter().any(|force| force.key == key)
        })
    }

    /// Whether the running simulation has other numbers of this body or force than the document, or none.
    pub fn waits_for_reset(&self, key: NodeKey) -> bool {
        match (&self.running, self.scene()) {
            (Some(running), Some(scene)) => differs(&running.scene, scene, key),
            _ => false,
        }
    }
}
