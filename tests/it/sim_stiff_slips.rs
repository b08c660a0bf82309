//! Friction where it is stiff, from seeds: coefficients up to 1000, balls down to a tenth of a millimetre, on faces, fixed balls,
//! edges and in grooves, also in air and with rolling friction: there bodies are stepped, leave and are stepped again.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, Roughness, Scene};
use polyscene::study::{OverlapMonitor, Random};

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball};
use crate::common::drive::{Promise, simulation, states};

const GRAVITY: f64 = 9.81;
const MIDDLE: DVec3 = DVec3::splat(5.0);

/// What a ball lies on.
#[derive(Clone, Copy, Debug)]
enum Support {
    Face,
    Sphere,
    Groove,
    Edge,
}

/// A ball of a radius that touches a support, with any velocity along it and any spin.
fn scene(support: Support, random: &mut Random) -> Scene {
    let radius = 10.0_f64.powf(random.range(-4.0, -0.5));
    let law = Roughness {
        friction: 10.0_f64.powf(random.range(-2.0, 3.0)),
        rolling: [0.0, 10.0_f64.powf(random.range(-3.0, -1.0))][random.below(2)],
        tangential: [0.0, random.unit()][random.below(2)],
    };
    let speed = (GRAVITY * radius).sqrt() * 10.0_f64.powf(random.range(-4.0, 1.0));
    let tilt = random.range(0.0, 0.6);
    let face = |id: i64, angle: f64| plate(id, MIDDLE, dvec3(-FRAC_PI_2, angle, 0.0), 3.0, 3.0);
    let (sin, cos) = tilt.sin_cos();
    let (statics, place, normal): (Vec<Body>, DVec3, DVec3) = match support {
        Support::Face => (vec![face(1, tilt)], radius * dvec3(sin, cos, 0.0), dvec3(sin, cos, 0.0)),
        Support::Sphere => {
            let own = radius * random.range(0.5, 20.0);
            let place = (own + radius) * dvec3(sin, cos, 0.0);
            (vec![static_ball(1, MIDDLE, own)], place, dvec3(sin, cos, 0.0))
        }
        Support::Groove => {
            let half = random.range(0.4, 1.3);
            let sides = vec![face(1, FRAC_PI_2 - half), face(2, half - FRAC_PI_2)];
            // Only along the groove it keeps to both.
            (sides, radius / half.sin() * DVec3::Y, DVec3::Y)
        }
        Support::Edge => {
            let edge = plate(1, MIDDLE - 3.0 * DVec3::X, dvec3(-FRAC_PI_2, 0.0, 0.0), 3.0, 3.0);
            (vec![edge], radius * dvec3(sin, cos, 0.0), dvec3(sin, cos, 0.0))
        }
    };
    let across = random.vector(1.0);
    let along = match support {
        Support::Groove => DVec3::Z * across.z,
        _ => across - across.dot(normal) * normal,
    };
    let spin = [0.0, 1.0, 20.0][random.below(3)] * speed / radius * random.vector(1.0);
    let moving = ball(9, MIDDLE + place, speed * along).radius(radius).mass(radius.powi(3) * 1e4).spin(spin);
    let mut all = empty().gravity(-GRAVITY);
    if random.below(3) == 0 {
        all = all.air(random.range(0.1, 10.0));
    }
    for body in statics.into_iter().chain([moving]) {
        all = all.body(Body { bounce: 0.4, roughness: law, ..body });
    }
    all
}

/// Runs all cases of a support for a while: no fault, no crowd of events, no energy from nowhere, no overlap.
fn hold(support: Support, cases: u64) {
    let mut random = Random::new(1000);
    let mut failures = Vec::new();
    for case in 0..cases {
        let scene = scene(support, &mut random);
        if let Some(failure) = failure(&scene) {
            failures.push(format!(
                "{support:?} {case}: {failure}\n{} forces, {:?}",
                scene.forces.len(),
                scene.bodies.last()
            ));
        }
    }
    assert!(failures.is_empty(), "{} of {cases}:\n{}", failures.len(), failures.join("\n"));
}

fn failure(scene: &Scene) -> Option<String> {
    let mut sim = simulation(scene);
    let promise = Promise::of_steps(&sim, scene);
    let monitor = OverlapMonitor::in_id_order(scene);
    let total = |sim: &polyscene::sim::Simulation| {
        sim.energy().kinetic + sim.energy().potential.expect("gravity and air alone")
    };
    let radius = scene.bodies.last().and_then(|body| match body.shape {
        polyscene::scene::Shape::Sphere { radius } => Some(radius),
        _ => None,
    })?;
    // A hundred times that of a fall by the radius.
    let until = 100.0 * (radius / GRAVITY).sqrt();
    let mut lowest = total(&sim);
    let size = lowest.abs();
    let mut events = 0;
    for sample in 1..=40 {
        sim.begin(until * f64::from(sample) / 40.0);
        loop {
            match sim.next_event() {
                Ok(Some(_)) => events += 1,
                Ok(None) => break,
                Err(fault) => return Some(format!("{fault:?}")),
            }
            if events > 2000 {
                return Some(format!("2000 events until {} of {until} s, {:?}", sim.time(), sim.counters()));
            }
        }
        let now = total(&sim);
        if now > lowest + promise.climb + 1e-13 * size {
            return Some(format!("t {}: energy from {lowest} to {now} J", sim.time()));
        }
        lowest = lowest.min(now);
        let residual = sim.energy().residual.unwrap_or(f64::NAN).abs();
        if residual.is_nan() || residual > 1e-10 {
            return Some(format!(
                "t {}: energy residual {residual:e}, {} steps",
                sim.time(),
                sim.counters().steps
            ));
        }
        let places: Vec<DVec3> = states(&sim).iter().map(|(_, state)| state.position).collect();
        let overlap = monitor.worst(&places);
        if overlap > promise.overlap + 1e-14 {
            return Some(format!("t {}: overlap {overlap:e} m", sim.time()));
        }
    }
    None
}

#[test]
fn on_faces() {
    hold(Support::Face, 150);
}

#[test]
fn on_fixed_balls() {
    hold(Support::Sphere, 150);
}

#[test]
fn in_grooves() {
    // Those with rolling friction are stepped.
    hold(Support::Groove, 30);
}

#[test]
fn on_edges() {
    hold(Support::Edge, 150);
}
