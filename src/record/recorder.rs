//! The recorder: carries out commands on a simulation, step by step, and keeps what is needed to go back.
//! It has no clock and never blocks: a runner calls [`Recorder::work`] as often as it likes.

use std::collections::VecDeque;
use std::sync::Arc;

use super::drift::Drift;
use super::history::History;
use super::{EventRow, RunCommand, RunState};
use crate::scene::{Diagnostic, Scene};
use crate::sim::{Event, Method, Progress, SimEdit, Simulation};

/// Events of one Δt that are kept for the table; older ones are left out, and the frame says so.
const MAX_ROWS: usize = 20_000;

/// Drives one simulation.
#[derive(Debug, Default)]
pub(super) struct Recorder {
    pub(super) run: Option<Run>,
    /// How simulations are stepped.
    pub(super) method: Method,
    /// Why the scene can't be simulated, or geometric warnings of the start.
    pub(super) problems: Arc<Vec<Diagnostic>>,
    task: Task,
    waiting: VecDeque<RunCommand>,
}

/// A loaded simulation with its Δt grid and its past.
#[derive(Debug)]
pub(super) struct Run {
    pub(super) simulation: Simulation,
    scene: Box<Scene>,
    pub(super) grid: StepGrid,
    pub(super) rows: Rows,
    pub(super) history: History,
    pub(super) drift: Drift,
    /// Deepest overlap at any time looked at so far, m.
    pub(super) worst_overlap: f64,
    /// Number of the last event reached.
    pub(super) last_event: u64,
    /// The fault that stopped it, or why the last edit was refused.
    pub(super) message: Option<String>,
    pub(super) faulted: bool,
}

/// Events of the Δt being looked at.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    pub(super) list: VecDeque<Arc<EventRow>>,
    pub(super) truncated: bool,
}

/// Where the Δt begin and end: tick k at origin + k·Δt, by product, so that no error adds up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StepGrid {
    origin: f64,
    dt: f64,
    ticks: u64,
    /// Number of Δt before `origin`.
    before: u64,
    /// Start and end of the Δt that is open.
    pub(super) open: Option<(f64, f64)>,
}

/// What is being worked on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Task {
    #[default]
    Idle,
    Steps {
        dt: f64,
        left: u32,
    },
    ToEvent {
        dt: f64,
        /// Δt looked through in vain so far.
        empty: u32,
    },
    Finish,
    Play {
        dt: f64,
        speed: f64,
        /// Model seconds that have come due and are not yet simulated.
        due: f64,
    },
}

/// What became of a Δt in a slice of work.
enum Slice {
    /// The Δt is done.
    Done,
    /// An event was reached.
    Event,
    /// The slice is used up.
    Pause,
}

/// Wall-clock seconds of playing that may wait to be simulated. A machine that can't follow falls behind
/// by this much and then plays slower, with the same Δt.
const MOST_DUE: f64 = 0.1;

/// Predictions carried out between two looks at the budget: a Δt may hold millions that are no events.
const PREDICTIONS: u32 = 64;

/// Δt without an event after which "next event" stops looking, so that a scene in which nothing happens
/// any more does not run for ever.
const MOST_EMPTY_STEPS: u32 = 100_000;

impl StepGrid {
    fn new() -> Self {
        Self { origin: 0.0, dt: 0.0, ticks: 0, before: 0, open: None }
    }

    /// Number of the Δt being looked at.
    pub(super) fn index(&self) -> u64 {
        self.before + self.ticks + u64::from(self.open.is_some())
    }

    /// Start and end of the Δt being looked at; `None` before the first.
    pub(super) fn span(&self) -> Option<(f64, f64)> {
        let at = |ticks: u64| self.origin + ticks as f64 * self.dt;
        self.open.or_else(|| self.ticks.checked_sub(1).map(|before| (at(before), at(self.ticks))))
    }

    /// The grid as it stood before its last Δt was closed, with that one open from `start` to `end`.
    pub(super) fn reopened(self, start: f64, end: f64) -> Self {
        Self { ticks: self.ticks.saturating_sub(1), open: Some((start, end)), ..self }
    }

    /// Opens the next Δt at `now`; another Δt than before starts the grid anew there.
    fn open(&mut self, now: f64, dt: f64) {
        let expected = self.origin + self.ticks as f64 * self.dt;
        if dt != self.dt || now != expected {
            *self = Self { origin: now, dt, ticks: 0, before: self.before + self.ticks, open: None };
        }
        self.open = Some((now, self.origin + (self.ticks + 1) as f64 * self.dt));
    }

    fn close(&mut self) {
        self.open = None;
        self.ticks += 1;
    }
}

impl Recorder {
    /// Takes a command. Those that end what is being done act at once; others wait for it.
    pub(super) fn command(&mut self, command: RunCommand) {
        match command {
            RunCommand::Load(scene) => self.load(scene),
            RunCommand::Unload => *self = Self { method: self.method, ..Self::default() },
            RunCommand::Reset => self.reset(),
            RunCommand::Method(method) if method != self.method => {
                self.method = method;
                self.reset();
            }
            RunCommand::Method(_) => {}
            RunCommand::Pause => self.stop(),
            RunCommand::Edit(edit) => self.edit(&edit),
            other => {
                if matches!(self.task, Task::Play { .. }) {
                    self.task = Task::Idle;
                }
                self.waiting.push_back(other);
            }
        }
    }

    pub(super) fn state(&self) -> RunState {
        match (&self.run, self.task) {
            (None, _) => RunState::Empty,
            (Some(run), _) if run.faulted => RunState::Faulted,
            (_, Task::Play { .. }) => RunState::Playing,
            (_, Task::Idle) if self.waiting.is_empty() => RunState::Paused,
            _ => RunState::Busy,
        }
    }

    /// Tells that wall-clock time has passed, while playing.
    pub(super) fn elapse(&mut self, wall_s: f64) {
        if let Task::Play { dt, speed, due } = &mut self.task {
            *due = (*due + wall_s.max(0.0) * *speed).min(MOST_DUE * *speed + *dt);
        }
    }

    /// Works on for at most `events` events; whether there is more to do at once.
    pub(super) fn work(&mut self, events: u32) -> bool {
        let mut budget = events;
        while budget > 0 {
            if self.task == Task::Idle && !self.start_next() {
                return false;
            }
            let Some(run) = &mut self.run else {
                self.stop();
                return false;
            };
            if run.faulted {
                self.stop();
                return false;
            }
            if !Self::advance_task(&mut self.task, run, &mut budget) {
                return !matches!(self.task, Task::Play { .. });
            }
        }
        true
    }

    /// Does one Δt of the task, or what the budget allows; false when a task can't go on for now.
    fn advance_task(task: &mut Task, run: &mut Run, budget: &mut u32) -> bool {
        match task {
            Task::Idle => {}
            Task::Steps { dt, left } => match run.slice(*dt, budget) {
                Slice::Done if *left <= 1 => *task = Task::Idle,
                Slice::Done => *left -= 1,
                Slice::Event | Slice::Pause => {}
            },
            Task::ToEvent { dt, empty } => match run.slice(*dt, budget) {
                Slice::Event => *task = Task::Idle,
                Slice::Done if *empty >= MOST_EMPTY_STEPS => {
                    run.message = Some(format!("no event within {MOST_EMPTY_STEPS} Δt"));
                    *task = Task::Idle;
                }
                Slice::Done => *empty += 1,
                Slice::Pause => {}
            },
            Task::Finish => match run.grid.open {
                Some((start, end)) => {
                    if matches!(run.slice(end - start, budget), Slice::Done) {
                        *task = Task::Idle;
                    }
                }
                None => *task = Task::Idle,
            },
            Task::Play { dt, due, .. } => {
                if run.grid.open.is_none() && *due < *dt {
                    return false;
                }
                if matches!(run.slice(*dt, budget), Slice::Done) {
                    *due = (*due - *dt).max(0.0);
                }
            }
        }
        true
    }

    /// Takes the next waiting command; false when there is none.
    fn start_next(&mut self) -> bool {
        let Some(command) = self.waiting.pop_front() else { return false };
        let Some(run) = &mut self.run else {
            self.waiting.clear();
            return false;
        };
        if !run.faulted {
            run.message = None;
        }
        let valid = |dt: f64| dt.is_finite() && dt > 0.0;
        match command {
            RunCommand::Step { dt, count } if valid(dt) && count > 0 => {
                self.task = Task::Steps { dt, left: count }
            }
            RunCommand::NextEvent { dt } if valid(dt) => self.task = Task::ToEvent { dt, empty: 0 },
            RunCommand::FinishStep => self.task = Task::Finish,
            RunCommand::Play { dt, speed } if valid(dt) && speed.is_finite() && speed > 0.0 => {
                self.task = Task::Play { dt, speed, due: 0.0 };
            }
            RunCommand::StepBack => run.step_back(),
            RunCommand::EventBack => run.event_back(),
            RunCommand::GoTo { event } => run.back_to_event(event),
            RunCommand::Step { .. } | RunCommand::NextEvent { .. } | RunCommand::Play { .. } => {
                run.message = Some("Δt and speed must be above zero".into());
            }
            _ => {}
        }
        true
    }

    fn stop(&mut self) {
        self.task = Task::Idle;
        self.waiting.clear();
    }

    fn load(&mut self, scene: Box<Scene>) {
        self.stop();
        match Simulation::with_method(&scene, self.method) {
            Ok(simulation) => {
                self.problems = Arc::new(simulation.start_warnings().to_vec());
                self.run = Some(Run::new(simulation, scene));
            }
            Err(error) => {
                self.problems = Arc::new(error.problems);
                self.run = None;
            }
        }
    }

    fn reset(&mut self) {
        if let Some(run) = self.run.take() {
            self.load(run.scene);
        }
    }

    fn edit(&mut self, edit: &SimEdit) {
        if let Some(run) = &mut self.run {
            run.edit(edit);
        }
    }
}

impl Run {
    fn new(simulation: Simulation, scene: Box<Scene>) -> Self {
        let history = History::new(&simulation, StepGrid::new());
        Self {
            worst_overlap: simulation.worst_overlap(),
            simulation,
            scene,
            grid: StepGrid::new(),
            rows: Rows::default(),
            history,
            drift: Drift::default(),
            last_event: 0,
            message: None,
            faulted: false,
        }
    }

    /// Goes on in the open Δt, or opens one, until an event, its end, or the end of the budget.
    fn slice(&mut self, dt: f64, budget: &mut u32) -> Slice {
        let (_, end) = self.open_step(dt);
        if *budget == 0 {
            return Slice::Pause;
        }
        *budget -= 1;
        self.begin_until(end, end);
        match self.simulation.work(PREDICTIONS) {
            Ok(Progress::Event(event)) => {
                self.note(&event);
                Slice::Event
            }
            Ok(Progress::Working) => Slice::Pause,
            Ok(Progress::Done) => {
                self.close_step();
                Slice::Done
            }
            Err(fault) => {
                self.message = Some(fault.to_string());
                self.faulted = true;
                Slice::Pause
            }
        }
    }

    fn open_step(&mut self, dt: f64) -> (f64, f64) {
        if self.grid.open.is_none() {
            self.grid.open(self.simulation.time(), dt);
            self.rows = Rows::default();
            let end = self.grid.open.map_or(0.0, |(_, end)| end);
            let lost = self.history.divide_time_anew(&self.simulation, self.last_event, end);
            if lost > 0 {
                self.message = Some(format!("{lost} edit(s) made later, in steps of another Δt"));
            }
        }
        self.grid.open.unwrap_or_default()
    }

    fn close_step(&mut self) {
        self.grid.close();
        self.history.note_tick(&self.simulation, self.grid, self.last_event);
    }

    /// Enters an event into the table and the history.
    pub(super) fn note(&mut self, event: &Event) {
        self.last_event = event.seq;
        self.history.note_event(event);
        self.drift.note(&self.simulation, event);
        if self.rows.list.len() >= MAX_ROWS {
            self.rows.list.pop_front();
            self.rows.truncated = true;
        }
        self.rows.list.push_back(Arc::new(row_of(&self.simulation, event, self.grid.index())));
    }

    /// Looks for overlaps now. It costs a look through the tiles, so it is done when a frame is made.
    pub(super) fn look_for_overlap(&mut self) {
        self.worst_overlap = self.worst_overlap.max(self.simulation.worst_overlap());
    }

    /// Changes the scene now, between events, and records it with the time it was stamped with.
    fn edit(&mut self, edit: &SimEdit) {
        match self.simulation.apply(edit) {
            Ok(()) => {
                self.history.note_edit(&self.simulation, self.grid, self.last_event, edit);
                self.message = None;
                self.faulted = false;
            }
            Err(refused) => {
                self.message = Some(format!("the running simulation refused the edit: {refused}"));
            }
        }
    }
}

fn row_of(simulation: &Simulation, event: &Event, dt_index: u64) -> EventRow {
    EventRow {
        event: *event,
        a_key: simulation.key(event.a),
        b_key: event.b.map(|b| simulation.key(b)),
        a_label: simulation.label(event.a).to_owned(),
        b_label: event.b.map_or(String::new(), |b| simulation.label(b).to_owned()),
        dt_index,
    }
}
