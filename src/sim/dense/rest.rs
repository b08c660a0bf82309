//! Leaving and coming to rest: by what bodies touch, and by how far they came.

use glam::DVec3;

use super::data::{Component, Dense, Role};
use super::membership::{Left, release};
use super::stepped::FIXED;
use super::tolerance::{IDLE_STEPS, STILL, STILL_ENERGY, STILL_STEPS};
use super::view::keep_forces;
use crate::sim::account::angular;
use crate::sim::body::BodyId;
use crate::sim::books::potential_of;
use crate::sim::event::{Event, EventKind};
use crate::sim::ledger::{rank, record};
use crate::sim::model::Model;
use crate::sim::motion::place;
use crate::sim::neighbours::register_within;
use crate::sim::rub::inertia;
use crate::sim::segment::Segment;
use crate::sim::state::State;

/// Lets members go that have had nothing to push for some steps, and no other moving body near.
pub(super) fn leave(model: &Model, state: &mut State, dense: &mut Dense, time: f64) -> Vec<Left> {
    if dense.is_list_stale {
        return Vec::new();
    }
    let leaves = |slot: usize| {
        let member = &dense.members[slot];
        member.is_stepped
            && !member.has_company
            && member.idle >= IDLE_STEPS
            && state.segments[member.body as usize].end <= time
    };
    let slots: Vec<usize> = (0..dense.members.len()).filter(|slot| leaves(*slot)).collect();
    let beside = fixed_beside(dense, &slots);
    let left: Vec<Left> = slots
        .iter()
        .zip(&beside)
        .map(|(slot, beside)| lifted(model, state, dense.members[*slot].body, beside, time))
        .collect();
    let bodies: Vec<u32> = left.iter().map(|left| left.body).collect();
    for left in &left {
        register_within(model, state, left.body, left.x, model.radius(left.body));
    }
    release(dense, &bodies, Role::Outside);
    left
}

/// What does not move beside each of some members, whose places are in order; each in the order of the list.
fn fixed_beside(dense: &Dense, slots: &[usize]) -> Vec<Vec<BodyId>> {
    let mut beside = vec![Vec::new(); slots.len()];
    if slots.is_empty() {
        return beside;
    }
    for listed in dense.pairs.iter().filter(|listed| listed.slots[1] == FIXED) {
        let slot = listed.slots[0] as usize;
        if let Ok(nth) = slots.binary_search(&slot) {
            beside[nth].push(listed.pair.other(dense.members[slot].body));
        }
    }
    beside
}

/// Where a member leaves from: out of what it overlaps, which is booked.
fn lifted(model: &Model, state: &mut State, body: u32, beside: &[BodyId], time: f64) -> Left {
    let (from, v) = (state.position(body, time), state.velocity(body, time));
    let mut x = from;
    for other in beside.iter().copied() {
        let near = model.body(other).shape.convex().nearest(state.path_of(model, other).segment.x, x);
        let depth = model.radius(body) - near.distance;
        if depth > 0.0 {
            x -= depth * near.towards;
        }
    }
    if x != from {
        let potential = |x: DVec3| potential_of(model, body, time, x).unwrap_or(0.0);
        state.account.impact_losses.add(potential(from) - potential(x));
        if model.plan.spin {
            state.account.angular.impulses.add(angular(x - from, model.mass(body) * v));
        }
    }
    Left { body, x, v }
}

/// Notes which bodies moved; whether a component lies still, so that it may be frozen.
pub(super) fn is_still(
    model: &Model,
    state: &State,
    dense: &mut Dense,
    component: &Component,
    time: f64,
) -> bool {
    let mut is_still = true;
    let (mut kinetic, mut scale) = (0.0, 0.0);
    for (slot, body) in component.slots.iter().zip(&component.work.bodies) {
        let member = &mut dense.members[*slot as usize];
        let radius = body.radius;
        if (body.x - member.anchor).length_squared() > (STILL * radius) * (STILL * radius) {
            (member.anchor, member.still_since) = (body.x, time);
        }
        is_still &= member.is_stepped && time - member.still_since >= STILL_STEPS * body.step;
        let mass = model.mass(body.body);
        kinetic += 0.5 * mass * drift(&state.segments[body.body as usize], time).length_squared();
        scale += mass * body.drive * radius;
    }
    is_still && kinetic <= STILL_ENERGY * scale && !model.may_depend_on_time()
}

/// Velocity of a body in the middle of the step that ends at a time, m/s. At both ends of it what lies still rises and
/// falls, by ½gh.
fn drift(segment: &Segment, time: f64) -> DVec3 {
    segment.v + 0.5 * (time - segment.start) * segment.a
}

/// Lets a component lie where it is. What it still moved is lost.
pub(super) fn freeze(model: &Model, state: &mut State, dense: &mut Dense, bodies: &[u32], time: f64) {
    let group = bodies.iter().map(|body| group_of(dense, *body)).max().unwrap_or(0);
    for body in bodies {
        let (x, v) = (state.position(*body, time), state.velocity(*body, time));
        let mass = model.mass(*body);
        if model.plan.spin {
            let (inertia, spin) = (inertia(model, *body), state.spin(*body, time));
            state.account.impact_losses.add(0.5 * inertia * spin.length_squared());
            state.account.angular.impulses.add(angular(x, -mass * v) - inertia * spin);
            state.give_spin(*body, DVec3::ZERO);
        }
        let still = Segment { constrained: true, ..Segment::ballistic(time, x, DVec3::ZERO, DVec3::ZERO) };
        place(model, state, *body, still, None);
        state.account.impact_losses.add(0.5 * mass * v.length_squared());
        state.account.impulses.add(-mass * v);
        register_within(model, state, *body, x, model.radius(*body));
    }
    dense.last_frozen += 1;
    let number = dense.last_frozen;
    release(dense, bodies, Role::Frozen(number));
    keep_forces(dense, number);
    record_group(model, state, EventKind::GroupRest, bodies, group, time);
}

/// The group that a member entered with; 0 for one that joined others.
fn group_of(dense: &Dense, body: u32) -> u64 {
    let Role::Member(slot) = dense.role(body) else { return 0 };
    dense.members[slot as usize].group
}

/// A row about a whole group: its body of the smallest UserID stands for it.
pub(super) fn record_group(
    model: &Model,
    state: &mut State,
    kind: EventKind,
    bodies: &[u32],
    group: u64,
    time: f64,
) {
    let ids = bodies.iter().map(|body| BodyId::of_dynamic(*body));
    let Some(first) = ids.min_by_key(|id| rank(model, id.to_ref())) else { return };
    let at = state.position(first.index(), time);
    let event = Event::of_one(time, kind, first.to_ref(), at);
    record(state, Event { group, bodies: bodies.len() as u32, ..event });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A group whose steps stay halved comes to rest too: one in a wedge of 300 balls never did.
    #[test]
    fn what_lies_still_does_not_drift_however_long_its_steps_are() {
        let gravity = DVec3::new(0.0, -9.81, 0.0);
        for halvings in 0..5 {
            let h = 1.0 / 1024.0 / f64::from(1 << halvings);
            let step = Segment::ballistic(3.0, DVec3::ONE, -0.5 * h * gravity, gravity);
            assert_eq!(drift(&step, 3.0 + h), DVec3::ZERO);
        }
    }
}
