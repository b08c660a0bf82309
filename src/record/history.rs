//! The past of a run: snapshots, ticks, events and edits, enough to go back to any of them and to come
//! out with the same bits.

use super::grid::StepGrid;
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

/// A moment of a run: after so many events, at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moment {
    pub(super) event: u64,
    /// s.
    pub(super) time: f64,
}

#[derive(Debug)]
pub(super) struct Keyframe {
    pub(super) at: Moment,
    pub(super) snapshot: Snapshot,
    pub(super) grid: StepGrid,
    segments: u64,
    /// Recorded edits that it contains.
    edits: usize,
}

/// Edits made together.
#[derive(Clone, Debug)]
pub(super) struct RecordedEdits {
    pub(super) at: Moment,
    pub(super) edits: Vec<SimEdit>,
}

/// End of a Δt, with the grid as it stands there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tick {
    pub(super) at: Moment,
    pub(super) grid: StepGrid,
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
    edits: Vec<RecordedEdits>,
    /// How many of them the simulation has behind it now.
    applied: usize,
}

impl History {
    pub(super) fn new(simulation: &Simulation, grid: StepGrid) -> Self {
        let at = Moment { event: 0, time: simulation.time() };
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
        let at = Moment { event, time: simulation.time() };
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
    pub(super) fn next_tick(&self, now: f64) -> Option<f64> {
        self.ticks.get(self.ticks.partition_point(|tick| tick.at.time <= now)).map(|tick| tick.at.time)
    }

    /// Forgets what another Δt than before, from now to `end`, makes untrue: the ticks to come, and where
    /// the method depends on Δt the whole future. Gives the number of edits in it.
    pub(super) fn divide_time_anew(&mut self, simulation: &Simulation, event: u64, end: f64) -> usize {
        let at = Moment { event, time: simulation.time() };
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

    /// Records edits made now. What was recorded for later is another future and is forgotten.
    pub(super) fn note_edits(
        &mut self,
        simulation: &Simulation,
        grid: StepGrid,
        event: u64,
        edits: Vec<SimEdit>,
    ) {
        let at = Moment { event, time: simulation.time() };
        self.forget_after(at);
        self.edits.push(RecordedEdits { at, edits });
        self.applied = self.edits.len();
        self.keep(simulation, grid, at);
    }

    fn forget_after(&mut self, at: Moment) {
        self.keyframes.retain(|key| key.at.time <= at.time && key.at.event <= at.event);
        self.ticks.retain(|tick| tick.at.time <= at.time && tick.at.event <= at.event);
        self.edits.truncate(self.applied);
        self.event_times.truncate((at.event + 1).saturating_sub(self.first_event) as usize);
    }

    fn keep(&mut self, simulation: &Simulation, grid: StepGrid, at: Moment) {
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

    /// The last tick before `now`, and the one before that.
    pub(super) fn last_ticks(&self, now: f64) -> Option<(Tick, Option<Tick>)> {
        let index = self.ticks.iter().rposition(|tick| tick.at.time < now)?;
        Some((self.ticks[index], index.checked_sub(1).map(|before| self.ticks[before])))
    }

    /// The last tick before a recorded event.
    pub(super) fn tick_before(&self, event: Moment) -> Option<Tick> {
        let is_before = |tick: &&Tick| tick.at.event < event.event && tick.at.time <= event.time;
        self.ticks.iter().rev().find(is_before).copied()
    }

    /// The last tick not after `now`, and the first after it.
    pub(super) fn ticks_around(&self, now: f64) -> (Option<Tick>, Option<Tick>) {
        let after = self.ticks.partition_point(|tick| tick.at.time <= now);
        (after.checked_sub(1).map(|before| self.ticks[before]), self.ticks.get(after).copied())
    }

    /// The snapshot to start from in order to reach `at`: what was recorded after it is ahead again.
    pub(super) fn rewind(&mut self, at: Moment) -> Option<&Keyframe> {
        let usable = |key: &&Keyframe| key.at.time <= at.time && key.at.event <= at.event;
        let key = self.keyframes.iter().rev().find(usable)?;
        self.applied = key.edits;
        Some(key)
    }

    /// When the next recorded edit was made, if no event more comes before it.
    pub(super) fn next_edit(&self, last_event: u64) -> Option<f64> {
        self.edits.get(self.applied).map(|next| next.at).filter(|at| at.event <= last_event).map(|at| at.time)
    }

    /// The next recorded edit, if it was made not after this event and time; it counts as applied.
    pub(super) fn take_due_edits(&mut self, last_event: u64, now: f64) -> Option<RecordedEdits> {
        let next = self.edits.get(self.applied)?;
        if next.at.event > last_event || next.at.time > now {
            return None;
        }
        self.applied += 1;
        Some(next.clone())
    }

    /// When an event happened; `None` for one that is not recorded.
    pub(super) fn time_of(&self, event: u64) -> Option<f64> {
        self.event_times.get(usize::try_from(event.checked_sub(self.first_event)?).ok()?).copied()
    }
}
