//! One ball where rounding decides what it does next: on seams, in pits, in corners that are not quite upright. It may lift off,
//! meet and settle without end, and time must go on all the same.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec3, dvec3};
use polyscene::scene::Scene;
use polyscene::study::Random;

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball};
use crate::common::drive::{Sampling, simulation, watch};

const GRAVITY: f64 = 9.8;
const RADIUS: f64 = 0.25;

/// Of model time: a tenth of what events take in real time.
const EVENTS_PER_SECOND: f64 = 1e4;

/// Runs a scene of one ball of 1 kg: it takes little work, sinks into nothing, and gains nothing.
fn check(scene: &Scene, until: f64, what: &str) {
    let mut sim = simulation(scene);
    let (mut events, mut lowest) = (0_u64, f64::INFINITY);
    watch(&mut sim, until, Sampling::Every(1.0 / 64.0), |sim, event| {
        events += event.map_or(0, |_| 1);
        assert!(
            events as f64 <= EVENTS_PER_SECOND * (1.0 + sim.time()),
            "{what}: {events} events until t {}",
            sim.time()
        );
        assert!(sim.worst_overlap() <= 1e-3 * RADIUS, "{what}: overlap {:e} m", sim.worst_overlap());
        let total = sim.energy().total.expect("gravity has a potential");
        lowest = lowest.min(total);
        assert!(total - lowest <= 1e-2 * GRAVITY * RADIUS, "{what}: up by {:e} J", total - lowest);
    });
    let segments = sim.counters().segments;
    assert!(segments as f64 <= 2.0 * EVENTS_PER_SECOND * (1.0 + until), "{what}: {segments} segments");
}

/// Two plates of a floor, one higher by next to nothing, and a wall that the ball touches as it rolls over the seam.
#[test]
fn a_seam_beside_a_wall_is_passed() {
    for step in [0.0, 1e-13, 1e-12, 4e-12, 1e-10, 1e-8] {
        for (bounce, friction) in [(0.0, 0.0), (0.5, 0.0), (0.0, 0.3)] {
            let flat = dvec3(-FRAC_PI_2, 0.0, 0.0);
            let plates = [
                plate(11, dvec3(7.0, 0.0, 2.0), flat, 1.0, 1.0),
                plate(12, dvec3(7.0, step, 4.0), flat, 1.0, 1.0),
                plate(13, dvec3(8.0, 3.0, 4.0), dvec3(0.0, FRAC_PI_2, 0.0), 4.0, 3.0),
            ];
            let rolling = ball(14, dvec3(8.0 - RADIUS, RADIUS, 1.5), DVec3::Z).radius(RADIUS);
            let scene = plates.into_iter().chain([rolling]).fold(empty().gravity(-GRAVITY), |scene, body| {
                scene.body(body.bounce(bounce).friction(friction))
            });
            check(&scene, 4.0, &format!("step {step:e}, bounce {bounce}, friction {friction}"));
        }
    }
}

/// A ball on a ring of static ones, whose places are rounded as people write them.
#[test]
fn a_pit_of_rounded_places_is_lain_in() {
    let mut random = Random::new(7);
    for nth in 0..40 {
        let (count, digits) = (4 + nth % 3, [3, 4, 5, 8][nth % 4]);
        let bounce = [0.0, 0.7, 0.9][nth / 4 % 3];
        let rounding = libm::pow(10.0, f64::from(digits));
        let rounded = |x: f64| (x * rounding).round() / rounding;
        let turn = random.range(0.0, TAU);
        let mut scene = empty().gravity(-GRAVITY);
        for k in 0..count {
            let angle = turn + TAU * k as f64 / count as f64;
            let height = rounded(1.0 + random.range(-1.0, 1.0) / rounding);
            let at =
                dvec3(3.0 + rounded(0.5 * libm::cos(angle)), height, 3.0 + rounded(0.5 * libm::sin(angle)));
            scene = scene.body(static_ball(10 + k as i64, at, 0.3).bounce(bounce));
        }
        let at = dvec3(3.0 + random.range(-0.05, 0.05), 2.0, 3.0 + random.range(-0.05, 0.05));
        let falling = ball(9, at, DVec3::ZERO).radius(RADIUS).bounce(bounce);
        check(&scene.body(falling), 8.0, &format!("pit {nth} of {count}, {digits} digits, bounce {bounce}"));
    }
}

/// A rough ball on a floor that is not quite level, so that it is pressed to a wall with a millionth of its weight.
#[test]
fn a_corner_tilted_by_a_millionth_is_lain_in() {
    let mut random = Random::new(3);
    for nth in 0..40 {
        let tilt = [1e-6, 5e-7, 1.3e-6, 1e-5][nth % 4];
        let bounce = if nth % 3 == 0 { 0.3 } else { 0.0 };
        let floor = plate(11, dvec3(4.0, 0.0, 4.0), dvec3(tilt - FRAC_PI_2, 0.0, 0.0), 3.0, 3.0);
        let wall = plate(12, dvec3(4.0, 3.0, 7.0), DVec3::ZERO, 3.0, 3.0);
        let velocity = dvec3(random.range(-1.0, 1.0), 0.0, random.range(0.5, 2.0));
        let start = dvec3(4.0, random.range(0.26, 0.8), random.range(5.0, 6.5));
        let thrown = ball(13, start, velocity).radius(RADIUS).rolling(0.01);
        let bodies = [floor, wall, thrown].map(|body| body.bounce(bounce).friction(0.5));
        let scene = bodies.into_iter().fold(empty().gravity(-GRAVITY), Build::body);
        check(&scene, 6.0, &format!("corner {nth}, tilt {tilt:e}, bounce {bounce}"));
    }
}
