//! At which event the books were off most: the energy residual is looked at after every event, and the
//! largest change of it is remembered together with the event.

use super::frame::Jump;
use crate::sim::{Event, Simulation};

/// Adding energies up costs a look at all bodies, some 30 ns each: with more than this, only as many are looked at as there
/// are events beyond it, so that a gas pays less than a hundredth of the time of an event.
const EVERY_EVENT: u64 = 4;

#[derive(Clone, Debug, Default)]
pub(super) struct Drift {
    residual: f64,
    /// Events since the residual was looked at, and how many bodies there were then: counting them costs as much.
    since: u64,
    bodies: u64,
    /// Jumps larger than all before them, so that going back leaves the largest of what remains.
    records: Vec<Jump>,
}

impl Drift {
    /// The largest up to an event.
    pub(super) fn largest(&self, event: u64) -> Option<Jump> {
        self.records.iter().rev().find(|jump| jump.event <= event).copied()
    }

    pub(super) fn note(&mut self, simulation: &Simulation, event: &Event) {
        self.since += 1;
        if self.since + EVERY_EVENT <= self.bodies {
            return;
        }
        self.bodies = simulation.dynamic_count() as u64;
        let residual = residual_of(simulation);
        let size = (residual - self.residual).abs();
        (self.residual, self.since) = (residual, 0);
        if self.records.last().is_none_or(|last| event.seq > last.event && size > last.size) && size > 0.0 {
            self.records.push(Jump { event: event.seq, time: event.time, size });
        }
    }

    /// Another future begins after this event, where the simulation is.
    pub(super) fn drop_after(&mut self, event: u64, simulation: &Simulation) {
        self.records.retain(|jump| jump.event <= event);
        (self.residual, self.since) = (residual_of(simulation), 0);
    }
}

fn residual_of(simulation: &Simulation) -> f64 {
    simulation.energy().residual.unwrap_or_else(|| simulation.momentum().residual)
}
