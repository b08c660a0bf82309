//! The step of stepped groups: the components that are due are bounded, solved, booked and sent on.

use glam::DVec3;

use super::clock::step_end;
use super::contact::{Contact, Stepped, contact};
use super::data::{Dense, FIXED, Member, Role};
use super::list::{self, NearOutsiders};
use super::membership::{Left, component, frozen_with, take_in};
use super::rest::{freeze, is_still, leave, record_group};
use super::sweep::{Solution, solve};
use super::tolerance::{
    MOST_ATTEMPTS, MOST_HALVINGS, MOST_HALVINGS_TO_CONVERGE, MOST_SWEEPS, TURN_IN_A_STEP, WAY_OF_RADIUS,
};
use crate::sim::body::BodyId;
use crate::sim::capture::{hold, is_swallowed};
use crate::sim::event::EventKind;
use crate::sim::fault::{Fault, fault};
use crate::sim::force::Law;
use crate::sim::model::Model;
use crate::sim::motion::{check, place};
use crate::sim::neighbours::{predict_all, predict_pair, reach_of};
use crate::sim::pair::Pair;
use crate::sim::place::Place;
use crate::sim::segment::Segment;
use crate::sim::state::State;

/// When the next step is due, s; infinite while nothing is stepped.
pub(in crate::sim) fn next_step(state: &State) -> f64 {
    state.dense.as_ref().map_or(f64::INFINITY, |dense| dense.next)
}

/// Lets the components that are due at a time go on, with all that waits to join them. Gives the bodies that left
/// and are to go on from event to event.
pub(in crate::sim) fn step(model: &Model, state: &mut State, time: f64) -> Result<Vec<Left>, Fault> {
    with_dense(model, state, time, |state, dense| {
        let waiting = std::mem::take(&mut dense.waiting);
        for body in waiting {
            let bodies = component(model, state, dense, &[body], time);
            take_in(state, dense, &bodies, time, 0);
        }
        let left = leave(model, state, dense, time);
        Ok((left, advance(model, state, dense, time)?))
    })
}

/// Takes in bodies with all that they touch, and lets them go on. It is news unless they join others.
pub(in crate::sim) fn enter(model: &Model, state: &mut State, seeds: &[u32], time: f64) -> Result<(), Fault> {
    take_over(model, state, seeds, time, true)
}

/// A body is about to come near a member: it joins at the next step, or now if that is too late.
pub(in crate::sim) fn reach(
    model: &Model,
    state: &mut State,
    body: u32,
    member: u32,
    time: f64,
) -> Result<(), Fault> {
    let met = reach_of(model, state, body, member, time);
    let Some(dense) = state.dense.as_mut() else { return Ok(()) };
    let Some(met) = met else { return Ok(()) };
    if met > dense.next {
        if !dense.waiting.contains(&body) {
            dense.waiting.push(body);
        }
        return Ok(());
    }
    take_over(model, state, &[body], time, false)
}

/// Wakes all that lies still, and steps all that is stepped anew: after an edit.
pub(in crate::sim) fn wake_all(model: &Model, state: &mut State, time: f64) -> Result<(), Fault> {
    with_dense(model, state, time, |state, dense| {
        forget_removed(model, dense);
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

/// Forgets bodies that an edit has removed.
fn forget_removed(model: &Model, dense: &mut Dense) {
    let is_gone = |body: u32| !model.dynamic(body).present;
    dense.members.retain(|member| !is_gone(member.body));
    dense.waiting.retain(|body| !is_gone(*body));
    for (_, role) in (0..).zip(&mut dense.roles).filter(|(body, _)| is_gone(*body)) {
        dense.frozen -= usize::from(matches!(role, Role::Frozen(_)));
        *role = Role::Outside;
    }
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

/// Members connected by listed pairs, which are stepped together.
struct Component {
    slots: Vec<u32>,
    /// Places in the list of pairs.
    listed: Vec<u32>,
}

/// A component with what its step came to.
struct Proposal {
    component: Component,
    bodies: Vec<Stepped>,
    contacts: Vec<Contact>,
    solution: Solution,
    end: f64,
    halvings: u8,
}

/// Steps all components that are due.
fn advance(model: &Model, state: &mut State, dense: &mut Dense, time: f64) -> Result<Outcome, Fault> {
    let mut outcome = Outcome::default();
    for attempt in 1..=MOST_ATTEMPTS {
        if list::is_old(model, state, dense, time) {
            outcome.near = list::make(model, state, dense, time);
        }
        let components = due(state, dense, time);
        swallow(model, state, dense, &components, time);
        let reached = reached_frozen(model, state, dense, &components, time);
        if !reached.is_empty() {
            take_in(state, dense, &reached, time, 0);
            continue;
        }
        let (mut proposals, mut still) = (Vec::new(), Vec::new());
        for component in components {
            let bodies = bodies_of(model, state, dense, &component, time);
            if is_still(model, dense, &component.slots, &bodies, time) {
                still.push(component);
            } else {
                proposals.push(propose(model, state, dense, component, bodies, time));
            }
        }
        if widen(dense, &proposals, time) && attempt < MOST_ATTEMPTS {
            continue;
        }
        for proposal in proposals {
            carry_out(model, state, dense, proposal, time)?;
        }
        let frozen: Vec<Vec<u32>> = still.iter().map(|component| bodies_in(dense, component)).collect();
        for bodies in frozen {
            freeze(model, state, dense, &bodies, time);
            outcome.frozen.extend(bodies);
        }
        break;
    }
    Ok(outcome)
}

/// Holds the bodies of components that attractors have captured.
fn swallow(model: &Model, state: &mut State, dense: &Dense, components: &[Component], time: f64) {
    if model.is_ballistic() {
        return;
    }
    for slot in components.iter().flat_map(|component| &component.slots) {
        let body = dense.members[*slot as usize].body;
        let now = (state.position(body, time), state.velocity(body, time));
        if !state.captured.contains(&body) && is_swallowed(model, body, now) {
            hold(model, state, body, time);
        }
    }
}

fn bodies_in(dense: &Dense, component: &Component) -> Vec<u32> {
    component.slots.iter().map(|slot| dense.members[*slot as usize].body).collect()
}

/// The components with a member whose step has ended, or that has just entered; in the order of their first bodies.
fn due(state: &State, dense: &Dense, time: f64) -> Vec<Component> {
    let count = dense.members.len();
    let mut roots: Vec<u32> = (0..count as u32).collect();
    for listed in &dense.pairs {
        let [a, b] = listed.slots;
        if b != FIXED {
            let (a, b) = (root(&mut roots, a), root(&mut roots, b));
            // The first body of a component is its root.
            roots[a.max(b) as usize] = a.min(b);
        }
    }
    let is_due = |member: &Member| !member.is_stepped || state.segments[member.body as usize].end <= time;
    let mut place = vec![FIXED; count];
    let mut is_wanted = vec![false; count];
    for (slot, member) in (0..).zip(&dense.members) {
        if is_due(member) {
            is_wanted[root(&mut roots, slot) as usize] = true;
        }
    }
    let mut components: Vec<Component> = Vec::new();
    for slot in 0..count as u32 {
        let root = root(&mut roots, slot) as usize;
        if is_wanted[root] {
            if place[root] == FIXED {
                place[root] = components.len() as u32;
                components.push(Component { slots: Vec::new(), listed: Vec::new() });
            }
            components[place[root] as usize].slots.push(slot);
        }
    }
    for (index, listed) in (0..).zip(&dense.pairs) {
        let root = root(&mut roots, listed.slots[0]) as usize;
        if is_wanted[root] {
            components[place[root] as usize].listed.push(index);
        }
    }
    components
}

fn root(roots: &mut [u32], mut slot: u32) -> u32 {
    while roots[slot as usize] != slot {
        roots[slot as usize] = roots[roots[slot as usize] as usize];
        slot = roots[slot as usize];
    }
    slot
}

/// The bodies of components at rest that one of these may reach in its step.
fn reached_frozen(
    model: &Model,
    state: &State,
    dense: &Dense,
    components: &[Component],
    time: f64,
) -> Vec<u32> {
    let mut reached = Vec::new();
    for index in components.iter().flat_map(|component| &component.listed) {
        let listed = &dense.pairs[*index as usize];
        if listed.slots[1] != FIXED || listed.pair.second().is_none() {
            continue;
        }
        let member = &dense.members[listed.slots[0] as usize];
        let Some(other) = listed.pair.other(member.body).dynamic() else { continue };
        let Role::Frozen(number) = dense.role(other) else { continue };
        let path = state.path(member.body);
        let (x, v) = (path.position(time), path.velocity(time));
        let gap =
            (x - state.segments[other as usize].x).length() - model.radius(member.body) - model.radius(other);
        let way = model.dense_step * (v.length() + model.dense_step * path.segment.a.length());
        if gap <= 2.0 * way {
            reached.extend(frozen_with(dense, number));
        }
    }
    reached.sort_unstable();
    reached.dedup();
    reached
}

/// The bodies of a component at a time, with u for steps as long as the last.
fn bodies_of(model: &Model, state: &State, dense: &Dense, component: &Component, time: f64) -> Vec<Stepped> {
    let step = model.dense_step;
    let of = |slot: &u32| {
        let member = &dense.members[*slot as usize];
        let path = state.path(member.body);
        let inverse_mass = state.inverse_mass(model, member.body);
        let v = if inverse_mass > 0.0 { path.velocity(time) } else { DVec3::ZERO };
        let x = path.position(time);
        let a = if inverse_mass > 0.0 { driven(model, member.body, (x, v), time, step) } else { DVec3::ZERO };
        // Where forces change along the way, the leapfrog's other half of the kick.
        let kick = if member.is_stepped && inverse_mass > 0.0 {
            0.5 * (time - path.segment.start) * (a - path.segment.a)
        } else {
            DVec3::ZERO
        };
        let stiffness = if inverse_mass > 0.0 { stiffness(model, x, v) } else { 0.0 };
        Stepped {
            stiffness,
            body: member.body,
            x,
            v: v + kick,
            kick,
            u: v + kick - 0.5 * step * a,
            a,
            inverse_mass,
        }
    };
    component.slots.iter().map(of).collect()
}

/// What the applied forces give a body during a step of length h, m/s². Forces that change faster than that, drag on
/// what is light and the pull where no halving of the step is enough, are taken as an implicit midpoint rule would:
/// a = −κx and −κv give −κx/(1 + ¼h²κ) and −κv/(1 + ½hκ), which no step makes unstable.
fn driven(model: &Model, body: u32, (x, v): (DVec3, DVec3), time: f64, h: f64) -> DVec3 {
    let subject = model.subject(body, time, Place::exact(x), v);
    if model.is_ballistic() {
        return model.applied_acceleration(&subject);
    }
    let of_law = |law: &Law| {
        let a = law.force(&subject) / subject.mass;
        match law {
            Law::Drag { .. } => {
                let rate = a.length() / v.length().max(f64::MIN_POSITIVE);
                a / (1.0 + 0.5 * h * rate)
            }
            Law::Point { center, .. } => {
                let rate = a.length() / (x - *center).length().max(f64::MIN_POSITIVE);
                // Steps become shorter here, as far as they can.
                let shortest = h / f64::from(1_u32 << MOST_HALVINGS);
                let turn = h.min(shortest.max(TURN_IN_A_STEP / rate.sqrt())) * rate.sqrt();
                a / (1.0 + 0.25 * (turn * turn - TURN_IN_A_STEP * TURN_IN_A_STEP).max(0.0))
            }
            Law::Uniform { .. } | Law::Custom(_) => a,
        }
    };
    model.forces.iter().map(|force| of_law(&force.law)).sum()
}

/// How fast the pull of an attractor changes at a place, 1/s²: G/d³ by its own doing, or (v/d)² where a body falls in.
fn stiffness(model: &Model, x: DVec3, v: DVec3) -> f64 {
    let of_law = |law: &Law| match *law {
        Law::Point { center, intensity } if intensity != 0.0 => {
            let way = x - center;
            let distance = way.length();
            let rate = -way.dot(v) / (distance * distance);
            (intensity.abs() / (distance * distance * distance)).max(rate.max(0.0) * rate)
        }
        _ => 0.0,
    };
    model.forces.iter().map(|force| of_law(&force.law)).fold(0.0, f64::max)
}

/// Solves the step of a component, halved as often as it takes.
fn propose(
    model: &Model,
    state: &mut State,
    dense: &Dense,
    component: Component,
    mut bodies: Vec<Stepped>,
    time: f64,
) -> Proposal {
    let radii: Vec<f64> = bodies.iter().map(|body| model.radius(body.body)).collect();
    let mut halvings = halvings(model, dense, &component, &bodies, &radii);
    let mut local = std::mem::take(&mut state.scratch.slots);
    local.resize(dense.members.len(), FIXED);
    for (index, slot) in (0..).zip(&component.slots) {
        local[*slot as usize] = index;
    }
    loop {
        let end = step_end(model.dense_step, halvings, time);
        let h = end - time;
        for body in &mut bodies {
            body.u = body.v - 0.5 * h * body.a;
        }
        let contact_of = |index: &u32| {
            let listed = &dense.pairs[*index as usize];
            let [a, b] = listed
                .slots
                .map(|slot| if slot == FIXED { bodies.len() as u32 } else { local[slot as usize] });
            contact(model, state, (*index, listed.pair, listed.force), (a, b), &bodies, h)
        };
        let mut contacts: Vec<Contact> = component.listed.iter().filter_map(contact_of).collect();
        let solution = solve(&mut contacts, &bodies, &radii, h);
        state.counters.sweeps += solution.sweeps as u64;
        if solution.has_converged || halvings >= MOST_HALVINGS_TO_CONVERGE {
            state.scratch.slots = local;
            return Proposal { component, bodies, contacts, solution, end, halvings };
        }
        state.counters.halvings += 1;
        halvings += 1;
    }
}

/// How often the step of a component must be halved at least: as often as the last, or once less after an easy one,
/// and so often that nobody passes much of its radius in it.
fn halvings(model: &Model, dense: &Dense, component: &Component, bodies: &[Stepped], radii: &[f64]) -> u8 {
    let members = component.slots.iter().map(|slot| &dense.members[*slot as usize]);
    let of = |member: &Member| member.halvings.saturating_sub(u8::from(member.is_easy));
    let mut halvings = members.map(of).max().unwrap_or(0);
    let ways = bodies.iter().zip(radii).map(|(body, radius)| model.dense_step * body.v.length() / radius);
    let stiffest = bodies.iter().map(|body| body.stiffness).fold(0.0, f64::max);
    // The part of a radius that is passed, and that of a turn.
    let passed =
        (ways.fold(0.0, f64::max) / WAY_OF_RADIUS).max(model.dense_step * stiffest.sqrt() / TURN_IN_A_STEP);
    while passed > f64::from(1_u32 << halvings) && halvings < MOST_HALVINGS {
        halvings += 1;
    }
    halvings
}

/// Whether somebody would leave what the list covers; the next list will cover it.
fn widen(dense: &mut Dense, proposals: &[Proposal], time: f64) -> bool {
    let mut is_wanted = false;
    for proposal in proposals {
        let h = proposal.end - time;
        for ((slot, body), u) in
            proposal.component.slots.iter().zip(&proposal.bodies).zip(&proposal.solution.velocities)
        {
            let member = &mut dense.members[*slot as usize];
            let way = h * (u.length() + h * body.a.length());
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
    proposal: Proposal,
    time: f64,
) -> Result<(), Fault> {
    let Proposal { component, bodies, contacts, solution, end, halvings } = proposal;
    let h = end - time;
    state.counters.steps += 1;
    state.counters.contacts += contacts.len() as u64;
    state.account.impact_losses.add(solution.loss);
    let is_easy = solution.sweeps < MOST_SWEEPS / 4;
    for slot in &component.slots {
        let member = &mut dense.members[*slot as usize];
        (member.halvings, member.is_easy, member.is_stepped) = (halvings, is_easy, true);
        member.idle = member.idle.saturating_add(1);
    }
    for index in &component.listed {
        dense.pairs[*index as usize].force = 0.0;
    }
    for contact in &contacts {
        let listed = &mut dense.pairs[contact.listed as usize];
        listed.force = contact.impulse / h;
        if contact.impulse > 0.0 {
            if listed.pair.second().is_some() {
                for slot in listed.slots.into_iter().filter(|slot| *slot != FIXED) {
                    dense.members[slot as usize].idle = 0;
                }
            }
            book_outside(state, contact, &bodies);
        }
    }
    for (body, u) in bodies.iter().zip(&solution.velocities) {
        let v = if body.inverse_mass > 0.0 { *u - 0.5 * h * body.a } else { DVec3::ZERO };
        let segment = Segment { end, constrained: true, ..Segment::ballistic(time, body.x, v, body.a) };
        check(model, &segment).map_err(|error| fault(model, body.body, time, error))?;
        if body.kick != DVec3::ZERO {
            state.account.force_impulse.add(model.mass(body.body) * body.kick);
        }
        place(model, state, body.body, segment, None);
    }
    Ok(())
}

/// Books the impulse that what does not move gave.
fn book_outside(state: &mut State, contact: &Contact, bodies: &[Stepped]) {
    let is_fixed = |index: u32| bodies.get(index as usize).is_none_or(|body| body.inverse_mass == 0.0);
    let impulse = contact.impulse * contact.normal;
    if is_fixed(contact.b) {
        state.account.impulses.add(-impulse);
    } else if is_fixed(contact.a) {
        state.account.impulses.add(impulse);
    }
}
