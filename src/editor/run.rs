//! The simulation of the open document: edits reach its runner in batches, its frames are taken, commands drive it.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::live::{Waiting, live_change, waits};
use super::scenes::{Scenes, drawn};
use super::talk::Talk;
use super::travel::Way;
use super::{Notice, Playback};
use crate::record::{EventRow, Frame, PathSpan, Recorded, RunCommand, RunState, Runner, Written};
use crate::scene::{Diagnostic, Document, NodeKey, Scene, Touched, shown_path};
use crate::sim::Method;

/// How long a drag must stand still until the simulation hears of it. Shorter would compile a scene for
/// every mouse move.
const SETTLE_TIME: Duration = Duration::from_millis(150);

pub(super) struct Run {
    runner: Box<dyn Runner>,
    /// Number of the last command sent.
    sent: u64,
    /// Number of the last command by which another run began: frames that do not know of it are of the one before.
    begun: u64,
    /// Number of the last command that ended playing: a frame that does not know of it cannot tell.
    halted: u64,
    /// What ways the runner was asked for.
    paths: Option<PathSpan>,
    /// Of which bodies it was asked for the tile crossings.
    crossings: Arc<[NodeKey]>,
    /// Whether it was asked for the predictions that an event cancelled.
    cancelled: bool,
    /// Whether it was asked for the occupied tiles.
    tiles: bool,
    pub frame: Arc<Frame>,
    pub playback: Playback,
    pub shown_event: Option<Arc<EventRow>>,
    /// The scene that the runner runs; `None` when it has none.
    pub running: Option<Running>,
    /// What ran before each edit.
    scenes: Scenes,
    /// What it ran before its start was edited, while that can be brought back.
    replaced: Option<(Running, Scenes)>,
    /// What edits touched that have not reached the runner yet.
    pub pending: Touched,
    /// The document state that was seen last while edits are pending, and since when.
    settling: Option<(u64, Instant)>,
    last_poll: Option<Instant>,
}

pub(super) struct Running {
    pub scene: Arc<Scene>,
    /// What was loaded.
    pub document: Document,
    /// Whether it was changed since it was loaded, so that going back to its start is not enough.
    pub edited: bool,
    /// Changes of the document that this run cannot take.
    pub waiting: Waiting,
}

/// A scene that ran at some moment.
#[derive(Clone, Debug)]
pub struct Ran {
    scene: Arc<Scene>,
    /// Whether edits came after it.
    is_past: bool,
    /// What is drawn as the document has it, for the run has not heard of it yet.
    pending: BTreeSet<NodeKey>,
}

impl Ran {
    /// Whether both are of the same scene.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.is_past == other.is_past
            && self.pending == other.pending
    }
}

impl Running {
    /// What of a document runs otherwise now.
    fn wait_for(&mut self, document: &Document) {
        let Some(scene) = document.scene() else { return };
        self.waiting = waits(&self.scene, scene, &all_of(&self.scene, scene));
    }
}

/// As though everything in two scenes was touched.
fn all_of(one: &Scene, other: &Scene) -> Touched {
    let keys = |scene: &Scene| {
        let bodies = scene.bodies.iter().map(|body| body.key);
        bodies.chain(scene.forces.iter().map(|force| force.key)).collect::<Vec<_>>()
    };
    Touched { keys: [keys(one), keys(other)].concat().into_iter().collect(), ..Touched::default() }
}

impl Run {
    pub fn new(runner: Box<dyn Runner>, playback: Playback) -> Self {
        Self {
            frame: runner.frame(),
            runner,
            sent: 0,
            begun: 0,
            halted: 0,
            paths: None,
            crossings: Arc::default(),
            cancelled: false,
            tiles: false,
            playback,
            shown_event: None,
            running: None,
            scenes: Scenes::default(),
            replaced: None,
            pending: Touched::default(),
            settling: None,
            last_poll: None,
        }
    }

    pub fn send(&mut self, command: RunCommand) -> u64 {
        self.sent = self.runner.send(command);
        self.sent
    }

    /// Whether the newest frame does not show yet all that the simulation was told.
    pub fn is_behind(&self) -> bool {
        let is_at_work = match self.frame.state {
            RunState::Busy => true,
            RunState::Paused => !self.frame.is_settled || self.frame.seeks_cancelled,
            RunState::Empty | RunState::Playing | RunState::Faulted => false,
        };
        self.frame.command < self.sent || is_at_work
    }

    /// Takes the newest frame.
    pub fn look(&mut self, now: Instant, talk: &mut Talk) {
        if let Some(before) = self.last_poll.replace(now) {
            self.runner.tick(now.saturating_duration_since(before).as_secs_f64());
        }
        let frame = self.runner.frame();
        if frame.command < self.begun {
            return;
        }
        self.playback.look_at(&frame);
        if let Some(written) = news(&self.frame.written, &frame.written) {
            talk.notices.push(report_written(written));
        }
        self.report(&frame, talk);
        self.frame = frame;
        // After an edit another event may have its number.
        let is_recorded = |row: &Arc<EventRow>| {
            self.frame.event(row.event.seq).is_some_and(|now| now.event.time == row.event.time)
        };
        if !self.shown_event.as_ref().is_some_and(is_recorded) {
            self.shown_event = None;
        }
    }

    /// Whether the scene cannot be simulated. Says so only when the runner has tried.
    pub fn has_no_simulation(&self) -> bool {
        let failed =
            self.frame.state == RunState::Empty && self.frame.problems.iter().any(Diagnostic::is_error);
        self.running.is_none() || failed
    }

    /// Passes on what a frame says.
    fn report(&mut self, frame: &Frame, talk: &mut Talk) {
        if let Some(fault) = news(&self.frame.fault, &frame.fault) {
            talk.notices.push(Notice::error(format!("The simulation stopped: {fault}")));
        }
        if let Some(message) = news(&self.frame.message, &frame.message) {
            talk.notices.push(Notice::warning(message));
        }
        if let Some(reason) = news(&self.frame.refused, &frame.refused) {
            talk.notices.push(Notice::warning(format!("Not applied to the running simulation: {reason}")));
            self.scenes.refused(frame);
            // The edit is in the document and waits for the start.
            if let Some(running) = &mut self.running {
                running.waiting.refused = true;
            }
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
    pub fn sync(&mut self, document: &Document, way: Way, talk: &mut Talk) {
        let touched = std::mem::take(&mut self.pending);
        self.settling = None;
        let wanted = if document.has_errors() { None } else { document.scene_shared() };
        match (&mut self.running, wanted) {
            (None, None) => {}
            (None, Some(scene)) => self.load(document, scene),
            (Some(_), None) => {
                if !self.playback.is_at_start() {
                    talk.notices.push(Notice::warning("The simulation was dropped: the scene has errors"));
                }
                self.unload();
            }
            (Some(running), Some(scene)) if self.playback.is_at_start() => {
                let other = running.edited || running.waiting.any();
                if other || waits(&running.scene, &scene, &touched).any() {
                    self.load_edited(document, scene);
                } else {
                    (running.scene, running.document) = (scene, document.clone());
                }
            }
            (Some(running), Some(scene)) => {
                // Before other edits another scene ran: from here on it is the document's in all.
                let then = self.scenes.then(&self.frame).cloned();
                let touched = then.as_ref().map_or(touched, |then| all_of(then, &scene));
                let base = then.unwrap_or_else(|| running.scene.clone());
                let change = live_change((&base, &running.waiting), &scene, &touched);
                if !change.edits.is_empty() {
                    self.scenes.edit(&base, &running.scene, &change.edits, &self.frame);
                }
                let speed_changed = running.scene.time_speed != scene.time_speed;
                running.edited |= !change.edits.is_empty();
                running.waiting = change.waiting;
                running.scene = change.scene;
                if !change.edits.is_empty() {
                    self.replaced = None;
                    self.send(RunCommand::Edit(change.edits));
                }
                if speed_changed {
                    self.play_on(way);
                }
            }
        }
    }

    fn load(&mut self, document: &Document, scene: Arc<Scene>) {
        self.replaced = None;
        let command = self.send(RunCommand::Load(scene.clone()));
        self.begin(command, document, scene);
    }

    /// Loads a scene whose start was edited. What was recorded from there can be brought back.
    fn load_edited(&mut self, document: &Document, scene: Arc<Scene>) {
        let keeps_run = self.frame.recorded.to > 0.0;
        if keeps_run {
            let scenes = std::mem::take(&mut self.scenes);
            self.replaced = self.running.take().map(|running| (running, scenes));
        }
        if self.replaced.is_none() {
            return self.load(document, scene);
        }
        let command = self.send(RunCommand::LoadEdited { scene: scene.clone(), keeps_run });
        self.begin(command, document, scene);
    }

    fn begin(&mut self, command: u64, document: &Document, scene: Arc<Scene>) {
        self.scenes = Scenes::default();
        self.running =
            Some(Running { scene, document: document.clone(), edited: false, waiting: Waiting::default() });
        let can_bring_back = self.replaced.is_some();
        let recorded = Arc::new(Recorded { can_bring_back, ..Recorded::default() });
        self.begin_anew(command, Frame { recorded, ..self.frame_at_start() });
    }

    /// Takes the last edit in the past out of the run, or that of its start.
    pub fn bring_back(&mut self, document: &Document) {
        let Some((mut before, scenes)) = self.replaced.take() else {
            self.go_back(RunCommand::BringBack);
            if let (Some(running), Some(scene)) = (&mut self.running, self.scenes.bring_back()) {
                running.scene = scene;
                running.wait_for(document);
            }
            return;
        };
        before.wait_for(document);
        (self.running, self.scenes) = (Some(before), scenes);
        let command = self.send(RunCommand::BringBack);
        self.begin_anew(command, self.frame_at_start());
    }

    /// What to draw instead of the document's scene, and whether that is of the past; `None` for that itself.
    pub fn scene_then(&self, wanted: &Arc<Scene>) -> Option<Ran> {
        let running = self.running.as_ref().filter(|_| !self.playback.is_at_start())?;
        let past = self.scenes.then(&self.frame);
        let scene = past.unwrap_or(&running.scene);
        let pending = self.pending.keys.clone();
        let then = Ran { scene: scene.clone(), is_past: past.is_some(), pending };
        (!Arc::ptr_eq(scene, wanted)).then_some(then)
    }

    pub fn drawn(&self, wanted: &Arc<Scene>, then: &Ran) -> Arc<Scene> {
        drawn(wanted, &then.scene, then.is_past, &then.pending)
    }

    /// What a body was called that an edit has removed from the run.
    pub fn former_name(&self, key: NodeKey) -> Option<&str> {
        self.scenes.former_name(key)
    }

    fn unload(&mut self) {
        let command = self.send(RunCommand::Unload);
        (self.running, self.replaced) = (None, None);
        self.begin_anew(command, Frame::default());
    }

    /// With this command another run begins: nothing plays and nothing is recorded, as the next frame will say.
    fn begin_anew(&mut self, command: u64, frame: Frame) {
        (self.begun, self.halted) = (command, command);
        self.playback.sent(command, true);
        self.shown_event = None;
        let (revision, written) = (self.frame.revision, self.frame.written.clone());
        self.frame = Arc::new(Frame { revision, written, method: self.playback.method(), ..frame });
    }

    /// The last frame as though its run stood at the start, which is what is seen until the next one comes.
    fn frame_at_start(&self) -> Frame {
        let Frame { bodies, contacts, energy, momentum, plan, tiling, problems, .. } = &*self.frame;
        Frame {
            state: RunState::Paused,
            bodies: bodies.clone(),
            contacts: contacts.clone(),
            energy: *energy,
            momentum: *momentum,
            plan: plan.clone(),
            tiling: tiling.clone(),
            problems: problems.clone(),
            ..Frame::default()
        }
    }

    /// Forgets the run, so that the next sync loads whatever the document is.
    pub fn forget(&mut self) {
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
                self.load(document, scene);
            }
        } else {
            self.replaced = None;
            let command = self.send(RunCommand::Reset);
            self.begin_anew(command, self.frame_at_start());
        }
    }

    /// Steps by another method from now on. The caller goes to the start.
    pub fn set_method(&mut self, method: Method) {
        self.playback.set_method(method);
        self.send(RunCommand::Method(method));
    }

    /// Sends a command that moves the time forwards.
    pub fn go_on(&mut self, command: RunCommand) {
        if !matches!(command, RunCommand::Play { .. }) {
            self.stop_playing();
        }
        self.shown_event = None;
        let command = self.send(command);
        self.playback.sent(command, false);
    }

    pub fn go_back(&mut self, command: RunCommand) {
        self.stop_playing();
        self.shown_event = None;
        let command = self.send(command);
        self.playback.sent(command, false);
    }

    /// Plays at the speed that is set.
    pub fn play(&mut self, way: Way) {
        let speed = self.playback.speed() * way.speed;
        self.halted = 0;
        self.go_on(RunCommand::Play { dt: self.playback.dt(), speed, range: way.range });
    }

    /// Lets a change of Δt or speed take hold while playing.
    pub fn play_on(&mut self, way: Way) {
        if self.is_playing() {
            self.play(way);
        }
    }

    /// A step is taken from where the user saw the scene stop, not in the middle of playing.
    fn stop_playing(&mut self) {
        if self.is_playing() {
            self.pause();
        }
    }

    /// Whether it plays, as far as the newest frame and the commands sent since tell. A pause that is sent twice would end what was
    /// sent between.
    fn is_playing(&self) -> bool {
        self.frame.state == RunState::Playing && self.frame.command >= self.halted
    }

    /// How much of the bodies' ways the frames have.
    pub fn show_paths(&mut self, span: Option<PathSpan>) {
        if self.paths != span {
            self.paths = span;
            self.send(RunCommand::Paths(span));
        }
    }

    /// Of which bodies the frames have the tile crossings.
    pub fn show_crossings(&mut self, keys: &[NodeKey]) {
        if *self.crossings != *keys {
            self.crossings = keys.into();
            self.send(RunCommand::Crossings(self.crossings.clone()));
        }
    }

    /// Whether frames at an event have the predictions that it cancelled.
    pub fn show_cancelled(&mut self, wanted: bool) {
        if self.cancelled != wanted {
            self.cancelled = wanted;
            self.send(RunCommand::Cancelled(wanted));
        }
    }

    /// Whether the frames have the occupied tiles.
    pub fn show_tiles(&mut self, wanted: bool) {
        if self.tiles != wanted {
            self.tiles = wanted;
            self.send(RunCommand::Tiles(wanted));
        }
    }

    pub fn set_memory(&mut self, bytes: usize) {
        self.send(RunCommand::Budget(bytes));
    }

    pub fn pause(&mut self) {
        self.halted = self.send(RunCommand::Pause);
    }
}

/// What a frame says, if the one before has not said it: the same words may be said again.
fn news<'a, T: ?Sized>(before: &Option<Arc<T>>, now: &'a Option<Arc<T>>) -> Option<&'a T> {
    let is_known = |now: &Arc<T>| before.as_ref().is_some_and(|before| Arc::ptr_eq(before, now));
    now.as_ref().filter(|now| !is_known(now)).map(|now| &**now)
}

fn report_written(written: &Written) -> Notice {
    let path = shown_path(&written.path);
    match &written.problem {
        None => Notice::info(format!("Wrote {path}")),
        Some(problem) => Notice::error(format!("{path} cannot be written: {problem}")),
    }
}
