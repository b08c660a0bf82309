//! Rough balls in rooms, from seeds: jammed ones without gravity, thrown into corners, piled and stacked with unequal masses.
//! Friction gives nobody energy, and the books close.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, Roughness, Scene};
use polyscene::sim::Simulation;
use polyscene::study::Random;

use crate::common::build::{Build, Shaped, ball, empty, plate};
use crate::common::drive::{Promise, simulation};

/// The walls of a room between the origin and this corner, with a roughness and a restitution.
fn room(size: DVec3, friction: f64, bounce: f64) -> Scene {
    let half = 0.5 * size;
    let walls = [
        (dvec3(half.x, 0.0, half.z), dvec3(-FRAC_PI_2, 0.0, 0.0), half.x, half.z),
        (dvec3(half.x, size.y, half.z), dvec3(-FRAC_PI_2, 0.0, 0.0), half.x, half.z),
        (dvec3(0.0, half.y, half.z), dvec3(0.0, FRAC_PI_2, 0.0), half.z, half.y),
        (dvec3(size.x, half.y, half.z), dvec3(0.0, FRAC_PI_2, 0.0), half.z, half.y),
        (dvec3(half.x, half.y, 0.0), DVec3::ZERO, half.x, half.y),
        (dvec3(half.x, half.y, size.z), DVec3::ZERO, half.x, half.y),
    ];
    (1..).zip(walls).fold(empty(), |scene, (id, (place, rotation, x, y))| {
        scene.body(rough(plate(id, place, rotation, x, y), friction, bounce))
    })
}

fn rough(body: Body, friction: f64, bounce: f64) -> Body {
    Body { bounce, roughness: Roughness { friction, ..body.roughness }, ..body }
}

fn one_of<const N: usize>(random: &mut Random, values: [f64; N]) -> f64 {
    values[random.below(N)]
}

/// Balls that fill a room and fly about in it, of masses 1 : 1000.
fn jammed(random: &mut Random) -> Scene {
    let count = [4, 8][random.below(2)];
    let radius = 0.75 * one_of(random, [0.9, 1.0]);
    (0..count).fold(room(DVec3::splat(3.0), 0.8, 1.0), |scene, nth| {
        let cell = dvec3((nth % 2) as f64, (nth / 2 % 2) as f64, (nth / 4) as f64);
        let moving = ball(9 + nth, 0.75 + 1.5 * cell, random.vector(3.0));
        scene.body(rough(moving.radius(radius).mass(one_of(random, [1.0, 1000.0])), 0.8, 1.0))
    })
}

/// One ball thrown into a room that comes to lie against its walls.
fn thrown(random: &mut Random) -> Scene {
    let friction = one_of(random, [0.3, 0.5, 0.8]);
    let place = dvec3(random.range(0.3, 1.7), random.range(0.3, 2.0), random.range(0.3, 1.7));
    let moving = ball(9, place, random.vector(3.0)).radius(0.25).mass(1.0).spin(random.vector(10.0));
    room(dvec3(2.0, 3.0, 2.0), friction, 1.0).gravity(-9.8).body(rough(moving, friction, 0.0))
}

/// Some balls side by side and above each other, some of which are heavy or spin.
fn piled(random: &mut Random) -> Scene {
    let (friction, bounce) = (one_of(random, [0.1, 0.3, 0.5, 0.8]), one_of(random, [0.0, 0.3, 0.5]));
    let heavy = one_of(random, [1.0, 1.0, 10.0, 100.0]);
    let count = [3, 4, 5, 6, 8][random.below(5)];
    let is_column = random.below(2) == 0;
    (0..count).fold(room(dvec3(2.0, 6.0, 2.0), friction, bounce).gravity(-9.8), |scene, nth| {
        let shift = 0.01 * random.vector(1.0).abs();
        let place = if is_column {
            dvec3(1.0, 0.25 + 0.5 * nth as f64, 1.0) + 0.1 * random.below(2) as f64 * dvec3(shift.x, 0.0, 0.0)
        } else {
            dvec3(0.4 + 0.6 * (nth % 3) as f64, 0.3 + 0.6 * (nth / 3) as f64, 0.4) + shift
        };
        let spin = if random.below(5) == 0 { random.vector(10.0) } else { DVec3::ZERO };
        let moving = ball(9 + nth, place, DVec3::ZERO).radius(0.25).spin(spin);
        scene.body(rough(moving.mass(one_of(random, [1.0, heavy])), friction, bounce))
    })
}

fn total(sim: &Simulation) -> f64 {
    sim.energy().kinetic + sim.energy().potential.unwrap_or(f64::NAN)
}

fn failure(scene: &Scene, until: f64) -> Option<String> {
    let mut sim = simulation(scene);
    let promise = Promise::of_steps(&sim, scene);
    let mut lowest = total(&sim);
    let size = sim.energy().kinetic.max(lowest.abs());
    for sample in 1..=20 {
        sim.begin(until * f64::from(sample) / 20.0);
        loop {
            match sim.next_event() {
                Ok(Some(_)) => {}
                Ok(None) => break,
                Err(fault) => return Some(format!("{fault:?}")),
            }
        }
        let now = total(&sim);
        if now.is_nan() || now > lowest + promise.climb + 1e-12 * size {
            return Some(format!("t {}: energy from {lowest} to {now} J", sim.time()));
        }
        lowest = lowest.min(now);
        let residuals = [sim.energy().residual.unwrap_or(f64::NAN).abs(), sim.momentum().residual];
        if residuals.iter().any(|residual| residual.is_nan() || *residual > 1e-10) {
            return Some(format!("t {}: residuals of energy and momentum {residuals:?}", sim.time()));
        }
    }
    None
}

fn hold(scene: impl Fn(&mut Random) -> Scene, cases: u64, until: f64) {
    let of =
        |case| failure(&scene(&mut Random::new(case)), until).map(|failure| format!("{case}: {failure}"));
    let failures: Vec<String> = (0..cases).filter_map(of).collect();
    assert!(failures.is_empty(), "{} of {cases}:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn jammed_balls_gain_nothing() {
    hold(jammed, 40, 2.0);
}

#[test]
fn balls_thrown_into_corners_come_to_rest() {
    hold(thrown, 250, 5.0);
}

#[test]
fn piles_of_unequal_balls_keep_their_books() {
    hold(piled, 40, 1.0);
}
