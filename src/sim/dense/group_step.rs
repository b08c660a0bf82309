//! The step of stepped groups: the components that are due are bounded, solved, booked and sent on.

use std::collections::BTreeSet;

use glam::DVec3;

use super::clock::{step_at, step_end};
use super::data::{Component, Dense, Member, Role, Work};
use super::list::{self, NearOutsiders};
use super::membership::{Left, component, frozen_with, take_in};
use super::rest::{freeze, is_still, leave, record_group};
use super::solve::{Landing, find_contacts, solve_contacts};
use super::start::read_bodies;
use super::stepped::{Contact, FIXED, Stepped, velocity};
use super::tolerance::{
    EASY_STEPS, MOST_ATTEMPTS, MOST_HALVINGS, MOST_HALVINGS_TO_CONVERGE, MOST_SWEEPS, TURN_IN_A_STEP,
    WAY_OF_RADIUS,
};
use crate::sim::account::angular;
use crate::sim::body::BodyId;
use crate::sim::books::book_kick;
use crate::sim::capture::{hold, is_swallowed};
use crate::sim::event::EventKind;
use crate::sim::fault::{Fault, fault};
use crate::sim::geometry::{ball, contact_distance, gap_of, rubbing_of, surface_of, target};
use crate::sim::model::Model;
use crate::sim::motion::{check, place};
use crate::sim::neighbours::{predict_all, predict_pair, reach_of};
use crate::sim::pair::Pair;
use crate::sim::predict;
use crate::sim::segment::Segment;
use crate::sim::shape::Surface;
use crate::sim::state::State;

/// When the next step is due, s; infinite while nothing is stepped.
pub(in crate::sim) fn next_step(state: &State) -> f64 {
    state.dense.as_ref().map_or(f64::INFINITY, |dense| dense.next)
}

/// Lets the components that are due at a time go on, with all that waits to join them. Gives the bodies that left
/// and are to go on from event to event.
pub(in crate::sim) fn step(model: &Model, state: &mut State, time: f64) -> Result<Vec<Left>, Fault> {
    with_dense(model, state, time, |state, dense| {
        take_waiting(model, state, dense, time);
        let left = leave(model, state, dense, time);
        Ok((left, advance(model, state, dense, time)?))
    })
}

/// Takes in the bodies that wait to join, with all that they touch.
fn take_waiting(model: &Model, state: &mut State, dense: &mut Dense, time: f64) {
    let waiting = std::mem::take(&mut dense.waiting);
    if !waiting.is_empty() {
        let bodies = component(model, state, dense, &waiting, time);
        take_in(state, dense, &bodies, time, 0);
    }
}

/// Takes in bodies with all that they touch, and lets them go on: a new group.
pub(in crate::sim) fn enter(model: &Model, state: &mut State, seeds: &[u32], time: f64) -> Result<(), Fault> {
    take_over(model, state, seeds, time, true)
}

/// A body is about to come near a member: it joins at the next step, or now if they touch before that.
pub(in crate::sim) fn reach(
    model: &Model,
    state: &mut State,
    body: u32,
    member: u32,
    time: f64,
) -> Result<(), Fault> {
    let is_near = reach_of(model, state, body, member, time).is_some();
    let Some(next) = state.dense.as_ref().filter(|_| is_near).map(|dense| dense.next) else { return Ok(()) };
    if meet_before(model, state, (body, member), time, next) {
        return take_over(model, state, &[body], time, false);
    }
    if let Some(dense) = state.dense.as_mut().filter(|dense| !dense.waiting.contains(&body)) {
        dense.waiting.push(body);
    }
    Ok(())
}

/// Whether two bodies meet on their present segments before some time. They may touch already, and be searched from
/// there in vain.
fn meet_before(model: &Model, state: &State, (body, member): (u32, u32), time: f64, next: f64) -> bool {
    let pair = Pair::of(body, BodyId::of_dynamic(member));
    let gap = gap_of(model, state, pair, time);
    let ball = ball(model, state, pair.first());
    let met = || predict::first_contact(ball, target(model, state, pair.b), time);
    gap.distance <= contact_distance(model, pair, gap.point) || met().is_some_and(|met| met <= next)
}

/// Wakes all that lies still, and steps all that is stepped anew: after an edit.
pub(in crate::sim) fn wake_all(model: &Model, state: &mut State, time: f64) -> Result<(), Fault> {
    with_dense(model, state, time, |state, dense| {
        let frozen: Vec<u32> = (0..)
            .zip(&dense.roles)
            .filter(|(_, role)| matches!(role, Role::Frozen(_)))
            .map(|(body, _)| body)
            .collect();
        take_in(state, dense, &frozen, time, 0);
        dense.members.iter_mut().for_each(|member| member.is_stepped = false);
        Ok((Vec::new(), advance(model, state, dense, time)?))
    })
    .map(|_| ())
}

/// Forgets bodies that an edit has removed, before any other goes on, and who waits to join: the next list finds that anew.
pub(in crate::sim) fn forget_removed(model: &Model, state: &mut State) {
    let Some(dense) = &mut state.dense else { return };
    dense.waiting.clear();
    let is_gone = |body: u32| !model.dynamic(body).present;
    dense.members.retain(|member| !is_gone(member.body));
    for (_, role) in (0..).zip(&mut dense.roles).filter(|(body, _)| is_gone(*body)) {
        dense.frozen -= usize::from(matches!(role, Role::Frozen(_)));
        *role = Role::Outside;
    }
    dense.renumber();
}

fn take_over(model: &Model, state: &mut State, seeds: &[u32], time: f64, is_news: bool) -> Result<(), Fault> {
    with_dense(model, state, time, |state, dense| {
        let bodies = component(model, state, dense, seeds, time);
        if is_news {
            state.group += 1;
            let group = state.group;
            record_group(model, state, EventKind::Dense, &bodies, group, time);
        }
        let group = if is_news { state.group } else { 0 };
        take_in(state, dense, &bodies, time, group);
        // Who waits was to meet nobody before the next step, but now this one is a step.
        take_waiting(model, state, dense, time);
        Ok((Vec::new(), advance(model, state, dense, time)?))
    })
    .map(|_| ())
}

/// What there is to do when all roles and segments stand.
#[derive(Default)]
struct Outcome {
    near: NearOutsiders,
    frozen: Vec<u32>,
}

/// Runs a change of the stepped bodies, and then predicts who may come near them.
fn with_dense(
    model: &Model,
    state: &mut State,
    time: f64,
    change: impl FnOnce(&mut State, &mut Dense) -> Result<(Vec<Left>, Outcome), Fault>,
) -> Result<Vec<Left>, Fault> {
    let Some(mut dense) = state.dense.take() else { return Ok(Vec::new()) };
    let outcome = change(state, &mut dense);
    let ends = dense.members.iter().map(|member| state.segments[member.body as usize].end);
    dense.next = ends.fold(f64::INFINITY, f64::min);
    state.dense = Some(dense);
    let (left, Outcome { near, frozen }) = outcome?;
    for (member, outsider) in near {
        predict_pair(model, state, Pair::of(member, BodyId::of_dynamic(outsider)), f64::NEG_INFINITY, time);
    }
    frozen.into_iter().for_each(|body| predict_all(model, state, body, time));
    Ok(left)
}

/// Steps all components that are due.
fn advance(model: &Model, state: &mut State, dense: &mut Dense, time: f64) -> Result<Outcome, Fault> {
    let mut outcome = Outcome::default();
    for attempt in 1..=MOST_ATTEMPTS {
        if list::is_old(model, state, dense, time) {
            outcome.near = list::make(model, state, dense, time);
        }
        let mut components = std::mem::take(&mut dense.components);
        let is_last = attempt == MOST_ATTEMPTS;
        let is_done = try_step(model, state, dense, &mut components, (time, is_last));
        let still = take_still(dense, &mut components);
        dense.components = components;
        if is_done? {
            for bodies in still {
                freeze(model, state, dense, &bodies, time);
                outcome.frozen.extend(bodies);
            }
            break;
        }
    }
    Ok(outcome)
}

/// Holds the bodies of a component that attractors have captured.
fn swallow(model: &Model, state: &mut State, dense: &Dense, component: &Component, time: f64) {
    if model.is_ballistic() {
        return;
    }
    for slot in &component.slots {
        let body = dense.members[*slot as usize].body;
        let now = (state.position(body, time), state.velocity(body, time));
        if !state.captured.contains(&body) && is_swallowed(model, body, now) {
            hold(model, state, body, time);
        }
    }
}

/// Steps the components that are due, unless the list must be made anew for it, which is news for all but the last
/// attempt.
fn try_step(
    model: &Model,
    state: &mut State,
    dense: &mut Dense,
    components: &mut [Component],
    (time, is_last): (f64, bool),
) -> Result<bool, Fault> {
    let due = |component: &&mut Component| is_due(state, dense, component, time);
    let mut due: Vec<&mut Component> = components.iter_mut().filter(due).collect();
    for component in &mut due {
        swallow(model, state, dense, component, time);
        read_bodies(model, state, dense, component, time);
    }
    let reached = reached_frozen(model, state, dense, &due, time);
    if !reached.is_empty() {
        take_in(state, dense, &reached, time, 0);
        return Ok(false);
    }
    for component in &mut due {
        component.work.is_still = is_still(model, state, dense, component, time);
        if !component.work.is_still {
            propose(model, state, dense, component, time);
        }
    }
    due.retain(|component| !component.work.is_still);
    if widen(dense, &due, time) && !is_last {
        return Ok(false);
    }
    due.into_iter().try_for_each(|component| carry_out(model, state, dense, component, time)).map(|()| true)
}

/// The bodies of each component that was found to lie still.
fn take_still(dense: &Dense, components: &mut [Component]) -> Vec<Vec<u32>> {
    let still = components.iter_mut().filter_map(|component| {
        let bodies = || component.slots.iter().map(|slot| dense.members[*slot as usize].body).collect();
        std::mem::take(&mut component.work.is_still).then(bodies)
    });
    still.collect()
}

/// Whether a step of a member has ended, or it has just entered.
fn is_due(state: &State, dense: &Dense, component: &Component, time: f64) -> bool {
    component.slots.iter().any(|slot| {
        let member = &dense.members[*slot as usize];
        !member.is_stepped || state.segments[member.body as usize].end <= time
    })
}

/// The bodies of components at rest that one of these may reach in its step.
fn reached_frozen(
    model: &Model,
    state: &State,
    dense: &Dense,
    components: &[&mut Component],
    time: f64,
) -> Vec<u32> {
    let mut numbers = BTreeSet::new();
    for index in components.iter().flat_map(|component| &component.with_frozen) {
        let listed = &dense.pairs[*index as usize];
        let member = &dense.members[listed.slots[0] as usize];
        let Some(other) = listed.pair.other(member.body).dynamic() else { continue };
        let Role::Frozen(number) = dense.role(other) else { continue };
        let path = state.path(member.body);
        let (x, v) = (path.position(time), path.velocity(time));
        let gap =
            (x - state.segments[other as usize].x).length() - model.radius(member.body) - model.radius(other);
        let step = step_at(model, member.body, time, (x, v));
        let way = step * (v.length() + step * path.segment.a.length());
        if gap <= 2.0 * way {
            numbers.insert(number);
        }
    }
    if numbers.is_empty() { Vec::new() } else { frozen_with(dense, &numbers) }
}

/// Solves the step of a component, halved as often as it takes.
fn propose(model: &Model, state: &mut State, dense: &Dense, component: &mut Component, time: f64) {
    let by_pull = component.work.bodies.iter().map(|body| body.halvings_by_pull).max().unwrap_or(0);
    begin_halved(model, dense, component, by_pull);
    let given = component.slots.iter().map(|slot| dense.members[*slot as usize].given);
    component.work.given = given.fold(0.0, f64::max);
    loop {
        let work = &mut component.work;
        work.end = step_end(model.dense_step, work.halvings, time);
        let h = work.end - time;
        work.bodies.iter_mut().for_each(|body| body.take_step(h));
        let spin = model.plan.spin.then_some(|body| state.spin(body, time));
        work.rubbing.begin(&work.bodies, spin);
        find_contacts(model, state, component, h);
        solve_contacts(model, state, dense, component, h, Landing::OrRebound);
        let work = &mut component.work;
        state.counters.sweeps += work.solution.sweeps as u64;
        if work.solution.has_converged {
            return;
        }
        if work.halvings >= by_pull + MOST_HALVINGS_TO_CONVERGE {
            if work.solution.gains {
                solve_contacts(model, state, dense, component, h, Landing::Only);
                state.counters.sweeps += component.work.solution.sweeps as u64;
            }
            return;
        }
        state.counters.halvings += 1;
        work.halvings += 1;
    }
}

/// How often the step of a component must be halved at least: as often as steps before to converge, or once less after
/// many easy ones, so often as the pull of attractors wants it, and so often that nobody passes much of its radius in it.
fn begin_halved(model: &Model, dense: &Dense, component: &mut Component, by_pull: u8) {
    let members = component.slots.iter().map(|slot| &dense.members[*slot as usize]);
    let kept = |member: &Member| member.halvings.saturating_sub(u8::from(member.easy >= EASY_STEPS));
    let kept_halvings = members.map(kept).max().unwrap_or(0);
    let mut halvings = kept_halvings.max(by_pull);
    let ways = component.work.bodies.iter().map(|body| model.dense_step * body.v.length() / body.radius);
    let stiffest = component.work.bodies.iter().map(|body| body.stiffness).fold(0.0, f64::max);
    // The part of a radius that is passed, and that of a turn.
    let passed =
        (ways.fold(0.0, f64::max) / WAY_OF_RADIUS).max(model.dense_step * stiffest.sqrt() / TURN_IN_A_STEP);
    while passed > f64::from(1_u32 << halvings) && halvings < by_pull + MOST_HALVINGS {
        halvings += 1;
    }
    let work = &mut component.work;
    (work.halvings, work.first_halvings, work.kept_halvings) = (halvings, halvings, kept_halvings);
}

/// Whether somebody would leave what the list covers; the next list will cover it.
fn widen(dense: &mut Dense, components: &[&mut Component], time: f64) -> bool {
    let mut is_wanted = false;
    for component in components {
        let work = &component.work;
        let h = work.end - time;
        for ((slot, body), moving) in component.slots.iter().zip(&work.bodies).zip(&work.system.moving) {
            let member = &mut dense.members[*slot as usize];
            let way = h * (velocity(moving).length() + h * body.drive);
            if (body.x - member.listed_at).length() + way > member.margin {
                member.widened = 2.0 * way;
                is_wanted = true;
            }
        }
    }
    dense.is_list_stale |= is_wanted;
    is_wanted
}

/// Books a step and sends its bodies on.
fn carry_out(
    model: &Model,
    state: &mut State,
    dense: &mut Dense,
    component: &mut Component,
    time: f64,
) -> Result<(), Fault> {
    let h = component.work.end - time;
    note_forces(dense, component, h);
    let Component { slots, work, .. } = &*component;
    state.counters.steps += 1;
    state.counters.contacts += work.contacts.len() as u64;
    state.account.impact_losses.add(work.solution.loss);
    for slot in slots {
        let member = &mut dense.members[*slot as usize];
        note_length(member, work);
        member.given = (work.given - work.solution.loss).max(0.0);
        member.is_stepped = true;
    }
    book_outside(state, work);
    if !work.rubbing.spins.is_empty() {
        note_friction(model, dense, component, h);
        book_friction(state, work);
        for (body, spin) in work.bodies.iter().zip(&work.rubbing.spins) {
            state.give_spin(body.body, *spin);
        }
    }
    for (body, moving) in work.bodies.iter().zip(&work.system.moving) {
        let v = if body.inverse_mass > 0.0 { velocity(moving) - 0.5 * h * body.a } else { DVec3::ZERO };
        let segment =
            Segment { end: work.end, constrained: true, ..Segment::ballistic(time, body.x, v, body.a) };
        check(model, &segment).map_err(|error| fault(model, body.body, time, error))?;
        if body.kick != DVec3::ZERO {
            book_kick(model, state, body.body, time, body.kick, body.v - body.kick);
        }
        place(model, state, body.body, segment, None);
    }
    Ok(())
}

/// Keeps how often a step had to be halved to converge.
fn note_length(member: &mut Member, work: &Work) {
    let before = member.halvings;
    let had_to = work.halvings > work.first_halvings;
    member.halvings = if had_to { work.halvings } else { work.kept_halvings };
    let is_easy = member.halvings == before && work.solution.sweeps < MOST_SWEEPS / 4;
    member.easy = if is_easy { member.easy.saturating_add(1) } else { 0 };
}

/// Keeps the forces for the next step, and who is pushed by another body.
fn note_forces(dense: &mut Dense, component: &mut Component, h: f64) {
    let Component { slots, near, work, .. } = component;
    for slot in slots.iter() {
        let member = &mut dense.members[*slot as usize];
        member.idle = member.idle.saturating_add(1);
        member.stays = member.stays.saturating_sub(1);
    }
    near.iter_mut().for_each(|near| near.force = 0.0);
    for contact in work.contacts.iter().filter(|contact| contact.impulse > 0.0) {
        let near = &mut near[contact.near as usize];
        near.force = contact.impulse / h;
        for slot in [contact.a, contact.b].into_iter().filter_map(|body| slots.get(body as usize)) {
            let member = &mut dense.members[*slot as usize];
            if near.pair.second().is_some() || member.stays > 0 {
                member.idle = 0;
            }
        }
    }
}

/// Keeps the friction for the next step. Whoever lies on two bodies that do not move stays, however it moves, and so does who
/// rolls on one where that can't be followed from event to event: it would be back at once.
fn note_friction(model: &Model, dense: &mut Dense, component: &Component, h: f64) {
    let Component { slots, near, work, .. } = component;
    for near in near {
        dense.rubs[near.listed as usize] = DVec3::ZERO;
    }
    for (contact, impulse) in work.rubbing.impulses() {
        dense.rubs[work.contacts[contact].listed as usize] = impulse / h;
    }
    let mut supports = vec![0_u32; slots.len()];
    for contact in work.contacts.iter().filter(|contact| contact.impulse > 0.0 && contact.b == FIXED) {
        let body = &work.bodies[contact.a as usize];
        let is_followed = is_followed(model, body, dense.pairs[contact.listed as usize].pair);
        supports[contact.a as usize] += if is_followed { 1 } else { 2 };
    }
    for (slot, _) in slots.iter().zip(supports).filter(|(_, supports)| *supports > 1) {
        dense.members[*slot as usize].idle = 0;
    }
}

/// Whether what one ball does on a body that does not move is known from event to event: rolling friction is on a face alone,
/// where nothing but uniform forces acts.
fn is_followed(model: &Model, body: &Stepped, pair: Pair) -> bool {
    let other = pair.other(body.body);
    let is_face = || other.is_static() && matches!(surface_of(model, other, body.x), Surface::Flat(_));
    rubbing_of(model, pair).rolling == 0.0 || (model.is_ballistic() && is_face())
}

/// Books the friction that what does not move gave, and the angular momentum of all that it gave.
fn book_friction(state: &mut State, work: &Work) {
    let is_fixed = |index: u32| work.bodies.get(index as usize).is_none_or(|body| body.inverse_mass == 0.0);
    let shares = |ends: [u32; 2]| f64::from(is_fixed(ends[0])) - f64::from(is_fixed(ends[1]));
    let at = |contact: &Contact| {
        let body = &work.bodies[contact.a as usize];
        body.x + body.radius * contact.normal
    };
    for contact in work.contacts.iter().filter(|contact| contact.impulse > 0.0) {
        let given = shares([contact.a, contact.b]) * contact.impulse * contact.normal;
        state.account.angular.impulses.add(angular(at(contact), given));
    }
    for (contact, impulse) in work.rubbing.impulses() {
        let contact = &work.contacts[contact];
        let given = shares([contact.a, contact.b]) * impulse;
        state.account.impulses.add(given);
        state.account.angular.impulses.add(angular(at(contact), given));
    }
    for (ends, torque) in work.rubbing.torques() {
        state.account.angular.impulses.add(shares(ends) * torque);
    }
}

/// Books the impulses that what does not move gave.
fn book_outside(state: &mut State, work: &Work) {
    let is_fixed = |index: u32| work.bodies.get(index as usize).is_none_or(|body| body.inverse_mass == 0.0);
    let mut given = DVec3::ZERO;
    for contact in work.contacts.iter().filter(|contact| contact.impulse > 0.0) {
        if is_fixed(contact.b) {
            given -= contact.impulse * contact.normal;
        } else if is_fixed(contact.a) {
            given += contact.impulse * contact.normal;
        }
    }
    state.account.impulses.add(given);
}
