//! A loaded simulation on its grid of Δt, with the recording of what it has done, and the moment of it that is shown.

use std::sync::Arc;

use super::cost::Cost;
use super::drift::Drift;
use super::frame::WorstOverlap;
use super::grid::StepGrid;
use super::ledger::{EventRow, Names};
use super::limits::PREDICTIONS;
use super::moment::Moment;
use super::overlaps::Overlaps;
use super::recording::{Future, Recording};
use super::ticks::Tick;
use crate::scene::Scene;
use crate::sim::{Counters, Event, Fault, Progress, SimEdit, Simulation};

/// Portions of work on what is left at one time; more is no ordinary scene.
const MOST_AT_ONCE: u32 = 10_000;

/// A loaded simulation with its Δt grid and its past.
#[derive(Debug)]
pub(super) struct Run {
    pub(super) simulation: Simulation,
    pub(super) scene: Arc<Scene>,
    /// The Δt around what is shown.
    pub(super) grid: StepGrid,
    /// What is shown: somewhere in the recording.
    pub(super) cursor: Moment,
    /// Where the simulation stands: at the cursor, or on its way there.
    pub(super) at: Moment,
    /// How many recorded edits the simulation has behind it.
    pub(super) applied: usize,
    pub(super) recording: Recording,
    /// What an edit in the past has replaced, until the next edit.
    dropped: Option<Replaced>,
    pub(super) drift: Drift,
    pub(super) overlaps: Overlaps,
    /// Why the last edit that was refused was: until another one is, for frames come less often than commands.
    pub(super) refused: Option<Arc<str>>,
    /// What there is to say of the last command otherwise.
    pub(super) message: Option<Arc<str>>,
    /// The fault that stopped it.
    fault: Option<Stopped>,
    /// Whether the simulation has stopped where it was between two events.
    is_between: bool,
    /// What the simulation counted at the last event that is known.
    counted: Counters,
}

/// A fault, and the moment that it allows nothing after.
#[derive(Debug)]
pub(super) struct Stopped {
    at: Moment,
    pub(super) why: Arc<str>,
}

/// What an edit in the past has replaced.
#[derive(Debug)]
struct Replaced {
    future: Future,
    /// How the books were off at the end of it, how bodies overlapped, and what was counted at its last event.
    drift: Drift,
    overlaps: Overlaps,
    counted: Counters,
}

/// Where to stop inside a Δt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// At events that are recorded; one that is simulated always ends a slice of work.
    pub(super) at_events: bool,
    /// Not beyond this time, s.
    pub(super) time: f64,
}

impl Stop {
    pub(super) const NOWHERE: Self = Self { at_events: false, time: f64::INFINITY };
    pub(super) const AT_EVENTS: Self = Self { at_events: true, time: f64::INFINITY };
}

/// What became of a Δt in a slice of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slice {
    /// The Δt is done.
    Done,
    /// An event was reached.
    Event,
    /// The time to stop at was reached inside the Δt.
    Stopped,
    /// The slice is used up.
    Pause,
}

impl Run {
    pub(super) fn new(mut simulation: Simulation, scene: Arc<Scene>, budget: usize) -> Self {
        let grid = StepGrid::new();
        let recording = Recording::new(&mut simulation, grid, budget);
        let mut run = Self {
            overlaps: Overlaps::default(),
            cursor: recording.end,
            at: recording.end,
            simulation,
            scene,
            grid,
            applied: 0,
            recording,
            dropped: None,
            drift: Drift::default(),
            refused: None,
            message: None,
            fault: None,
            is_between: false,
            counted: Counters::default(),
        };
        run.look_for_overlap();
        run
    }

    /// The row of the event that is shown, where that is the moment right after one.
    pub(super) fn event_shown(&self) -> Option<&Arc<EventRow>> {
        let now = self.cursor;
        let row = self.recording.ledger.get(now.event)?;
        (!now.is_over && row.event.time == now.time).then_some(row)
    }

    /// Whether the simulation is at what is shown.
    pub(super) fn is_settled(&self) -> bool {
        self.at == self.cursor
    }

    /// Whether what is shown is the end of what is known, and the simulation there.
    pub(super) fn is_live(&self) -> bool {
        self.is_settled() && self.at == self.recording.end
    }

    /// Whether a fault keeps it from going on from what is shown.
    pub(super) fn is_faulted(&self) -> bool {
        self.fault_here().is_some()
    }

    pub(super) fn fault_here(&self) -> Option<&Stopped> {
        self.fault.as_ref().filter(|fault| fault.at == self.cursor)
    }

    /// Goes on in the open Δt, or opens one, until its end, a stop on the way, or the end of the budget: through what is
    /// recorded by looking it up, and beyond by simulating.
    pub(super) fn slice(&mut self, dt: f64, stop: Stop, budget: &mut u32) -> Slice {
        if *budget == 0 {
            return Slice::Pause;
        }
        *budget -= 1;
        let Some(end) = self.open_step(dt) else {
            self.settle();
            return Slice::Pause;
        };
        let until = end.min(stop.time).max(self.cursor.time);
        if stop.at_events
            && let Some(next) = self.next_recorded(until)
        {
            self.cursor = next;
            return Slice::Event;
        }
        if self.recording.knows(until) {
            self.cursor = self.recording.moment_at(until);
            if until < end {
                return Slice::Stopped;
            }
            self.grid.close();
            self.recording.ticks.note(Tick { at: self.cursor, grid: self.grid });
            return Slice::Done;
        }
        if !self.go_to_end() {
            return Slice::Pause;
        }
        self.simulate(end, until)
    }

    /// The next recorded event, if it is not after `end`.
    fn next_recorded(&self, end: f64) -> Option<Moment> {
        let event = self.cursor.event + 1;
        let time = self.recording.ledger.get(event)?.event.time;
        (time <= end).then_some(Moment::right_after(event, time))
    }

    /// Goes on simulating at the end of what is known, towards the end of the Δt.
    fn simulate(&mut self, end: f64, until: f64) -> Slice {
        // A method that steps by Δt must know its end before it is asked to stop inside it.
        self.simulation.begin(end);
        self.simulation.begin(until);
        let progress = self.simulation.work(PREDICTIONS);
        self.reached(&progress);
        let slice = match progress {
            Ok(Progress::Event(event)) => {
                self.note(&event);
                self.recording.note_keyframe(&self.simulation, self.counted.segments);
                Slice::Event
            }
            Ok(Progress::Working) => Slice::Pause,
            Ok(Progress::Done) if self.at.time < end => Slice::Stopped,
            Ok(Progress::Done) => {
                self.grid.close();
                self.recording.end_grid = self.grid;
                self.recording.note_tick();
                self.recording.note_keyframe(&self.simulation, self.simulation.counters().segments);
                Slice::Done
            }
            Err(fault) => {
                self.stop_at(&fault);
                Slice::Pause
            }
        };
        self.stay_within_budget();
        slice
    }

    /// The simulation has gone on: so far is known now, and shown.
    fn reached(&mut self, progress: &Result<Progress, Fault>) {
        self.arrive(progress);
        self.recording.take_motion(&mut self.simulation);
        (self.recording.end, self.recording.end_grid) = (self.at, self.grid);
        self.cursor = self.at;
        self.is_between = matches!(progress, Ok(Progress::Working));
    }

    /// Where the simulation stands after some work.
    pub(super) fn arrive(&mut self, progress: &Result<Progress, Fault>) {
        if let Ok(Progress::Event(event)) = progress {
            self.at.event = event.seq;
        }
        self.at.time = self.simulation.time();
        self.at.is_over = matches!(progress, Ok(Progress::Done));
    }

    /// Work that was given up may have stopped between two things that happen at one time, which is no moment to come back
    /// to: does what is left at that time.
    pub(super) fn finish_moment(&mut self) {
        let mut left = MOST_AT_ONCE;
        while std::mem::take(&mut self.is_between) && self.is_live() && left > 0 {
            left -= 1;
            self.simulation.begin(self.at.time);
            let progress = self.simulation.work(PREDICTIONS);
            self.reached(&progress);
            match progress {
                Ok(Progress::Event(event)) => self.note(&event),
                Ok(Progress::Working | Progress::Done) => {}
                Err(fault) => self.stop_at(&fault),
            }
        }
    }

    /// Notes a fault: nothing goes on from here but back.
    pub(super) fn stop_at(&mut self, fault: &Fault) {
        self.fault = Some(Stopped { at: self.at, why: fault.to_string().into() });
    }

    /// The end of the Δt that is open, or is now opened; `None` where another Δt than before makes another future and the
    /// simulation has to be there first.
    fn open_step(&mut self, dt: f64) -> Option<f64> {
        if let Some((_, end)) = self.grid.open {
            return Some(end);
        }
        let mut grid = self.grid;
        grid.open(self.cursor.time, dt);
        let end = grid.open.map_or(self.cursor.time, |(_, end)| end);
        let is_known = self.cursor != self.recording.end;
        let divides_anew = is_known
            && self.recording.ticks.around(self.cursor.time).1.is_none_or(|next| next.at.time != end);
        if divides_anew && self.simulation.method().depends_on_dt() {
            if !self.is_settled() {
                return None;
            }
            self.drop_future();
        } else if divides_anew {
            self.recording.ticks.split_off(self.cursor);
        }
        self.grid = grid;
        Some(end)
    }

    /// Forgets what lies after what is shown, where the simulation stands.
    fn drop_future(&mut self) {
        let future = self.recording.split_off(self.cursor);
        self.recording.ledger.rename(Arc::new(Names::of(&self.simulation)));
        let lost = future.edit_count();
        if lost > 0 {
            self.message = Some(format!("{lost} edit(s) made later no longer apply").into());
        }
        self.fault = None;
        let drift = self.drift.clone();
        self.drift.drop_after(self.cursor.event, &self.simulation);
        let overlaps = self.overlaps.clone();
        self.overlaps.drop_after(self.cursor);
        let counted = std::mem::replace(&mut self.counted, self.simulation.counters());
        self.dropped = Some(Replaced { future, drift, overlaps, counted });
    }

    /// Whether an edit in the past has replaced something that can be brought back.
    pub(super) fn can_bring_back(&self) -> bool {
        self.dropped.is_some()
    }

    /// Bytes that are kept of the run: the recording, and what an edit has replaced.
    pub(super) fn bytes(&self) -> usize {
        self.recording.bytes() + self.dropped.as_ref().map_or(0, |replaced| replaced.future.bytes())
    }

    /// Drops, where all takes too much, first what an edit has replaced, then the oldest.
    fn stay_within_budget(&mut self) {
        if self.dropped.is_some() && self.bytes() > self.recording.budget() {
            self.dropped = None;
        }
        if self.recording.stay_within_budget() {
            self.forget_unreachable();
        }
    }

    pub(super) fn set_budget(&mut self, bytes: usize) {
        self.dropped.take_if(|replaced| self.recording.bytes() + replaced.future.bytes() > bytes);
        self.recording.set_budget(bytes);
        self.forget_unreachable();
        let from = self.recording.from();
        if !from.is_not_after(self.cursor) {
            self.show(from, self.grid_at(from));
        }
    }

    /// What was replaced continues from a moment: once that is dropped to stay within the budget, it continues nothing.
    fn forget_unreachable(&mut self) {
        let from = self.recording.from();
        self.dropped.take_if(|replaced| !from.is_not_after(replaced.future.from));
    }

    /// Takes the last edit in the past back: what it replaced is the future again.
    pub(super) fn bring_back(&mut self) {
        let Some(Replaced { future, drift, overlaps, counted }) = self.dropped.take() else {
            self.message = Some("no edit in the past has replaced anything".into());
            return;
        };
        let moment = future.from;
        (self.drift, self.overlaps, self.counted) = (drift, overlaps, counted);
        self.recording.put_back(future);
        self.show(moment, self.grid_at(moment));
        self.fault = None;
        self.rewind();
    }

    /// Enters an event into the recording.
    fn note(&mut self, event: &Event) {
        let counters = self.simulation.counters();
        self.recording.note_event(event, Cost::between(&self.counted, &counters));
        self.counted = counters;
        self.drift.note(&self.simulation, event);
    }

    /// Looks for overlaps where the simulation stands. It costs a look through the tiles, so it is done when a frame is made.
    pub(super) fn look_for_overlap(&mut self) {
        let is_of_stepped = self.simulation.counters().steps > 0;
        self.overlaps.note(self.at, WorstOverlap { depth: self.simulation.worst_overlap(), is_of_stepped });
    }

    /// Changes the scene at what is shown, where the simulation stands, and records what was accepted. What was recorded
    /// for later is another future.
    pub(super) fn edit(&mut self, mut edits: Vec<SimEdit>) {
        let mut refusal = None;
        let (at_end, counted) = (self.is_live(), self.simulation.counters());
        let mut outcomes = self.simulation.apply_all(&edits).into_iter();
        edits.retain(|_| match outcomes.next() {
            Some(Err(refused)) => {
                refusal = Some(refused.to_string().into());
                false
            }
            _ => true,
        });
        self.refused = refusal.or(self.refused.take());
        self.message = None;
        if edits.is_empty() {
            return;
        }
        self.dropped = None;
        if !at_end {
            self.drop_future();
            self.counted = counted;
        }
        self.recording.take_motion(&mut self.simulation);
        self.recording.end_grid = self.grid;
        self.recording.note_edits(&self.simulation, edits);
        self.applied = self.recording.edits().len();
        self.fault = None;
        self.stay_within_budget();
    }
}
