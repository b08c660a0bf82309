//! Events of lasting contact: bounces that settle, surfaces that end, pressure that ceases.

use glam::DVec3;

use super::ContactState;
use super::constraint::{Link, enter_none, largest_push, stay_on};
use super::contact::{Contact, Pair, Partner, Surface};
use super::group::{Group, Member};
use super::island::{connected, first_parting};
use super::model::{FixtureShape, Model};
use super::neighbours::first_beyond;
use super::predict::{PRESSURE_ROUNDING, touch_tolerance};
use super::queue::Kind;
use super::state::State;

/// Predicts when the contacts of a body settle or end on its present segment.
pub(super) fn predict_contact_events(model: &Model, state: &mut State, body: u32, time: f64) {
    for index in 0..state.contacts[body as usize].len() {
        let contact = state.contacts[body as usize][index];
        let pair = Pair::new(body, contact.partner);
        if pair.a != body {
            continue;
        }
        if let Some(settled) = contact.settles_at {
            state.predict_of(settled.max(time), [Kind::PairSettled, Kind::Settled], pair);
        }
        if let Some(end) = end_of_face(model, state, body, &contact, time) {
            state.predict_of(end, [Kind::PairEnd, Kind::ContactEnd], pair);
        }
    }
    predict_parting(model, state, body);
}

/// Predicts where the island of a body comes apart, once for all its bodies.
fn predict_parting(model: &Model, state: &mut State, body: u32) {
    if state.contacts[body as usize].is_empty() || state.segments[body as usize].step == 0.0 {
        return;
    }
    let ids = connected(state, [body]);
    if ids.first() != Some(&body) {
        return;
    }
    if let Some((time, pairs)) = first_parting(model, state, &ids) {
        for pair in pairs {
            state.predict_of(time, [Kind::PairEnd, Kind::ContactEnd], pair);
        }
    }
}

/// First time at which the body slides off the face of a plate.
fn end_of_face(model: &Model, state: &State, body: u32, contact: &Contact, time: f64) -> Option<f64> {
    let (Surface::Flat(_), Partner::Static(fixture)) = (contact.surface, contact.partner) else {
        return None;
    };
    let FixtureShape::Plate(plate) = &model.fixtures[fixture as usize].shape else { return None };
    let path = state.path(body);
    // A rounding beyond the edge, so that what comes next meets the edge and not the face again.
    let beyond = touch_tolerance(path.segment.x, model.movers[body as usize].radius);
    let sides = [
        (plate.axis_x, plate.half_x),
        (-plate.axis_x, plate.half_x),
        (plate.axis_y, plate.half_y),
        (-plate.axis_y, plate.half_y),
    ];
    sides
        .into_iter()
        .filter_map(|(axis, half)| {
            first_beyond(path, axis, axis.dot(plate.center) + half + beyond, 0.0, time)
        })
        .reduce(f64::min)
}

/// A contact of a group that lasts from now on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Settling {
    /// Which contact of the group.
    pub member: usize,
    /// When the last of the bounces left out would end; `None` for a contact that lasted before.
    pub settles_at: Option<f64>,
}

/// Which contacts of a group last, after its impacts. Bounces are over if their sum has a near limit, or if
/// they are lower than the rounding of the position: then the event comes at the limit time
/// t + Σ flights = t + 2v'/(g(1−e)), and the velocities are levelled now.
pub(super) fn settle(model: &Model, group: &mut Group) -> Vec<Settling> {
    let mut candidates: Vec<Candidate> =
        (0..group.members.len()).filter_map(|member| could_last(model, group, member)).collect();
    if candidates.iter().any(|candidate| !candidate.is_undisturbed) {
        drop_unsettled(model, group, &mut candidates);
    }
    let lasts = |candidate: &Candidate| Settling {
        member: candidate.member,
        settles_at: (!group.members[candidate.member].is_lasting).then_some(group.time + candidate.flights),
    };
    let settling: Vec<Settling> = candidates.iter().map(lasts).collect();
    level(group, &settling);
    settling
}

/// A contact that may last.
struct Candidate {
    member: usize,
    /// It lasted before, and nothing has moved its bodies apart.
    is_undisturbed: bool,
    /// Sum of the bounces left out, s.
    flights: f64,
}

/// Whether a contact is slow enough to last.
fn could_last(model: &Model, group: &Group, index: usize) -> Option<Candidate> {
    let member = &group.members[index];
    let parting = -group.closing(member);
    let is_undisturbed = member.is_lasting && parting <= group.rounding(member);
    let slow = model.params.rest_speed.max((SLOWEST * slack(model, group, member)).sqrt());
    (is_undisturbed || parting <= slow).then_some(Candidate { member: index, is_undisturbed, flights: 0.0 })
}

/// More than any acceleration times two that is worth a thought, m/s²: a first, coarse sieve.
const SLOWEST: f64 = 1e6;

fn slack(model: &Model, group: &Group, member: &Member) -> f64 {
    touch_tolerance(group.bodies.x[member.link.a], model.movers[member.pair.a as usize].radius)
}

/// Leaves those candidates whose bounces end while all the others hold.
fn drop_unsettled(model: &Model, group: &Group, candidates: &mut Vec<Candidate>) {
    let free = group.bodies.free(model, group.time);
    let links = group.acceleration_links(model);
    loop {
        let held: Vec<Link> = candidates.iter().map(|candidate| links[candidate.member]).collect();
        let loads = enter_none(&held, &group.bodies.inverse_mass, &mut free.clone());
        let ends: Vec<Option<f64>> = (0..held.len())
            .map(|k| {
                if candidates[k].is_undisturbed {
                    return Some(0.0);
                }
                let pressing = pressing(group, &held, k, loads[k], &free)?;
                remaining_flights(model, group, candidates[k].member, pressing)
            })
            .collect();
        let mut end = ends.iter();
        candidates.retain_mut(|candidate| {
            let Some(flights) = end.next().copied().flatten() else { return false };
            candidate.flights = flights;
            true
        });
        if candidates.len() == ends.len() {
            return;
        }
    }
}

/// Acceleration that presses two bodies together while the other contacts hold, m/s²; `None` if nothing
/// does. Where the others alone would hold them (a ball in a heap), what the contact carries counts.
fn pressing(group: &Group, held: &[Link], index: usize, load: f64, free: &[DVec3]) -> Option<f64> {
    let link = &held[index];
    let others: Vec<Link> =
        (0..held.len()).filter(|other| *other != index).map(|other| held[other]).collect();
    let mut driven = free.to_vec();
    let loads = enter_none(&others, &group.bodies.inverse_mass, &mut driven);
    let applied = link.b.map_or(0.0, |b| free[b].length()).max(free[link.a].length()) + link.limit;
    let rounding = PRESSURE_ROUNDING * applied.max(largest_push(&others, &group.bodies.inverse_mass, &loads));
    let alone = link.entering(&driven) - link.limit;
    let shared = load * link.response(link, &group.bodies.inverse_mass);
    [alone, shared].into_iter().find(|pressing| *pressing > rounding)
}

/// Sum of the flights that are left under an acceleration that presses the bodies together, s; `None` if it
/// is not to be left out.
fn remaining_flights(model: &Model, group: &Group, index: usize, pressing: f64) -> Option<f64> {
    let member = &group.members[index];
    let parting = (-group.closing(member)).max(0.0);
    let flights = 2.0 * parting / (pressing * (1.0 - member.restitution));
    let has_limit =
        member.restitution < 1.0 && parting <= model.params.rest_speed && flights <= model.params.rest_time;
    if has_limit {
        return Some(flights);
    }
    let is_below_rounding = parting * parting <= 2.0 * pressing * slack(model, group, member);
    is_below_rounding.then_some(0.0)
}

/// Takes what still parts or enters at lasting contacts out of the velocities.
fn level(group: &mut Group, settling: &[Settling]) {
    let links: Vec<Link> = settling.iter().map(|contact| group.members[contact.member].link).collect();
    let multipliers = stay_on(&links, &group.bodies.inverse_mass, &mut group.bodies.v);
    for (contact, multiplier) in settling.iter().zip(multipliers) {
        group.members[contact.member].impulse += multiplier;
    }
}

/// How a body moves at a time, for people: a body in contact that neither moves nor is driven
/// rests, and so does one that is held.
pub(super) fn contact_state(state: &State, body: u32, time: f64) -> ContactState {
    if state.contacts[body as usize].is_empty() && !state.held.contains(body) {
        return ContactState::Flight;
    }
    let path = state.path(body);
    let still = path.velocity(time) == DVec3::ZERO && path.acceleration(time) == DVec3::ZERO;
    if still { ContactState::Rest } else { ContactState::Slide }
}
