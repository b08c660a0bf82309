//! The simulation of the open document: edits reach its runner in batches, its frames are taken, commands drive it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::live::{Waiting, live_change, waits};
use super::talk::Talk;
use super::{Notice, Playback};
use crate::record::{EventRow, Frame, RunCommand, RunState, Runner};
use crate::scene::{Diagnostic, Document, Scene, Touched};
use crate::sim::Method;

/// How long a drag must stand still until the simulation hears of it. Shorter would compile a scene for
/// every mouse move.
const SETTLE_TIME: Duration = Duration::from_millis(150);

pub(super) struct Run {
    runner: Box<dyn Runner>,
    pub frame: Arc<Frame>,
    pub playback: Playback,
    pub shown_event: Option<Arc<EventRow>>,
    /// Number of an event to show as soon as a frame lists it.
    pub awaited_event: Option<u64>,
    /// The scene that the runner runs; `None` when it has none.
    pub running: Option<Running>,
    /// What edits touched that have not reached the runner yet.
    pub pending: Touched,
    /// The document state that was seen last while edits are pending, and since when.
    settling: Option<(u64, Instant)>,
    last_poll: Option<Instant>,
}

pub(super) struct Running {
    pub scene: Arc<Scene>,
    /// Whether it was changed since it was loaded, so that going back to its start is not enough.
    pub edited: bool,
    /// Changes of the document that this run cannot take.
    pub waiting: Waiting,
}

impl Run {
    pub fn new(runner: Box<dyn Runner>, playback: Playback) -> Self {
        Self {
            frame: runner.frame(),
            runner,
            playback,
            shown_event: None,
            awaited_event: None,
            running: None,
            pending: Touched::default(),
            settling: None,
            last_poll: None,
        }
    }

    /// Takes the newest frame.
    pub fn look(&mut self, now: Instant, talk: &mut Talk) {
        if let Some(before) = self.last_poll.replace(now) {
            self.runner.tick(now.saturating_duration_since(before).as_secs_f64());
        }
        let frame = self.runner.frame();
        self.playback.look_at(&frame);
        if frame.fault != self.frame.fault {
            self.report_fault(&frame, talk);
        }
        self.frame = frame;
        if self.shown_event.as_ref().is_some_and(|row| self.frame.event(row.event.seq).is_none()) {
            self.shown_event = None;
        }
    }

    /// Whether the scene cannot be simulated. Says so only when the runner has tried.
    pub fn has_no_simulation(&self) -> bool {
        let failed =
            self.frame.state == RunState::Empty && self.frame.problems.iter().any(Diagnostic::is_error);
        self.running.is_none() || failed
    }

    fn report_fault(&mut self, frame: &Frame, talk: &mut Talk) {
        let Some(fault) = &frame.fault else { return };
        if frame.state == RunState::Faulted {
            talk.notices.push(Notice::error(format!("The simulation stopped: {fault}")));
            return;
        }
        // an edit that the simulation refused is in the document and waits for the start
        talk.notices.push(Notice::warning(format!("Not applied to the running simulation: {fault}")));
        if let Some(running) = &mut self.running {
            running.waiting.refused = true;
        }
    }

    /// Whether the pending edits of a gesture have stood still long enough; `state` is the document's.
    pub fn has_settled(&mut self, state: u64, now: Instant) -> bool {
        if self.pending.is_empty() {
            return false;
        }
        match self.settling {
            Some((seen, since)) if seen == state => now.saturating_duration_since(since) >= SETTLE_TIME,
            _ => {
                self.settling = Some((state, now));
                false
            }
        }
    }

    /// Brings the runner in line with the document, as far as a running simulation can be changed. All
    /// pending edits go as one batch.
    pub fn sync(&mut self, document: &Document, talk: &mut Talk) {
        let touched = std::mem::take(&mut self.pending);
        self.settling = None;
        let wanted = if document.has_errors() { None } else { document.scene_shared() };
        match (&mut self.running, wanted) {
            (None, None) => {}
            (None, Some(scene)) => self.load(scene),
            (Some(_), None) => {
                if !self.playback.is_at_start() {
                    talk.notices.push(Notice::warning("The simulation was dropped: the scene has errors"));
                }
                self.unload();
            }
            (Some(running), Some(scene)) if self.playback.is_at_start() => {
                let other = running.edited || running.waiting.any();
                if other || waits(&running.scene, &scene, &touched).any() {
                    self.load(scene);
                } else {
                    running.scene = scene;
                }
            }
            (Some(running), Some(scene)) => {
                let change = live_change((&running.scene, &running.waiting), &scene, &touched);
                let speed_changed = running.scene.time_speed != scene.time_speed;
                running.edited |= !change.edits.is_empty();
                running.waiting = change.waiting;
                running.scene = change.scene;
                if !change.edits.is_empty() {
                    self.runner.send(RunCommand::Edit(change.edits));
                }
                if speed_changed {
                    self.play_on(scene.time_speed);
                }
            }
        }
    }

    fn load(&mut self, scene: Arc<Scene>) {
        self.runner.send(RunCommand::Load(scene.clone()));
        self.running = Some(Running { scene, edited: false, waiting: Waiting::default() });
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
    pub fn forget(&mut self) {
        self.playback.went_to_start();
        self.pending = Touched::default();
        if self.running.is_some() {
            self.unload();
        }
    }

    /// Goes to the start of the scene as it is edited now.
    pub fn reset(&mut self, document: &Document) {
        self.stop_playing();
        self.shown_event = None;
        let Some(running) = &self.running else { return };
        if running.edited || running.waiting.any() {
            if let Some(scene) = document.scene_shared() {
                self.load(scene);
            }
        } else {
            self.runner.send(RunCommand::Reset);
            self.playback.went_to_start();
        }
    }

    /// Steps by another method from now on. The caller goes to the start.
    pub fn set_method(&mut self, method: Method) {
        self.playback.set_method(method);
        self.runner.send(RunCommand::Method(method));
    }

    /// Sends a command that moves the time forwards.
    pub fn go_on(&mut self, command: RunCommand) {
        if !matches!(command, RunCommand::Play { .. }) {
            self.stop_playing();
        }
        (self.shown_event, self.awaited_event) = (None, None);
        self.runner.send(command);
        self.playback.went_on();
    }

    pub fn go_back(&mut self, command: RunCommand) {
        self.stop_playing();
        (self.shown_event, self.awaited_event) = (None, None);
        self.runner.send(command);
        self.playback.went_back(&self.frame);
    }

    /// Plays; a scene may ask for another `time_speed` than that of the clock.
    pub fn play(&mut self, time_speed: f64) {
        let speed = self.playback.speed() * time_speed;
        self.go_on(RunCommand::Play { dt: self.playback.dt(), speed });
    }

    /// Lets a change of Δt or speed take hold while playing.
    pub fn play_on(&mut self, time_speed: f64) {
        if self.frame.state == RunState::Playing {
            self.play(time_speed);
        }
    }

    /// A step is taken from where the user saw the scene stop, not in the middle of playing.
    fn stop_playing(&mut self) {
        if self.frame.state == RunState::Playing {
            self.pause();
        }
    }

    pub fn pause(&mut self) {
        self.runner.send(RunCommand::Pause);
    }
}
