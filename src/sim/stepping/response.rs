//! A collision: both bodies are where they meet; the law of impact, the books, a row of the ledger.

use super::overlap::Hit;
use super::trial;
use crate::sim::Fault;
use crate::sim::contact::gap_of;
use crate::sim::impact::{exchange, velocity_change};
use crate::sim::model::Model;
use crate::sim::state::State;

/// Lets a pair bounce. Its bodies must have been moved to `hit.time`. A pair that does not close in, such as
/// a ball that lies on a floor, exchanges nothing.
pub(super) fn respond(model: &Model, state: &mut State, hit: &Hit) -> Result<(), Fault> {
    let gap = gap_of(model, state, hit.pair, hit.time);
    if gap.rate >= 0.0 {
        return Ok(());
    }
    let impulse = exchange(model, state, hit.time, hit.pair, &gap);
    for (body, impulse) in hit.pair.dynamic().zip([-impulse, impulse]) {
        let change = velocity_change(model, body, impulse, gap.normal);
        let (x, v) = (state.position(body, hit.time), state.velocity(body, hit.time));
        trial::begin(model, state, body, hit.time, x, v + change)?;
    }
    Ok(())
}
