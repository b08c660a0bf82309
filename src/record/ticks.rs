//! The Δt that a run was divided into: their ends, with the grid as it stood there.

use super::file::Steps;
use super::grid::StepGrid;
use super::moment::Moment;

/// End of a Δt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tick {
    pub(super) at: Moment,
    pub(super) grid: StepGrid,
}

/// The start, then the end of every Δt.
#[derive(Clone, Debug)]
pub(super) struct Ticks(Vec<Tick>);

/// Ticks that are kept: steps of 1 ms for a quarter of an hour.
const MOST: usize = 1_000_000;

impl Ticks {
    pub(super) fn new(at: Moment, grid: StepGrid) -> Self {
        Self(vec![Tick { at, grid }])
    }

    pub(super) fn note(&mut self, tick: Tick) {
        // Most come last; to search for the others waits for memory.
        if self.0.last().is_some_and(|last| last.at.time < tick.at.time) {
            self.0.push(tick);
            return self.stay_bounded();
        }
        let place = self.0.partition_point(|other| other.at.time < tick.at.time);
        match self.0.get_mut(place) {
            Some(again) if again.at.time == tick.at.time => *again = tick,
            _ => self.0.insert(place, tick),
        }
        self.stay_bounded();
    }

    fn stay_bounded(&mut self) {
        if self.0.len() > MOST {
            self.0.drain(..MOST / 4);
        }
    }

    /// The last tick before a moment.
    pub(super) fn before(&self, moment: Moment) -> Option<Tick> {
        let after = self.0.partition_point(|tick| tick.at.is_not_after(moment) && tick.at != moment);
        after.checked_sub(1).and_then(|before| self.0.get(before)).copied()
    }

    /// The last tick before an event.
    pub(super) fn before_event(&self, event: Moment) -> Option<Tick> {
        let after = self.0.partition_point(|tick| tick.at.event < event.event && tick.at.time <= event.time);
        after.checked_sub(1).and_then(|before| self.0.get(before)).copied()
    }

    /// The last tick not after a time, and the first after it.
    pub(super) fn around(&self, time: f64) -> (Option<Tick>, Option<Tick>) {
        let after = self.0.partition_point(|tick| tick.at.time <= time);
        (after.checked_sub(1).map(|before| self.0[before]), self.0.get(after).copied())
    }

    pub(super) fn split_off(&mut self, at: Moment) -> Vec<Tick> {
        let kept = self.0.partition_point(|tick| tick.at.is_not_after(at));
        self.0.split_off(kept)
    }

    pub(super) fn append(&mut self, rest: Vec<Tick>) {
        self.0.extend(rest);
    }

    /// The Δt in the order in which they were taken, those of one length together.
    pub(super) fn steps(&self) -> Vec<Steps> {
        let mut steps: Vec<Steps> = Vec::new();
        let mut origin = None;
        for tick in self.0.iter().skip(1) {
            let (begin, dt) = tick.grid.stretch();
            match steps.last_mut() {
                Some(last) if origin == Some((begin, dt)) => last.count += 1,
                _ => steps.push(Steps { dt, count: 1 }),
            }
            origin = Some((begin, dt));
        }
        steps
    }
}
