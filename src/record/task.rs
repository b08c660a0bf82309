//! What a recorder is working on, one portion at a time.

use super::command::{Goal, Of};
use super::grid::StepGrid;
use super::moment::Moment;
use super::run::{Run, Slice, Stop};
use crate::sim::EventKind;

/// What is being worked on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Task {
    #[default]
    Idle,
    Steps {
        dt: f64,
        left: u32,
    },
    ToEvent {
        dt: f64,
        of: Of,
        /// Δt without an event so far.
        empty: u32,
        /// What was shown when it began.
        from: Option<(Moment, StepGrid)>,
    },
    Until {
        dt: f64,
        goal: Goal,
        /// Δt in which the goal came no nearer.
        waited: u32,
    },
    Finish,
    Play(Play),
}

/// Playing, by a clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Play {
    dt: f64,
    /// Model seconds per wall second, ≠ 0.
    speed: f64,
    range: Option<(f64, f64)>,
    /// Model seconds that have come due since the last end of a Δt.
    due: f64,
    /// Model seconds gone through, and those that were given up, for the machine cannot follow.
    played: f64,
    lost: f64,
    /// Whether what is shown was inside a Δt at the beginning, and counts as due.
    has_begun: bool,
}

/// Wall-clock seconds of playing that may wait to be simulated. A machine that cannot follow falls behind
/// by this much and then plays slower, with the same Δt.
const MOST_DUE: f64 = 0.1;

/// Wall-clock seconds between two pictures: a Δt that takes longer to play is gone through in between.
const PICTURE: f64 = 1.0 / 60.0;

/// Δt after which waiting for rest ends, so that a scene in which that never happens does not run for ever.
const MOST_EMPTY_STEPS: u32 = 100_000;

/// Δt without an event after which "next event" stops looking: some minutes of most scenes.
const MOST_STEPS_TO_EVENT: u32 = 10_000;

/// Empty Δt after which it looks again whether anything moves.
const STEPS_BETWEEN_LOOKS: u32 = 64;

impl Task {
    /// Does one Δt, or what the budget allows; false when a task cannot go on for now.
    pub(super) fn advance(&mut self, run: &mut Run, budget: &mut u32) -> bool {
        match self {
            Self::Idle => {}
            Self::Steps { dt, left } => {
                if run.slice(*dt, Stop::NOWHERE, budget) == Slice::Done {
                    *left -= 1;
                    if *left == 0 {
                        *self = Self::Idle;
                    }
                }
            }
            Self::ToEvent { dt, of, empty, from } => {
                let (moment, grid) = *from.get_or_insert((run.cursor, run.grid));
                match run.slice(*dt, Stop::AT_EVENTS, budget) {
                    Slice::Event if is_reached(run, *of) => *self = Self::Idle,
                    Slice::Done => match no_event(run, *empty) {
                        None => *empty += 1,
                        Some(why) => {
                            if run.recording.from().is_not_after(moment) {
                                run.show(moment, grid);
                            }
                            run.message = Some(why.into());
                            *self = Self::Idle;
                        }
                    },
                    Slice::Event | Slice::Stopped | Slice::Pause => {}
                }
            }
            Self::Until { dt, goal, waited } => {
                if goal.advance(run, *dt, budget, waited) {
                    *self = Self::Idle;
                } else if let Some(why) = goal.why_in_vain(run) {
                    run.message = Some(format!("{}: {why}", goal.missing()).into());
                    *self = Self::Idle;
                } else if *waited >= MOST_EMPTY_STEPS {
                    let text = format!("{} within {MOST_EMPTY_STEPS} Δt", goal.missing());
                    run.message = Some(text.into());
                    *self = Self::Idle;
                }
            }
            Self::Finish => match run.grid.open {
                Some((start, end)) => {
                    if run.slice(end - start, Stop::NOWHERE, budget) == Slice::Done {
                        *self = Self::Idle;
                    }
                }
                None => *self = Self::Idle,
            },
            Self::Play(play) => return play.advance(run, budget).unwrap_or_else(|| self.end()),
        }
        true
    }

    fn end(&mut self) -> bool {
        *self = Self::Idle;
        true
    }
}

/// Why "next event" stops looking after so many empty Δt and this one.
fn no_event(run: &mut Run, empty: u32) -> Option<String> {
    let is_certain = run.is_settled() && run.simulation.is_over();
    // A look at all bodies costs.
    if is_certain || (empty.is_multiple_of(STEPS_BETWEEN_LOOKS) && run.is_over()) {
        return Some(format!("there is no event after this: {}", why_over(run)));
    }
    (empty >= MOST_STEPS_TO_EVENT).then(|| format!("no event within {MOST_STEPS_TO_EVENT} Δt after this"))
}

/// Why nothing will happen any more.
fn why_over(run: &Run) -> &'static str {
    if run.is_over() {
        "nothing moves, and no force acts on what could"
    } else {
        "what moves flies on and meets nothing any more"
    }
}

fn is_reached(run: &Run, of: Of) -> bool {
    run.recording.ledger.get(run.cursor.event).is_some_and(|row| of.holds(row))
}

impl Goal {
    /// What has not happened where the goal is given up.
    fn missing(self) -> &'static str {
        match self {
            Self::Rest => "no rest",
            Self::Time(_) | Self::Events(_) | Self::Event { .. } => "no event",
        }
    }

    /// Why nothing will happen any more that it waits for, where that is known.
    fn why_in_vain(self, run: &mut Run) -> Option<&'static str> {
        let waits = matches!(self, Self::Rest | Self::Events(_));
        (waits && run.is_live() && run.simulation.is_over()).then(|| why_over(run))
    }

    /// Goes on, and counts the Δt in `waited` that brought the goal no nearer; whether it is reached.
    fn advance(&mut self, run: &mut Run, dt: f64, budget: &mut u32, waited: &mut u32) -> bool {
        match self {
            Self::Time(time) => {
                let stop = Stop { at_events: false, time: *time };
                if run.cursor.time < *time && run.slice(dt, stop, budget) == Slice::Pause {
                    return false;
                }
                run.cursor.time >= *time
            }
            Self::Events(left) => {
                match run.slice(dt, Stop::AT_EVENTS, budget) {
                    Slice::Event => (*left, *waited) = (left.saturating_sub(1), 0),
                    slice => *waited += u32::from(slice == Slice::Done),
                }
                *left == 0
            }
            Self::Event { number, time } => {
                let stop = Stop { at_events: true, time: *time };
                let is_missing = run.cursor.event < *number
                    && matches!(run.slice(dt, stop, budget), Slice::Done | Slice::Stopped)
                    && run.cursor.time >= *time;
                is_missing || run.cursor.event >= *number
            }
            Self::Rest => {
                if run.is_at_rest() {
                    return true;
                }
                // A look at all bodies costs: only where one may have come to rest.
                while *budget > 0 && !run.is_faulted() {
                    let slice = run.slice(dt, Stop::AT_EVENTS, budget);
                    *waited += u32::from(slice == Slice::Done);
                    if slice == Slice::Done || (slice == Slice::Event && ends_motion(run)) {
                        return run.is_at_rest();
                    }
                }
                false
            }
        }
    }
}

/// Whether the event shown is one after which a body may lie still.
fn ends_motion(run: &Run) -> bool {
    let row = run.recording.ledger.get(run.cursor.event);
    row.is_some_and(|row| {
        matches!(row.event.kind, EventKind::Rest | EventKind::GroupRest | EventKind::Captured)
    })
}

impl Play {
    pub(super) fn new(dt: f64, speed: f64, range: Option<(f64, f64)>) -> Self {
        Self { dt, speed, range, due: 0.0, played: 0.0, lost: 0.0, has_begun: false }
    }

    /// Notes that wall-clock time has passed.
    pub(super) fn elapse(&mut self, wall_s: f64) {
        let wanted = self.due + wall_s.max(0.0) * self.speed.abs();
        self.due = wanted.min(MOST_DUE * self.speed.abs() + self.dt);
        self.lost += wanted - self.due;
    }

    /// Model seconds that were gone through, and that were given up, since the last call.
    pub(super) fn take_pace(&mut self) -> (f64, f64) {
        (std::mem::take(&mut self.played), std::mem::take(&mut self.lost))
    }

    /// One Δt, or what the budget allows; `Some(false)` when nothing is due, `None` at the end of what can be played.
    fn advance(&mut self, run: &mut Run, budget: &mut u32) -> Option<bool> {
        self.begin(run);
        let from = run.cursor.time;
        if self.due >= self.dt {
            let is_through =
                if self.speed > 0.0 { self.step(run, budget) } else { self.step_back(run, budget)? };
            self.played += (run.cursor.time - from).abs();
            return (!is_through || self.loop_over(run)).then_some(true);
        }
        let glides = PICTURE * self.speed.abs() < self.dt && self.due > 0.0;
        let goes_on = glides && self.glide(run, budget);
        self.played += (run.cursor.time - from).abs();
        Some(goes_on)
    }

    /// Goes on in the Δt that is due; whether it is through.
    fn step(&mut self, run: &mut Run, budget: &mut u32) -> bool {
        let is_through = run.slice(self.dt, Stop::NOWHERE, budget) == Slice::Done;
        if is_through {
            self.due = (self.due - self.dt).max(0.0);
        }
        is_through
    }

    /// Goes through the Δt before; whether there was one, and `None` where playing ends at the first.
    fn step_back(&mut self, run: &mut Run, budget: &mut u32) -> Option<bool> {
        *budget = budget.saturating_sub(1);
        if run.step_back() {
            self.due -= self.dt;
            return Some(true);
        }
        self.begin_again(run).then_some(false)
    }

    /// What is gone of an open Δt has come due.
    fn begin(&mut self, run: &Run) {
        if let Some((start, end)) = run.grid.open.filter(|_| !self.has_begun) {
            let now = run.cursor.time;
            self.due += if self.speed > 0.0 { now - start } else { end - now };
        }
        self.has_begun = true;
    }

    /// Shows a place inside the Δt, once that is known; whether there is more to do for that at once.
    fn glide(&mut self, run: &mut Run, budget: &mut u32) -> bool {
        let (start, end) = run.grid.open.unwrap_or_else(|| {
            let now = run.cursor.time;
            if self.speed > 0.0 { (now, now + self.dt) } else { (now - self.dt, now) }
        });
        let wanted = if self.speed > 0.0 { (start + self.due).min(end) } else { (end - self.due).max(start) };
        let slice = if run.recording.end.time < wanted {
            run.slice(self.dt, Stop::NOWHERE, budget)
        } else {
            Slice::Done
        };
        if !run.is_faulted() {
            run.seek(wanted.min(run.recording.end.time));
        }
        slice != Slice::Done
    }

    /// At the end of the range back to its beginning, or the other way; false where playing ends.
    fn loop_over(&self, run: &mut Run) -> bool {
        let is_over = |(from, to)| {
            if self.speed > 0.0 { run.cursor.time >= to } else { run.cursor.time <= from }
        };
        if self.range.is_some_and(is_over) { self.begin_again(run) } else { true }
    }

    /// Goes to where the range begins, backwards its end, as far as it is recorded; whether any of it is.
    fn begin_again(&self, run: &mut Run) -> bool {
        let Some((from, to)) = self.range else { return false };
        run.seek(if self.speed > 0.0 { from } else { to.min(run.recording.end.time) });
        let is_inside = if self.speed > 0.0 { run.cursor.time < to } else { run.cursor.time > from };
        if !is_inside {
            run.message = Some("nothing is recorded of the range that is to be played".into());
        }
        is_inside
    }
}
