//! The deepest overlap up to each moment of a run that was looked at: going back leaves what belongs to the time shown.

use super::frame::WorstOverlap;
use super::moment::Moment;

#[derive(Clone, Debug, Default)]
pub(super) struct Overlaps {
    /// Overlaps deeper than all found before them in the run, in order.
    records: Vec<(Moment, WorstOverlap)>,
}

impl Overlaps {
    /// The deepest up to a moment.
    pub(super) fn worst(&self, until: Moment) -> WorstOverlap {
        let before = self.records.iter().rev().find(|(at, _)| at.is_not_after(until));
        before.map(|(_, overlap)| *overlap).unwrap_or_default()
    }

    pub(super) fn note(&mut self, at: Moment, found: WorstOverlap) {
        if found.depth <= self.worst(at).depth {
            return;
        }
        // Moments are looked at in any order.
        let place = self.records.partition_point(|(other, _)| other.is_not_after(at));
        let shallow = self.records[place..].partition_point(|(_, later)| later.depth <= found.depth);
        self.records.splice(place..place + shallow, [(at, found)]);
    }

    /// Another future begins after this moment.
    pub(super) fn drop_after(&mut self, at: Moment) {
        self.records.retain(|(found, _)| found.is_not_after(at));
    }
}
