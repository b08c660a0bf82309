//! The order of the scene tree, which is that of the file: things are put beside others of their kind, or move up and down.

use std::collections::BTreeSet;

use super::group::regroup;
use super::group_order::shift_groups;
use super::plan::{Given, Plan};
use crate::scene::{Edit, NodeKey, Scene, Side};

/// What stands in one run of rows: a group or, outside of groups, a kind of things.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Section {
    group: Option<String>,
    is_force: bool,
    /// What rests and what moves have a heading each; in a group they are mixed.
    is_static: bool,
}

/// One row of the tree, in file order.
struct Entry {
    key: NodeKey,
    section: Section,
}

/// Puts what is given beside another thing: into its group and, as far as it is of the kind that is listed there,
/// before or after it. What is of another kind is regrouped alone.
pub fn put_beside(given: &Given<'_>, side: Side, anchor: NodeKey) -> Plan {
    let entries = entries(given.scene);
    let Some(to) = entries.iter().find(|entry| entry.key == anchor).map(|entry| entry.section.clone()) else {
        return Plan::default();
    };
    let mut plan = regroup(given, to.group.as_deref());
    let there = |section: &Section| Section { group: to.group.clone(), ..section.clone() };
    let listed = |section: &Section| there(section).listed() == to.listed();
    let chosen: BTreeSet<NodeKey> = given.keys.iter().copied().collect();
    let moved: Vec<NodeKey> = entries
        .iter()
        .filter(|entry| chosen.contains(&entry.key) && listed(&entry.section))
        .map(|entry| entry.key)
        .collect();
    if is_elsewhere(&entries, &moved, side, anchor) {
        if plan.edits.is_empty() {
            plan.label = label(moved.len());
        }
        plan.edits.push(Edit::Reorder { keys: moved, side, anchor });
    }
    plan
}

/// Moves what is given up or down by one place, each kind and group by itself and gathered there, and groups all of which
/// is given as a whole; no edits where all is at its end already.
pub fn shift(given: &Given<'_>, side: Side) -> Plan {
    let entries = entries(given.scene);
    let chosen: BTreeSet<NodeKey> = given.keys.iter().copied().collect();
    let is_chosen = |entry: &&Entry| chosen.contains(&entry.key);
    let sections: BTreeSet<Section> =
        entries.iter().filter(is_chosen).map(|entry| entry.section.listed()).collect();
    let mut edits = shift_groups(given, side);
    for section in sections {
        let rows: Vec<&Entry> = entries.iter().filter(|entry| entry.section.listed() == section).collect();
        let keys: Vec<NodeKey> = rows.iter().copied().filter(is_chosen).map(|entry| entry.key).collect();
        let free = |entry: &&&Entry| !chosen.contains(&entry.key);
        let passed = match side {
            Side::Before => rows.iter().take_while(|entry| entry.key != keys[0]).filter(free).last(),
            Side::After => {
                let last = keys.last();
                rows.iter().rev().take_while(|entry| Some(&entry.key) != last).filter(free).last()
            }
        };
        edits.extend(passed.map(|passed| Edit::Reorder { keys, side, anchor: passed.key }));
    }
    Plan { select: Some(given.keys.to_vec()), ..Plan::new(label(given.keys.len()), edits) }
}

fn label(count: usize) -> String {
    format!("Move {count} {} in the tree", if count == 1 { "object" } else { "objects" })
}

impl Section {
    /// Without what makes no difference there.
    fn listed(&self) -> Self {
        Self { is_static: self.is_static && self.group.is_none(), ..self.clone() }
    }
}

fn entries(scene: &Scene) -> Vec<Entry> {
    let forces = scene.forces.iter().map(|force| {
        let section = Section { group: force.group.clone(), is_force: true, is_static: false };
        Entry { key: force.key, section }
    });
    let bodies = scene.bodies.iter().map(|body| {
        let section = Section { group: body.group.clone(), is_force: false, is_static: !body.is_dynamic() };
        Entry { key: body.key, section }
    });
    forces.chain(bodies).collect()
}

/// Whether any of these would get another place in its list.
fn is_elsewhere(entries: &[Entry], moved: &[NodeKey], side: Side, anchor: NodeKey) -> bool {
    let chosen: BTreeSet<NodeKey> = moved.iter().copied().collect();
    let Some(force) = entries.iter().find(|entry| entry.key == anchor).map(|entry| entry.section.is_force)
    else {
        return false;
    };
    let list: Vec<NodeKey> =
        entries.iter().filter(|entry| entry.section.is_force == force).map(|entry| entry.key).collect();
    let at = list.iter().position(|key| *key == anchor).unwrap_or(0) + usize::from(side == Side::After);
    let stays =
        |keys: &[NodeKey]| keys.iter().copied().filter(|key| !chosen.contains(key)).collect::<Vec<_>>();
    let (before, behind) = list.split_at(at);
    [stays(before), moved.to_vec(), stays(behind)].concat() != list
}
