//! Groups of bodies that are stepped: closed forms that they must follow to the step, and what no heap may do.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};

use super::case::{Case, Demand, Source, at_most, reported};
use super::trial::{Stop, Trial, start, states};
use crate::scene::{Body, Force, ForceKind, Map, Motion, Scene, Shape, SimParams};
use crate::sim::{BodyRef, BodyState, Simulation};
use crate::study::closed_form::Bounces;
use crate::study::{OverlapMonitor, Random};

/// m, m/s², kg.
const RADIUS: f64 = 0.05;
const GRAVITY: f64 = 9.81;
const MASS: f64 = 1.0;
/// What the energy of a heap is measured by, J.
const UNIT: f64 = MASS * GRAVITY * RADIUS;

/// Segments of stepped bodies count too: one a step for each.
const BUDGET: u64 = 50_000_000;

pub(super) const RAFT: Case = Case {
    number: 18,
    id: "raft",
    title: "Raft of 64 touching balls dropped flat, e = 0.5, stepped",
    reference: "the bounces of one ball",
    peers: "",
    source: Source::Built(|| raft(1.0 / 256.0)),
    demands: &[
        at_most(1.0, "", "height off, over first speed times step"),
        at_most(0.3, "", "1 − exponent with which it falls with the step"),
        at_most(1e-2, "", "balls apart in height, over the radius"),
        reported("", "share of looks at which all are stepped"),
    ],
    budget: BUDGET,
    long: false,
    run: measure_raft,
};

pub(super) const CLUSTER: Case = Case {
    id: "cluster",
    title: "Cluster of 75 balls, hit in free fall, e = 0.5, stepped",
    reference: "momenta; the parabola of the centre of mass",
    source: Source::Built(cluster),
    demands: &[
        at_most(1e-12, "m", "centre of mass off"),
        at_most(1e-12, "", "momentum off, relative"),
        at_most(1e-10, "", "angular momentum off, relative"),
        at_most(1e-3, "", "overlap over the radius"),
        reported("", "balls stepped at most"),
    ],
    run: measure_cluster,
    ..RAFT
};

pub(super) const COLUMN: Case = Case {
    id: "column",
    title: "Column of 70 balls at rest, e = 0.2, stepped",
    reference: "each contact bears the weight above it",
    source: Source::Built(column),
    demands: &[
        at_most(1e-2, "", "load of a contact off, over the whole weight"),
        at_most(1e-3, "", "overlap over the radius"),
        at_most(1e-2, "", "energy gained, in m g r of a ball"),
        reported("", "loads"),
    ],
    run: measure_column,
    ..RAFT
};

const HEAP: &[Demand] = &[
    at_most(1e-3, "", "overlap over the radius"),
    at_most(1e-2, "", "energy gained, in m g r of a ball"),
    at_most(0.0, "m", "out of the box"),
    at_most(1e-11, "", "energy residual"),
    at_most(1e-3, "", "kinetic energy of a ball at 5 s, in m g r"),
];

pub(super) const DROP_300: Case = Case {
    id: "drop-300",
    title: "300 balls dropped into a box, e = 0.2, 5 s",
    reference: "invariants",
    source: Source::Built(|| dropped(300)),
    demands: HEAP,
    run: measure_heap,
    ..RAFT
};

pub(super) const DROP_1000: Case = Case {
    id: "drop-1000",
    title: "1000 balls dropped into a box, e = 0.2, 5 s",
    source: Source::Built(|| dropped(1000)),
    long: true,
    ..DROP_300
};

pub(super) const MIRROR: Case = Case {
    id: "mirror",
    title: "Flat pyramid of 66 hit in its middle, e = 0.3, 0.3 s",
    reference: "mirror symmetry, which the order of the sweeps breaks by what they leave",
    source: Source::Built(pyramid),
    demands: &[
        at_most(1e-2, "", "asymmetry over the radius"),
        at_most(1e-3, "", "overlap over the radius"),
        at_most(1e-2, "", "energy gained, in m g r of a ball"),
        reported("", "balls stepped at most"),
    ],
    run: measure_mirror,
    ..RAFT
};

/// Watches what no heap may do.
struct Watcher {
    overlaps: OverlapMonitor,
    lowest: f64,
    /// Over the radius.
    overlap: f64,
    /// In `m g r`.
    gain: f64,
    stepped: usize,
}

impl Watcher {
    fn new(scene: &Scene) -> Self {
        let overlaps = OverlapMonitor::in_id_order(scene);
        Self { overlaps, lowest: f64::INFINITY, overlap: 0.0, gain: 0.0, stepped: 0 }
    }

    fn look(&mut self, sim: &Simulation) {
        let states = states(sim);
        let places: Vec<DVec3> = states.iter().map(|state| state.position).collect();
        self.overlap = self.overlap.max(self.overlaps.worst(&places) / RADIUS);
        let total: f64 = states.iter().map(energy).sum();
        self.lowest = self.lowest.min(total);
        self.gain = self.gain.max((total - self.lowest) / UNIT);
        self.stepped = self.stepped.max(sim.stepped().map_or(0, |stepped| stepped.count));
    }
}

/// Kinetic and potential energy of a ball, J.
fn energy(state: &BodyState) -> f64 {
    MASS * (0.5 * state.velocity.length_squared() + GRAVITY * state.position.y)
}

fn measure_raft(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let (coarse, fine) = (1.0 / 256.0, 1.0 / 4096.0);
    let [one, other] = [coarse, fine].map(|step| follow_raft(trial, step));
    let (one, other) = (one?, other?);
    let exponent = libm::log(one.off / other.off) / libm::log(coarse / fine);
    let speed = (2.0 * GRAVITY * DROP).sqrt();
    Ok(vec![one.off / (speed * coarse), 1.0 - exponent, one.apart.max(other.apart) / RADIUS, one.stepped])
}

/// How a raft moved.
struct Followed {
    /// Largest distance in height from one ball by itself, m.
    off: f64,
    /// Largest difference in height between balls, m.
    apart: f64,
    stepped: f64,
}

fn follow_raft(trial: &Trial, step: f64) -> Result<Followed, Stop> {
    let scene = raft(step);
    let mut sim = start(&scene)?;
    let bounces = Bounces::dropped(DROP, GRAVITY, 0.5);
    let mut followed = Followed { off: 0.0, apart: 0.0, stepped: 0.0 };
    let (mut looks, mut stepped) = (0.0, 0.0);
    trial.watch(&mut sim, 1.0, |sim, _| {
        let height = RADIUS + bounces.height(sim.time());
        let heights: Vec<f64> = states(sim).iter().map(|state| state.position.y).collect();
        let (low, high) = heights
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(*y), high.max(*y)));
        followed.off = followed.off.max(high - height).max(height - low);
        followed.apart = followed.apart.max(high - low);
        looks += 1.0;
        stepped += f64::from(sim.stepped().is_some_and(|stepped| stepped.count == heights.len()));
        Ok(())
    })?;
    followed.stepped = stepped / looks;
    Ok(followed)
}

fn measure_cluster(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut watcher = Watcher::new(&trial.scene);
    let (gravity, count) = (DVec3::NEG_Y * GRAVITY, states(&sim).len() as f64);
    let (place, speed, spin) = sums(&states(&sim));
    let brought: f64 = states(&sim).iter().map(|state| MASS * state.velocity.length()).sum();
    let (mut off, mut momentum, mut turning) = (0.0_f64, 0.0_f64, 0.0_f64);
    trial.watch(&mut sim, 0.5, |sim, event| {
        if event.is_none() {
            watcher.look(sim);
            let t = sim.time();
            let (now, now_speed, now_spin) = sums(&states(sim));
            let expected = place + speed * t + 0.5 * t * t * gravity;
            off = off.max((now - expected).length());
            let change = count * MASS * (now_speed - speed - t * gravity).length();
            momentum = momentum.max(change / (brought + count * MASS * GRAVITY * t));
            turning = turning.max((now_spin - spin).length() / (brought * RADIUS));
        }
        Ok(())
    })?;
    Ok(vec![off, momentum, turning, watcher.overlap, watcher.stepped as f64])
}

/// Centre of mass, its velocity, and the angular momentum about it.
fn sums(states: &[BodyState]) -> (DVec3, DVec3, DVec3) {
    let count = states.len() as f64;
    let place = states.iter().map(|state| state.position).sum::<DVec3>() / count;
    let speed = states.iter().map(|state| state.velocity).sum::<DVec3>() / count;
    let spin = states.iter().map(|state| MASS * (state.position - place).cross(state.velocity - speed)).sum();
    (place, speed, spin)
}

fn measure_column(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut watcher = Watcher::new(&trial.scene);
    trial.watch(&mut sim, 4.0, |sim, _| {
        watcher.look(sim);
        Ok(())
    })?;
    let balls = states(&sim).len();
    let whole = balls as f64 * MASS * GRAVITY;
    let forces = sim.contact_forces(usize::MAX);
    let above = |contact: &crate::sim::ContactForce| {
        let lower = match (contact.a, contact.b) {
            (BodyRef::Dynamic(a), BodyRef::Dynamic(b)) => a.min(b) as usize + 1,
            _ => 0,
        };
        (balls - lower) as f64 * MASS * GRAVITY
    };
    let off = forces.iter().map(|contact| (contact.force - above(contact)).abs() / whole);
    let off = if forces.len() == balls { off.fold(0.0, f64::max) } else { f64::NAN };
    Ok(vec![off, watcher.overlap, watcher.gain, forces.len() as f64])
}

fn measure_heap(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut watcher = Watcher::new(&trial.scene);
    let size = trial.scene.map.size;
    let (mut out, mut residual) = (f64::NEG_INFINITY, 0.0_f64);
    trial.watch(&mut sim, 5.0, |sim, event| {
        if event.is_none() {
            watcher.look(sim);
            let outside = |state: BodyState| (-state.position).max(state.position - size).max_element();
            out = states(sim).into_iter().map(outside).fold(out, f64::max);
            residual = residual.max(sim.energy().residual.map_or(f64::NAN, f64::abs));
        }
        Ok(())
    })?;
    let kinetic: f64 = states(&sim).iter().map(|state| 0.5 * MASS * state.velocity.length_squared()).sum();
    let of_each = kinetic / states(&sim).len() as f64 / UNIT;
    Ok(vec![watcher.overlap, watcher.gain, out.max(0.0), residual, of_each])
}

fn measure_mirror(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut watcher = Watcher::new(&trial.scene);
    let partners = partners(&states(&sim));
    let mut asymmetry = 0.0_f64;
    trial.watch(&mut sim, 0.3, |sim, event| {
        if event.is_none() {
            watcher.look(sim);
            let states = states(sim);
            for (one, other) in partners.iter().enumerate() {
                let mirrored = mirror(states[*other].position);
                asymmetry = asymmetry.max((states[one].position - mirrored).length());
            }
        }
        Ok(())
    })?;
    Ok(vec![asymmetry / RADIUS, watcher.overlap, watcher.gain, watcher.stepped as f64])
}

/// Which ball each one is the mirror image of.
fn partners(states: &[BodyState]) -> Vec<usize> {
    let off = |one: &BodyState, other: &BodyState| (one.position - mirror(other.position)).length();
    let nearest = |one: &BodyState| {
        (0..states.len()).min_by(|a, b| off(one, &states[*a]).total_cmp(&off(one, &states[*b]))).unwrap_or(0)
    };
    states.iter().map(nearest).collect()
}

/// Height over the floor from which the raft falls, m.
const DROP: f64 = 0.5;
/// Middle of the map, in x and z, m.
const MIDDLE: f64 = 2.0;

fn mirror(at: DVec3) -> DVec3 {
    dvec3(2.0 * MIDDLE - at.x, at.y, at.z)
}

/// 8×8 balls that touch, in steps of so many seconds.
fn raft(step: f64) -> Scene {
    let places = (0..64).map(|k| {
        let [x, z] = [k % 8, k / 8].map(|cell| MIDDLE + 2.0 * RADIUS * (f64::from(cell) - 3.5));
        dvec3(x, DROP + RADIUS, z)
    });
    let mut scene = on_floor(4.0, 0.5, places);
    scene.params.dense_step = step;
    scene
}

/// 5×5×3 balls that touch, and one that flies into them off their middle.
fn cluster() -> Scene {
    let places = (0..75).map(|k| {
        let cell = [k % 5, k / 25, k / 5 % 5].map(f64::from);
        DVec3::splat(MIDDLE) + 2.0 * RADIUS * (DVec3::from(cell) - dvec3(2.0, 1.0, 2.0))
    });
    let mut scene = in_gravity(4.0, 0.5, places);
    let bullet = scene.bodies.len() as i64 + 1;
    let at = DVec3::splat(MIDDLE) + dvec3(-0.5, 0.03, 0.02);
    scene.bodies.push(ball(bullet, at, DVec3::X * 5.0, 0.5));
    scene
}

fn column() -> Scene {
    on_floor(8.0, 0.2, (0..70).map(|k| dvec3(MIDDLE, RADIUS * (2.0 * f64::from(k) + 1.0), MIDDLE)))
}

/// Rows of eleven balls and fewer between two walls, each ball in the notch of two, and one that falls on the top.
fn pyramid() -> Scene {
    let mut places = Vec::new();
    for row in 0..11_u32 {
        let height = RADIUS * (1.0 + f64::from(row) * 3.0_f64.sqrt());
        let balls = 11 - row;
        let first = -RADIUS * f64::from(balls - 1);
        places
            .extend((0..balls).map(|k| dvec3(MIDDLE + first + 2.0 * RADIUS * f64::from(k), height, MIDDLE)));
    }
    places.push(dvec3(MIDDLE, RADIUS * (3.0 + 10.0 * 3.0_f64.sqrt()) + 0.02, MIDDLE));
    let mut scene = on_floor(4.0, 0.3, places);
    for (id, side) in [(10_001, -1.0), (10_002, 1.0)] {
        let at = dvec3(MIDDLE + side * 11.0 * RADIUS, 2.0, MIDDLE);
        scene.bodies.push(plate(id, at, dvec3(0.0, -side * FRAC_PI_2, 0.0), 2.0, 0.3));
    }
    scene
}

/// Balls above the floor of a box that is about as wide as they are many.
fn dropped(balls: usize) -> Scene {
    let across = libm::ceil(libm::cbrt(balls as f64));
    let pitch = 2.3 * RADIUS;
    let width = across * pitch;
    let mut random = Random::new(balls as u64);
    let side = across as usize;
    let places: Vec<DVec3> = (0..balls)
        .map(|k| {
            let cell = [k % side, k / (side * side), k / side % side].map(|cell| cell as f64 + 0.5);
            pitch * DVec3::from(cell) + random.vector(0.1 * RADIUS)
        })
        .collect();
    let height = 2.0 * width;
    let mut scene = in_gravity(width, 0.2, places);
    scene.map.size.y = height;
    let (half, middle) = (0.5 * width, dvec3(0.5 * width, 0.5 * height, 0.5 * width));
    let walls = [
        (dvec3(middle.x, 0.0, middle.z), dvec3(-FRAC_PI_2, 0.0, 0.0), half, half),
        (dvec3(0.0, middle.y, middle.z), dvec3(0.0, FRAC_PI_2, 0.0), half, 0.5 * height),
        (dvec3(width, middle.y, middle.z), dvec3(0.0, -FRAC_PI_2, 0.0), half, 0.5 * height),
        (dvec3(middle.x, middle.y, 0.0), DVec3::ZERO, half, 0.5 * height),
        (dvec3(middle.x, middle.y, width), DVec3::ZERO, half, 0.5 * height),
    ];
    for (id, (at, rotation, half_x, half_y)) in (10_000..).zip(walls) {
        let mut wall = plate(id, at, rotation, half_x, half_y);
        wall.bounce = 0.2_f64.sqrt();
        scene.bodies.push(wall);
    }
    scene
}

/// Balls over a wide floor; every pair has the restitution `e`.
fn on_floor(size: f64, e: f64, places: impl IntoIterator<Item = DVec3>) -> Scene {
    let mut scene = in_gravity(size, e, places);
    let mut floor = plate(10_000, dvec3(MIDDLE, 0.0, MIDDLE), dvec3(-FRAC_PI_2, 0.0, 0.0), 4.0, 4.0);
    floor.bounce = e.sqrt();
    scene.bodies.push(floor);
    scene
}

fn in_gravity(size: f64, e: f64, places: impl IntoIterator<Item = DVec3>) -> Scene {
    let acceleration = DVec3::NEG_Y * GRAVITY;
    let balls = (1..).zip(places).map(|(id, at)| ball(id, at, DVec3::ZERO, e));
    Scene {
        map: Map { size: DVec3::splat(size), tiles: [(size / (3.0 * RADIUS)) as u32; 3] },
        time_speed: 1.0,
        params: SimParams::default(),
        forces: vec![Force::new(1, ForceKind::GravityPlane { position: DVec3::ZERO, acceleration })],
        bodies: balls.collect(),
    }
}

fn ball(id: i64, at: DVec3, velocity: DVec3, e: f64) -> Body {
    let motion = Motion::Dynamic { mass: MASS, velocity };
    Body { bounce: e.sqrt(), ..Body::new(id, at, motion, Shape::Sphere { radius: RADIUS }) }
}

fn plate(id: i64, at: DVec3, rotation: DVec3, half_x: f64, half_y: f64) -> Body {
    Body { rotation, ..Body::new(id, at, Motion::Static, Shape::Plane { half_x, half_y }) }
}
