//! Undo: the documents before and after each finished gesture. Documents share what they have in
//! common, so a point costs little; camera, selection and playback stay out.

use std::collections::VecDeque;

use crate::scene::{Document, Touched};

/// Most points kept. More than a person goes back through; with [`MAX_BODIES_HELD`] it bounds memory.
const MAX_POINTS: usize = 4096;

/// Most bodies over all points kept: every point has its own typed scene, about 250 bytes a body, so
/// this is about half a gigabyte for scenes that are huge to begin with. Two points are always kept.
const MAX_BODIES_HELD: usize = 2_000_000;

/// Names one drag, one stay in a text field or the like. Edits of one gesture in a row are one point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Gesture(pub u64);

/// A document, and the edit that led to it.
struct UndoPoint {
    document: Document,
    /// Such as `Move 5853`; empty for the document as opened.
    label: String,
    /// What that edit touched: going back or forth over it touches the same.
    touched: Touched,
    /// Never reused, so equal means the very same document.
    state: u64,
    bodies: usize,
}

pub(super) struct History {
    past: VecDeque<UndoPoint>,
    present: UndoPoint,
    /// The next one to redo is last.
    future: Vec<UndoPoint>,
    /// The state that the file holds; `None` when no state does.
    saved: Option<u64>,
    next_state: u64,
    /// The gesture that made the present and may still change it.
    open: Option<Gesture>,
}

impl History {
    /// `saved` says whether the document is what its file holds.
    pub fn new(document: Document, saved: bool) -> Self {
        let present = UndoPoint {
            bodies: body_count(&document),
            document,
            label: String::new(),
            touched: Touched::default(),
            state: 0,
        };
        Self {
            past: VecDeque::new(),
            present,
            future: Vec::new(),
            saved: saved.then_some(0),
            next_state: 1,
            open: None,
        }
    }

    pub fn document(&self) -> &Document {
        &self.present.document
    }

    /// Identifies the present document among all that this history ever held.
    pub fn state(&self) -> u64 {
        self.present.state
    }

    pub fn is_dirty(&self) -> bool {
        self.saved != Some(self.present.state)
    }

    pub fn mark_saved(&mut self) {
        self.saved = Some(self.present.state);
        self.open = None;
    }

    /// No state is what the file holds: the file is gone.
    pub fn mark_unsaved(&mut self) {
        self.saved = None;
    }

    /// Makes `document` the present. It replaces the present if that came from the same open gesture.
    pub fn push(&mut self, document: Document, label: String, touched: &Touched, gesture: Option<Gesture>) {
        let (bodies, touched) = (body_count(&document), touched.clone());
        let point = UndoPoint { document, label, touched, state: self.next_state, bodies };
        self.next_state += 1;
        self.future.clear();
        let before = std::mem::replace(&mut self.present, point);
        if gesture.is_none() || self.open != gesture {
            self.past.push_back(before);
        } else {
            self.present.touched.extend(&before.touched);
        }
        self.open = gesture;
        self.drop_oldest();
    }

    /// Later edits make a point of their own. What was not written while the hand moved is written now.
    pub fn end_gesture(&mut self) {
        if self.open.take().is_some() {
            self.present.document = self.present.document.written();
        }
    }

    /// Takes back what the open gesture did, leaving nothing to redo. Returns what that touched.
    pub fn abandon_gesture(&mut self) -> Option<Touched> {
        self.open.take()?;
        let before = self.past.pop_back()?;
        Some(std::mem::replace(&mut self.present, before).touched)
    }

    pub fn open_gesture(&self) -> Option<Gesture> {
        self.open
    }

    /// Goes back over the last edit. Returns what that touched.
    pub fn undo(&mut self) -> Option<Touched> {
        self.open = None;
        let before = self.past.pop_back()?;
        let touched = self.present.touched.clone();
        self.future.push(std::mem::replace(&mut self.present, before));
        Some(touched)
    }

    /// Goes forth over the edit taken back last. Returns what that touched.
    pub fn redo(&mut self) -> Option<Touched> {
        self.open = None;
        let after = self.future.pop()?;
        let touched = after.touched.clone();
        self.past.push_back(std::mem::replace(&mut self.present, after));
        Some(touched)
    }

    /// What undo would take back.
    pub fn undo_label(&self) -> Option<&str> {
        (!self.past.is_empty()).then_some(self.present.label.as_str())
    }

    /// What redo would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.future.last().map(|point| point.label.as_str())
    }

    fn drop_oldest(&mut self) {
        let mut held: usize = self.past.iter().map(|point| point.bodies).sum();
        while self.past.len() > MAX_POINTS || (self.past.len() > 2 && held > MAX_BODIES_HELD) {
            held -= self.past.pop_front().map_or(0, |point| point.bodies);
        }
    }
}

fn body_count(document: &Document) -> usize {
    document.scene().map_or(0, |scene| scene.bodies.len())
}
