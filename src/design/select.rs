//! Other selections from one: what is alike, what touches, what is in the same tiles.

use std::collections::BTreeSet;

use super::gap::{gap, tolerance};
use super::near::for_each_near;
use super::plan::{Given, Plan};
use super::tool::{Tool, ToolGroup};
use crate::scene::{Body, Force, ForceKind, Map, NodeKey, Shape};

pub(super) const SAME_KIND: Tool = Tool {
    id: "select_same_kind",
    label: "Same kind",
    group: ToolGroup::Select,
    help: "Selects all bodies and forces of the kinds that are selected: moving balls, plates, drags",
    inputs: &[],
    follow: None,
    enabled: with_any,
    plan: |given, _| {
        let kinds: BTreeSet<_> = given.bodies().iter().map(|body| kind(body)).collect();
        let forces: BTreeSet<_> = given.forces().iter().map(|force| force_kind(force)).collect();
        Ok(selection(given, |body| kinds.contains(&kind(body)), |force| forces.contains(&force_kind(force))))
    },
};

pub(super) const SAME_MATERIAL: Tool = Tool {
    id: "select_same_material",
    label: "Same material",
    group: ToolGroup::Select,
    help: "Selects all bodies with the materials of those that are selected",
    inputs: &[],
    follow: None,
    enabled: with_body,
    plan: |given, _| {
        let materials: BTreeSet<_> = given.bodies().iter().map(|body| body.material.as_deref()).collect();
        Ok(selection(given, |body| materials.contains(&body.material.as_deref()), |_| false))
    },
};

pub(super) const SAME_GROUP: Tool = Tool {
    id: "select_same_group",
    label: "Same group",
    group: ToolGroup::Select,
    help: "Selects everything in the groups of what is selected",
    inputs: &[],
    follow: None,
    enabled: |given| {
        let bodies = given.bodies().iter().any(|body| body.group.is_some());
        let forces = given.forces().iter().any(|force| force.group.is_some());
        if bodies || forces { Ok(()) } else { Err("nothing that is selected is in a group") }
    },
    plan: |given, _| {
        let (bodies, forces) = (given.bodies(), given.forces());
        let of_bodies = bodies.iter().filter_map(|body| body.group.as_deref());
        let groups: BTreeSet<_> =
            of_bodies.chain(forces.iter().filter_map(|force| force.group.as_deref())).collect();
        let is_in = |group: &Option<String>| group.as_deref().is_some_and(|group| groups.contains(group));
        Ok(selection(given, |body| is_in(&body.group), |force| is_in(&force.group)))
    },
};

pub(super) const TOUCHING: Tool = Tool {
    id: "select_touching",
    label: "Touching",
    group: ToolGroup::Select,
    help: "Adds to the selection what touches it; again: what touches that",
    inputs: &[],
    follow: None,
    enabled: with_body,
    plan: |given, _| {
        let bodies = &given.scene.bodies;
        let selected: BTreeSet<NodeKey> = given.keys.iter().copied().collect();
        let mut found = selected.clone();
        // Wider than any tolerance, which the gap then decides by.
        let margin = 1e-6 * given.scene.map.size.max_element();
        for_each_near(bodies, margin, |a, b| {
            let (a, b) = (&bodies[a], &bodies[b]);
            let touch = || gap(a, b).is_some_and(|gap| gap.distance <= tolerance(given.scene, a, b));
            if selected.contains(&a.key) != selected.contains(&b.key) && touch() {
                found.extend([a.key, b.key]);
            }
            true
        });
        let forces = given.forces();
        let is_kept = |force: &Force| forces.iter().any(|kept| kept.key == force.key);
        Ok(selection(given, |body| found.contains(&body.key), is_kept))
    },
};

pub(super) const IN_TILE: Tool = Tool {
    id: "select_in_tile",
    label: "All in the same tiles",
    group: ToolGroup::Select,
    help: "Selects all bodies whose middles lie in the tiles of those that are selected",
    inputs: &[],
    follow: None,
    enabled: with_body,
    plan: |given, _| {
        let map = &given.scene.map;
        let tiles: BTreeSet<_> = given.bodies().iter().map(|body| tile(map, body)).collect();
        Ok(selection(given, |body| tiles.contains(&tile(map, body)), |_| false))
    },
};

fn with_any(given: &Given<'_>) -> Result<(), &'static str> {
    if given.keys.is_empty() { Err("nothing is selected") } else { Ok(()) }
}

fn with_body(given: &Given<'_>) -> Result<(), &'static str> {
    if given.bodies().is_empty() { Err("no body is selected") } else { Ok(()) }
}

/// Selects what is visible of these.
fn selection(
    given: &Given<'_>,
    of_bodies: impl Fn(&Body) -> bool,
    of_forces: impl Fn(&Force) -> bool,
) -> Plan {
    let scene = given.scene;
    let bodies = scene.bodies.iter().filter(|body| !body.hidden && of_bodies(body)).map(|body| body.key);
    let forces = scene.forces.iter().filter(|force| !force.hidden && of_forces(force)).map(|force| force.key);
    Plan { select: Some(forces.chain(bodies).collect()), ..Plan::default() }
}

fn kind(body: &Body) -> (u8, bool) {
    let shape = match body.shape {
        Shape::Sphere { .. } => 0,
        Shape::Plane { .. } => 1,
        Shape::Unbuilt { .. } => 2,
    };
    (shape, body.is_dynamic())
}

fn force_kind(force: &Force) -> u8 {
    match force.kind {
        ForceKind::GravityPoint { .. } => 0,
        ForceKind::GravityPlane { .. } => 1,
        ForceKind::Drag { .. } => 2,
    }
}

fn tile(map: &Map, body: &Body) -> [i64; 3] {
    let counts = glam::DVec3::from_array(map.tiles.map(f64::from));
    (body.position / map.size * counts).to_array().map(|place| place.floor() as i64)
}
