//! The Δt that a run was divided into: their ends, with the grid as it stood there.

use super::file::Steps;
use super::grid::StepGrid;
use super::moment::Moment;

/// Stretches of equal Δt that are told of.
const MOST_DIVISIONS: usize = 1000;

/// Δt of one length, one after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Division {
    /// Where they begin to be counted, s: the k-th ends k·`dt` later.
    pub origin: f64,
    /// s.
    pub dt: f64,
    /// End of the last, s. Another division begins there or later.
    pub to: f64,
}

/// End of a Δt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tick {
    pub(super) at: Moment,
    pub(super) grid: StepGrid,
}

/// The start, then the end of every Δt.
#[derive(Clone, Debug)]
pub(super) struct Ticks {
    /// Those before all that is kept, as many of them as came one after the other on one grid: a run is made again by them.
    early: Vec<Early>,
    kept: Vec<Tick>,
}

/// Ends of Δt at origin + n·Δt, for as many n as there are from the first on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Early {
    origin: f64,
    dt: f64,
    first: u64,
    count: u64,
}

impl Early {
    fn end(&self, nth: u64) -> f64 {
        self.origin + (self.first + nth) as f64 * self.dt
    }

    /// The first end after a time.
    fn after(&self, time: f64) -> Option<f64> {
        let last = self.count - 1;
        let near = ((time - self.origin) / self.dt).max(0.0) as u64;
        // The quotient may be off by its rounding.
        let mut nth = near.saturating_sub(self.first + 1).min(last);
        while nth < last && self.end(nth) <= time {
            nth += 1;
        }
        Some(self.end(nth)).filter(|end| *end > time)
    }
}

impl Ticks {
    pub(super) fn new(at: Moment, grid: StepGrid) -> Self {
        Self { early: Vec::new(), kept: vec![Tick { at, grid }] }
    }

    /// Bytes that they take.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.early) + size_of_val(&*self.kept)
    }

    /// Keeps of those before the last one not after a time no more than where they were.
    pub(super) fn drop_before(&mut self, time: f64) {
        let gone = self.kept.partition_point(|tick| tick.at.time <= time).saturating_sub(1);
        for tick in self.kept.drain(..gone) {
            let (origin, dt) = tick.grid.stretch();
            let number = tick.grid.number();
            match self.early.last_mut() {
                // The start is the end of no Δt.
                _ if number == 0 => {}
                Some(last) if (last.origin, last.dt, last.first + last.count) == (origin, dt, number) => {
                    last.count += 1;
                }
                _ => self.early.push(Early { origin, dt, first: number, count: 1 }),
            }
        }
    }

    /// The Δt that are kept, as stretches of one length each; of very many stretches the first.
    pub(super) fn divisions(&self) -> Vec<Division> {
        let (mut divisions, mut rest) = (Vec::new(), self.kept.as_slice());
        while let Some(first) = rest.first().filter(|_| divisions.len() < MOST_DIVISIONS) {
            let stretch = first.grid.stretch();
            // Those of one stretch lie side by side.
            let count = rest.partition_point(|tick| tick.grid.stretch() == stretch).max(1);
            let ((origin, dt), to) = (stretch, rest[count - 1].at.time);
            // The start is the end of no Δt.
            if dt > 0.0 {
                divisions.push(Division { origin, dt, to });
            }
            rest = &rest[count..];
        }
        divisions
    }

    /// When the Δt ends in which a time lies.
    pub(super) fn end_after(&self, time: f64) -> Option<f64> {
        if self.kept.first().is_some_and(|first| first.at.time <= time) {
            return self.around(time).1.map(|tick| tick.at.time);
        }
        let early = self.early.iter().find_map(|early| early.after(time));
        early.or_else(|| self.kept.first().map(|first| first.at.time))
    }

    pub(super) fn note(&mut self, tick: Tick) {
        // Most come last; to search for the others waits for memory.
        if self.kept.last().is_some_and(|last| last.at.time < tick.at.time) {
            return self.kept.push(tick);
        }
        let place = self.kept.partition_point(|other| other.at.time < tick.at.time);
        match self.kept.get_mut(place) {
            Some(again) if again.at.time == tick.at.time => *again = tick,
            _ => self.kept.insert(place, tick),
        }
    }

    /// The last tick before a moment.
    pub(super) fn before(&self, moment: Moment) -> Option<Tick> {
        let after = self.kept.partition_point(|tick| tick.at.is_not_after(moment) && tick.at != moment);
        after.checked_sub(1).and_then(|before| self.kept.get(before)).copied()
    }

    /// The last tick before an event.
    pub(super) fn before_event(&self, event: Moment) -> Option<Tick> {
        let after =
            self.kept.partition_point(|tick| tick.at.event < event.event && tick.at.time <= event.time);
        after.checked_sub(1).and_then(|before| self.kept.get(before)).copied()
    }

    /// The last tick not after a time, and the first after it.
    pub(super) fn around(&self, time: f64) -> (Option<Tick>, Option<Tick>) {
        let after = self.kept.partition_point(|tick| tick.at.time <= time);
        (after.checked_sub(1).map(|before| self.kept[before]), self.kept.get(after).copied())
    }

    pub(super) fn split_off(&mut self, at: Moment) -> Vec<Tick> {
        let kept = self.kept.partition_point(|tick| tick.at.is_not_after(at));
        self.kept.split_off(kept)
    }

    pub(super) fn append(&mut self, rest: Vec<Tick>) {
        self.kept.extend(rest);
    }

    /// The Δt in the order in which they were taken, those of one length together.
    pub(super) fn steps(&self) -> Vec<Steps> {
        let early = self.early.iter().map(|early| ((early.origin, early.dt), early.count));
        let kept =
            self.kept.iter().filter(|tick| tick.grid.number() > 0).map(|tick| (tick.grid.stretch(), 1));
        let mut steps: Vec<Steps> = Vec::new();
        let mut before = None;
        for (grid, more) in early.chain(kept) {
            match steps.last_mut() {
                Some(last) if before == Some(grid) => last.count += more,
                _ => steps.push(Steps { dt: grid.1, count: more }),
            }
            before = Some(grid);
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is dropped is still known as far as a run is made again by it: where every Δt ended, and how long they were.
    #[test]
    fn where_the_steps_ended_is_known_of_those_dropped_too() {
        let mut grid = StepGrid::new();
        let mut ticks = Ticks::new(Moment::default(), grid);
        let mut ends = vec![0.0];
        for (nth, dt) in [(0_u64, 0.1), (1, 1.0 / 60.0), (2, 0.1), (3, 1e-3)] {
            for _ in 0..100 {
                grid.open(ends[ends.len() - 1], dt);
                let end = grid.open.map_or(0.0, |(_, end)| end);
                grid.close();
                ticks.note(Tick { at: Moment::after_all(nth, end), grid });
                ends.push(end);
            }
        }
        let divisions = ticks.divisions();
        assert_eq!(divisions.len(), 4);
        assert!(divisions.windows(2).all(|pair| pair[0].to == pair[1].origin), "{divisions:?}");
        let steps = ticks.steps();
        assert_eq!(steps.iter().map(|steps| steps.count).collect::<Vec<_>>(), [100; 4]);
        for part in [0.0, 0.05, 0.3, 0.9, 1.0] {
            let before = ticks.bytes();
            ticks.drop_before(part * ends[ends.len() - 1]);
            assert!(ticks.bytes() <= before);
            assert_eq!(ticks.steps(), steps, "{part} of them dropped");
            for pair in ends.windows(2) {
                assert_eq!(ticks.end_after(pair[0]), Some(pair[1]));
                assert_eq!(ticks.end_after(0.5 * (pair[0] + pair[1])), Some(pair[1]));
            }
        }
        assert!(ticks.bytes() < 10 * size_of::<Tick>(), "{} bytes", ticks.bytes());
    }
}
