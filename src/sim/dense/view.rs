//! What can be seen of stepped groups: how many bodies are stepped and since when, and what they press on each other
//! with, also where they have come to rest.

use super::data::{Dense, Held, Role};
use crate::sim::geometry::gap_of;
use crate::sim::model::Model;
use crate::sim::pair::Pair;
use crate::sim::report::{ContactForce, SteppedBodies};
use crate::sim::state::State;

/// How many bodies are stepped now; `None` for none.
pub(in crate::sim) fn stepped_bodies(model: &Model, state: &State) -> Option<SteppedBodies> {
    let dense = state.dense.as_ref().filter(|dense| !dense.members.is_empty())?;
    Some(SteppedBodies { count: dense.members.len(), since: dense.stepped_since, step: model.dense_step })
}

/// Contacts of stepped bodies and of those that came to rest together, with the forces of the last step; in the order
/// of their bodies, and if there are more than `most`, the strongest.
pub(in crate::sim) fn contact_forces(model: &Model, state: &State, most: usize) -> Vec<ContactForce> {
    let Some(dense) = &state.dense else { return Vec::new() };
    let is_stepped = |pair: Pair| pair.dynamic().any(|body| dense.is_member(body));
    let pressed = dense.listed().filter(|near| near.force > 0.0 && is_stepped(near.pair));
    let held = dense.held.iter().filter(|held| is_held(dense, held.pair));
    let mut forces: Vec<Held> = pressed.map(|near| Held { pair: near.pair, force: near.force }).collect();
    forces.extend(held);
    if forces.len() > most {
        forces.select_nth_unstable_by(most, |one, other| {
            other.force.total_cmp(&one.force).then(one.pair.cmp(&other.pair))
        });
        forces.truncate(most);
    }
    forces.sort_unstable_by_key(|held| held.pair);
    forces.iter().map(|held| shown(model, state, *held)).collect()
}

fn shown(model: &Model, state: &State, Held { pair, force }: Held) -> ContactForce {
    let gap = gap_of(model, state, pair, state.now);
    let (a, b) = pair.refs();
    ContactForce { a, b, point: gap.point, normal: gap.normal, force }
}

/// Keeps the forces of a component that has just come to rest, as long as it does.
pub(super) fn keep_forces(dense: &mut Dense, number: u32) {
    let roles = &dense.roles;
    let is_of_it = |pair: Pair| pair.dynamic().any(|body| roles[body as usize] == Role::Frozen(number));
    let kept = dense.listed().filter(|near| near.force > 0.0 && is_of_it(near.pair));
    let kept: Vec<Held> = kept.map(|near| Held { pair: near.pair, force: near.force }).collect();
    dense.held.extend(kept);
}

/// Forgets the forces of bodies that lie still no longer.
pub(super) fn forget_forces(dense: &mut Dense) {
    let mut held = std::mem::take(&mut dense.held);
    held.retain(|held| is_held(dense, held.pair));
    dense.held = held;
}

fn is_held(dense: &Dense, pair: Pair) -> bool {
    pair.dynamic().all(|body| matches!(dense.role(body), Role::Frozen(_)))
}
