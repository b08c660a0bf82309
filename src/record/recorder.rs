//! The recorder: carries out commands on a simulation, step by step, and keeps what is needed to go back.
//! It has no clock and never blocks: a runner calls [`RunRecorder::work`] as often as it likes.

use std::collections::VecDeque;
use std::sync::Arc;

use super::cancelled::Cancelling;
use super::command::{Goal, RunCommand};
use super::file::{Written, write};
use super::frame::RunState;
use super::motion::RecordedMotion;
use super::recording::BUDGET;
use super::run::Run;
use super::task::{Play, Task};
use super::ways::PathSpan;
use crate::scene::{Diagnostic, NodeKey, Scene};
use crate::sim::{Method, SimEdit, Simulation};

/// Drives one simulation.
#[derive(Debug)]
pub(super) struct RunRecorder {
    pub(super) run: Option<Run>,
    /// The one that an edit of its start has replaced, until a run is edited.
    replaced: Option<Box<Run>>,
    /// How simulations are stepped.
    pub(super) method: Method,
    /// Why the scene cannot be simulated, or geometric warnings of the start.
    pub(super) problems: Arc<Vec<Diagnostic>>,
    task: Task,
    waiting: VecDeque<RunCommand>,
    /// Edits that wait until the simulation is where they are made.
    edits: Vec<SimEdit>,
    /// Bytes that recordings may take.
    budget: usize,
    /// How much of the bodies' ways frames have.
    pub(super) paths: Option<PathSpan>,
    /// Of which bodies frames have the tile crossings.
    pub(super) crossings: Arc<[NodeKey]>,
    /// Whether frames have the occupied tiles.
    pub(super) tiles: bool,
    /// What the event shown cancelled.
    pub(super) cancelling: Cancelling,
    /// The file that was written last.
    pub(super) written: Option<Arc<Written>>,
    /// The motion that was asked for.
    pub(super) motion: Option<Arc<RecordedMotion>>,
}

impl Default for RunRecorder {
    fn default() -> Self {
        Self {
            run: None,
            replaced: None,
            method: Method::default(),
            problems: Arc::default(),
            task: Task::Idle,
            waiting: VecDeque::new(),
            edits: Vec::new(),
            budget: BUDGET,
            paths: None,
            crossings: Arc::default(),
            tiles: false,
            cancelling: Cancelling::default(),
            written: None,
            motion: None,
        }
    }
}

impl RunRecorder {
    /// Takes a command. Those that end what is being done act at once; others wait for it.
    pub(super) fn command(&mut self, command: RunCommand) {
        match command {
            RunCommand::Load(scene) => {
                self.replaced = None;
                self.load(scene);
            }
            RunCommand::LoadEdited { scene, keeps_run } => {
                if keeps_run {
                    self.replaced = self.run.take().map(Box::new);
                }
                self.load(scene);
            }
            RunCommand::Unload => {
                self.forget_work();
                (self.run, self.motion, self.problems) = (None, None, Arc::default());
                self.replaced = None;
                self.cancelling.forget();
            }
            RunCommand::Reset => self.reset(),
            RunCommand::Method(method) if method != self.method => {
                self.method = method;
                self.reset();
            }
            RunCommand::Method(_) => {}
            RunCommand::Budget(bytes) => self.set_budget(bytes),
            RunCommand::Paths(span) => self.paths = span,
            RunCommand::Crossings(keys) => self.crossings = keys,
            RunCommand::Tiles(wanted) => self.tiles = wanted,
            RunCommand::Cancelled(wanted) => self.cancelling.is_wanted = wanted,
            RunCommand::ShareMotion(wanted) => {
                let run = self.run.as_ref().filter(|_| wanted);
                self.motion = run.map(|run| Arc::new(RecordedMotion::of(&run.recording, &run.simulation)));
            }
            RunCommand::Pause => self.pause(),
            RunCommand::Script(commands) if commands.is_empty() => {}
            // After commands that wait it is meant for where they lead to.
            RunCommand::Edit(edits) if self.waiting.is_empty() => self.take_edits(edits),
            other => {
                if matches!(self.task, Task::Play(_)) {
                    self.task = Task::Idle;
                }
                // Playing that has not begun ends by what comes after it too: it would never come to that.
                self.waiting.retain(|waiting| !matches!(waiting, RunCommand::Play { .. }));
                self.waiting.push_back(other);
            }
        }
    }

    pub(super) fn state(&self) -> RunState {
        match (&self.run, self.task) {
            (None, _) => RunState::Empty,
            (Some(run), _) if run.is_faulted() => RunState::Faulted,
            (_, Task::Play(_)) => RunState::Playing,
            (_, Task::Idle) if self.waiting.is_empty() && self.edits.is_empty() => RunState::Paused,
            _ => RunState::Busy,
        }
    }

    /// Whether what an event cancelled is being looked for.
    pub(super) fn is_searching(&self) -> bool {
        self.cancelling.is_searching()
    }

    /// Notes that wall-clock time has passed, while playing.
    pub(super) fn elapse(&mut self, wall_s: f64) {
        if let Task::Play(play) = &mut self.task {
            play.elapse(wall_s);
        }
    }

    /// Model seconds that playing has gone through, and has given up, since the last call.
    pub(super) fn take_pace(&mut self) -> (f64, f64) {
        match &mut self.task {
            Task::Play(play) => play.take_pace(),
            _ => (0.0, 0.0),
        }
    }

    /// Works on for at most `events` events; whether there is more to do at once.
    pub(super) fn work(&mut self, events: u32) -> bool {
        let has_more = self.work_on(events);
        self.stay_within_budget();
        has_more
    }

    fn work_on(&mut self, events: u32) -> bool {
        let mut budget = events;
        while budget > 0 {
            if !self.edits.is_empty() {
                self.make_edits(&mut budget);
                continue;
            }
            if self.task == Task::Idle {
                if let Some(run) = &mut self.run {
                    run.finish_moment();
                }
                if !self.start_next() {
                    return self.settle(budget);
                }
                // What was looked up can be shown before the simulation is there.
                if self.task == Task::Idle && self.waiting.is_empty() {
                    return true;
                }
            }
            let Some(run) = &mut self.run else {
                self.forget_work();
                return false;
            };
            if run.is_faulted() {
                self.pause();
                if self.waiting.is_empty() {
                    return false;
                }
                continue;
            }
            if !self.task.advance(run, &mut budget) {
                return !matches!(self.task, Task::Play(_));
            }
        }
        true
    }

    fn take_edits(&mut self, edits: Vec<SimEdit>) {
        self.cancelling.forget();
        self.edits.extend(edits);
        self.replaced = None;
    }

    /// Bytes that are kept of all runs.
    pub(super) fn bytes(&self) -> usize {
        let all = self.run.iter().chain(self.replaced.as_deref());
        all.map(Run::bytes).sum()
    }

    /// Drops the run that an edit of the start has replaced where both take too much.
    fn stay_within_budget(&mut self) {
        if self.replaced.is_some() && self.bytes() > self.budget {
            self.replaced = None;
        }
    }

    /// Whether an edit in the past, or of the start, has replaced something that can be brought back.
    pub(super) fn can_bring_back(&self) -> bool {
        self.replaced.is_some() || self.run.as_ref().is_some_and(Run::can_bring_back)
    }

    /// Takes an edit of the start back: the run before it is there again, where it was left.
    fn bring_back_run(&mut self) {
        let Some(mut run) = self.replaced.take() else { return };
        self.cancelling.forget();
        self.problems = Arc::new(run.simulation.start_warnings().to_vec());
        self.motion = None;
        run.set_budget(self.budget);
        self.run = Some(*run);
    }

    /// Makes the edits that wait, once the simulation is where what is shown is.
    fn make_edits(&mut self, budget: &mut u32) {
        let Some(run) = &mut self.run else {
            self.edits.clear();
            return;
        };
        *budget -= 1;
        if run.settle() {
            run.edit(std::mem::take(&mut self.edits));
        }
    }

    /// With nothing else to do, brings the simulation to what is shown, and then finds what the event there cancelled; whether there
    /// is more to do for that.
    fn settle(&mut self, budget: u32) -> bool {
        let Some(run) = &mut self.run else { return false };
        !(0..budget).any(|_| run.settle()) || self.cancelling.advance(run, budget)
    }

    /// Takes the next waiting command; false when there is none.
    fn start_next(&mut self) -> bool {
        if self.run.is_none() {
            self.forget_work();
        }
        let Some(command) = self.next_waiting() else { return false };
        let Some(run) = &mut self.run else { return false };
        self.cancelling.stop();
        run.message = None;
        let is_valid = |dt: f64| dt.is_finite() && dt > 0.0;
        match command {
            RunCommand::Step { dt, .. }
            | RunCommand::NextEvent { dt, .. }
            | RunCommand::RunUntil { dt, .. }
            | RunCommand::Play { dt, .. }
            | RunCommand::Seek { dt, .. }
                if !is_valid(dt) =>
            {
                run.message = Some("Δt must be above zero".into());
            }
            RunCommand::Step { dt, count } if count > 0 => self.task = Task::Steps { dt, left: count },
            RunCommand::NextEvent { dt, of } => self.task = Task::ToEvent { dt, of, empty: 0, from: None },
            RunCommand::RunUntil { dt, goal } => self.task = Task::Until { dt, goal, waited: 0 },
            RunCommand::FinishStep => self.task = Task::Finish,
            RunCommand::Play { dt, speed, range } if speed.is_finite() && speed != 0.0 => {
                self.task = Task::Play(Play::new(dt, speed, range));
            }
            RunCommand::Play { .. } => run.message = Some("the speed must not be zero".into()),
            RunCommand::Seek { time, .. } if !time.is_finite() => {
                run.message = Some("that is not a time".into());
            }
            RunCommand::Seek { dt, time } if !run.seek(time) => {
                self.task = Task::Until { dt, goal: Goal::Time(time), waited: 0 };
            }
            RunCommand::StepBack => drop(run.step_back()),
            RunCommand::EventBack { of } => run.event_back(of),
            RunCommand::GoTo { event } => run.go_to_event(event),
            RunCommand::Show(moment) => run.go_to(moment),
            RunCommand::Edit(edits) => self.take_edits(edits),
            RunCommand::BringBack if self.replaced.is_some() => self.bring_back_run(),
            RunCommand::BringBack => {
                self.cancelling.forget();
                run.bring_back();
            }
            RunCommand::Write(request) => self.written = Some(Arc::new(write(run, &request))),
            _ => {}
        }
        true
    }

    /// Ends what moves the time, or waits to. Edits, and files that wait to be written, are not part of that: whoever sent them
    /// counts on them.
    fn pause(&mut self) {
        self.task = Task::Idle;
        let stays = |command: &RunCommand| {
            matches!(command, RunCommand::Edit(_) | RunCommand::BringBack | RunCommand::Write(_))
        };
        self.waiting.retain(stays);
    }

    /// Gives up all that is left to do, for its run is no more. Whoever waits for a file hears that there will be none.
    fn forget_work(&mut self) {
        self.task = Task::Idle;
        self.edits.clear();
        for command in std::mem::take(&mut self.waiting) {
            if let RunCommand::Write(request) = command {
                let problem = Some("the run was left before".to_owned());
                self.written = Some(Arc::new(Written { path: request.path, problem }));
            }
        }
    }

    /// Takes the command that is next, out of a script one by one.
    fn next_waiting(&mut self) -> Option<RunCommand> {
        let mut commands = match self.waiting.pop_front()? {
            RunCommand::Script(commands) => commands,
            other => return Some(other),
        };
        let next = commands.pop_front();
        if !commands.is_empty() {
            self.waiting.push_front(RunCommand::Script(commands));
        }
        next
    }

    fn set_budget(&mut self, bytes: usize) {
        self.budget = bytes;
        self.stay_within_budget();
        if let Some(run) = &mut self.run {
            run.set_budget(bytes);
        }
    }

    fn load(&mut self, scene: Arc<Scene>) {
        self.forget_work();
        self.cancelling.forget();
        self.motion = None;
        match Simulation::with_method(&scene, self.method) {
            Ok(simulation) => {
                self.problems = Arc::new(simulation.start_warnings().to_vec());
                self.run = Some(Run::new(simulation, scene, self.budget));
            }
            Err(error) => {
                self.problems = Arc::new(error.problems);
                self.run = None;
            }
        }
    }

    fn reset(&mut self) {
        self.replaced = None;
        if let Some(run) = self.run.take() {
            self.load(run.scene);
        }
    }
}
