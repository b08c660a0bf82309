//! The elastic gas: many equal balls in a closed box.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::case::{Case, Demand, Source, at_most, file, reported};
use super::monitor::Monitor;
use super::trial::{Stop, Trial};
use crate::scene::{Body, Map, Motion, Scene, Shape, SimParams};
use crate::sim::BodyRef;
use crate::study::Random;

const DEMANDS: &[Demand] = &[
    at_most(1e-10, "", "energy off, relative"),
    at_most(1e-9, "", "overlap over the radius"),
    reported("", "ball-ball impacts over Enskog's bulk rate"),
    reported("", "impacts"),
];

const GAS: Case = Case {
    number: 8,
    id: "",
    title: "",
    reference: "invariants; Enskog's rate for orientation",
    peers: "",
    source: file!("hard/gas-1000"),
    demands: DEMANDS,
    budget: 500_000,
    long: false,
    run,
};

pub(super) const THOUSAND_THIN: Case = Case {
    id: "gas-1000-thin",
    title: "Gas of 1000, packing 0.1, 10 s",
    peers: "energy −10 % in 10 s (rapier, Δt 1/60), −3.2 % (1/240); 2e-16 (DynamO)",
    ..GAS
};

pub(super) const THOUSAND_DENSE: Case = Case {
    id: "gas-1000-dense",
    title: "Gas of 1000, packing 0.3, 10 s",
    peers: "energy −59 % in 10 s (rapier, Δt 1/60), −31 % (1/240); 2e-16 (DynamO)",
    source: Source::Built(|| gas(10, 0.3)),
    budget: 1_000_000,
    long: true,
    ..GAS
};

pub(super) const TEN_THOUSAND_THIN: Case = Case {
    id: "gas-10000-thin",
    title: "Gas of 10 648, packing 0.1, 10 s",
    peers: "energy −6.9 % in 10 s (rapier, Δt 1/60)",
    source: Source::Built(|| gas(22, 0.1)),
    budget: 2_000_000,
    long: true,
    ..GAS
};

pub(super) const TEN_THOUSAND_DENSE: Case = Case {
    id: "gas-10000-dense",
    title: "Gas of 10 648, packing 0.3, 10 s",
    peers: "energy −51 % in 10 s (rapier, Δt 1/60)",
    source: Source::Built(|| gas(22, 0.3)),
    budget: 10_000_000,
    long: true,
    ..GAS
};

fn run(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const UNTIL: f64 = 10.0;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let (mut impacts, mut of_balls) = (0.0, 0.0);
    trial.watch(&mut sim, UNTIL, |sim, event| {
        monitor.look(sim, event);
        if let Some(event) = event {
            impacts += 1.0;
            let both = [Some(event.a), event.b].into_iter().flatten();
            if both.filter(|body| matches!(body, BodyRef::Dynamic(_))).count() == 2 {
                of_balls += 1.0;
            }
        }
        Ok(())
    })?;
    let (radius, rate) = enskog(&trial.scene)?;
    Ok(vec![monitor.energy_drift, monitor.worst_overlap / radius, of_balls / UNTIL / rate, impacts])
}

/// The balls' radius and the rate of their impacts in a bulk of this density and energy, 1/s:
/// ½N · 4 n σ² χ √(πkT/m), χ = (1 − φ/2)/(1 − φ)³ (Carnahan and Starling).
fn enskog(scene: &Scene) -> Result<(f64, f64), Stop> {
    let mut radius = f64::NAN;
    let (mut count, mut squares) = (0.0, 0.0);
    for body in &scene.bodies {
        if let (Motion::Dynamic { velocity, .. }, &Shape::Sphere { radius: own }) = (body.motion, &body.shape)
        {
            radius = own;
            count += 1.0;
            squares += velocity.length_squared();
        }
    }
    let volume = scene.map.size.element_product();
    let packing = count * 4.0 / 3.0 * PI * radius * radius * radius / volume;
    // kT/m is a third of the mean square of the velocity.
    let thermal = squares / count / 3.0;
    let contact = (1.0 - packing / 2.0) / ((1.0 - packing) * (1.0 - packing) * (1.0 - packing));
    let rate = 0.5 * count * 4.0 * (count / volume) * 4.0 * radius * radius * contact * (PI * thermal).sqrt();
    if rate > 0.0 { Ok((radius, rate)) } else { Err(Stop::Unexpected("no gas".into())) }
}

/// `side`³ balls of 1 kg in a box of `side` metres, each anywhere in its own cubic metre, with normally
/// distributed velocities.
fn gas(side: u32, packing: f64) -> Scene {
    let radius = libm::cbrt(packing * 3.0 / (4.0 * PI));
    let mut random = Random::new(u64::from(side));
    let free = 0.49 - radius;
    let mut bodies = walls(f64::from(side));
    for index in 0..side * side * side {
        let cell = [index / (side * side), index / side % side, index % side].map(|k| f64::from(k) + 0.5);
        let position = DVec3::from(cell.map(|middle| middle + random.range(-free, free)));
        let velocity = DVec3::new(random.normal(), random.normal(), random.normal());
        let motion = Motion::Dynamic { mass: 1.0, velocity };
        bodies.push(body(i64::from(index) + 7, position, DVec3::ZERO, motion, Shape::Sphere { radius }));
    }
    Scene {
        map: Map { size: DVec3::splat(f64::from(side)), tiles: [side; 3] },
        time_speed: 1.0,
        params: SimParams::default(),
        forces: Vec::new(),
        bodies: bodies.into(),
    }
}

fn walls(side: f64) -> Vec<Body> {
    let h = side / 2.0;
    let walls = [
        ([0.0, h, h], [0.0, FRAC_PI_2, 0.0]),
        ([side, h, h], [0.0, -FRAC_PI_2, 0.0]),
        ([h, 0.0, h], [-FRAC_PI_2, 0.0, 0.0]),
        ([h, side, h], [FRAC_PI_2, 0.0, 0.0]),
        ([h, h, 0.0], [0.0, 0.0, 0.0]),
        ([h, h, side], [PI, 0.0, 0.0]),
    ];
    let shape = Shape::Plane { half_x: h, half_y: h };
    let walls = walls.into_iter().zip(1..);
    walls
        .map(|((at, turned), id)| body(id, at.into(), turned.into(), Motion::Static, shape.clone()))
        .collect()
}

fn body(id: i64, position: DVec3, rotation: DVec3, motion: Motion, shape: Shape) -> Body {
    Body { rotation, ..Body::new(id, position, motion, shape) }
}
