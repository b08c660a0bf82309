//! A Δt in progress, of the methods that step by it: what is left to do in it.

use super::pair::Pair;

/// A Δt that is not over.
#[derive(Clone, Debug)]
pub(super) struct OpenStep {
    /// s.
    pub end: f64,
    pub search: Collisions,
}

/// The collisions left in a Δt.
#[derive(Clone, Debug)]
pub(super) enum Collisions {
    /// The trial steps are still to be made.
    Planned,
    Sets(SetSearch),
    Pairs(PairSearch),
}

/// A pair that overlaps at the end of its trial step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Just before the surfaces meet, s.
    pub time: f64,
    pub pair: Pair,
}

impl Hit {
    /// Order by time; ties by the pair, so that a run is the same every time.
    pub fn is_before(&self, other: &Self) -> bool {
        self.time.total_cmp(&other.time).then(self.pair.cmp(&other.pair)).is_lt()
    }

    pub fn involves(&self, body: u32) -> bool {
        self.pair.involves(body)
    }
}

/// The overlaps at the end of a step that are not resolved yet.
#[derive(Clone, Debug)]
pub(super) struct PairSearch {
    pub hits: Vec<Hit>,
    /// Collisions of each body in this step.
    pub collisions: Vec<u32>,
}

/// All local sets of a Δt.
#[derive(Clone, Debug)]
pub(super) struct SetSearch {
    pub sets: Vec<LocalSet>,
}

/// Bodies that could meet in this Δt, and those that do.
#[derive(Clone, Debug)]
pub(super) struct LocalSet {
    pub dynamic: Vec<u32>,
    pub statics: Vec<u32>,
    pub hits: Vec<Hit>,
    /// Collisions that may still be resolved.
    pub left: u32,
}
