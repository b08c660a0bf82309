//! Motion between events against closed forms: throw, Kepler ellipse, fall through air.

use std::f64::consts::PI;

use glam::{DVec3, dvec3};
use polyscene::scene::Scene;
use polyscene::sim::BodyState;
use polyscene::study::closed_form::{self, Ellipse, FallInAir};

use crate::common::build::{Build, Shaped, ball, empty};
use crate::common::drive::{Sampling, simulation, state_of, watch};

/// The Δt at which every closed form must hold.
const STEPS: [f64; 3] = [1.0, 1.0 / 60.0, 1e-3];

/// Calls `check` with model time and the state of body 1 at every sample.
fn at_samples(scene: &Scene, until: f64, dt: f64, mut check: impl FnMut(f64, BodyState)) {
    watch(&mut simulation(scene), until, Sampling::Every(dt), |sim, event| {
        assert!(event.is_none(), "nothing to meet, but {event:?}");
        check(sim.time(), state_of(sim, 1));
    });
}

#[test]
fn throw_follows_its_parabola() {
    // Relative position error ≤ 1e-12 at each of 1000 samples.
    let (start, velocity) = (dvec3(3.0, 4.0, 5.0), dvec3(2.0, 7.0, -1.5));
    let scene = empty().gravity(-9.8).ball(1, start, velocity);
    for dt in STEPS {
        at_samples(&scene, 1000.0 * dt, dt, |t, state| {
            let (place, speed) = closed_form::throw(start, velocity, dvec3(0.0, -9.8, 0.0), t);
            let error = (state.position - place).length() / place.length();
            assert!(error <= 1e-12, "Δt {dt}, t {t}: {error:e}");
            assert!((state.velocity - speed).length() <= 1e-12 * speed.length(), "Δt {dt}, t {t}");
            assert_eq!(state.acceleration, dvec3(0.0, -9.8, 0.0));
        });
    }
}

#[test]
fn several_uniform_fields_add_up() {
    let scene = empty().gravity(-9.8).gravity(4.8).ball(1, DVec3::ZERO, DVec3::X);
    at_samples(&scene, 3.0, 0.5, |t, state| {
        assert!((state.position - dvec3(t, -2.5 * t * t, 0.0)).length() <= 1e-12);
    });
}

/// Offset from an attractor of 10 m³/s² in the xz plane, on an ellipse of a = 2.5 m that begins at the periapsis.
fn on_ellipse(eccentricity: f64, t: f64) -> DVec3 {
    let [along, across] = Ellipse { axis: 2.5, eccentricity, intensity: 10.0, phase: 0.0 }.offset(t);
    dvec3(along, 0.0, -across)
}

#[test]
fn kepler_ellipse_stays_for_a_hundred_orbits() {
    // a = 2.5 m, e = 0.6, G = 10 m³/s²: T = 2.5π s, 1 m and 4 m/s at the periapsis.
    let centre = DVec3::splat(5.0);
    let scene =
        empty().attractor(centre, 10.0).body(ball(1, centre + DVec3::X, dvec3(0.0, 0.0, -4.0)).radius(0.15));
    let energy = 8.0 - 10.0;
    for dt in STEPS {
        let stride = (0.1 / dt).ceil() as u64;
        let mut sample = 0;
        let mut sim = simulation(&scene);
        watch(&mut sim, 250.0 * PI, Sampling::Every(dt), |sim, event| {
            assert!(event.is_none(), "{event:?}");
            sample += 1;
            if sample % stride != 0 && sim.time() < 250.0 * PI {
                return;
            }
            let (t, state) = (sim.time(), state_of(sim, 1));
            let off = (state.position - centre - on_ellipse(0.6, t)).length() / 2.5;
            assert!(off <= 1e-6, "Δt {dt}, t {t}: off by {off:e} of the semi-axis");
            let found = state.velocity.length_squared() / 2.0 - 10.0 / (state.position - centre).length();
            assert!((found / energy - 1.0).abs() <= 1e-9, "Δt {dt}, t {t}: energy {found}");
            let residual = sim.energy().residual.expect("an attractor has a potential");
            assert!(residual.abs() <= 1e-9, "Δt {dt}, t {t}: residual {residual:e}");
        });
    }
}

#[test]
fn thin_kepler_ellipse_stays_for_ten_orbits() {
    // The centre passes 0.025 m from the attractor at 28 m/s.
    let centre = DVec3::splat(5.0);
    let speed = (10.0 * 1.99 / (2.5 * 0.01_f64)).sqrt();
    let scene = empty()
        .attractor(centre, 10.0)
        .body(ball(1, centre + DVec3::X * 0.025, dvec3(0.0, 0.0, -speed)).radius(0.01));
    for dt in STEPS {
        at_samples(&scene, 25.0 * PI, dt, |t, state| {
            let off = (state.position - centre - on_ellipse(0.99, t)).length() / 2.5;
            assert!(off <= 1e-6, "Δt {dt}, t {t}: off by {off:e} of the semi-axis");
            let found = state.velocity.length_squared() / 2.0 - 10.0 / (state.position - centre).length();
            assert!((found / -2.0 - 1.0).abs() <= 1e-9, "Δt {dt}, t {t}: energy {found}");
        });
    }
}

#[test]
fn repelled_body_flies_off_with_its_energy() {
    let centre = DVec3::splat(5.0);
    let scene = empty().attractor(centre, -8.0).ball(1, dvec3(9.0, 5.1, 5.0), dvec3(-1.0, 0.0, 0.0));
    let start = 0.5 + 8.0 / (dvec3(9.0, 5.1, 5.0) - centre).length();
    at_samples(&scene, 100.0, 1.0, |t, state| {
        let found = state.velocity.length_squared() / 2.0 + 8.0 / (state.position - centre).length();
        assert!((found / start - 1.0).abs() <= 1e-12, "t {t}: energy {found} of {start}");
    });
}

#[test]
fn fall_through_air_nears_its_terminal_speed() {
    let (mass, radius, density) = (0.05, 0.1, 1.276);
    let fall = FallInAir::new(9.8, mass, radius, density);
    let falling = ball(1, dvec3(5.0, 60.0, 5.0), DVec3::ZERO).radius(radius).mass(mass);
    let scene = empty().gravity(-9.8).air(density).body(falling);
    for dt in STEPS {
        at_samples(&scene, 10.0, dt, |t, state| {
            let (speed, fallen) = (fall.speed(t), fall.fallen(t));
            assert!((state.velocity.y / -speed - 1.0).abs() <= 1e-8, "Δt {dt}, t {t}: {}", state.velocity.y);
            // Measured from 60 m, the place itself is only known to an ulp of it.
            let error = (60.0 - state.position.y - fallen).abs();
            assert!(error <= 1e-8 * fallen + 1e-14, "Δt {dt}, t {t}: {error:e} of {fallen}");
        });
    }
}

#[test]
fn drag_alone_slows_by_the_hyperbola() {
    // v = v₀ / (1 + k v₀ t), s = ln(1 + k v₀ t) / k, k = ½ C ρ S / m; two airs add up.
    let start = dvec3(1.0, 2.0, 3.0);
    let velocity = dvec3(6.0, -3.0, 2.0);
    let scene = empty().air(40.0).air(60.0).body(ball(1, start, velocity).mass(2.0).radius(0.2));
    let k = 0.5 * 0.5 * 100.0 * PI * 0.04 / 2.0;
    for dt in STEPS {
        at_samples(&scene, 20.0, dt, |t, state| {
            let slowed = 1.0 + k * 7.0 * t;
            let expected = start + velocity / 7.0 * (slowed.ln() / k);
            let error = (state.position - expected).length() / (expected - start).length().max(1e-3);
            assert!(error <= 1e-8, "Δt {dt}, t {t}: {error:e}");
            assert!((state.velocity * slowed - velocity).length() <= 1e-8 * 7.0, "Δt {dt}, t {t}");
        });
    }
}

#[test]
fn dissipated_work_closes_the_energy_balance() {
    let scene = empty().gravity(-9.8).air(1.276).ball(1, DVec3::ZERO, dvec3(30.0, 10.0, 0.0));
    let mut sim = simulation(&scene);
    watch(&mut sim, 30.0, Sampling::Every(0.25), |sim, _| {
        let residual = sim.energy().residual.expect("gravity and drag have a balance");
        assert!(residual.abs() <= 1e-9, "t {}: {residual:e}", sim.time());
    });
}
