//! What an edit of the document means for a simulation that runs: forces, statics, bounce and mass
//! apply at once; poses and velocities of dynamic bodies, ids, map and settings wait for a reset.

use std::collections::BTreeMap;

use crate::scene::{Body, Force, Motion, NodeKey, Scene};
use crate::sim::SimEdit;

/// The changes that turn the running scene into `scene` as far as a running one can be turned.
pub(super) struct LiveChange {
    pub edits: Vec<SimEdit>,
    /// The scene that runs after the edits.
    pub scene: Scene,
}

/// Compares the scene that runs with the one wanted.
pub(super) fn live_change(running: &Scene, wanted: &Scene) -> LiveChange {
    let mut edits = Vec::new();
    let forces = live_forces(&running.forces, &wanted.forces, &mut edits);
    let bodies = live_bodies(&running.bodies, &wanted.bodies, &mut edits);
    let scene =
        Scene { map: running.map, time_speed: wanted.time_speed, params: running.params, forces, bodies };
    LiveChange { edits, scene }
}

/// Whether a simulation of `running` differs from one of `wanted`. Names, colours, what is hidden or
/// locked, the time speed and the place where a uniform gravity is drawn make no difference.
pub fn needs_reset(running: &Scene, wanted: &Scene) -> bool {
    let same = running.map == wanted.map
        && running.params == wanted.params
        && running.forces.len() == wanted.forces.len()
        && running.bodies.len() == wanted.bodies.len()
        && running.forces.iter().zip(&wanted.forces).all(|(a, b)| same_force(a, b))
        && running.bodies.iter().zip(&wanted.bodies).all(|(a, b)| same_body(a, b));
    !same
}

/// Whether one body or force runs otherwise than wanted, or is only in one of the scenes.
pub(super) fn differs<'a>(running: &'a Scene, wanted: &'a Scene, key: NodeKey) -> bool {
    let force = |scene: &'a Scene| scene.forces.iter().find(|force| force.key == key);
    let body = |scene: &'a Scene| scene.bodies.iter().find(|body| body.key == key);
    match (force(running), force(wanted), body(running), body(wanted)) {
        (Some(a), Some(b), ..) => !same_force(a, b),
        (.., Some(a), Some(b)) => !same_body(a, b),
        (None, None, None, None) => false,
        _ => true,
    }
}

fn same_force(a: &Force, b: &Force) -> bool {
    a.key == b.key && a.id == b.id && a.kind == b.kind
}

fn same_body(a: &Body, b: &Body) -> bool {
    a.key == b.key && a.id == b.id && a.motion == b.motion && same_surface(a, b)
}

fn same_surface(a: &Body, b: &Body) -> bool {
    a.position == b.position
        && a.rotation == b.rotation
        && a.bounce == b.bounce
        && a.material == b.material
        && a.shape == b.shape
}

fn live_forces(running: &[Force], wanted: &[Force], edits: &mut Vec<SimEdit>) -> Vec<Force> {
    let before: BTreeMap<NodeKey, &Force> = running.iter().map(|force| (force.key, force)).collect();
    let after: BTreeMap<NodeKey, &Force> = wanted.iter().map(|force| (force.key, force)).collect();
    for force in running.iter().filter(|force| !after.contains_key(&force.key)) {
        edits.push(SimEdit::Remove(force.key));
    }
    for force in wanted {
        match before.get(&force.key) {
            None => edits.push(SimEdit::AddForce(Box::new(force.clone()))),
            Some(old) if old.kind != force.kind => edits.push(SimEdit::ChangeForce(Box::new(force.clone()))),
            Some(_) => {}
        }
    }
    wanted.to_vec()
}

fn live_bodies(running: &[Body], wanted: &[Body], edits: &mut Vec<SimEdit>) -> Vec<Body> {
    let before: BTreeMap<NodeKey, &Body> = running.iter().map(|body| (body.key, body)).collect();
    let after: BTreeMap<NodeKey, &Body> = wanted.iter().map(|body| (body.key, body)).collect();
    for body in running.iter().filter(|body| !after.contains_key(&body.key)) {
        edits.push(SimEdit::Remove(body.key));
    }
    wanted.iter().filter_map(|body| live_body(before.get(&body.key).copied(), body, edits)).collect()
}

/// The body that runs once `wanted` is the one wanted; `None` for one that waits for the start.
fn live_body(running: Option<&Body>, wanted: &Body, edits: &mut Vec<SimEdit>) -> Option<Body> {
    let Some(running) = running else {
        // a moving body belongs to the start: its pose and velocity are those of t = 0
        if wanted.is_dynamic() {
            return None;
        }
        edits.push(SimEdit::AddBody(Box::new(wanted.clone())));
        return Some(wanted.clone());
    };
    // ids order the bodies of a simulation, so they cannot change while it runs
    let mut next = Body { id: running.id, label: running.label.clone(), ..wanted.clone() };
    match (running.motion, wanted.motion) {
        (Motion::Static, Motion::Static) => {
            let only_bounce = Body { bounce: running.bounce, ..wanted.clone() };
            if !same_surface(running, &only_bounce) {
                edits.push(SimEdit::ChangeStatic(Box::new(next.clone())));
            } else if running.bounce != wanted.bounce {
                edits.push(SimEdit::Bounce(wanted.key, wanted.bounce));
            }
        }
        (Motion::Dynamic { mass: old_mass, velocity }, Motion::Dynamic { mass, .. }) => {
            next =
                Body { bounce: wanted.bounce, motion: Motion::Dynamic { mass, velocity }, ..running.clone() };
            if running.bounce != wanted.bounce {
                edits.push(SimEdit::Bounce(wanted.key, wanted.bounce));
            }
            if old_mass != mass {
                edits.push(SimEdit::Mass(wanted.key, mass));
            }
        }
        _ => next = running.clone(),
    }
    Some(next)
}
