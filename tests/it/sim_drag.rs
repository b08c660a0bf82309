//! Drag, whose law −½CρS|v|v is not smooth where a body turns round: apices against closed forms.

use glam::{DVec3, dvec3};
use polyscene::scene::{Force, NodeKey, Scene};
use polyscene::sim::{SimEdit, Simulation};

use crate::common::build::{Build, Shaped, ball, empty, plate};
use crate::common::drive::{Sampling, advance, impacts, run, simulation, state_of, watch};

const GRAVITY: f64 = 9.81;

/// Density of air in which a ball of 1 kg and 0.1 m falls at most at this speed: ½CρS v² = mg, C = ½.
fn density(terminal: f64) -> f64 {
    GRAVITY / (terminal * terminal * 0.25 * std::f64::consts::PI * 0.01)
}

/// A ball of 1 kg thrown from the floor, in air.
fn thrown(velocity: DVec3, terminal: f64) -> Scene {
    let body = ball(2, dvec3(5.0, 0.1, 5.0), velocity).radius(0.1);
    let floor = plate(1, dvec3(5.0, 0.0, 5.0), dvec3(-std::f64::consts::FRAC_PI_2, 0.0, 0.0), 1e4, 1e4);
    empty().gravity(-GRAVITY).air(density(terminal)).body(floor).body(body)
}

/// Time of flight of a vertical throw, and the speed of the return: v' = −g − g v²/v_t², hence
/// up (v_t/g) atan(v/v_t), high (v_t²/2g) ln(1 + v²/v_t²), down (v_t/g) acosh(e^{gh/v_t²}).
fn flight(speed: f64, terminal: f64) -> (f64, f64) {
    let (unit, ratio) = (terminal / GRAVITY, speed / terminal);
    // e^{2gh/v_t²} = 1 + v²/v_t², and acosh √(1 + x²) = asinh x.
    (unit * (ratio.atan() + ratio.asinh()), speed / ratio.hypot(1.0))
}

/// Symptom: impacts of a ball thrown straight up in air came up to 4e-8 s off, while the residual stayed 1e-15.
/// Expected: the closed form. Cause: long steps went across the apex, where |v|v has a kink that the last
/// coefficient of the series does not show.
#[test]
fn a_vertical_throw_in_air_lands_on_time() {
    for terminal in [1e4, 300.0, 40.0, 5.0, 0.5] {
        for speed in [0.02, 1.0, 17.21, 300.0] {
            let scene = thrown(DVec3::Y * speed, terminal);
            let mut expected = Vec::new();
            let (mut time, mut next) = (0.0, speed);
            for _ in 0..5 {
                let (duration, back) = flight(next, terminal);
                (time, next) = (time + duration, back);
                expected.push(time);
            }
            let mut sim = simulation(&scene);
            let events = advance(&mut sim, time * (1.0 + 1e-9) + 1e-9, Sampling::Every(time / 3.0));
            assert_eq!(impacts(&events).len(), 5, "v {speed}, v_t {terminal}: {events:?}");
            for (event, expected) in events.iter().zip(expected) {
                let off = (event.time - expected).abs();
                assert!(off <= 1e-11 * time.max(1.0), "v {speed}, v_t {terminal}: {off:e} s at {expected}");
            }
            let evaluations = sim.counters().force_evaluations;
            assert!(evaluations < 15_000, "v {speed}, v_t {terminal}: {evaluations} evaluations");
        }
    }
}

/// The apex of a nearly vertical throw is passed at `across` m/s, where |v| is smooth, but only over |v|/g.
/// The hodograph has a closed form: with φ the angle of climb, 1/v_x² = 1/v_x0² + (A(φ0) − A(φ))/v_t², where
/// A(φ) = tan φ √(1 + tan² φ) + asinh(tan φ).
#[test]
fn an_apex_that_is_passed_slowly_is_resolved() {
    let along = |slope: f64| slope * slope.hypot(1.0) + slope.asinh();
    for terminal in [100.0, 10.0, 2.0] {
        for across in [1e-9, 1e-6, 1e-4, 1e-2, 0.3, 3.0] {
            let start = dvec3(across, 10.0, 0.0);
            let mut sim = simulation(&thrown(start, terminal));
            let mut samples = 0;
            watch(&mut sim, 1.5, Sampling::Every(0.01), |sim, event| {
                let v = state_of(sim, 2).velocity;
                if event.is_some() || sim.counters().events[0] > 0 {
                    return;
                }
                samples += 1;
                let rise = along(start.y / start.x) - along(v.y / v.x);
                let expected = (across.powi(-2) + rise / (terminal * terminal)).powf(-0.5);
                // Steps are judged by the whole acceleration: a small component has its rounding.
                let off = (v.x - expected).abs() / (expected + 1e-4 * start.y);
                assert!(off <= 1e-11, "{across} across, v_t {terminal}, t {}: {off:e}", sim.time());
            });
            assert!(samples > 10, "{across} across, v_t {terminal}: {samples}");
            let evaluations = sim.counters().force_evaluations;
            assert!(evaluations < 6000, "{across} across, v_t {terminal}: {evaluations} evaluations");
        }
    }
}

/// Energy at every sample, less what drag took.
fn worst_residual(sim: &mut Simulation, until: f64) -> f64 {
    let mut worst: f64 = 0.0;
    watch(sim, until, Sampling::Every(until / 50.0), |sim, _| {
        worst = worst.max(sim.energy().residual.expect("all forces have potentials").abs());
    });
    worst
}

/// The same kink in contact: two balls that touch slide up a slope in air and back. On a slope of 30° that is the
/// vertical throw with g/2.
#[test]
fn a_slide_up_a_slope_in_air_turns_round_on_time() {
    let slope = dvec3(-std::f64::consts::FRAC_PI_3, 0.0, 0.0);
    let scene = empty().gravity(-GRAVITY).air(density(20.0)).plate(1, DVec3::splat(5.0), slope, 50.0, 50.0);
    let (normal, up) = (dvec3(0.0, 0.5 * 3.0_f64.sqrt(), 0.5), dvec3(0.0, 0.5, -0.5 * 3.0_f64.sqrt()));
    let start = DVec3::splat(5.0) + 0.1 * normal;
    let sliding = |id: i64, at: DVec3| ball(id, at, 8.0 * up).radius(0.1).bounce(0.0);
    let scene = scene.body(sliding(2, start)).body(sliding(3, start + 0.2 * DVec3::X));
    let mut sim = simulation(&scene);
    // Half the pull: the terminal speed is 20/√2 m/s.
    let (gravity, terminal) = (0.5 * GRAVITY, 20.0 / 2.0_f64.sqrt());
    let rise = terminal / gravity * (8.0 / terminal).atan();
    let residual = worst_residual(&mut sim, rise);
    for id in [2, 3] {
        let state = state_of(&sim, id);
        assert!(state.velocity.length() <= 1e-11, "{state:?}");
        let high = 0.5 * terminal * terminal / gravity * (1.0 + (8.0 / terminal).powi(2)).ln();
        let off = (state.position - start).dot(up) - high;
        assert!(off.abs() <= 1e-11, "{off:e}");
    }
    let back = terminal * (gravity / terminal).tanh();
    let residual = residual.max(worst_residual(&mut sim, rise + 1.0));
    let speed = -state_of(&sim, 2).velocity.dot(up);
    assert!((speed - back).abs() <= 1e-11, "{speed} {back}");
    assert!(residual <= 1e-11, "{residual:e}");
}

/// Symptom: a ball at rest in air, without gravity, was a fault as soon as another hit it: "the integrator's step has shrunk
/// to nothing". Expected: equal elastic balls exchange their velocities, and each one's way is ln(1 + kvt)/k. Cause: its
/// steps at rest were 1e100 s long, and the first after the hit began from that.
#[test]
fn a_ball_that_stands_in_air_can_be_hit() {
    let density = 5.0;
    let k = 0.5 * 0.5 * density * std::f64::consts::PI * 0.25;
    for speed in [1e-6, 0.3, 1.0, 1e3] {
        let scene = empty().air(density).ball(1, dvec3(2.0, 5.0, 5.0), DVec3::X * speed).ball(
            2,
            dvec3(4.0, 5.0, 5.0),
            DVec3::ZERO,
        );
        // After a metre of way; then for as long again and more.
        let hit = (libm::exp(k) - 1.0) / (k * speed);
        let after = speed / (1.0 + k * speed * hit);
        let end = run(&scene, 2.0 * hit, Sampling::Every(hit / 3.0));
        let [first, second] = [0, 1].map(|ball| end.states[ball].1);
        let way = libm::log1p(k * after * hit) / k;
        assert_eq!(end.events.len(), 1, "{speed} m/s: {:?}", end.events);
        assert!((end.events[0].time / hit - 1.0).abs() <= 1e-11, "{speed} m/s: at {} s", end.events[0].time);
        assert!((second.position.x - 4.0 - way).abs() <= 1e-11, "{speed} m/s: {}", second.position);
        assert!((first.position.x - 3.0).abs() <= 1e-11, "{speed} m/s: {}", first.position);
    }
}

/// The same of a ball that hangs still in air, at the weight of which another pulls: gravity is switched on. Its velocity
/// is none, and what its steps were says nothing either.
#[test]
fn a_ball_that_stands_in_air_can_fall() {
    let density = density(30.0);
    let scene = empty().air(density).body(ball(1, DVec3::splat(5.0), DVec3::ZERO).radius(0.1));
    let mut sim = simulation(&scene);
    sim.begin(1.0);
    sim.finish(&mut |_, _| {}).expect("it stands");
    let gravity = empty().gravity(-GRAVITY).forces.remove(0);
    sim.apply(&SimEdit::AddForce(Box::new(Force { key: NodeKey(777), ..gravity }))).expect("it is added");
    sim.begin(2.0);
    sim.finish(&mut |_, _| {}).expect("it falls");
    let fallen = 5.0 - state_of(&sim, 1).position.y;
    let expected = 900.0 / GRAVITY * libm::log(libm::cosh(GRAVITY / 30.0));
    assert!((fallen - expected).abs() <= 1e-11, "{fallen} of {expected}");
}

/// Symptom: a ball of 1 kg that fell in a medium of 1e12 kg/m³ took 3 million steps for each second, for ever. Expected: it is at its
/// terminal speed at once, and then its way is that speed times the time. Cause: steps cannot be much longer than the time
/// in which drag brings a disturbed body back to that speed, 1e-7 s.
#[test]
fn thick_air_costs_no_more_than_thin() {
    for exponent in 3..=15 {
        let density = libm::pow(10.0, f64::from(exponent));
        let k = 0.25 * density * std::f64::consts::PI * 0.01;
        let body = ball(1, DVec3::splat(5.0), DVec3::X).radius(0.1);
        let mut sim = simulation(&empty().gravity(-GRAVITY).air(density).body(body));
        // Some 80 times as long as it takes the thinnest to bring it to a part of e.
        sim.begin(5.0);
        sim.finish(&mut |_, _| {}).expect("it falls");
        let terminal = (GRAVITY / k).sqrt();
        let speed = -state_of(&sim, 1).velocity.y;
        assert!((speed / terminal - 1.0).abs() <= 1e-14, "1e{exponent} kg/m³: {speed} of {terminal}");
        let evaluations = sim.counters().force_evaluations;
        assert!(evaluations < 50_000, "1e{exponent} kg/m³: {evaluations} evaluations");
        let energy = sim.energy().residual.expect("all forces have potentials");
        let momentum = sim.momentum().residual;
        assert!(energy.abs().max(momentum) <= 1e-12, "1e{exponent} kg/m³: {energy:e}, {momentum:e}");
    }
}
