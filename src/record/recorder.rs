//! The recorder: carries out commands on a simulation, step by step, and keeps what is needed to go back.
//! It has no clock and never blocks: a runner calls [`RunRecorder::work`] as often as it likes.

use std::collections::VecDeque;
use std::sync::Arc;

use super::replay::Replay;
use super::run::{Run, Slice};
use super::{RunCommand, RunState};
use crate::scene::{Diagnostic, Scene};
use crate::sim::{Method, SimEdit, Simulation};

/// Drives one simulation.
#[derive(Debug, Default)]
pub(super) struct RunRecorder {
    pub(super) run: Option<Run>,
    /// How simulations are stepped.
    pub(super) method: Method,
    /// Why the scene cannot be simulated, or geometric warnings of the start.
    pub(super) problems: Arc<Vec<Diagnostic>>,
    task: Task,
    waiting: VecDeque<RunCommand>,
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
        /// Δt without an event so far.
        empty: u32,
    },
    Finish,
    Back(Replay),
    Play {
        dt: f64,
        speed: f64,
        /// Model seconds that have come due and are not yet simulated.
        due: f64,
        /// Model seconds that were given up, for the machine cannot follow.
        lost: f64,
    },
}

/// Wall-clock seconds of playing that may wait to be simulated. A machine that cannot follow falls behind
/// by this much and then plays slower, with the same Δt.
const MOST_DUE: f64 = 0.1;

/// Δt without an event after which "next event" stops looking, so that a scene in which nothing happens
/// any more does not run for ever.
const MOST_EMPTY_STEPS: u32 = 100_000;

impl RunRecorder {
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
            // One that is made while going back is meant for where that leads to.
            RunCommand::Edit(edits) if !self.goes_back() => self.edit(edits),
            other => {
                if matches!(self.task, Task::Play { .. }) {
                    self.task = Task::Idle;
                }
                self.waiting.push_back(other);
            }
        }
    }

    /// Whether it goes back, or will when what waits is done.
    fn goes_back(&self) -> bool {
        let back = |command: &RunCommand| {
            matches!(command, RunCommand::StepBack | RunCommand::EventBack | RunCommand::GoTo { .. })
        };
        matches!(self.task, Task::Back(_)) || self.waiting.iter().any(back)
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

    /// Notes that wall-clock time has passed, while playing.
    pub(super) fn elapse(&mut self, wall_s: f64) {
        if let Task::Play { dt, speed, due, lost } = &mut self.task {
            let wanted = *due + wall_s.max(0.0) * *speed;
            *due = wanted.min(MOST_DUE * *speed + *dt);
            *lost += wanted - *due;
        }
    }

    /// Model seconds that playing has given up since the last call.
    pub(super) fn take_lost(&mut self) -> f64 {
        match &mut self.task {
            Task::Play { lost, .. } => std::mem::take(lost),
            _ => 0.0,
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

    /// Does one Δt of the task, or what the budget allows; false when a task cannot go on for now.
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
            Task::Back(replay) => {
                *budget -= 1;
                if run.replay(replay) {
                    *task = Task::Idle;
                }
            }
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
                self.task = Task::Play { dt, speed, due: 0.0, lost: 0.0 };
            }
            RunCommand::StepBack => self.task = run.step_back().map_or(Task::Idle, Task::Back),
            RunCommand::EventBack => self.task = run.event_back().map_or(Task::Idle, Task::Back),
            RunCommand::GoTo { event } => {
                self.task = run.back_to_event(event).map_or(Task::Idle, Task::Back);
            }
            RunCommand::Edit(edits) => run.edit(edits),
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

    fn load(&mut self, scene: Arc<Scene>) {
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

    fn edit(&mut self, edits: Vec<SimEdit>) {
        if let Some(run) = &mut self.run {
            run.edit(edits);
        }
    }
}
