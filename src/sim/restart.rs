//! How bodies go on from an event: in free flight, captured by an attractor, or held by those they touch.

use std::collections::{BTreeMap, VecDeque};

use glam::DVec3;

use super::dense::{
    LARGE_ISLAND, Role, SMALLEST_CROWD, enter, is_stuck, least_crowd, note_held, note_impact, note_work,
};
use super::fault::{Fault, fault};
use super::gripping::{Gripped, begin_gripping, can_grip};
use super::island::{Island, begin_island, connected, drop_unpressed, islands};
use super::model::Model;
use super::motion::{begin_segment, begin_stay, place};
use super::neighbours::predict_all;
use super::rolling::{begin_on_face, lone_face, rubs};
use super::segment::Segment;
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
    /// At the core of an attractor, where it stays.
    Captured,
    /// With all that it is in lasting contact with; among them one that is captured stays too.
    Held,
}

fn regime(state: &State, body: u32) -> Regime {
    if !state.contacts[body as usize].is_empty() {
        Regime::Held
    } else if state.captured.contains(&body) {
        Regime::Captured
    } else {
        Regime::Free
    }
}

/// Lets bodies go on, with all that they are in contact with: contacts that no longer hold are dropped,
/// segments begin, and everything about them is predicted. All segments must stand before anything is
/// predicted between them.
pub(super) fn restart(model: &Model, state: &mut State, time: f64, starts: &[Start]) -> Result<(), Fault> {
    if starts.iter().all(|start| regime(state, start.body) != Regime::Held) {
        for start in starts {
            begin_alone(model, state, time, start)?;
        }
        starts.iter().for_each(|start| predict_all(model, state, start.body, time));
        return Ok(());
    }
    let (held, alone): (Vec<Start>, Vec<Start>) =
        starts.iter().partition(|start| regime(state, start.body) == Regime::Held);
    for start in &alone {
        begin_alone(model, state, time, start)?;
    }
    let mut bodies = begin_islands(model, state, time, &held)?;
    bodies.extend(alone.iter().map(|start| start.body));
    bodies.sort_unstable();
    for body in bodies {
        // Some may be stepped now.
        if state.role(body) == Role::Outside {
            predict_all(model, state, body, time);
        }
    }
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
    let mut to_step = Vec::new();
    // What is left may have fallen apart.
    let mut waiting: VecDeque<Vec<u32>> = islands(state, &bodies).into();
    while let Some(ids) = waiting.pop_front() {
        let mut island = island(state, ids);
        let regime = regime(state, island.ids[0]);
        note_regime(model, state, &island.ids, regime, time);
        match regime {
            Regime::Free | Regime::Captured => {
                debug_assert_eq!(island.ids.len(), 1, "bodies without contact move alone");
                let start = Start { body: island.ids[0], x: island.x[0], v: island.v[0] };
                begin_alone(model, state, time, &start)?;
            }
            Regime::Held if is_for_steps(model, state, &island, time) => {
                halt(model, state, &island, time);
                to_step.push(island.ids);
            }
            Regime::Held if rubs(model, &island) => match begin_rubbing(model, state, &mut island, time)? {
                Gripped::Goes => note_integrated(model, state, &island.ids, time),
                Gripped::Parted => {
                    // What parts may be put together again at once, and so for ever.
                    island.ids.iter().for_each(|body| note_impact(model, state, *body, time, true));
                    waiting.extend(islands(state, &island.ids));
                }
                Gripped::Stepped => {
                    halt(model, state, &island, time);
                    to_step.push(island.ids);
                }
            },
            Regime::Held => {
                begin_island(model, state, &mut island, time)
                    .map_err(|(body, error)| fault(model, body, time, error))?;
                note_integrated(model, state, &island.ids, time);
            }
        }
    }
    for ids in to_step {
        // One may have been taken along with another.
        if ids.iter().any(|body| state.role(*body) == Role::Outside) {
            enter(model, state, &ids, time)?;
        }
    }
    Ok(bodies)
}

/// Notes that an island goes on in contact.
fn note_regime(model: &Model, state: &mut State, ids: &[u32], regime: Regime, time: f64) {
    if regime == Regime::Held {
        note_held(model, state, ids, time);
    }
}

/// Notes what it costs to go on with an island, if its motion is integrated.
fn note_integrated(model: &Model, state: &mut State, ids: &[u32], time: f64) {
    if state.segments[ids[0] as usize].step > 0.0 {
        note_work(model, state, ids, time);
    }
}

/// Lets an island go on that rubs.
fn begin_rubbing(model: &Model, state: &mut State, island: &mut Island, time: f64) -> Result<Gripped, Fault> {
    let outcome = match lone_face(model, island) {
        Some(face) => begin_on_face(model, state, island, face, time).map(|()| Gripped::Goes),
        None => begin_gripping(model, state, island, time),
    };
    match outcome.map_err(|(body, error)| fault(model, body, time, error))? {
        Gripped::Stepped if state.dense.is_none() => {
            Err(Fault::internal(time, "bodies that rub can't be stepped"))
        }
        gripped => Ok(gripped),
    }
}

/// Whether an island is too large for events, costs too much, or rubs in a way that events do not know.
fn is_for_steps(model: &Model, state: &State, island: &Island, time: f64) -> bool {
    let ids = &island.ids;
    state.dense.is_some()
        && (ids.len() >= LARGE_ISLAND
            || is_stuck(model, state, ids.iter().copied(), time)
            || ids
                .iter()
                .filter_map(|body| least_crowd(model, state, *body, time))
                .any(|least| ids.len() >= least || model.plan.spin && least <= SMALLEST_CROWD)
            || rubs(model, island) && lone_face(model, island).is_none() && !can_grip(model, state, island))
}

/// Lets bodies begin anew where they are, from where a step of theirs will go on.
fn halt(model: &Model, state: &mut State, island: &Island, time: f64) {
    for ((body, x), v) in island.ids.iter().zip(&island.x).zip(&island.v) {
        place(model, state, *body, Segment::ballistic(time, *x, *v, DVec3::ZERO), None);
    }
}

/// Lets a body go on that touches no other.
fn begin_alone(model: &Model, state: &mut State, time: f64, start: &Start) -> Result<(), Fault> {
    let Start { body, x, v } = *start;
    let outcome = match regime(state, body) {
        Regime::Captured => begin_stay(model, state, body, time, x),
        Regime::Free | Regime::Held => begin_segment(model, state, body, time, x, v),
    };
    outcome.map_err(|error| fault(model, body, time, error))
}
