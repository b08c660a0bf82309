//! Chains of impacts with known outcomes: head-on pairs, Newton's cradle, counting π.

use glam::{DVec3, dvec3};
use polyscene::scene::Scene;
use polyscene::study::closed_form::{self, pi_collisions};

use crate::common::build::{Build, Shaped, ball, empty};
use crate::common::drive::{Sampling, advance, impacts, run, simulation, state_of};
use crate::common::load::load;

/// The Δt at which every closed form must hold.
const STEPS: [f64; 3] = [1.0, 1.0 / 60.0, 1e-3];

#[test]
fn head_on_impact_shares_momentum_by_newtons_law() {
    for (m1, m2, e) in [(1.0, 1.0, 1.0), (2.0, 5.0, 0.5), (1.0, 1e6, 0.25), (3.0, 2.0, 0.0)] {
        let scene = empty()
            .body(ball(1, dvec3(2.0, 5.0, 5.0), dvec3(3.0, 0.0, 0.0)).mass(m1).bounce(e))
            .body(ball(2, dvec3(6.0, 5.0, 5.0), dvec3(-1.0, 0.0, 0.0)).mass(m2));
        let run = run(&scene, 1.5, Sampling::Every(0.4));
        assert_eq!(impacts(&run.events).len(), 1, "{:?}", run.events);
        assert!((run.events[0].time - 0.75).abs() <= 1e-14, "{:?}", run.events);
        let impulse = (1.0 + e) * 4.0 * m1 * m2 / (m1 + m2);
        assert!((run.events[0].impulse / impulse - 1.0).abs() <= 1e-12, "{:?}", run.events);
        let [left, right] = [0, 1].map(|k| run.states[k].1.velocity);
        assert!((left - dvec3(3.0 - impulse / m1, 0.0, 0.0)).length() <= 1e-12, "{left} at e = {e}");
        assert!((right - dvec3(-1.0 + impulse / m2, 0.0, 0.0)).length() <= 1e-12, "{right} at e = {e}");
    }
}

/// A row of `row` touching spheres along a direction, and one that comes in with 2 m/s.
fn cradle(row: usize, along: DVec3) -> Scene {
    let start = DVec3::splat(2.0);
    let incoming = ball(1, start - along * 1.5, along * 2.0);
    (0..row).fold(empty().body(incoming), |scene, k| {
        scene.ball(2 + k as i64, start + along * k as f64, DVec3::ZERO)
    })
}

#[test]
fn cradle_hands_the_whole_speed_to_the_last_ball() {
    // One comes in: to a row of five, and to four, the classical five in all.
    for (row, dt) in [5, 4].into_iter().flat_map(|row| STEPS.map(|dt| (row, dt))) {
        let run = run(&cradle(row, DVec3::X), 1.0, Sampling::Every(dt));
        let expected = closed_form::cradle(row + 1, 1, DVec3::X * 2.0);
        for (k, ((_, state), expected)) in run.states.iter().zip(expected).enumerate() {
            let off = (state.velocity - expected).length();
            assert!(off <= 1e-12, "row of {row}, Δt {dt}: ball {k} has {}", state.velocity);
        }
        assert!(run.events.iter().all(|event| (event.time - 0.25).abs() <= 1e-12), "{:?}", run.events);
        assert!(run.events.iter().all(|event| event.impulse >= 0.0), "{:?}", run.events);
    }
}

#[test]
fn cradle_does_not_care_which_way_it_points() {
    // Here no two centres are exactly two radii apart: gaps and overlaps are of the size of rounding.
    for along in [dvec3(2.0, 1.0, 2.0) / 3.0, dvec3(1.0, 1.0, 1.0) / 3.0_f64.sqrt(), dvec3(0.6, -0.8, 0.0)] {
        let run = run(&cradle(5, along), 1.0, Sampling::Every(1.0 / 60.0));
        let expected = closed_form::cradle(6, 1, along * 2.0);
        for (k, ((_, state), expected)) in run.states.iter().zip(expected).enumerate() {
            let off = (state.velocity - expected).length();
            assert!(off <= 1e-12, "along {along}: ball {k} has {}", state.velocity);
        }
    }
}

#[test]
fn cradle_sample_goes_back_and_forth() {
    // At 2 m/s: 1.5 m to the row, then the last ball 3.5 m to the wall and as far back, then the first 2.5 m.
    let mut sim = simulation(&load("cradle.xml"));
    advance(&mut sim, 0.25, Sampling::Every(1.0));
    assert_eq!(state_of(&sim, 3).velocity, dvec3(2.0, 0.0, 0.0));
    for (time, moving) in [(1.0, 8), (3.0, 8), (5.0, 3)] {
        advance(&mut sim, time, Sampling::Every(0.1));
        for id in 3..=8 {
            let speed = state_of(&sim, id).velocity.length();
            let expected = if id == moving { 2.0 } else { 0.0 };
            assert!((speed - expected).abs() <= 1e-11, "t {time}: ball {id} has {speed} m/s");
        }
    }
}

/// Masses 1 : 100^k in front of a wall. All in a line that is exact in binary: the squeezed ball multiplies
/// the smallest offset from it (a wall turned by π/2 is off by 6e-17, and the count for k = 2 becomes 266).
pub fn counting_pi(k: u32) -> Scene {
    empty()
        .plate(1, dvec3(2.0, 2.0, 0.0), DVec3::ZERO, 2.0, 2.0)
        .body(ball(2, dvec3(2.0, 2.0, 1.0), DVec3::ZERO).radius(0.4))
        .body(ball(3, dvec3(2.0, 2.0, 6.0), dvec3(0.0, 0.0, -1.0)).radius(1.0).mass(100.0_f64.powi(k as i32)))
}

#[test]
fn collisions_count_the_digits_of_pi() {
    // For k = 2 the last one comes late, at t = 7.7 s.
    for k in 0..4 {
        let expected = pi_collisions(k) as usize;
        for dt in STEPS {
            let mut sim = simulation(&counting_pi(k));
            let events = advance(&mut sim, 20.0, Sampling::Every(dt));
            assert_eq!(events.len(), expected, "k = {k}, Δt {dt}");
            assert_eq!(impacts(&events).len(), expected, "k = {k}, Δt {dt}");
            assert_eq!(advance(&mut sim, 1e4, Sampling::Every(1e3)), [], "k = {k}, Δt {dt}");
            let residual = sim.energy().residual.expect("no forces");
            assert!(residual.abs() <= 1e-11, "k = {k}, Δt {dt}: residual {residual:e}");
        }
    }
}

#[test]
fn counting_pi_sample_shows_314() {
    assert_eq!(run(&load("counting-pi.xml"), 12.0, Sampling::Every(0.1)).events.len(), 314);
}
