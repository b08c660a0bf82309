//! The past of a run: snapshots, ticks, events and edits, enough to go back to any of them and to come
//! out with the same bits. Between snapshots it simulates again.

use super::recorder::{Rows, Run, StepGrid};
use crate::sim::{Event, SimEdit, Simulation, Snapshot};

/// Memory that snapshots may take, bytes. Beyond it every second one is dropped, so that the intervals to
/// simulate again grow longer.
const SNAPSHOT_BUDGET: usize = 128 << 20;
/// About what one dynamic body takes in a snapshot, bytes: its columns, predictions and tiles.
const BODY_SIZE: usize = 1024;
/// Events and ticks that can be gone back to.
const LONGEST_PAST: usize = 1_000_000;
/// Segments to simulate again at most between two snapshots, for a scene of few bodies.
const SEGMENTS_APART: u64 = 500;

/// A point of a run: after so many events, at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    event: u64,
    time: f64,
}

#[derive(Debug)]
struct Keyframe {
    at: Point,
    snapshot: Snapshot,
    grid: StepGrid,
    segments: u64,
    /// Recorded edits that it contains.
    edits: usize,
}

#[derive(Debug)]
struct RecordedEdit {
    at: Point,
    edit: SimEdit,
}

/// End of a Δt, with the grid as it stands there.
#[derive(Clone, Copy, Debug)]
struct Tick {
    at: Point,
    grid: StepGrid,
}

#[derive(Debug)]
pub(super) struct History {
    keyframes: Vec<Keyframe>,
    /// The start, then the end of every Δt.
    ticks: Vec<Tick>,
    /// Time of each event; the first is number `first_event`.
    event_times: Vec<f64>,
    first_event: u64,
    /// In the order of their stamps.
    edits: Vec<RecordedEdit>,
    /// How many of them the simulation has behind it now.
    applied: usize,
}

impl History {
    pub(super) fn new(simulation: &Simulation, grid: StepGrid) -> Self {
        let at = Point { event: 0, time: simulation.time() };
        Self {
            keyframes: vec![Keyframe { at, snapshot: simulation.snapshot(), grid, segments: 0, edits: 0 }],
            ticks: vec![Tick { at, grid }],
            event_times: Vec::new(),
            first_event: 1,
            edits: Vec::new(),
            applied: 0,
        }
    }

    pub(super) fn can_go_back(&self, simulation: &Simulation) -> bool {
        self.ticks.first().is_some_and(|first| first.at.time < simulation.time())
    }

    pub(super) fn note_event(&mut self, event: &Event) {
        if event.seq == self.first_event + self.event_times.len() as u64 {
            self.event_times.push(event.time);
        }
        if self.event_times.len() > LONGEST_PAST {
            self.event_times.drain(..LONGEST_PAST / 4);
            self.first_event += (LONGEST_PAST / 4) as u64;
        }
    }

    pub(super) fn note_tick(&mut self, simulation: &Simulation, grid: StepGrid, event: u64) {
        let at = Point { event, time: simulation.time() };
        let place = self.ticks.partition_point(|tick| tick.at.time < at.time);
        match self.ticks.get_mut(place) {
            Some(again) if again.at.time == at.time => *again = Tick { at, grid },
            _ => self.ticks.push(Tick { at, grid }),
        }
        if self.ticks.len() > LONGEST_PAST {
            self.ticks.drain(..LONGEST_PAST / 4);
        }
        let segments = simulation.counters().segments;
        let apart = SEGMENTS_APART.max(2 * simulation.dynamic_count() as u64);
        if self.keyframes.last().is_none_or(|last| segments >= last.segments + apart) {
            self.keep(simulation, grid, at);
        }
    }

    /// Time of the first tick after `now`.
    fn next_tick(&self, now: f64) -> Option<f64> {
        self.ticks.get(self.ticks.partition_point(|tick| tick.at.time <= now)).map(|tick| tick.at.time)
    }

    /// Forgets what another Δt than before, from now to `end`, makes untrue: the ticks to come, and where
    /// the method depends on Δt the whole future. Gives the number of edits in it.
    pub(super) fn divide_time_anew(&mut self, simulation: &Simulation, event: u64, end: f64) -> usize {
        let at = Point { event, time: simulation.time() };
        if self.next_tick(at.time).is_none_or(|next| next == end) {
            return 0;
        }
        if simulation.method().depends_on_dt() {
            let lost = self.edits.len() - self.applied;
            self.forget_after(at);
            return lost;
        }
        self.ticks.retain(|tick| tick.at.time <= at.time);
        0
    }

    /// Records an edit made now. What was recorded for later is another future and is forgotten.
    pub(super) fn note_edit(&mut self, simulation: &Simulation, grid: StepGrid, event: u64, edit: &SimEdit) {
        let at = Point { event, time: simulation.time() };
        self.forget_after(at);
        self.edits.push(RecordedEdit { at, edit: edit.clone() });
        self.applied = self.edits.len();
        self.keep(simulation, grid, at);
    }

    fn forget_after(&mut self, at: Point) {
        self.keyframes.retain(|key| key.at.time <= at.time && key.at.event <= at.event);
        self.ticks.retain(|tick| tick.at.time <= at.time && tick.at.event <= at.event);
        self.edits.truncate(self.applied);
        self.event_times.truncate((at.event + 1).saturating_sub(self.first_event) as usize);
    }

    fn keep(&mut self, simulation: &Simulation, grid: StepGrid, at: Point) {
        let segments = simulation.counters().segments;
        self.keyframes.push(Keyframe {
            at,
            snapshot: simulation.snapshot(),
            grid,
            segments,
            edits: self.applied,
        });
        let size = BODY_SIZE * (simulation.dynamic_count() + 8);
        if self.keyframes.len() > 2 && self.keyframes.len() * size > SNAPSHOT_BUDGET {
            // The start and the newest stay.
            let last = self.keyframes.len() - 1;
            let mut index = 0;
            self.keyframes.retain(|_| {
                index += 1;
                index % 2 == 1 || index > last
            });
        }
    }
}

impl Run {
    /// Back to the beginning of the open Δt, or else of the last one.
    pub(super) fn step_back(&mut self) {
        let now = self.simulation.time();
        let Some(index) = self.history.ticks.iter().rposition(|tick| tick.at.time < now) else { return };
        let tick = self.history.ticks[index];
        let before = index.checked_sub(1).map(|index| self.history.ticks[index]);
        self.replay(before.unwrap_or(tick), |run| {
            if let Some(before) = before {
                run.grid = tick.grid.reopened(before.at.time, tick.at.time);
            }
            run.run_to(tick.at);
            run.grid = tick.grid;
        });
    }

    /// Back to the event before the one now looked at; the Δt around it is open then.
    pub(super) fn event_back(&mut self) {
        let history = &self.history;
        // After the end of a Δt the last event is itself the one before.
        let at_event =
            history.time_of(self.last_event) == Some(self.simulation.time()) && self.grid.open.is_some();
        let target = if at_event { self.last_event.saturating_sub(1) } else { self.last_event };
        if self.history.time_of(target).is_none() {
            self.message = Some("there is no recorded event before this one".into());
            return;
        }
        self.back_to_event(target);
    }

    /// Back to an event that was reached before; the Δt around it is open then.
    pub(super) fn back_to_event(&mut self, target: u64) {
        let history = &self.history;
        let Some(time) = history.time_of(target) else { return };
        let Some(index) =
            history.ticks.iter().rposition(|tick| tick.at.event < target && tick.at.time <= time)
        else {
            return;
        };
        let (tick, after) = (history.ticks[index], history.ticks.get(index + 1).copied());
        let around = match after {
            Some(after) => after.grid.reopened(tick.at.time, after.at.time),
            None => self.grid,
        };
        self.replay(tick, |run| {
            run.grid = around;
            run.run_to(Point { event: target, time });
        });
    }

    /// Puts the run back to where it was at `from` and lets `then` go on from there, with the table filled
    /// by what it passes.
    fn replay(&mut self, from: Tick, then: impl FnOnce(&mut Self)) {
        let keyframes = &self.history.keyframes;
        let usable = |key: &Keyframe| key.at.time <= from.at.time && key.at.event <= from.at.event;
        let Some(key) = keyframes.iter().rev().find(|key| usable(key)) else { return };
        self.simulation.restore(&key.snapshot);
        self.grid = key.grid;
        self.last_event = key.at.event;
        self.drift.rewind(&self.simulation, key.at.event);
        self.history.applied = key.edits;
        self.run_to(from.at);
        self.rows = Rows::default();
        then(self);
        self.faulted = false;
        self.message = None;
    }

    /// Simulates again up to a point, Δt by Δt as before, with the edits on the way applied at their stamps.
    fn run_to(&mut self, target: Point) {
        loop {
            let now = self.simulation.time();
            let open = self.grid.open.map(|(_, end)| end).filter(|end| *end > now);
            let end = self.history.next_tick(now).or(open).unwrap_or(target.time);
            self.begin_until(end, target.time);
            if self.last_event >= target.event && self.simulation.time() >= target.time {
                return;
            }
            match self.simulation.next_event() {
                Ok(Some(event)) => self.note(&event),
                Ok(None) if self.simulation.time() < target.time => {}
                Ok(None) | Err(_) => return,
            }
        }
    }

    /// Begins the Δt that ends at `end`, or goes on in it, up to `until`. Recorded edits that are due are
    /// applied first.
    pub(super) fn begin_until(&mut self, end: f64, until: f64) {
        let until = until.min(end);
        // A method that steps by Δt must know its end before it is asked to stop inside it.
        self.simulation.begin(end);
        self.apply_due_edits(until);
        // An edit ends the Δt; the rest of it is begun anew.
        self.simulation.begin(end);
        self.simulation.begin(until);
    }

    /// Applies the recorded edits whose turn it is, up to a time, each exactly where it was made.
    fn apply_due_edits(&mut self, until: f64) {
        while let Some(next) = self.history.edits.get(self.history.applied) {
            if next.at.event != self.last_event || next.at.time > until {
                return;
            }
            let edit = next.edit.clone();
            if next.at.time > self.simulation.time() {
                self.simulation.begin(next.at.time);
                // Between its event and its stamp there is none.
                let _ = self.simulation.finish(&mut |_, _| {});
            }
            self.history.applied += 1;
            // It was accepted in this very state before.
            let _ = self.simulation.apply(&edit);
        }
    }
}

impl History {
    fn time_of(&self, event: u64) -> Option<f64> {
        self.event_times.get(usize::try_from(event.checked_sub(self.first_event)?).ok()?).copied()
    }
}
