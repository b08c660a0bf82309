//! Document and simulation side by side, once per turn of the window and after every edit.

use std::time::Instant;

use super::{Notice, Session};
use crate::record::RunCommand;
use crate::scene::Touched;
use crate::sim::Method;

impl Session {
    /// Once per turn of the window: takes the newest frame, passes on edits that have settled, keeps the
    /// recovery file up to date.
    pub fn poll(&mut self, now: Instant) {
        self.run.look(now, &mut self.talk);
        self.follow_disk();
        self.follow_verification();
        if self.run.has_settled(self.doc.history.state(), now) {
            self.sync();
        }
        if self.open_gesture().is_none() {
            self.keep_recovery(now);
        }
    }

    /// Brings an edit to the runner, at once or, inside a gesture, when it has settled.
    pub(super) fn document_changed(&mut self, touched: &Touched) {
        self.selection.purge(self.doc.history.document().scene(), touched);
        self.run.pending.extend(touched);
        if self.open_gesture().is_none() {
            self.sync();
        }
    }

    pub(super) fn sync(&mut self) {
        let way = self.way();
        self.run.sync(self.doc.history.document(), way, &mut self.talk);
    }

    /// Ends an open gesture and lets the runner know what it did.
    pub(super) fn settle(&mut self) {
        self.doc.history.end_gesture();
        if !self.run.pending.is_empty() {
            self.sync();
        }
    }

    /// Goes to the start of the scene as it is edited now.
    pub(super) fn reset(&mut self) {
        self.settle();
        self.run.reset(self.doc.history.document());
    }

    /// Steps by another method from now on, from the start of the scene as it is edited now.
    pub(super) fn set_method(&mut self, method: Method) {
        if method == self.run.playback.method() {
            return;
        }
        let moved = !self.run.playback.is_at_start();
        self.run.set_method(method);
        self.reset();
        if moved {
            let text = format!("Back to the start: the method is now {}", method.name());
            self.talk.notices.push(Notice::info(text));
        }
    }

    /// A method belongs to the scene it was chosen for: the next one starts with the exact one.
    pub(super) fn forget_method(&mut self) {
        let method = Method::Exact;
        if method != self.run.playback.method() {
            self.run.set_method(method);
        }
    }

    /// Sends a command that moves the time forwards, after all edits made so far.
    pub(super) fn go_on(&mut self, command: RunCommand) {
        self.settle();
        self.run.go_on(command);
    }

    pub(super) fn go_back(&mut self, command: RunCommand) {
        self.settle();
        self.run.go_back(command);
    }
}
