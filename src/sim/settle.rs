//! Which contacts of a group last after an impact: bounces that settle.

use glam::DVec3;

use super::constraint::{Link, enter_none, largest_push, stay_on};
use super::group::{Group, Member};
use super::model::Model;
use super::predict::touch_tolerance;
use super::tolerance::{PRESSURE_ROUNDING, SETTLING_ACCELERATION};

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
    let slow = model.params.rest_speed.max((SETTLING_ACCELERATION * slack(model, group, member)).sqrt());
    (is_undisturbed || parting <= slow).then_some(Candidate { member: index, is_undisturbed, flights: 0.0 })
}

fn slack(model: &Model, group: &Group, member: &Member) -> f64 {
    touch_tolerance(group.bodies.x[member.link.a], model.radius(member.pair.first()))
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
