//! The event queue: what is predicted to happen next. Order is (time, kind, bodies), never the order of
//! insertion, so the same predictions give the same run.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What is predicted. The order of the variants breaks ties in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// The body's segment ends: a new one is due.
    SegmentEnd,
    /// The body leaves the tiles it is registered in.
    LeaveTiles,
    /// A body comes within the core radius of point attractor `b`.
    CorePass,
    /// The last of a body's skipped bounces on static body `b` would end.
    Settled,
    /// A body in lasting contact leaves static body `b`.
    ContactEnd,
    /// Dynamic bodies `a` and `b` touch.
    Impact,
    /// Dynamic body `a` touches static body `b`.
    FixtureImpact,
}

/// A prediction, good as long as the bodies it was made for have not changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Predicted {
    /// Model time, s.
    pub time: f64,
    pub kind: Kind,
    pub a: u32,
    pub b: u32,
    /// Number of the segment of `a`, and of `b` where that is a dynamic body, at the prediction.
    pub stamp_a: u32,
    pub stamp_b: u32,
}

impl Predicted {
    fn key_order(&self, other: &Self) -> Ordering {
        self.time
            .total_cmp(&other.time)
            .then(self.kind.cmp(&other.kind))
            .then(self.a.cmp(&other.a))
            .then(self.b.cmp(&other.b))
            .then(self.stamp_a.cmp(&other.stamp_a))
            .then(self.stamp_b.cmp(&other.stamp_b))
    }
}

/// Reversed, so that the heap's greatest entry is the earliest.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry(Predicted);

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.key_order(&self.0)
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A binary heap whose stale entries are dropped when they come up, or all at once when they are many.
#[derive(Clone, Debug, Default)]
pub(super) struct Queue {
    heap: BinaryHeap<Entry>,
    /// Size at which stale entries are swept out.
    sweep_at: usize,
}

/// Below this size sweeping is not worth its cost.
const SMALLEST_SWEEP: usize = 1024;

impl Queue {
    pub fn push(&mut self, predicted: Predicted) {
        self.heap.push(Entry(predicted));
    }

    /// The earliest prediction that still holds, if it is not after `until`.
    pub fn pop(
        &mut self,
        until: f64,
        dropped: &mut u64,
        mut holds: impl FnMut(&Predicted) -> bool,
    ) -> Option<Predicted> {
        while let Some(Entry(next)) = self.heap.peek().copied() {
            if next.time > until {
                return None;
            }
            self.heap.pop();
            if holds(&next) {
                return Some(next);
            }
            *dropped += 1;
        }
        None
    }

    /// Sweeps stale entries out when there may be more of them than of good ones.
    pub fn tidy(&mut self, mut holds: impl FnMut(&Predicted) -> bool) {
        if self.heap.len() < self.sweep_at.max(SMALLEST_SWEEP) {
            return;
        }
        self.heap.retain(|entry| holds(&entry.0));
        self.sweep_at = 2 * self.heap.len();
    }
}
