//! A point of a run.

use serde::{Deserialize, Serialize};

/// After so many events, at a time. Several events may share a time, so that neither says it alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Number of the last event; 0 before the first.
    pub event: u64,
    /// Model time, s.
    pub time: f64,
    /// Whether what happens at this time without an event, such as the end of a segment, has happened too.
    pub is_over: bool,
}

impl Moment {
    /// Right after an event.
    pub(super) fn right_after(event: u64, time: f64) -> Self {
        Self { event, time, is_over: false }
    }

    /// After all that happens at a time; `event` is the last.
    pub(super) fn after_all(event: u64, time: f64) -> Self {
        Self { event, time, is_over: true }
    }

    /// Whether all that happened until this moment has happened at the other too.
    pub fn is_not_after(self, other: Self) -> bool {
        let is_same = self.event == other.event && self.time == other.time;
        self.event <= other.event && self.time <= other.time && (!is_same || !self.is_over || other.is_over)
    }
}
