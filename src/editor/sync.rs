//! Document and simulation side by side: edits reach the runner, its frames are taken.

use std::time::{Duration, Instant};

use super::live::{live_change, needs_reset};
use super::session::Running;
use super::{Notice, Session};
use crate::record::{Frame, RunCommand, RunState};
use crate::scene::{Diagnostic, Scene};
use crate::sim::{Method, SimEdit};

/// How long a drag must stand still until the simulation hears of it. Shorter would compile a scene for
/// every mouse move.
const SETTLE_TIME: Duration = Duration::from_millis(150);

impl Session {
    /// Once per turn of the window: takes the newest frame, passes on edits that have settled, keeps the
    /// recovery file up to date.
    pub fn poll(&mut self, now: Instant) {
        if let Some(before) = self.last_poll.replace(now) {
            self.runner.tick(now.saturating_duration_since(before).as_secs_f64());
        }
        let frame = self.runner.frame();
        self.playback.look_at(&frame);
        if frame.fault != self.frame.fault {
            self.report_fault(&frame);
        }
        self.frame = frame;
        if self.shown_event.as_ref().is_some_and(|row| self.frame.event(row.event.seq).is_none()) {
            self.shown_event = None;
        }
        self.show_awaited_event();
        self.sync_when_settled(now);
        if self.open_gesture().is_none() {
            self.keep_recovery(now);
        }
    }

    /// Whether the scene cannot be simulated. Says so only when the runner has tried.
    pub(super) fn has_no_simulation(&self) -> bool {
        let failed =
            self.frame.state == RunState::Empty && self.frame.problems.iter().any(Diagnostic::is_error);
        self.running.is_none() || failed
    }

    fn report_fault(&mut self, frame: &Frame) {
        let Some(fault) = &frame.fault else { return };
        if frame.state == RunState::Faulted {
            self.notices.push(Notice::error(format!("The simulation stopped: {fault}")));
            return;
        }
        // an edit that the simulation refused is in the document and waits for the start
        self.notices.push(Notice::warning(format!("Not applied to the running simulation: {fault}")));
        if let Some(running) = &mut self.running {
            running.needs_reset = true;
        }
    }

    fn sync_when_settled(&mut self, now: Instant) {
        if !self.unsynced {
            return;
        }
        let state = self.history.state();
        match self.settling {
            Some((seen, since)) if seen == state => {
                if now.saturating_duration_since(since) >= SETTLE_TIME {
                    self.sync();
                }
            }
            _ => self.settling = Some((state, now)),
        }
    }

    /// Brings the document to the runner, at once or, inside a gesture, when it has settled.
    pub(super) fn document_changed(&mut self) {
        self.selection.purge(self.history.document().scene());
        match self.history.open_gesture() {
            Some(_) => self.unsynced = true,
            None => self.sync(),
        }
    }

    /// Brings the runner in line with the document, as far as a running simulation can be changed.
    pub(super) fn sync(&mut self) {
        self.unsynced = false;
        self.settling = None;
        let document = self.history.document();
        let wanted = if document.has_errors() { None } else { document.scene().cloned() };
        match (&mut self.running, wanted) {
            (None, None) => {}
            (None, Some(scene)) => self.load(scene),
            (Some(_), None) => {
                if !self.playback.is_at_start() {
                    self.notices.push(Notice::warning("The simulation was dropped: the scene has errors"));
                }
                self.unload();
            }
            (Some(running), Some(scene)) if self.playback.is_at_start() => {
                if running.edited || needs_reset(&running.scene, &scene) {
                    self.load(scene);
                } else {
                    running.scene = scene;
                }
            }
            (Some(running), Some(scene)) => {
                let change = live_change(&running.scene, &scene);
                running.edited |= !change.edits.is_empty();
                running.needs_reset = needs_reset(&change.scene, &scene);
                let speed_changed = running.scene.time_speed != scene.time_speed;
                running.scene = change.scene;
                self.send_edits(change.edits);
                if speed_changed {
                    self.play_on();
                }
            }
        }
    }

    fn send_edits(&mut self, edits: Vec<SimEdit>) {
        for edit in edits {
            self.runner.send(RunCommand::Edit(Box::new(edit)));
        }
    }

    fn load(&mut self, scene: Scene) {
        self.runner.send(RunCommand::Load(Box::new(scene.clone())));
        self.running = Some(Running { scene, edited: false, needs_reset: false });
        self.playback.went_to_start();
        self.shown_event = None;
    }

    fn unload(&mut self) {
        self.runner.send(RunCommand::Unload);
        self.running = None;
        self.playback.went_to_start();
        self.shown_event = None;
    }

    /// Forgets the run, so that the next sync loads whatever the document is.
    pub(super) fn drop_run(&mut self) {
        self.playback.went_to_start();
        if self.running.is_some() {
            self.unload();
        }
    }

    /// Goes to the start of the scene as it is edited now.
    pub(super) fn reset(&mut self) {
        self.settle();
        self.stop_playing();
        self.shown_event = None;
        let Some(running) = &self.running else { return };
        if running.edited || running.needs_reset {
            if let Some(scene) = self.scene().cloned() {
                self.load(scene);
            }
        } else {
            self.runner.send(RunCommand::Reset);
            self.playback.went_to_start();
        }
    }

    /// Steps by another method from now on, from the start of the scene as it is edited now.
    pub(super) fn set_method(&mut self, method: Method) {
        if method == self.playback.method() {
            return;
        }
        let moved = !self.playback.is_at_start();
        self.playback.set_method(method);
        self.runner.send(RunCommand::Method(method));
        self.reset();
        if moved {
            let text = format!("Back to the start: the method is now {}", method.name());
            self.notices.push(Notice::info(text));
        }
    }

    /// A method belongs to the scene it was chosen for: the next one starts with the exact one.
    pub(super) fn forget_method(&mut self) {
        let method = Method::Exact;
        if method != self.playback.method() {
            self.playback.set_method(method);
            self.runner.send(RunCommand::Method(method));
        }
    }

    /// Sends a command that moves the time forwards, after all edits made so far.
    pub(super) fn go_on(&mut self, command: RunCommand) {
        self.settle();
        if !matches!(command, RunCommand::Play { .. }) {
            self.stop_playing();
        }
        (self.shown_event, self.awaited_event) = (None, None);
        self.runner.send(command);
        self.playback.went_on();
    }

    pub(super) fn go_back(&mut self, command: RunCommand) {
        self.settle();
        self.stop_playing();
        (self.shown_event, self.awaited_event) = (None, None);
        self.runner.send(command);
        self.playback.went_back(&self.frame);
    }

    /// A step is taken from where the user saw the scene stop, not in the middle of playing.
    fn stop_playing(&mut self) {
        if self.frame.state == RunState::Playing {
            self.pause();
        }
    }

    pub(super) fn pause(&mut self) {
        self.runner.send(RunCommand::Pause);
    }

    /// Ends an open gesture and lets the runner know what it did.
    pub(super) fn settle(&mut self) {
        self.history.end_gesture();
        if self.unsynced {
            self.sync();
        }
    }
}
