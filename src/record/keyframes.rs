//! Copies of the simulation at some moments of a run, from which it goes on with the same bits.

use super::moment::Moment;
use crate::sim::{Simulation, Snapshot};

/// About what one dynamic body takes in a snapshot, bytes: its columns, predictions and tiles.
const BODY_SIZE: usize = 1024;
/// About what an edit's own copy of the compiled scene takes for each body, bytes: of a static one its surface, place and tiles
/// too.
const DYNAMIC_SIZE: usize = 200;
const STATIC_SIZE: usize = 500;
/// Segments to simulate again at most between two keyframes, for a scene of few bodies.
const SEGMENTS_APART: u64 = 500;
/// And for each body of a larger one: a copy of it takes about as long as a segment, so that copies cost some per cent.
const SEGMENTS_PER_BODY: u64 = 30;

#[derive(Debug)]
pub(super) struct Keyframe {
    pub(super) at: Moment,
    pub(super) snapshot: Snapshot,
    /// [`Simulation::hash`] there.
    pub(super) hash: u64,
    /// Number of segments from which on another one is due: counting bodies for it at every Δt would cost.
    next_due: u64,
    /// About what it takes, bytes.
    bytes: usize,
    /// Edits that it contains.
    pub(super) edits: usize,
    /// Right after an edit: what is looked up after it needs its bodies and forces, so that it is never thinned out.
    after_edit: bool,
}

/// Keyframes in order, the first at the start.
#[derive(Debug, Default)]
pub(super) struct Keyframes {
    list: Vec<Keyframe>,
    /// About what `list` takes, bytes.
    bytes: usize,
    /// At the end of what is known, while the simulation is elsewhere.
    head: Option<Box<Keyframe>>,
}

impl Keyframe {
    pub(super) fn new(simulation: &Simulation, at: Moment, edits: usize) -> Self {
        let bodies = simulation.dynamic_count();
        let apart = SEGMENTS_APART.max(SEGMENTS_PER_BODY * bodies as u64);
        Self {
            at,
            snapshot: simulation.snapshot(),
            hash: simulation.hash(),
            next_due: simulation.counters().segments + apart,
            bytes: BODY_SIZE * (bodies + 8),
            edits,
            after_edit: false,
        }
    }

    /// Of a simulation right after an edit, which has a scene of its own.
    pub(super) fn after_edit(simulation: &Simulation, at: Moment, edits: usize) -> Self {
        let key = Self::new(simulation, at, edits);
        let scene = DYNAMIC_SIZE * simulation.dynamic_count() + STATIC_SIZE * simulation.static_count();
        Self { after_edit: true, bytes: key.bytes + scene, ..key }
    }
}

impl Keyframes {
    pub(super) fn push(&mut self, keyframe: Keyframe) {
        self.bytes += keyframe.bytes;
        self.list.push(keyframe);
    }

    /// Whether with so many segments enough was simulated since the last one for another.
    pub(super) fn is_due(&self, segments: u64) -> bool {
        self.list.last().is_none_or(|last| segments >= last.next_due)
    }

    /// The last one not after a moment.
    pub(super) fn before(&self, moment: Moment) -> Option<&Keyframe> {
        self.before_edits(moment, usize::MAX)
    }

    /// As [`Self::before`], of those with at most so many edits behind them.
    pub(super) fn before_edits(&self, moment: Moment, edits: usize) -> Option<&Keyframe> {
        let mut all = self.head.as_deref().into_iter().chain(self.list.iter().rev());
        all.find(|key| key.edits <= edits && key.at.is_not_after(moment))
    }

    /// The one at a moment.
    pub(super) fn at(&self, moment: Moment) -> Option<&Keyframe> {
        self.before(moment).filter(|key| key.at == moment)
    }

    pub(super) fn head(&self) -> Option<&Keyframe> {
        self.head.as_deref()
    }

    pub(super) fn set_head(&mut self, head: Keyframe) {
        self.head = Some(Box::new(head));
    }

    pub(super) fn take_head(&mut self) -> Option<Box<Keyframe>> {
        self.head.take()
    }

    pub(super) fn split_off(&mut self, at: Moment) -> Vec<Keyframe> {
        let kept = self.list.partition_point(|key| key.at.is_not_after(at));
        let rest = self.list.split_off(kept);
        self.count_bytes();
        rest
    }

    /// Drops those before the last one not after a moment before which nothing is shown any more, but the first of all.
    pub(super) fn drop_before(&mut self, from: Moment) {
        let last = self.list.iter().rposition(|key| key.at.is_not_after(from)).unwrap_or(0);
        if last > 1 {
            self.list.drain(1..last);
            self.count_bytes();
        }
    }

    /// Drops those of an edit that is taken back.
    pub(super) fn drop_after_edits(&mut self, edits: usize) {
        self.list.retain(|key| key.edits <= edits);
        self.count_bytes();
    }

    pub(super) fn append(&mut self, rest: Vec<Keyframe>) {
        self.list.extend(rest);
        self.count_bytes();
    }

    /// Drops every second one but those after edits, the first and the last; whether any was.
    pub(super) fn thin(&mut self) -> bool {
        let (before, last) = (self.list.len(), self.list.len().saturating_sub(1));
        let mut index = 0;
        self.list.retain(|key| {
            index += 1;
            index % 2 == 1 || index > last || key.after_edit
        });
        self.count_bytes();
        self.list.len() < before
    }

    fn count_bytes(&mut self) {
        self.bytes = self.list.iter().map(|key| key.bytes).sum();
    }

    /// Bytes that they take, about.
    pub(super) fn bytes(&self) -> usize {
        self.bytes + self.head.as_ref().map_or(0, |head| head.bytes)
    }

    #[cfg(test)]
    pub(super) fn exchange_first(&mut self, simulation: &Simulation) {
        self.list[0].snapshot = simulation.snapshot();
    }

    /// Each moment with the number of edits behind it, and the hash of the simulation there.
    pub(super) fn states(&self) -> impl Iterator<Item = (Moment, usize, u64)> + '_ {
        self.list.iter().map(|key| (key.at, key.edits, key.hash))
    }
}
