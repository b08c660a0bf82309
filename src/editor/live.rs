//! What an edit of the document means for a simulation that runs: forces, statics, bounce and mass
//! apply at once; poses and velocities of dynamic bodies, ids, map and settings wait for a reset.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::scene::{Body, Force, Motion, NodeKey, Scene, Touched};
use crate::sim::SimEdit;

/// What the document has otherwise than the run, until the next start.
#[derive(Clone, Debug, Default)]
pub(super) struct Waiting {
    pub keys: BTreeSet<NodeKey>,
    /// Map or solver.
    pub settings: bool,
    /// The running simulation refused an edit.
    pub refused: bool,
}

/// The changes that turn the running scene into the one wanted, as far as a running one can be turned.
pub(super) struct LiveChange {
    pub edits: Vec<SimEdit>,
    /// The scene that runs after the edits.
    pub scene: Arc<Scene>,
    pub waiting: Waiting,
}

impl Waiting {
    pub fn any(&self) -> bool {
        !self.keys.is_empty() || self.settings || self.refused
    }
}

/// What of `touched` runs otherwise than wanted.
pub(super) fn waits(running: &Scene, wanted: &Scene, touched: &Touched) -> Waiting {
    let forces = (by_key(touched.forces(running), force_key), by_key(touched.forces(wanted), force_key));
    let bodies = (by_key(touched.bodies(running), body_key), by_key(touched.bodies(wanted), body_key));
    let differ = |key: &NodeKey| {
        !same(forces.0.get(key), forces.1.get(key), same_force)
            || !same(bodies.0.get(key), bodies.1.get(key), same_body)
    };
    Waiting {
        keys: touched.keys.iter().copied().filter(differ).collect(),
        settings: running.map != wanted.map || running.params != wanted.params,
        refused: false,
    }
}

/// Brings what edits touched to the scene that runs.
pub(super) fn live_change(
    (running, waiting): (&Scene, &Waiting),
    wanted: &Arc<Scene>,
    touched: &Touched,
) -> LiveChange {
    let mut edits = Vec::new();
    live_forces(running, wanted, touched, &mut edits);
    let bodies = live_bodies(running, wanted, touched, &mut edits);
    let settings = running.map != wanted.map || running.params != wanted.params;
    let keys = still_waiting(waiting, wanted, touched, &bodies);
    let waiting = Waiting { keys, settings, refused: waiting.refused };
    let scene = scene_after(running, wanted, &bodies, &waiting);
    LiveChange { edits, scene, waiting }
}

/// What waits after the edits: of the touched what does not run as wanted, and what waited before.
fn still_waiting(
    waiting: &Waiting,
    wanted: &Scene,
    touched: &Touched,
    bodies: &BTreeMap<NodeKey, Option<Body>>,
) -> BTreeSet<NodeKey> {
    let mut keys: BTreeSet<NodeKey> = waiting.keys.difference(&touched.keys).copied().collect();
    let waits = |body: &&Body| {
        let runs = bodies.get(&body.key).and_then(Option::as_ref);
        runs.is_none_or(|runs| !same_body(runs, body))
    };
    keys.extend(touched.bodies(wanted).filter(waits).map(|body| body.key));
    keys
}

/// The scene that runs: the wanted one itself, unless something waits.
fn scene_after(
    running: &Scene,
    wanted: &Arc<Scene>,
    touched: &BTreeMap<NodeKey, Option<Body>>,
    waiting: &Waiting,
) -> Arc<Scene> {
    if waiting.keys.is_empty() && !waiting.settings {
        return wanted.clone();
    }
    let waited = running.bodies.iter().filter(|body| waiting.keys.contains(&body.key));
    let waited: BTreeMap<NodeKey, &Body> = by_key(waited, body_key);
    let runs = |body: &Body| match touched.get(&body.key) {
        Some(runs) => runs.clone(),
        None if waiting.keys.contains(&body.key) => waited.get(&body.key).map(|body| (*body).clone()),
        None => Some(body.clone()),
    };
    Arc::new(Scene {
        map: running.map,
        time_speed: wanted.time_speed,
        params: running.params,
        forces: wanted.forces.clone(),
        bodies: wanted.bodies.iter().filter_map(runs).collect(),
    })
}

fn by_key<'s, T>(items: impl Iterator<Item = &'s T>, key: fn(&T) -> NodeKey) -> BTreeMap<NodeKey, &'s T> {
    items.map(|item| (key(item), item)).collect()
}

fn body_key(body: &Body) -> NodeKey {
    body.key
}

fn force_key(force: &Force) -> NodeKey {
    force.key
}

fn same<T>(a: Option<&&T>, b: Option<&&T>, same: fn(&T, &T) -> bool) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => same(a, b),
        (None, None) => true,
        _ => false,
    }
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
    a.key == b.key && a.id == b.id && a.motion == b.motion && a.spin == b.spin && same_surface(a, b)
}

fn same_surface(a: &Body, b: &Body) -> bool {
    a.position == b.position
        && a.rotation == b.rotation
        && a.bounce == b.bounce
        && a.roughness == b.roughness
        && a.material == b.material
        && a.shape == b.shape
}

fn live_forces(running: &Scene, wanted: &Scene, touched: &Touched, edits: &mut Vec<SimEdit>) {
    let before = by_key(touched.forces(running), force_key);
    let after = by_key(touched.forces(wanted), force_key);
    for force in touched.forces(running).filter(|force| !after.contains_key(&force.key)) {
        edits.push(SimEdit::Remove(force.key));
    }
    for force in touched.forces(wanted) {
        match before.get(&force.key) {
            None => edits.push(SimEdit::AddForce(Box::new(force.clone()))),
            Some(old) if old.kind != force.kind => edits.push(SimEdit::ChangeForce(Box::new(force.clone()))),
            Some(_) => {}
        }
    }
}

/// The touched bodies as they run after the edits; `None` for one that waits for the start.
fn live_bodies(
    running: &Scene,
    wanted: &Scene,
    touched: &Touched,
    edits: &mut Vec<SimEdit>,
) -> BTreeMap<NodeKey, Option<Body>> {
    let before = by_key(touched.bodies(running), body_key);
    let after = by_key(touched.bodies(wanted), body_key);
    for body in touched.bodies(running).filter(|body| !after.contains_key(&body.key)) {
        edits.push(SimEdit::Remove(body.key));
    }
    let mut runs = |body: &Body| live_body(before.get(&body.key).copied(), body, edits);
    touched.bodies(wanted).map(|body| (body.key, runs(body))).collect()
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
            let only_rules = Body { bounce: running.bounce, roughness: running.roughness, ..wanted.clone() };
            if same_surface(running, &only_rules) {
                live_rules(running, wanted, edits);
            } else {
                edits.push(SimEdit::ChangeStatic(Box::new(next.clone())));
            }
        }
        (Motion::Dynamic { mass: old_mass, velocity }, Motion::Dynamic { mass, .. }) => {
            let Body { bounce, roughness, .. } = *wanted;
            next = Body { bounce, roughness, motion: Motion::Dynamic { mass, velocity }, ..running.clone() };
            live_rules(running, wanted, edits);
            if old_mass != mass {
                edits.push(SimEdit::Mass(wanted.key, mass));
            }
        }
        _ => next = running.clone(),
    }
    Some(next)
}

/// What a body does to others in an impact or in contact.
fn live_rules(running: &Body, wanted: &Body, edits: &mut Vec<SimEdit>) {
    if running.bounce != wanted.bounce {
        edits.push(SimEdit::Bounce(wanted.key, wanted.bounce));
    }
    if running.roughness != wanted.roughness {
        edits.push(SimEdit::Roughness(wanted.key, wanted.roughness));
    }
}
