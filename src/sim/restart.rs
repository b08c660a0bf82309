//! How bodies go on from an event: each in free flight, or held together with those it touches.

use std::collections::BTreeMap;

use glam::DVec3;

use super::fault::{Fault, fault};
use super::island::{Island, begin_island, connected, drop_unpressed, islands};
use super::model::Model;
use super::motion::begin_segment;
use super::neighbours::predict_all;
use super::state::State;

/// Where a body goes on from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Start {
    pub body: u32,
    pub x: DVec3,
    pub v: DVec3,
}

/// How a body goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Regime {
    /// In flight, under the applied forces alone.
    Free,
    /// With all that it is in lasting contact with.
    Held,
}

fn regime(state: &State, body: u32) -> Regime {
    if state.contacts[body as usize].is_empty() { Regime::Free } else { Regime::Held }
}

/// Lets bodies go on, with all that they are in contact with: contacts that no longer hold are dropped,
/// segments begin, and everything about them is predicted. All segments must stand before anything is
/// predicted between them.
pub(super) fn restart(model: &Model, state: &mut State, time: f64, starts: &[Start]) -> Result<(), Fault> {
    if starts.iter().all(|start| regime(state, start.body) == Regime::Free) {
        for start in starts {
            begin_free(model, state, time, start)?;
        }
        starts.iter().for_each(|start| predict_all(model, state, start.body, time));
        return Ok(());
    }
    let (free, held): (Vec<Start>, Vec<Start>) =
        starts.iter().partition(|start| regime(state, start.body) == Regime::Free);
    for start in &free {
        begin_free(model, state, time, start)?;
    }
    let mut bodies = begin_islands(model, state, time, &held)?;
    bodies.extend(free.iter().map(|start| start.body));
    bodies.sort_unstable();
    bodies.into_iter().for_each(|body| predict_all(model, state, body, time));
    Ok(())
}

/// Begins segments for bodies and all that they are in contact with; gives them all.
fn begin_islands(model: &Model, state: &mut State, time: f64, starts: &[Start]) -> Result<Vec<u32>, Fault> {
    let bodies = connected(state, starts.iter().map(|start| start.body));
    debug_assert!(
        bodies.iter().all(|body| state.has_symmetric_contacts(*body)),
        "both bodies list a contact"
    );
    let given: BTreeMap<u32, &Start> = starts.iter().map(|start| (start.body, start)).collect();
    let island = |state: &State, ids: Vec<u32>| {
        Island::new(model, state, ids, |body| match given.get(&body) {
            Some(start) => (start.x, start.v),
            None => (state.position(body, time), state.velocity(body, time)),
        })
    };
    for ids in islands(state, &bodies) {
        drop_unpressed(model, state, &island(state, ids), time);
    }
    // What is left may have fallen apart.
    for ids in islands(state, &bodies) {
        let mut island = island(state, ids);
        match regime(state, island.ids[0]) {
            Regime::Free => {
                debug_assert_eq!(island.ids.len(), 1, "free bodies move alone");
                let start = Start { body: island.ids[0], x: island.x[0], v: island.v[0] };
                begin_free(model, state, time, &start)?;
            }
            Regime::Held => begin_island(model, state, &mut island, time)
                .map_err(|(body, error)| fault(model, body, time, error))?,
        }
    }
    Ok(bodies)
}

fn begin_free(model: &Model, state: &mut State, time: f64, start: &Start) -> Result<(), Fault> {
    begin_segment(model, state, start.body, time, start.x, start.v)
        .map_err(|error| fault(model, start.body, time, error))
}
