//! Overlaps at the end of a trial step, and when they began.

use super::limits::StepLimits;
use crate::sim::geometry::gap_of;
use crate::sim::model::Model;
use crate::sim::open_step::Hit;
use crate::sim::pair::Pair;
use crate::sim::shape::Shape;
use crate::sim::state::State;

/// The hit of a pair between `from` and `to`, if it overlaps at `to`. A pair that overlaps at `from` already
/// hits there if it closes in, and else is left to part.
pub(super) fn hit(model: &Model, state: &mut State, pair: Pair, from: f64, to: f64) -> Option<Hit> {
    state.counters.pair_tests += 1;
    if !overlaps(model, state, pair, to) {
        return None;
    }
    let time = if overlaps(model, state, pair, from) {
        (gap_of(model, state, pair, from).rate < 0.0).then_some(from)?
    } else {
        bisect(model, state, pair, from, to)
    };
    Some(Hit { time, pair })
}

/// Whether two bodies overlap: the test that is made most.
fn overlaps(model: &Model, state: &State, pair: Pair, time: f64) -> bool {
    if let Shape::Sphere(other) = &model.body(pair.b).shape {
        let at = state.position(pair.first(), time);
        let reach = model.radius(pair.first()) + other.radius;
        (state.path_of(model, pair.b).position(time) - at).length_squared() < reach * reach
    } else {
        gap_of(model, state, pair, time).distance < 0.0
    }
}

/// Halves from..=to until both tolerances are met; the answer is on the side that does not overlap.
fn bisect(model: &Model, state: &State, pair: Pair, from: f64, to: f64) -> f64 {
    let limits = StepLimits::DEFAULT;
    let moved = |low: f64, high: f64| {
        let way = |of: u32| (state.position(of, high) - state.position(of, low)).length();
        pair.dynamic().map(way).fold(0.0, f64::max)
    };
    let (mut low, mut high) = (from, to);
    for _ in 0..limits.halvings {
        if high - low <= limits.time && moved(low, high) <= limits.distance {
            break;
        }
        let middle = 0.5 * (low + high);
        if overlaps(model, state, pair, middle) { high = middle } else { low = middle }
    }
    low
}
