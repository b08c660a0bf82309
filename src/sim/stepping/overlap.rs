//! Overlaps at the end of a trial step, and when they began.

use super::StepLimits;
use crate::sim::model::{FixtureShape, Model};
use crate::sim::predict::{Gap, sphere_fixture_gap, sphere_sphere_gap};
use crate::sim::state::State;

/// The second body of a pair whose first one moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Partner {
    Moving(u32),
    Fixed(u32),
}

/// A pair that overlaps at the end of its trial step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Just before the surfaces meet, s.
    pub time: f64,
    /// The smaller index of two moving bodies.
    pub body: u32,
    pub partner: Partner,
}

impl Hit {
    /// Order by time; ties as (body, partner), so that a run is the same every time.
    pub fn is_before(&self, other: &Self) -> bool {
        let order = self.time.total_cmp(&other.time);
        order.then(self.body.cmp(&other.body)).then(self.partner.cmp(&other.partner)).is_lt()
    }

    pub fn involves(&self, body: u32) -> bool {
        self.body == body || self.partner == Partner::Moving(body)
    }

    /// The moving bodies.
    pub fn bodies(&self) -> impl Iterator<Item = u32> + use<> {
        let second = match self.partner {
            Partner::Moving(other) => Some(other),
            Partner::Fixed(_) => None,
        };
        [Some(self.body), second].into_iter().flatten()
    }
}

pub(super) fn gap(model: &Model, state: &State, body: u32, partner: Partner, time: f64) -> Gap {
    let mover = state.mover(model, body);
    match partner {
        Partner::Moving(other) => sphere_sphere_gap(mover, state.mover(model, other), time),
        Partner::Fixed(index) => sphere_fixture_gap(mover, &model.fixtures[index as usize], time),
    }
}

/// The hit of a pair between `from` and `to`, if it overlaps at `to`. A pair that overlaps at `from` already
/// hits there if it closes in, and else is left to part.
pub(super) fn hit(
    model: &Model,
    state: &mut State,
    body: u32,
    partner: Partner,
    from: f64,
    to: f64,
) -> Option<Hit> {
    state.counters.pair_tests += 1;
    if !overlaps(model, state, body, partner, to) {
        return None;
    }
    let time = if overlaps(model, state, body, partner, from) {
        (gap(model, state, body, partner, from).rate < 0.0).then_some(from)?
    } else {
        bisect(model, state, body, partner, from, to)
    };
    Some(Hit { time, body, partner })
}

/// Whether two bodies overlap: the test that is made most.
fn overlaps(model: &Model, state: &State, body: u32, partner: Partner, time: f64) -> bool {
    let within = |other: glam::DVec3, reach: f64| {
        (other - state.position(body, time)).length_squared() < reach * reach
    };
    let radius = model.movers[body as usize].radius;
    match partner {
        Partner::Moving(other) => {
            within(state.position(other, time), radius + model.movers[other as usize].radius)
        }
        Partner::Fixed(index) => {
            let fixture = &model.fixtures[index as usize];
            match &fixture.shape {
                FixtureShape::Sphere { radius: fixed } => within(fixture.position, radius + fixed),
                FixtureShape::Plate(_) => gap(model, state, body, partner, time).distance < 0.0,
            }
        }
    }
}

/// Halves from..=to until both tolerances are met; the answer is on the side that does not overlap.
fn bisect(model: &Model, state: &State, body: u32, partner: Partner, from: f64, to: f64) -> f64 {
    let limits = StepLimits::DEFAULT;
    let moved = |low: f64, high: f64| {
        let way = |of: u32| (state.position(of, high) - state.position(of, low)).length();
        let partner_way = if let Partner::Moving(other) = partner { way(other) } else { 0.0 };
        way(body).max(partner_way)
    };
    let (mut low, mut high) = (from, to);
    for _ in 0..limits.halvings {
        if high - low <= limits.time && moved(low, high) <= limits.distance {
            break;
        }
        let middle = 0.5 * (low + high);
        if overlaps(model, state, body, partner, middle) { high = middle } else { low = middle }
    }
    low
}
