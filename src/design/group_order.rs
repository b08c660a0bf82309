//! The order of groups in the tree: that of their first bodies in the file. Groups of forces alone stand before the others.

use std::collections::{BTreeMap, BTreeSet};

use super::group::rename_group;
use super::plan::{Given, Plan};
use crate::scene::{Edit, NodeKey, Scene, Side};

/// What groups beside each other are ordered by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GroupRank {
    has_bodies: bool,
    /// Index of its first body, or of its first force.
    first: usize,
}

/// The ranks of all groups, also of those that hold nothing but other groups, by their paths.
pub fn group_ranks(scene: &Scene) -> BTreeMap<&str, GroupRank> {
    let mut ranks = BTreeMap::new();
    let bodies = scene.bodies.iter().enumerate().map(|(first, body)| (&body.group, true, first));
    let forces = scene.forces.iter().enumerate().map(|(first, force)| (&force.group, false, first));
    // Bodies first: a group that has any is ordered by them.
    for (group, has_bodies, first) in bodies.chain(forces) {
        for path in group.iter().flat_map(|group| with_parents(group)) {
            ranks.entry(path).or_insert(GroupRank { has_bodies, first });
        }
    }
    ranks
}

/// `a`, `a/b` and `a/b/c` of `a/b/c`.
fn with_parents(group: &str) -> impl Iterator<Item = &str> {
    group.match_indices('/').map(|(at, _)| at).chain([group.len()]).map(|end| &group[..end])
}

fn parent(path: &str) -> Option<&str> {
    path.rsplit_once('/').map(|(parent, _)| parent)
}

fn is_within(group: Option<&str>, path: &str) -> bool {
    group
        .and_then(|group| group.strip_prefix(path))
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
}

/// What of a kind is in a group and the groups inside it, in file order.
fn members(scene: &Scene, path: &str, bodies: bool) -> Vec<NodeKey> {
    if bodies {
        let within = scene.bodies.iter().filter(|body| is_within(body.group.as_deref(), path));
        return within.map(|body| body.key).collect();
    }
    let within = scene.forces.iter().filter(|force| is_within(force.group.as_deref(), path));
    within.map(|force| force.key).collect()
}

/// Groups beside this one that can change places with it, itself included, in their order.
fn beside<'a>(ranks: &BTreeMap<&'a str, GroupRank>, path: &str) -> Vec<&'a str> {
    let Some(own) = ranks.get(path) else { return Vec::new() };
    let mut all: Vec<(&GroupRank, &str)> = ranks
        .iter()
        .filter(|(other, rank)| parent(other) == parent(path) && rank.has_bodies == own.has_bodies)
        .map(|(other, rank)| (rank, *other))
        .collect();
    all.sort_unstable();
    all.into_iter().map(|(_, path)| path).collect()
}

/// Moves groups that are given as a whole up or down by one place, with all that is in them.
pub(super) fn shift_groups(given: &Given<'_>, side: Side) -> Vec<Edit> {
    let ranks = group_ranks(given.scene);
    let whole = whole_groups(given, &ranks);
    let mut edits = Vec::new();
    let mut done = BTreeSet::new();
    for path in &whole {
        let row = beside(&ranks, path);
        if row.iter().any(|other| !done.insert(*other)) {
            continue;
        }
        let chosen: Vec<&str> = row.iter().copied().filter(|other| whole.contains(other)).collect();
        let place = |path: Option<&&str>| row.iter().position(|other| Some(other) == path);
        let bodies = ranks.get(path).is_some_and(|rank| rank.has_bodies);
        let keys: Vec<NodeKey> = chosen.iter().flat_map(|path| members(given.scene, path, bodies)).collect();
        let to = match side {
            Side::Before => place(chosen.first()).and_then(|first| first.checked_sub(1)),
            // Behind the next one is before the one after that.
            Side::After => place(chosen.last()).map(|last| last + 2).filter(|to| *to <= row.len()),
        };
        edits.extend(to.and_then(|to| reorder(given.scene, &row, to, bodies, keys)));
    }
    edits
}

/// Puts things before the first of the n-th group, or behind the last group.
fn reorder(scene: &Scene, row: &[&str], to: usize, bodies: bool, keys: Vec<NodeKey>) -> Option<Edit> {
    let (side, anchor) = match row.get(to) {
        Some(path) => (Side::Before, members(scene, path, bodies).first().copied()?),
        None => {
            let of_all = row.iter().flat_map(|path| members(scene, path, bodies)).collect::<BTreeSet<_>>();
            let list: Vec<NodeKey> = if bodies {
                scene.bodies.iter().map(|body| body.key).collect()
            } else {
                scene.forces.iter().map(|force| force.key).collect()
            };
            (Side::After, list.into_iter().rfind(|key| of_all.contains(key) && !keys.contains(key))?)
        }
    };
    (!keys.contains(&anchor)).then_some(Edit::Reorder { keys, side, anchor })
}

/// Groups all of which is given, without those inside others.
fn whole_groups<'a>(given: &Given<'a>, ranks: &BTreeMap<&'a str, GroupRank>) -> BTreeSet<&'a str> {
    let chosen: BTreeSet<NodeKey> = given.keys.iter().copied().collect();
    let bodies = given.scene.bodies.iter().map(|body| (body.group.as_deref(), body.key));
    let forces = given.scene.forces.iter().map(|force| (force.group.as_deref(), force.key));
    let mut whole: BTreeSet<&str> = ranks.keys().copied().collect();
    for (group, _) in bodies.chain(forces).filter(|(_, key)| !chosen.contains(key)) {
        for path in group.into_iter().flat_map(with_parents) {
            whole.remove(path);
        }
    }
    let all = whole.clone();
    whole.retain(|path| parent(path).is_none_or(|parent| !all.contains(parent)));
    whole
}

/// Puts a group, with all that is in it, before or after another one, and into the same group as that. No edits where
/// that would put it into itself.
pub fn put_group_beside(given: &Given<'_>, from: &str, side: Side, to: &str) -> Plan {
    if is_within(Some(to), from) {
        return Plan::default();
    }
    let name = from.rsplit('/').next().unwrap_or_default();
    let path = parent(to).map_or(name.to_owned(), |parent| format!("{parent}/{name}"));
    let mut plan = if path == from {
        Plan::new("Move 1 group in the tree", Vec::new())
    } else {
        rename_group(given, from, &path)
    };
    let ranks = group_ranks(given.scene);
    let bodies = ranks.get(from).is_some_and(|rank| rank.has_bodies);
    let row = beside(&ranks, to);
    let old = row.iter().position(|other| *other == from);
    let at = row.iter().position(|other| *other == to).map(|at| at + usize::from(side == Side::After));
    let alike = ranks.get(to).is_some_and(|rank| rank.has_bodies == bodies);
    if let Some(at) = at.filter(|at| alike && old.is_none_or(|old| old != *at && old + 1 != *at)) {
        plan.edits.extend(reorder(given.scene, &row, at, bodies, members(given.scene, from, bodies)));
    }
    plan
}
