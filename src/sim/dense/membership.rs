//! Who is stepped: components are found, taken in, frozen and woken.

use std::collections::BTreeSet;

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::activity::take_stuck;
use super::data::{Dense, Member, Role};
use super::tolerance::{SAME_COMPONENT, STEPS_OF_STUCK};
use super::view::forget_forces;
use crate::sim::body::BodyId;
use crate::sim::model::Model;
use crate::sim::neighbours::within;
use crate::sim::state::State;

/// Some bodies that are not stepped, with all that they touch, directly or through others, and that are not stepped
/// either; in order.
pub(in crate::sim) fn component(
    model: &Model,
    state: &State,
    dense: &Dense,
    seeds: &[u32],
    time: f64,
) -> Vec<u32> {
    let mut bodies: Vec<u32> = Vec::new();
    let mut seen = FxHashSet::default();
    let mut see = |body: u32, bodies: &mut Vec<u32>| {
        if !dense.is_member(body) && seen.insert(body) {
            bodies.push(body);
        }
    };
    seeds.iter().for_each(|body| see(*body, &mut bodies));
    let mut next = 0;
    let mut found = Vec::new();
    while let Some(body) = bodies.get(next).copied() {
        next += 1;
        for contact in &state.contacts[body as usize] {
            if let Some(other) = contact.other.dynamic() {
                see(other, &mut bodies);
            }
        }
        let (at, radius) = (state.position(body, time), model.radius(body));
        within(model, state, at, (1.0 + SAME_COMPONENT) * radius, |other| other != body, &mut found);
        for other in found.drain(..).filter_map(BodyId::dynamic) {
            let other_radius = model.radius(other);
            let reach = radius + other_radius + SAME_COMPONENT * radius.min(other_radius);
            if (state.position(other, time) - at).length_squared() <= reach * reach {
                see(other, &mut bodies);
            }
        }
    }
    bodies.sort_unstable();
    bodies
}

/// Makes members of bodies that were none: their contacts are the group's from now on.
pub(super) fn take_in(state: &mut State, dense: &mut Dense, bodies: &[u32], time: f64, group: u64) {
    if dense.members.is_empty() {
        dense.stepped_since = time;
    }
    let frozen = dense.frozen;
    for body in bodies {
        if matches!(dense.role(*body), Role::Frozen(_)) {
            dense.frozen -= 1;
        }
        for contact in std::mem::take(&mut state.contacts[*body as usize]) {
            if let Some(other) = contact.other.dynamic() {
                let id = BodyId::of_dynamic(*body);
                state.contacts[other as usize].retain(|back| back.other != id);
            }
        }
        state.forget_touching(*body);
        state.plunges.remove(body);
        let x = state.position(*body, time);
        dense.members.push(Member {
            body: *body,
            listed_at: x,
            margin: 0.0,
            widened: 0.0,
            halvings: 0,
            easy: 0,
            given: 0.0,
            has_company: false,
            is_stepped: false,
            idle: 0,
            stays: if take_stuck(&mut dense.activity[*body as usize]) { STEPS_OF_STUCK } else { 0 },
            anchor: x,
            still_since: time,
            group,
        });
        dense.roles[*body as usize] = Role::Member(u32::MAX);
    }
    dense.renumber();
    if dense.frozen < frozen {
        forget_forces(dense);
    }
}

/// The bodies of components at rest, by the numbers of these.
pub(super) fn frozen_with(dense: &Dense, numbers: &BTreeSet<u32>) -> Vec<u32> {
    let is_its = |role: &Role| matches!(role, Role::Frozen(number) if numbers.contains(number));
    (0..).zip(&dense.roles).filter(|(_, role)| is_its(role)).map(|(body, _)| body).collect()
}

/// Lets members go.
pub(super) fn release(dense: &mut Dense, bodies: &[u32], role: Role) {
    if bodies.is_empty() {
        return;
    }
    for body in bodies {
        dense.roles[*body as usize] = role;
        dense.frozen += usize::from(role != Role::Outside);
    }
    let roles = &dense.roles;
    dense.members.retain(|member| matches!(roles[member.body as usize], Role::Member(_)));
    dense.renumber();
}

/// A body that left, with where it goes on from.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Left {
    pub body: u32,
    pub x: DVec3,
    pub v: DVec3,
}
