//! The recorded motion of a run for others: a copy that shares its pieces, so that a state at any time is looked up while the run
//! goes on.

use super::ledger::Ledger;
use super::log::Log;
use super::moment::Moment;
use super::recording::Recording;
use crate::scene::NodeKey;
use crate::sim::{BodyRef, BodyState, Simulation};

/// How bodies moved between two times.
#[derive(Clone, Debug)]
pub struct RecordedMotion {
    /// Those that were there at the end, in their order.
    bodies: Vec<MovingBody>,
    log: Log,
    ledger: Ledger,
    from: Moment,
    end: Moment,
}

#[derive(Clone, Debug)]
struct MovingBody {
    body: BodyRef,
    key: NodeKey,
}

impl RecordedMotion {
    pub(super) fn of(recording: &Recording, simulation: &Simulation) -> Self {
        let moving = |body| MovingBody { body, key: simulation.key(body) };
        let bodies = simulation.dynamic_bodies().map(moving).collect();
        let (log, ledger) = (recording.log.clone(), recording.ledger.clone());
        Self { bodies, log, ledger, from: recording.from(), end: recording.end }
    }

    /// From when to when it is recorded, s.
    pub fn span(&self) -> (f64, f64) {
        (self.from.time, self.end.time)
    }

    /// The bodies by the numbers that [`Self::state`] takes.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = (BodyRef, NodeKey)> {
        self.bodies.iter().map(|body| (body.body, body.key))
    }

    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// After all that happens at a time, with the bits that the simulation had; `None` outside of what is recorded.
    pub fn state(&self, nth: usize, time: f64) -> Option<BodyState> {
        let moment = match time {
            time if !(self.from.time..=self.end.time).contains(&time) => return None,
            time if time == self.end.time => self.end,
            time if time == self.from.time => self.from,
            time => Moment::after_all(self.ledger.number_until(time), time),
        };
        Some(self.log.at(moment).piece(self.bodies.get(nth)?.body)?.at(time))
    }

    /// Right after an event of the ledger.
    pub fn state_after(&self, nth: usize, event: u64) -> Option<BodyState> {
        let time = self.ledger.get(event)?.event.time;
        Some(self.log.at(Moment::right_after(event, time)).piece(self.bodies.get(nth)?.body)?.at(time))
    }
}
