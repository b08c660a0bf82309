//! One user's work. Read it through `&Session`; change it through [`Session::perform`].

use std::path::Path;
use std::sync::Arc;

use super::dialogue::{Question, Request};
use super::kept::Kept;
use super::live::differs;
use super::open_document::OpenDocument;
use super::run::{Ran, Run};
use super::talk::Talk;
use super::travel::Travel;
use super::{EditorSettings, Gesture, Notice, Playback, Selection};
use crate::record::{EventRow, Frame};
use crate::scene::{Document, NodeKey, Scene};

/// The document and everything around it, each part with one subject.
pub struct Session {
    pub(super) doc: OpenDocument,
    pub(super) run: Run,
    pub(super) travel: Travel,
    pub(super) selection: Selection,
    pub(super) talk: Talk,
    pub(super) kept: Kept,
}

impl Session {
    pub fn document(&self) -> &Document {
        self.doc.history.document()
    }

    /// The document as its file holds it; `None` for one that was never saved.
    pub fn saved_document(&self) -> Option<&Document> {
        self.doc.saved.as_ref()
    }

    /// What the document means; `None` while it has errors that leave no scene.
    pub fn scene(&self) -> Option<&Scene> {
        self.document().scene()
    }

    /// The picture of the simulation that this turn of the window shows; changes in [`Self::poll`] only.
    pub fn frame(&self) -> &Arc<Frame> {
        &self.run.frame
    }

    pub fn path(&self) -> Option<&Path> {
        self.doc.file.path.as_deref()
    }

    /// File name, or what to call a scene without a file.
    pub fn title(&self) -> &str {
        &self.doc.file.title
    }

    /// Whether the document differs from its file.
    pub fn is_dirty(&self) -> bool {
        self.doc.history.is_dirty()
    }

    /// Grows with every document that replaces another: opened, restored or new.
    pub fn opened_count(&self) -> u64 {
        self.doc.opened
    }

    /// Grows or changes with every change of the document: equal means the very same document.
    pub fn document_state(&self) -> u64 {
        self.doc.history.state()
    }

    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    pub fn playback(&self) -> &Playback {
        &self.run.playback
    }

    pub fn settings(&self) -> &EditorSettings {
        &self.kept.settings
    }

    /// The event whose place the views show.
    pub fn shown_event(&self) -> Option<&Arc<EventRow>> {
        self.run.shown_event.as_ref()
    }

    /// What must be answered before anything else.
    pub fn question(&self) -> Option<&Question> {
        self.talk.question.as_ref()
    }

    /// Things for the window to do, each once.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.talk.requests)
    }

    /// Messages to show, each once.
    pub fn take_notices(&mut self) -> Vec<Notice> {
        std::mem::take(&mut self.talk.notices)
    }

    /// What undo would take back, such as `Move 5853`.
    pub fn undo_label(&self) -> Option<&str> {
        self.doc.history.undo_label()
    }

    /// What redo would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.doc.history.redo_label()
    }

    /// The drag or typing that goes on.
    pub fn open_gesture(&self) -> Option<Gesture> {
        self.doc.history.open_gesture()
    }

    /// Whether a drag or typing changes the document just now. What may lag behind it, such as the list of problems, is
    /// made when the hand rests.
    pub fn hand_moves(&self) -> bool {
        self.open_gesture().is_some() && !self.run.pending.is_empty()
    }

    /// Whether the document has changes that the running simulation takes on only at a reset.
    pub fn needs_reset(&self) -> bool {
        self.run.running.as_ref().is_some_and(|running| running.waiting.any())
    }

    /// Whether a view should place dynamic bodies where the document says: at the start, where dragging
    /// a body must show at once. Elsewhere they are where the frame says.
    pub fn shows_start(&self) -> bool {
        self.run.playback.is_at_start()
    }

    /// The scene that ran at what is shown, where that is not the document's: before an edit, or while changes wait for a
    /// reset.
    pub fn scene_then(&self) -> Option<Ran> {
        self.run.scene_then(&self.document().scene_shared()?)
    }

    /// What to draw of a scene that ran: bodies as they were, named and coloured as the document has it.
    pub fn drawn(&self, then: &Ran) -> Option<Arc<Scene>> {
        Some(self.run.drawn(&self.document().scene_shared()?, then))
    }

    /// What a body was called that an edit has removed from the run.
    pub fn former_name(&self, key: NodeKey) -> Option<&str> {
        self.run.former_name(key)
    }

    /// Whether the newest frame does not show yet all that the simulation was told.
    pub fn awaits_simulation(&self) -> bool {
        self.run.is_behind()
    }

    /// Whether the running simulation knows a body or force; those added later wait for a reset.
    pub fn is_running(&self, key: NodeKey) -> bool {
        self.run.running.as_ref().is_some_and(|running| {
            running.scene.bodies.iter().any(|body| body.key == key)
                || running.scene.forces.iter().any(|force| force.key == key)
        })
    }

    /// Whether the running simulation has other numbers of this body or force than the document, or none.
    pub fn waits_for_reset(&self, key: NodeKey) -> bool {
        let Some(running) = &self.run.running else { return false };
        let unsent = || {
            self.run.pending.keys.contains(&key)
                && self.scene().is_some_and(|scene| differs(&running.scene, scene, key))
        };
        running.waiting.keys.contains(&key) || unsent()
    }
}
