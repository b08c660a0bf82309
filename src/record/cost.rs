//! What the core did on the way to an event: beside the ledger, for it depends on the tiles, which the events do not.

use crate::sim::Counters;

/// What was done since the event before, with what this one brought about; of several rows of one impact the first has it all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Cost {
    /// Pairs of bodies whose time of impact was searched for.
    pub searches: u32,
    /// Predictions dropped, for a body had changed since they were made.
    pub dropped: u32,
}

impl Cost {
    /// What was done between two looks at the counters.
    pub fn between(before: &Counters, after: &Counters) -> Self {
        let more = |of: fn(&Counters) -> u64| {
            u32::try_from(of(after).saturating_sub(of(before))).unwrap_or(u32::MAX)
        };
        Self {
            searches: more(|counters| counters.pair_tests),
            dropped: more(|counters| counters.stale_events),
        }
    }
}
