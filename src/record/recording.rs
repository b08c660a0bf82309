//! What is known of a run: how every body moved, every event, the edits, and what is needed to go on from any moment with
//! the same bits. The motion itself is recorded, so that a state at any time is looked up, not simulated again.

use std::sync::Arc;

use super::cost::Cost;
use super::grid::StepGrid;
use super::keyframes::{Keyframe, Keyframes};
use super::ledger::{Ledger, Names, Tail};
use super::log::{Log, Noted, Then};
use super::moment::Moment;
use super::ticks::{Tick, Ticks};
use crate::sim::{BodyRef, Event, Piece, SimEdit, Simulation};

/// Memory that a recording may take unless told otherwise, bytes: ten minutes of ten bodies, seconds of ten thousand.
pub const BUDGET: usize = 1 << 30;

/// Of the budget: what keyframes may take before they are thinned out, and what is dropped when all of it is used.
const KEYFRAME_SHARE: f64 = 0.25;
const DROPPED_SHARE: f64 = 0.25;
/// How often that is done at once, after which a tenth is left of the time that was known.
const MOST_DROPS: u32 = 8;
/// Of the budget: by how much a recording that takes too much, though all that can be dropped is, grows until the next look.
const LOOK_AGAIN_SHARE: f64 = 1.0 / 64.0;

/// Edits made together.
#[derive(Clone, Debug)]
pub(super) struct RecordedEdits {
    pub(super) at: Moment,
    pub(super) edits: Vec<SimEdit>,
}

#[derive(Debug)]
pub(super) struct Recording {
    pub(super) log: Log,
    pub(super) ledger: Ledger,
    pub(super) ticks: Ticks,
    pub(super) keyframes: Keyframes,
    /// In the order of their stamps, and the bytes that they take.
    edits: Vec<RecordedEdits>,
    edit_bytes: usize,
    /// From when on it is kept: what was before was dropped to stay within the budget.
    from: Moment,
    /// Up to where the run is known.
    pub(super) end: Moment,
    /// The Δt around the end.
    pub(super) end_grid: StepGrid,
    budget: usize,
    /// Bytes from which on there may be something to drop.
    look_at: usize,
}

/// What lay after a moment before an edit there made another future.
#[derive(Debug)]
pub(super) struct Future {
    pub(super) from: Moment,
    end: Moment,
    end_grid: StepGrid,
    pieces: Vec<Noted>,
    rows: Vec<Tail>,
    names: Arc<Names>,
    ticks: Vec<Tick>,
    keyframes: Vec<Keyframe>,
    head: Option<Box<Keyframe>>,
    edits: Vec<RecordedEdits>,
    /// How many edits and pieces were before it.
    edits_before: usize,
    pieces_before: u64,
    /// About what it takes.
    bytes: usize,
}

impl Future {
    pub(super) fn edit_count(&self) -> usize {
        self.edits.len()
    }

    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }
}

impl RecordedEdits {
    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.edits)
    }
}

impl Recording {
    /// Begins with the simulation as it is, and lets it tell its motion from now on.
    pub(super) fn new(simulation: &mut Simulation, grid: StepGrid, budget: usize) -> Self {
        let at = Moment::right_after(0, simulation.time());
        simulation.trace_motion();
        let mut recording = Self {
            log: Log::default(),
            ledger: Ledger::of(simulation),
            ticks: Ticks::new(at, grid),
            keyframes: Keyframes::default(),
            edits: Vec::new(),
            edit_bytes: 0,
            from: at,
            end: at,
            end_grid: grid,
            budget,
            look_at: budget,
        };
        recording.take_motion(simulation);
        recording.keyframes.push(Keyframe::new(simulation, at, 0));
        recording
    }

    /// Takes over the motion that the simulation has begun.
    pub(super) fn take_motion(&mut self, simulation: &mut Simulation) {
        simulation.take_motion(|begun| self.log.note(begun));
    }

    pub(super) fn note_event(&mut self, event: &Event, cost: Cost) {
        self.ledger.note(event, cost);
    }

    /// Notes the end of a Δt.
    pub(super) fn note_tick(&mut self) {
        self.ticks.note(Tick { at: self.end, grid: self.end_grid });
    }

    /// Adds a keyframe now and then, by the number of segments, at the end of what is known. A Δt may be as long as the run: they
    /// lie inside it too.
    pub(super) fn note_keyframe(&mut self, simulation: &Simulation, segments: u64) {
        if self.keyframes.is_due(segments) {
            self.keyframes.push(Keyframe::new(simulation, self.end, self.edits.len()));
            self.thin_keyframes();
        }
    }

    /// Records edits made at the end of what is known.
    pub(super) fn note_edits(&mut self, simulation: &Simulation, edits: Vec<SimEdit>) {
        let edits = RecordedEdits { at: self.end, edits };
        self.edit_bytes += edits.bytes();
        self.edits.push(edits);
        self.ledger.rename(Arc::new(Names::of(simulation)));
        self.keyframes.push(Keyframe::after_edit(simulation, self.end, self.edits.len()));
        self.thin_keyframes();
        self.stay_within_budget();
    }

    /// Keeps the simulation as it is at the end of what is known, before it goes elsewhere.
    pub(super) fn keep_head(&mut self, simulation: &Simulation) {
        let head = Keyframe::new(simulation, self.end, self.edits.len());
        self.keyframes.set_head(head);
    }

    /// What all bodies follow at a moment.
    pub(super) fn at(&self, moment: Moment) -> Then<'_> {
        self.log.at(moment)
    }

    /// The pieces that a body follows between two times of what is known.
    pub(super) fn pieces(&self, body: BodyRef, from: f64, to: f64) -> impl Iterator<Item = &Piece> {
        let (from, to) = (self.moment_at(from), self.moment_at(to));
        self.log.between(body, from, to)
    }

    /// After all that happens at a time; the first or last moment known where the time is before or after them.
    pub(super) fn moment_at(&self, time: f64) -> Moment {
        match time {
            time if time >= self.end.time => self.end,
            time if time <= self.from.time => self.from,
            time => Moment::after_all(self.ledger.number_until(time), time),
        }
    }

    /// Whether all is known that happens up to a time.
    pub(super) fn knows(&self, time: f64) -> bool {
        time < self.end.time || (time == self.end.time && self.end.is_over)
    }

    /// All edits, in the order of their moments.
    pub(super) fn edits(&self) -> &[RecordedEdits] {
        &self.edits
    }

    /// From when on it is kept.
    pub(super) fn from(&self) -> Moment {
        self.from
    }

    pub(super) fn bytes(&self) -> usize {
        let moved = self.log.bytes() + self.keyframes.bytes();
        moved + self.ledger.bytes() + self.ticks.bytes() + self.edit_bytes
    }

    pub(super) fn budget(&self) -> usize {
        self.budget
    }

    pub(super) fn set_budget(&mut self, bytes: usize) {
        self.budget = bytes;
        self.thin_keyframes();
        // One that is much smaller takes several rounds; what cannot be dropped may take more than it for ever.
        for _ in 0..MOST_DROPS {
            self.look_at = bytes;
            if !self.stay_within_budget() || self.bytes() <= bytes {
                break;
            }
        }
    }

    fn thin_keyframes(&mut self) {
        while self.keyframes.bytes() as f64 > KEYFRAME_SHARE * self.budget as f64 && self.keyframes.thin() {}
    }

    /// Drops the oldest motion and events where all takes too much; whether it has.
    pub(super) fn stay_within_budget(&mut self) -> bool {
        if self.bytes() <= self.look_at {
            return false;
        }
        let mut drops = 0;
        while self.bytes() > self.budget && drops < MOST_DROPS && self.from.time < self.end.time {
            self.drop_oldest();
            drops += 1;
        }
        let more = (LOOK_AGAIN_SHARE * self.budget as f64) as usize;
        self.look_at = self.budget.max(self.bytes().saturating_add(more));
        drops > 0
    }

    /// Drops a share of the time known, from its beginning. The first keyframe stays, and where the Δt ended, so that any moment
    /// after can still be gone on from, by methods that step by Δt too.
    fn drop_oldest(&mut self) {
        let time = self.from.time + DROPPED_SHARE * (self.end.time - self.from.time);
        self.from = Moment::after_all(self.ledger.number_until(time), time);
        self.ledger.drop_before(time);
        self.log.drop_before(time);
        self.ticks.drop_before(time);
        self.keyframes.drop_before(self.from);
    }

    /// Takes what lies after a moment: something else will happen from there on.
    pub(super) fn split_off(&mut self, at: Moment) -> Future {
        let edits_before = self.edits.partition_point(|edits| edits.at.is_not_after(at));
        self.look_at = self.budget;
        let before = self.bytes();
        let mut future = Future {
            from: at,
            end: std::mem::replace(&mut self.end, at),
            end_grid: self.end_grid,
            pieces: self.log.split_off(at),
            rows: self.ledger.split_off(at.event),
            names: self.ledger.names().clone(),
            ticks: self.ticks.split_off(at),
            keyframes: self.keyframes.split_off(at),
            head: self.keyframes.take_head(),
            edits: self.edits.split_off(edits_before),
            edits_before,
            pieces_before: self.log.count(),
            bytes: 0,
        };
        self.count_edit_bytes();
        future.bytes = before.saturating_sub(self.bytes());
        future
    }

    fn count_edit_bytes(&mut self) {
        self.edit_bytes = self.edits.iter().map(RecordedEdits::bytes).sum();
    }

    /// Puts back what was taken, in place of what lies after the moment where it was.
    pub(super) fn put_back(&mut self, future: Future) {
        self.split_off(future.from);
        self.edits.truncate(future.edits_before);
        self.keyframes.drop_after_edits(future.edits_before);
        self.log.truncate(future.pieces_before);
        (self.end, self.end_grid) = (future.end, future.end_grid);
        self.log.append(future.pieces);
        self.ledger.append(future.rows);
        self.ledger.rename(future.names);
        self.ticks.append(future.ticks);
        self.keyframes.append(future.keyframes);
        if let Some(head) = future.head {
            self.keyframes.set_head(*head);
        }
        self.edits.extend(future.edits);
        self.count_edit_bytes();
    }
}
