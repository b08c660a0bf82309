//! One user's work. Read it through `&Session`; change it through [`Session::perform`].

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::dialogue::{Intent, Question, Request};
use super::disk::DiskStamp;
use super::history::History;
use super::live::{differs, live_change, needs_reset};
use super::recovery::Recovery;
use super::{Action, Gesture, Notice, Outcome, Playback, Selection, Settings, Storage};
use crate::record::{EventRow, Frame, RunCommand, RunState, Runner};
use crate::scene::{Diagnostic, Document, NodeKey, NumberStyle, Scene};
use crate::sim::{Method, SimEdit};

/// How long a drag must stand still until the simulation hears of it. Shorter would compile a scene for
/// every mouse move.
const SETTLE_TIME: Duration = Duration::from_millis(150);

/// The document and everything around it.
pub struct Session {
    pub(super) history: History,
    pub(super) file: OpenFile,
    pub(super) selection: Selection,
    pub(super) playback: Playback,
    pub(super) settings: Settings,
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
    runner: Box<dyn Runner>,
    /// The scene that the runner runs; `None` when it has none.
    running: Option<Running>,
    /// Whether a gesture's edits have not reached the runner yet.
    unsynced: bool,
    /// The document state that was seen last while unsynced, and since when.
    settling: Option<(u64, Instant)>,
    last_poll: Option<Instant>,
}

/// Where the document came from and goes to.
pub(super) struct OpenFile {
    pub path: Option<std::path::PathBuf>,
    pub title: String,
    /// What the file held when it was read or written.
    pub stamp: Option<DiskStamp>,
    /// Whether the user knows that another program changed it.
    pub told_changed: bool,
}

struct Running {
    scene: Scene,
    /// Whether it was changed since it was loaded, so that going back to its start is not enough.
    edited: bool,
    /// The document has changes that this run can't take.
    needs_reset: bool,
}

impl Session {
    /// A new, empty scene; nothing is kept on the disk but what the user saves.
    pub fn new(runner: Box<dyn Runner>) -> Self {
        Self::with_storage(runner, Storage::default())
    }

    /// A new, empty scene, with settings and recovery files in the folders given. Asks for what to do
    /// with unsaved work of an earlier run.
    pub fn with_storage(runner: Box<dyn Runner>, storage: Storage) -> Self {
        let settings = Settings::load(&storage);
        let mut playback = Playback::default();
        if let Some(dt) = &settings.dt {
            // a Δt that is no longer accepted leaves the default
            let _ = playback.set_dt(dt);
        }
        let mut session = Self {
            history: History::new(Document::new(NumberStyle::Point), true),
            file: OpenFile::untitled("Untitled"),
            selection: Selection::default(),
            playback,
            recovery: Recovery::new(&storage),
            settings,
            storage,
            notices: Vec::new(),
            question: None,
            requests: Vec::new(),
            after_save: None,
            frame: runner.frame(),
            shown_event: None,
            awaited_event: None,
            opened: 0,
            runner,
            running: None,
            unsynced: false,
            settling: None,
            last_poll: None,
        };
        session.offer_recovery();
        session.sync();
        session
    }

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

    pub fn settings(&self) -> &Settings {
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

    /// Carries out what a panel sent.
    pub fn perform(&mut self, action: Action) -> Outcome {
        let outcome = self.carry_out(action);
        if let Outcome::Refused(reason) = &outcome {
            self.notices.push(Notice::warning(reason.clone()));
        }
        outcome
    }

    /// Once per turn of the window: takes the newest frame, passes on edits that have settled, keeps the
    /// recovery file up to date.
    pub fn poll(&mut self, now: Instant) {
        if let Some(before) = self.last_poll.replace(now) {
            self.runner.tick(now.saturating_duration_since(before).as_secs_f64());
        }
        let frame = self.runner.frame();
        self.playback.look_at(&frame);
        if frame.fault != self.frame.fault {
            self.tell_fault(&frame);
        }
        self.frame = frame;
        let listed =
            |row: &Arc<EventRow>| self.frame.events.iter().any(|other| other.event.seq == row.event.seq);
        if self.shown_event.as_ref().is_some_and(|row| !listed(row)) {
            self.shown_event = None;
        }
        self.show_awaited_event();
        self.sync_when_settled(now);
        if self.open_gesture().is_none() {
            self.keep_recovery(now);
        }
    }

    /// Whether the scene can't be simulated. Says so only when the runner has tried.
    pub(super) fn has_no_simulation(&self) -> bool {
        let failed =
            self.frame.state == RunState::Empty && self.frame.problems.iter().any(Diagnostic::is_error);
        self.running.is_none() || failed
    }

    fn tell_fault(&mut self, frame: &Frame) {
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

    /// Tells the runner about the document, at once or, inside a gesture, when it has settled.
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
