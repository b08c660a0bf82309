//! The list of pairs near each other: made when a member has moved by its margin, and good until then.

use glam::DVec3;

use super::cells::{Ball, for_each_overlap};
use super::clock::step_at;
use super::components;
use super::data::{Dense, Listed, Member, Role};
use super::stepped::FIXED;
use super::tolerance::{OLDEST_LIST, SKIN, SKIN_STEPS};
use crate::sim::body::BodyId;
use crate::sim::model::Model;
use crate::sim::neighbours::{OUTER, register_within, within};
use crate::sim::pair::Pair;
use crate::sim::state::State;

/// Members that outsiders lie near, with these: who may join must be predicted anew.
pub(super) type NearOutsiders = Vec<(u32, u32)>;

/// Whether the list no longer tells all that may touch in a step from `time` on.
pub(super) fn is_old(model: &Model, state: &State, dense: &Dense, time: f64) -> bool {
    dense.is_list_stale
        || time - dense.listed_since > OLDEST_LIST * model.dense_step
        || dense.members.iter().any(|member| {
            let path = state.path(member.body);
            let (x, v) = (path.position(time), path.velocity(time));
            let way = (x - member.listed_at).length();
            let step = step_at(model, member.body, time, (x, v));
            way + step * (v.length() + step * path.segment.a.length()) > member.margin
        })
}

/// Makes the list anew.
pub(super) fn make(model: &Model, state: &mut State, dense: &mut Dense, time: f64) -> NearOutsiders {
    place_members(model, state, dense, time);
    let mut pairs = dynamic_pairs(model, &dense.members);
    let outsiders = near_pairs(model, state, dense, &mut pairs);
    pairs.sort_unstable_by_key(|listed| listed.pair);
    if model.plan.spin {
        dense.rubs = carried(&dense.pairs, &dense.rubs, &pairs);
    }
    let forces = carried(&dense.pairs, &forces(dense), &pairs);
    dense.pairs = pairs;
    note_company(dense);
    components::find(dense, &forces);
    dense.epoch = dense.epoch.wrapping_add(1);
    dense.listed_since = time;
    dense.is_list_stale = false;
    outsiders
}

/// Notes where the members are, and registers them in all tiles that they may come to.
fn place_members(model: &Model, state: &mut State, dense: &mut Dense, time: f64) {
    for member in &mut dense.members {
        let path = state.path(member.body);
        let (x, v) = (path.position(time), path.velocity(time));
        let radius = model.radius(member.body);
        let skin = (SKIN * radius).max(SKIN_STEPS * step_at(model, member.body, time, (x, v)) * v.length());
        member.listed_at = x;
        member.margin = skin.max(member.widened);
        member.widened = 0.0;
        register_within(model, state, member.body, x, radius + OUTER * member.margin);
    }
}

/// Pairs of members whose balls of reach overlap.
fn dynamic_pairs(model: &Model, members: &[Member]) -> Vec<Listed> {
    let ball =
        |member: &Member| Ball { at: member.listed_at, radius: model.radius(member.body) + member.margin };
    let balls: Vec<Ball> = members.iter().map(ball).collect();
    let mut pairs = Vec::new();
    for_each_overlap(&balls, |one, other| {
        // Members are in the order of their bodies, and so is a pair.
        let slots = [one.min(other), one.max(other)];
        let [a, b] = slots.map(|slot| members[slot as usize].body);
        pairs.push(Listed { pair: Pair::of(a, BodyId::of_dynamic(b)), slots });
    });
    pairs
}

/// Notes who has another dynamic body near.
fn note_company(dense: &mut Dense) {
    dense.members.iter_mut().for_each(|member| member.has_company = false);
    for listed in dense.pairs.iter().filter(|listed| listed.pair.second().is_some()) {
        for slot in listed.slots.into_iter().filter(|slot| *slot != FIXED) {
            dense.members[slot as usize].has_company = true;
        }
    }
}

/// Adds pairs with static and frozen bodies; gives the outsiders in the tiles of members.
fn near_pairs(model: &Model, state: &State, dense: &Dense, pairs: &mut Vec<Listed>) -> NearOutsiders {
    let mut outsiders = NearOutsiders::new();
    let mut found = Vec::new();
    for (slot, member) in (0..).zip(&dense.members) {
        let reach = model.radius(member.body) + member.margin;
        let is_wanted = |body: u32| !dense.is_member(body);
        let outer = model.radius(member.body) + OUTER * member.margin;
        within(model, state, member.listed_at, outer, is_wanted, &mut found);
        for other in found.drain(..) {
            let role = other.dynamic().map(|body| dense.role(body));
            match role {
                Some(Role::Member(_)) => {}
                Some(Role::Outside) => outsiders.push((member.body, other.index())),
                None | Some(Role::Frozen(_)) => {
                    if distance(model, state, member.listed_at, other) <= reach {
                        let pair = Pair::of(member.body, other);
                        pairs.push(Listed { pair, slots: [slot, FIXED] });
                    }
                }
            }
        }
    }
    outsiders
}

/// Distance of a point from the surface of a body that does not move, m.
fn distance(model: &Model, state: &State, at: DVec3, other: BodyId) -> f64 {
    let place = state.path_of(model, other).segment.x;
    model.body(other).shape.convex().nearest(place, at).distance
}

/// The forces of the last step in the order of the list, N.
fn forces(dense: &Dense) -> Vec<f64> {
    let mut forces = vec![0.0; dense.pairs.len()];
    for near in dense.listed() {
        forces[near.listed as usize] = near.force;
    }
    forces
}

/// What is known of pairs that were listed before, for the new list; both lists are in order.
fn carried<T: Copy + Default>(old: &[Listed], known: &[T], new: &[Listed]) -> Vec<T> {
    let mut old = old.iter().zip(known).peekable();
    let of = |listed: &Listed| {
        while old.next_if(|(before, _)| before.pair < listed.pair).is_some() {}
        old.next_if(|(before, _)| before.pair == listed.pair).map_or(T::default(), |(_, known)| *known)
    };
    new.iter().map(of).collect()
}
