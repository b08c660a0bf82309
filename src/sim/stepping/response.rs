//! A collision: both bodies are where they meet; the law of impact, the books, a row of the ledger.

use glam::DVec3;

use super::trial;
use crate::sim::exchange::{exchange, velocity_change};
use crate::sim::fault::Fault;
use crate::sim::geometry::gap_of;
use crate::sim::model::Model;
use crate::sim::open_step::Hit;
use crate::sim::rub::rub_pair;
use crate::sim::state::State;

/// Lets a pair bounce. Its bodies must have been moved to `hit.time`. A pair that does not close in, such as
/// a ball that lies on a floor, exchanges nothing.
fn respond(model: &Model, state: &mut State, hit: &Hit) -> Result<(), Fault> {
    let gap = gap_of(model, state, hit.pair, hit.time);
    if gap.rate >= 0.0 {
        return Ok(());
    }
    let impulse = exchange(model, state, hit.time, hit.pair, &gap);
    let rubbed =
        if model.plan.spin { rub_pair(model, state, hit.time, hit.pair, &gap, impulse) } else { DVec3::ZERO };
    for (body, sign) in hit.pair.dynamic().zip([-1.0, 1.0]) {
        let mut change = velocity_change(model, state, body, sign * impulse, gap.normal);
        if rubbed != DVec3::ZERO {
            change += sign * state.inverse_mass(model, body) * rubbed;
        }
        let (x, v) = (state.position(body, hit.time), state.velocity(body, hit.time));
        trial::begin(model, state, body, hit.time, x, v + change)?;
    }
    Ok(())
}

/// Moves the bodies of a hit to it and lets them bounce.
pub(super) fn collide(
    model: &Model,
    state: &mut State,
    hit: &Hit,
    moved: impl Iterator<Item = u32>,
) -> Result<(), Fault> {
    for body in moved {
        trial::move_to(model, state, body, hit.time)?;
    }
    respond(model, state, hit)
}
