//! Which contacts of a group last after an impact: bounces that settle.

use glam::DVec3;

use super::constraint::enter_none;
use super::geometry::smaller_radius;
use super::group::{Group, Member};
use super::island::{largest, pressed};
use super::link::Link;
use super::model::Model;
use super::nearest::responses;
use super::predict::touch_tolerance;
use super::tolerance::{LEFT_OVER, MOST_LEVELLED, NO_CHANGE};

/// A contact of a group that lasts from now on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Settling {
    /// Which contact of the group.
    pub member: usize,
    /// When the last of the bounces left out would end; `None` for a contact that lasted before.
    pub settles_at: Option<f64>,
}

/// Which contacts of a group last, after its impacts, and the velocities that these leave. A contact lasts if
/// its bounces are over: their sum has a near limit, or they are lower than the rounding of the position. The
/// event comes at the limit time t + Σ flights = t + 2v'/(g(1−e)); the velocities are levelled now.
pub(super) fn settle(model: &Model, group: &mut Group) -> Vec<Settling> {
    let mut free = group.bodies.free(model, group.time);
    if model.plan.spin {
        group.add_friction(model, &mut free);
    }
    let links = group.acceleration_links(model);
    let mut candidates = slow(model, group, &free, &links);

    drop_bouncing(model, group, &mut candidates, &free, &links);

    drop_parting(model, group, &mut candidates, &free, &links);

    drop_unloaded(group, &mut candidates, &free, &links);

    level(group, &mut candidates, &free, &links);
    candidates.iter().map(|candidate| candidate.settling(group)).collect()
}

/// A contact that may last.
struct Candidate {
    member: usize,
    /// Its surfaces do not part now.
    touches: bool,
    /// Sum of the bounces left out, s.
    flights: f64,
    /// Time until the bodies are back, s.
    flight: f64,
}

impl Candidate {
    fn settling(&self, group: &Group) -> Settling {
        let member = self.member;
        let is_new = !group.members[member].is_lasting;
        Settling { member, settles_at: is_new.then_some(group.time + self.flights) }
    }
}

/// The contacts that part slowly enough to last under the accelerations that there are.
fn slow(model: &Model, group: &Group, free: &[DVec3], links: &[Link]) -> Vec<Candidate> {
    let strongest = 2.0 * largest(free, links);
    let candidate = |(k, member): (usize, &Member)| {
        let parting = -group.closing(member);
        let touches = parting <= group.rounding(member);
        let height = rest_height(model, member).max(slack(model, group, member));
        let is_slow = touches || parting * parting <= 2.0 * strongest * height;
        is_slow.then_some(Candidate { member: k, touches, flights: 0.0, flight: 0.0 })
    };
    group.members.iter().enumerate().filter_map(candidate).collect()
}

/// Height of the bounces that may be left out, m.
fn rest_height(model: &Model, member: &Member) -> f64 {
    model.params.rest_height * smaller_radius(model, member.pair)
}

fn slack(model: &Model, group: &Group, member: &Member) -> f64 {
    touch_tolerance(group.bodies.x[member.link.a], model.radius(member.pair.first()))
}

fn held_links(candidates: &[Candidate], links: &[Link]) -> Vec<Link> {
    candidates.iter().map(|candidate| links[candidate.member]).collect()
}

/// What presses the bodies of each contact together, m/s²: while all others hold, or while those hold that touch,
/// whichever is more. A ball on another that bounces falls with it, and returns only as far as that one holds; a ball
/// beside a seam returns to both plates at once, and neither holds it for the other.
fn pressing(group: &Group, candidates: &[Candidate], free: &[DVec3], links: &[Link]) -> Vec<f64> {
    let inverse_mass = &group.bodies.inverse_mass;
    let held = held_links(candidates, links);
    let loads = enter_none(&held, inverse_mass, &mut free.to_vec()).multipliers;
    let loaded: Vec<usize> = (0..held.len()).filter(|k| loads[*k] > 0.0).collect();
    let loaded_links: Vec<Link> = loaded.iter().map(|k| held[*k]).collect();
    let touching: Vec<Link> = candidates
        .iter()
        .filter(|candidate| candidate.touches)
        .map(|candidate| links[candidate.member])
        .collect();
    let mut motion = free.to_vec();
    enter_none(&touching, inverse_mass, &mut motion);
    let mut pressing: Vec<f64> = held.iter().map(|link| link.entering(&motion) - link.limit).collect();
    for (k, response) in loaded.iter().zip(responses(&loaded_links, inverse_mass)) {
        pressing[*k] = pressing[*k].max(loads[*k] * response);
    }
    pressing
}

/// Drops contacts whose bounces go on for long.
fn drop_bouncing(
    model: &Model,
    group: &Group,
    candidates: &mut Vec<Candidate>,
    free: &[DVec3],
    links: &[Link],
) {
    while candidates.iter().any(|candidate| !candidate.touches) {
        let pressing = pressing(group, candidates, free, links);
        let count = candidates.len();
        let mut of = pressing.into_iter();
        candidates.retain_mut(|candidate| {
            let Some(pressing) = of.next() else { return false };
            if candidate.touches {
                return true;
            }
            candidate.flight = 2.0 * (-group.closing(&group.members[candidate.member])).max(0.0) / pressing;
            let flights = remaining_flights(model, group, candidate.member, pressing);
            candidate.flights = flights.unwrap_or(0.0);
            flights.is_some()
        });
        if candidates.len() == count {
            return;
        }
    }
}

/// Sum of the flights that are left under an acceleration that presses the bodies together, s; `None` if it
/// is not to be left out.
fn remaining_flights(model: &Model, group: &Group, index: usize, pressing: f64) -> Option<f64> {
    if pressing <= 0.0 {
        return None;
    }
    let member = &group.members[index];
    let parting = (-group.closing(member)).max(0.0);
    let restitution = group.restitution_of(member);
    let flights = 2.0 * parting / (pressing * (1.0 - restitution));
    let is_low = |height: f64| parting * parting <= 2.0 * pressing * height;
    let fall_time = (2.0 * smaller_radius(model, member.pair) / pressing).sqrt();
    let is_short = restitution < 1.0 && flights <= model.params.rest_time * fall_time;
    if is_short && is_low(rest_height(model, member)) {
        return Some(flights);
    }
    is_low(slack(model, group, member)).then_some(0.0)
}

/// The time after which the last of the bodies is back, s.
fn longest_flight(candidates: &[Candidate]) -> f64 {
    candidates.iter().map(|candidate| candidate.flights.max(candidate.flight)).fold(0.0, f64::max)
}

/// Time in which bodies fall by the rounding of their positions, s.
fn rounding_of_flights(model: &Model, group: &Group, free: &[DVec3]) -> f64 {
    let strongest = free.iter().map(|a| a.length()).fold(0.0, f64::max);
    let height = group.members.iter().map(|member| slack(model, group, member)).fold(0.0, f64::max);
    if strongest > 0.0 { (2.0 * height / strongest).sqrt() } else { 0.0 }
}

/// Drops contacts that part all the same once the bodies have come back: one step of Moreau's over the longest
/// of the flights left out tells, or over the time in which bodies fall by the rounding of their positions: how high
/// they are above that can't be told. A ball that a step in the floor lifts leaves the floor, however slowly.
fn drop_parting(
    model: &Model,
    group: &Group,
    candidates: &mut Vec<Candidate>,
    free: &[DVec3],
    links: &[Link],
) {
    let flights = 2.0 * longest_flight(candidates);
    let span = if flights > 0.0 { flights.max(rounding_of_flights(model, group, free)) } else { 0.0 };
    let mut motion = group.bodies.v.clone();
    for (v, a) in motion.iter_mut().zip(free) {
        *v += span * *a;
    }
    let turned = |(member, link): (&Member, &Link)| Link { limit: span * link.limit, ..member.link };
    let links: Vec<Link> = group.members.iter().zip(links).map(turned).collect();
    let solved = enter_none(&links, &group.bodies.inverse_mass, &mut motion);
    candidates.retain(|candidate| {
        let link = &links[candidate.member];
        solved.multipliers[candidate.member] > 0.0
            || link.limit - link.entering(&motion) <= LEFT_OVER * solved.size(link)
    });
}

/// Drops contacts that nothing presses together while the others hold. One that lasted before ends by an event
/// of its own.
fn drop_unloaded(group: &Group, candidates: &mut Vec<Candidate>, free: &[DVec3], links: &[Link]) {
    loop {
        let held = held_links(candidates, links);
        let mut motion = free.to_vec();
        let solved = enter_none(&held, &group.bodies.inverse_mass, &mut motion);
        let mut of = pressed(&held, &solved, &group.bodies.inverse_mass, &motion).into_iter();
        let count = candidates.len();
        candidates
            .retain(|candidate| of.next().unwrap_or(false) || group.members[candidate.member].is_lasting);
        if candidates.len() == count {
            return;
        }
    }
}

/// Takes what still parts at lasting contacts out of the velocities, closing none of the others. Contacts that could
/// be kept only at the cost of other motion do not last yet: a ball on a plate would stop at every step that lifts it.
/// Levelling stands for what the forces do until the bodies are back, and may do no more.
fn level(group: &mut Group, candidates: &mut Vec<Candidate>, free: &[DVec3], links: &[Link]) {
    loop {
        // A light ball under a heavy one on a slope is squeezed out quicker than any force alone would drive it.
        let held = held_links(candidates, links);
        let mut motion = free.to_vec();
        enter_none(&held, &group.bodies.inverse_mass, &mut motion);
        let strongest = free.iter().chain(&motion).map(|a| a.length()).fold(0.0, f64::max);
        let mut lasts = vec![false; group.members.len()];
        candidates.iter().for_each(|candidate| lasts[candidate.member] = true);
        let levelled = group.levelled(&lasts);
        let changes =
            group.bodies.v.iter().zip(&levelled.velocities).map(|(old, new)| (*new - *old).length());
        let falls = candidates.len() as f64 * strongest * longest_flight(candidates);
        let is_fair = changes.fold(0.0, f64::max) <= MOST_LEVELLED * falls + NO_CHANGE * group.fastest;
        let parting = |candidate: &Candidate| -group.closing(&group.members[candidate.member]);
        let parts = (0..candidates.len()).filter(|k| !candidates[*k].touches);
        let fastest =
            parts.reduce(
                |best, next| {
                    if parting(&candidates[next]) > parting(&candidates[best]) { next } else { best }
                },
            );
        match fastest {
            Some(fastest) if !is_fair => candidates.remove(fastest),
            _ => return group.bring_to(levelled),
        };
    }
}
