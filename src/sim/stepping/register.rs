//! Tiles of the bodies at a time.

use crate::sim::model::Model;
use crate::sim::state::State;

/// Moves a body to the tiles of its box at `time`.
pub(super) fn register(model: &Model, state: &mut State, body: u32, time: f64) {
    let (position, radius) = (state.position(body, time), model.radius(body));
    let new = model.grid.range(position - radius, position + radius);
    let old = state.registered[body as usize];
    if new != old {
        state.dynamic_tiles.change(&model.grid, old, new, body);
        state.registered[body as usize] = new;
        state.counters.tile_crossings += 1;
    }
}
