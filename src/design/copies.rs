//! Where copies go: beside their originals, clear of everything.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::extent::Extent;
use super::gap::{gap, tolerance};
use super::place::{clear_step, round};
use super::plan::Plan;
use crate::scene::{Body, BodyChange, BodyCopy, Edit, Force, Names, NodeKey, Scene};

/// Multiples of a step that are tried along each axis.
const MULTIPLES: usize = 32;

/// Copies of these bodies and forces. `step` is the offset of the copies made before, which goes on as long as it
/// leads to a free place; else they go the shortest way along an axis that is clear.
pub fn duplicate(scene: &Scene, keys: &[NodeKey], step: Option<DVec3>) -> Plan {
    let chosen: BTreeSet<NodeKey> = keys.iter().copied().collect();
    let bodies: Vec<&Body> = scene.bodies.iter().filter(|body| chosen.contains(&body.key)).collect();
    let offset = clear_offset(scene, &bodies, step);
    let what = if keys.len() == 1 { "1 object".to_owned() } else { format!("{} objects", keys.len()) };
    let groups = whole_groups(scene, &chosen);
    let edits = if groups.is_empty() {
        vec![Edit::Duplicate { keys: keys.to_vec(), offset }]
    } else {
        grouped_copies(scene, keys, offset, &groups)
    };
    Plan::new(format!("Duplicate {what}"), edits)
}

/// Outermost groups all of which is copied, with the names that their copies get.
fn whole_groups(scene: &Scene, chosen: &BTreeSet<NodeKey>) -> BTreeMap<String, String> {
    let bodies = scene.bodies.iter().map(|body| (&body.group, body.key));
    let forces = scene.forces.iter().map(|force| (&force.group, force.key));
    let mut is_whole = BTreeMap::<&str, bool>::new();
    for (group, key) in bodies.chain(forces) {
        if let Some(outermost) = group.as_deref().and_then(|group| group.split('/').next()) {
            *is_whole.entry(outermost).or_insert(true) &= chosen.contains(&key);
        }
    }
    let mut names = Names::new(is_whole.keys().copied());
    let whole = is_whole.into_iter().filter(|(_, whole)| *whole);
    whole.map(|(group, _)| (group.to_owned(), names.take(group))).collect()
}

/// Copies whose groups are groups of their own.
fn grouped_copies(
    scene: &Scene,
    keys: &[NodeKey],
    offset: DVec3,
    groups: &BTreeMap<String, String>,
) -> Vec<Edit> {
    let renamed = |group: &Option<String>| {
        let group = group.as_deref()?;
        let outermost = group.split('/').next().unwrap_or(group);
        let new = groups.get(outermost).map_or(outermost, String::as_str);
        Some(format!("{new}{}", group.strip_prefix(outermost).unwrap_or_default()))
    };
    let bodies: BTreeMap<NodeKey, &Body> = scene.bodies.iter().map(|body| (body.key, body)).collect();
    let copies = keys.iter().filter_map(|key| bodies.get(key)).map(|body| BodyCopy {
        of: body.key,
        changes: vec![BodyChange::Position(body.position + offset), BodyChange::Group(renamed(&body.group))],
    });
    let mut names = Names::new(scene.forces.iter().filter_map(|force| force.name.as_deref()));
    let forces = scene.forces.iter().filter(|force| keys.contains(&force.key)).map(|force| {
        let kind = force.kind.moved(offset).unwrap_or(force.kind);
        let name = force.name.as_deref().map(|name| names.take(name));
        Edit::AddForce(Box::new(Force { kind, name, group: renamed(&force.group), ..force.clone() }))
    });
    [Edit::CopyBodies(copies.collect())].into_iter().chain(forces).collect()
}

/// The bodies and forces of another scene: in place, or where they are clear of this one.
pub fn paste(scene: &Scene, from: &Scene, in_place: bool) -> Plan {
    let bodies: Vec<&Body> = from.bodies.iter().collect();
    let offset = if in_place || is_clear(scene, &bodies, DVec3::ZERO) {
        DVec3::ZERO
    } else {
        clear_offset(scene, &bodies, None)
    };
    let mut body_names = Names::new(scene.bodies.iter().filter_map(|body| body.name.as_deref()));
    let mut force_names = Names::new(scene.forces.iter().filter_map(|force| force.name.as_deref()));
    let forces = from.forces.iter().map(|force| {
        let name = force.name.as_deref().map(|name| force_names.take(name));
        Edit::AddForce(Box::new(Force { name, ..force.clone() }))
    });
    let mut edits: Vec<Edit> = forces.collect();
    edits.extend(bodies.iter().map(|body| {
        let name = body.name.as_deref().map(|name| body_names.take(name));
        Edit::AddBody(Box::new(Body { name, position: body.position + offset, ..(*body).clone() }))
    }));
    Plan::new(format!("Paste {} objects", edits.len()), edits)
}

/// Whether bodies moved by `offset` overlap nothing in the scene and cover nothing.
pub fn is_clear(scene: &Scene, bodies: &[&Body], offset: DVec3) -> bool {
    let Some(all) = Extent::around(bodies.iter().copied()).map(|all| all.moved(offset)) else { return true };
    let near: Vec<(&Body, Extent)> = scene
        .bodies
        .iter()
        .map(|body| (body, Extent::of(body)))
        .filter(|(_, extent)| extent.meets(all, 0.0))
        .collect();
    bodies.iter().all(|body| {
        let copy = Body { position: body.position + offset, ..(*body).clone() };
        let extent = Extent::of(&copy);
        near.iter().all(|(other, there)| !extent.meets(*there, 0.0) || !covers(scene, &copy, other))
    })
}

/// Whether two bodies overlap, or lie in the same place where they cannot collide.
fn covers(scene: &Scene, copy: &Body, other: &Body) -> bool {
    match gap(copy, other) {
        Some(gap) => gap.distance < -tolerance(scene, copy, other),
        None => copy.position == other.position,
    }
}

/// Where copies of these bodies go.
fn clear_offset(scene: &Scene, bodies: &[&Body], step: Option<DVec3>) -> DVec3 {
    let going_on = step.into_iter().flat_map(|step| (1..=MULTIPLES).map(move |times| step * times as f64));
    if let Some(offset) = going_on.into_iter().find(|offset| is_clear(scene, bodies, *offset)) {
        return offset;
    }
    let least = round(scene.map.size.min_element() / 20.0);
    let Some(all) = Extent::around(bodies.iter().copied()) else { return DVec3::X * least };
    let map = Extent { min: DVec3::ZERO, max: scene.map.size };
    let mut ways = Vec::new();
    for sign in [1.0, -1.0] {
        for axis in [0, 2, 1] {
            let pitch = clear_step(all.size()[axis], least);
            ways.extend((1..=MULTIPLES).map(|times| DVec3::AXES[axis] * (sign * pitch * times as f64)));
        }
    }
    // The shortest first; of equal ones the first listed. Ways that leave the map come last.
    ways.sort_by(|a, b| {
        let leaves = |way: &DVec3| map.holds(all) && !map.holds(all.moved(*way));
        leaves(a).cmp(&leaves(b)).then(a.length().total_cmp(&b.length()))
    });
    let first = ways.first().copied().unwrap_or(DVec3::X * least);
    ways.into_iter().find(|way| is_clear(scene, bodies, *way)).unwrap_or(first)
}
