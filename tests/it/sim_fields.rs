//! Fields: plunges into attractors, thin orbits, forces that come and go, forces of the user's own.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, dvec3};
use polyscene::scene::{ForceKind, Scene};
use polyscene::sim::{EventKind, Force, SimEdit, Simulation, Subject};
use polyscene::study::closed_form::Plunge;

use crate::common::build::{Build, Shaped, ball, empty};
use crate::common::drive::{Sampling, assert_same_bits, run, simulation, state_of, watch};

/// The Δt at which every figure must hold.
const STEPS: [f64; 3] = [1.0, 1.0 / 60.0, 1e-4];

/// Where attractors stand: in the middle of the map, and where an f64 resolves 1.5e-11 m.
const CENTRES: [DVec3; 2] = [DVec3::splat(5.0), dvec3(1e5 + 0.3, -1e5 - 0.7, 1e5 + 0.1)];

fn residual(sim: &Simulation) -> f64 {
    sim.energy().residual.expect("all forces have potentials").abs()
}

/// A ball 2 m from an attractor of 8 m³/s², at rest but for a speed across.
fn plunging(centre: DVec3, across: f64) -> Scene {
    empty().attractor(centre, 8.0).body(ball(1, centre + DVec3::X * 2.0, DVec3::Y * across).radius(0.01))
}

#[test]
fn dead_centre_plunges_come_back_on_their_line_with_their_energy() {
    let plunge = Plunge { distance: 2.0, intensity: 8.0 };
    for centre in CENTRES {
        for dt in STEPS {
            let mut sim = simulation(&plunging(centre, 0.0));
            let mut passes = 0;
            let until = if dt < 1e-3 { 5.0 } else { 100.0 };
            let mut worst: f64 = 0.0;
            watch(&mut sim, until, Sampling::Every(dt), |sim, event| {
                if let Some(event) = event {
                    assert_eq!(event.kind, EventKind::SingularPass);
                    passes += 1;
                    return;
                }
                worst = worst.max(residual(sim));
                let off = state_of(sim, 1).position - centre;
                assert!(off.x > 0.0 && off.y.abs().max(off.z.abs()) <= 1e-10, "t {}: {off}", sim.time());
            });
            assert_eq!(f64::from(passes), plunge.pass_count(until), "{centre}, Δt {dt}");
            assert!(worst <= 1e-9, "{centre}, Δt {dt}: {worst:e} after {passes} passes");
        }
    }
}

#[test]
fn near_misses_keep_their_energy_and_their_line() {
    for across in [1e-9, 1e-6, 1e-4, 1e-3, 3e-3, 1e-2, 0.1] {
        for centre in CENTRES {
            let mut sim = simulation(&plunging(centre, across));
            let mut worst: f64 = 0.0;
            watch(&mut sim, 40.0, Sampling::Every(1.0 / 60.0), |sim, _| {
                worst = worst.max(residual(sim));
            });
            // A periapsis L²/2G: back at the distance it came from, on its line.
            let off = state_of(&sim, 1).position - centre;
            assert!(off.y.abs() <= 2.0 * across.max(1e-6) * 40.0, "{across}: {off}");
            // Just outside the core the depth is 10⁶ J for 4 J of energy: 1e-9 is a few ulps of it.
            let near = (1e-6..1e-5).contains(&(across * across / 4.0));
            let allowed = if near { 1e-8 } else { 1e-9 };
            assert!(worst <= allowed, "{across} m/s across at {centre}: {worst:e}");
        }
    }
}

#[test]
fn a_plunge_in_other_fields_goes_back_the_way_it_came() {
    // Uniform gravity along the line, so that it is a plunge all the same; and a second attractor on it.
    let centre = DVec3::splat(5.0);
    let scene = plunging(centre, 0.0)
        .force(ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: DVec3::X * -3.0 })
        .attractor(centre - DVec3::X * 3.0, 2.0);
    let mut sim = simulation(&scene);
    let mut worst: f64 = 0.0;
    watch(&mut sim, 50.0, Sampling::Every(0.01), |sim, _| worst = worst.max(residual(sim)));
    assert!(worst <= 1e-9, "{worst:e}");
    assert!(sim.counters().events[4] > 20, "{:?}", sim.counters());
}

#[test]
fn plunges_are_the_same_bits_for_every_step() {
    for across in [0.0, 1e-3, 0.1] {
        let scene = plunging(CENTRES[0], across);
        let whole = run(&scene, 6.0, Sampling::Every(1.0));
        for sampling in
            [Sampling::Every(1.0 / 60.0), Sampling::Every(1e-4), Sampling::Random(3), Sampling::Events]
        {
            assert_same_bits(&whole, &run(&scene, 6.0, sampling), &format!("{across}, {sampling:?}"));
        }
    }
}

#[test]
fn thin_orbits_keep_their_energy_and_their_period() {
    // Started at the apoapsis of a semi-axis of 2.5 m: after whole turns it is there again.
    for eccentricity in [0.6, 0.99, 0.999, 0.9999] {
        for centre in CENTRES {
            let speed = (10.0_f64 / 2.5 * (1.0 - eccentricity) / (1.0 + eccentricity)).sqrt();
            let start = centre + DVec3::X * (2.5 * (1.0 + eccentricity));
            let scene = empty().attractor(centre, 10.0).body(ball(1, start, DVec3::Z * speed).radius(0.001));
            for dt in STEPS {
                let turns = if dt < 1e-3 { 1.0 } else { 10.0 };
                let mut sim = simulation(&scene);
                let mut worst: f64 = 0.0;
                watch(&mut sim, turns * 2.5 * PI, Sampling::Every(dt), |sim, _| {
                    worst = worst.max(residual(sim));
                });
                let off = (state_of(&sim, 1).position - start).length() / 2.5;
                assert!(off <= 1e-6, "e {eccentricity} at {centre}, Δt {dt}: off {off:e}");
                assert!(worst <= 1e-9, "e {eccentricity} at {centre}, Δt {dt}: {worst:e}");
            }
        }
    }
}

#[test]
fn an_attractor_switched_while_running_explodes_and_books_the_work() {
    for dt in STEPS {
        let scene = empty()
            .attractor(DVec3::splat(5.0), 8.0)
            .body(ball(1, dvec3(7.0, 5.0, 5.0), DVec3::Y).radius(0.1))
            .body(ball(2, dvec3(5.0, 3.0, 5.0), DVec3::X * 2.0).radius(0.1));
        let mut sim = simulation(&scene);
        let mut changed = scene.forces[0].clone();
        for (nth, intensity) in [-8.0, 8.0, -80.0, 0.0, 8.0].into_iter().enumerate() {
            watch(&mut sim, 0.1 * (nth + 1) as f64, Sampling::Every(dt), |_, _| {});
            changed.kind = ForceKind::GravityPoint { position: DVec3::splat(5.0), intensity };
            sim.apply(&SimEdit::ChangeForce(Box::new(changed.clone()))).unwrap();
            assert!(residual(&sim) <= 1e-12);
        }
        watch(&mut sim, 2.0, Sampling::Every(dt), |sim, _| {
            assert!(residual(sim) <= 1e-9, "Δt {dt}, t {}: {:e}", sim.time(), residual(sim));
            assert!(sim.momentum().residual <= 1e-9);
        });
    }
}

#[test]
fn a_plunge_is_turned_round_on_its_way_by_an_edit() {
    // The way back is given up where a force changes: energy is booked all the same. (A stronger attractor
    // would hold the body within micrometres, for millions of passes a second.)
    let scene = plunging(CENTRES[0], 0.0);
    let mut sim = simulation(&scene);
    let pass = {
        sim.begin(5.0);
        sim.next_event().unwrap().expect("a pass").time
    };
    for later in [1e-9, 1e-7, 1e-5] {
        let copy = sim.snapshot();
        sim.begin(pass + later);
        sim.finish(&mut |_, _| {}).unwrap();
        let mut force = scene.forces[0].clone();
        force.kind = ForceKind::GravityPoint { position: CENTRES[0], intensity: 7.0 };
        sim.apply(&SimEdit::ChangeForce(Box::new(force))).unwrap();
        watch(&mut sim, 20.0, Sampling::Every(0.1), |sim, _| {
            assert!(residual(sim) <= 1e-8, "{later}: {:e}", residual(sim));
        });
        sim.restore(&copy);
    }
}

/// A force that is written down where it is used.
struct Written<F>(F, bool);

impl<F> std::fmt::Debug for Written<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Written")
    }
}

impl<F: Fn(&Subject<'_>) -> (DVec3, f64) + Send + Sync> Force for Written<F> {
    fn force(&self, on: &Subject<'_>) -> DVec3 {
        (self.0)(on).0
    }

    fn potential(&self, on: &Subject<'_>) -> Option<f64> {
        self.1.then(|| (self.0)(on).1)
    }
}

#[test]
fn a_stiff_force_of_the_users_own_keeps_to_its_closed_form() {
    // A spring of ω = 10⁴/s: 1 m·cos ωt for 1600 turns.
    let spring = |on: &Subject<'_>| (-1e8 * on.position, 0.5e8 * on.position.length_squared());
    for dt in STEPS {
        let mut sim = simulation(&empty().ball(1, DVec3::X, DVec3::ZERO));
        sim.add_force(Arc::new(Written(spring, true))).unwrap();
        watch(&mut sim, 1.0, Sampling::Every(dt), |sim, event| {
            if event.is_none() {
                let expected = (1e4 * sim.time()).cos();
                let off = (state_of(sim, 1).position.x - expected).abs();
                assert!(off <= 1e-8, "Δt {dt}, t {}: off {off:e}", sim.time());
                assert!(residual(sim) <= 1e-9, "Δt {dt}, t {}: {:e}", sim.time(), residual(sim));
            }
        });
    }
}

#[test]
fn a_force_that_jumps_is_passed_at_its_jump() {
    // 1 m/s through a jump of the force from 0 to 5 N at 2 m.
    let jump = |on: &Subject<'_>| {
        if on.position.x > 2.0 { (DVec3::X * 5.0, -5.0 * (on.position.x - 2.0)) } else { (DVec3::ZERO, 0.0) }
    };
    let mut sim = simulation(&empty().ball(1, DVec3::X, DVec3::X));
    sim.add_force(Arc::new(Written(jump, true))).unwrap();
    sim.begin(3.0);
    sim.finish(&mut |_, _| {}).expect("steps that grow short at the jump");
    // From 1 s on 5 m/s²: x = 2 + 2 + 2.5·4.
    assert!((state_of(&sim, 1).position.x - 14.0).abs() <= 1e-6, "{:?}", state_of(&sim, 1));
    assert!(residual(&sim) <= 1e-6, "{:?}", sim.energy());
    assert!(sim.counters().force_evaluations < 100_000, "{}", sim.counters().force_evaluations);
}

#[test]
fn work_of_a_removed_force_without_potential_stays_unknown() {
    let scene = empty().gravity(-9.8).ball(1, DVec3::splat(5.0), DVec3::ZERO);
    let mut sim = simulation(&scene);
    let push: Arc<dyn Force> = Arc::new(Written(|_: &Subject<'_>| (DVec3::X, 0.0), false));
    sim.add_force(push.clone()).unwrap();
    assert!(sim.energy().total.is_none());
    assert!(sim.remove_force(&push).unwrap());
    assert!(residual(&sim) == 0.0, "it never acted");
    sim.add_force(push.clone()).unwrap();
    sim.begin(1.0);
    sim.finish(&mut |_, _| {}).unwrap();
    assert!(sim.remove_force(&push).unwrap());
    let energy = sim.energy();
    assert!(energy.total.is_some() && energy.residual.is_none(), "{energy:?}");
    assert!(sim.momentum().residual <= 1e-14, "momentum is known all the same");
}

#[test]
fn a_fault_while_a_segment_begins_books_nothing_twice() {
    // The force breaks at 1 s; removed, the run goes on and the books still close.
    let broken: Arc<dyn Force> = Arc::new(Written(
        |on: &Subject<'_>| {
            let force = if on.time >= 1.0 { DVec3::NAN } else { DVec3::X * on.position.x };
            (force, -0.5 * on.position.x.powi(2))
        },
        true,
    ));
    let mut sim = simulation(&empty().air(50.0).ball(1, DVec3::X, DVec3::X));
    sim.add_force(broken.clone()).unwrap();
    sim.begin(2.0);
    assert!(sim.finish(&mut |_, _| {}).is_err());
    assert!(
        residual(&sim) <= 1e-9 && sim.momentum().residual <= 1e-9,
        "{:?} {:?}",
        sim.energy(),
        sim.momentum()
    );
    assert!(sim.remove_force(&broken).unwrap());
    sim.begin(3.0);
    sim.finish(&mut |_, _| {}).unwrap();
    assert!(residual(&sim) <= 1e-9 && sim.momentum().residual <= 1e-9, "{:?}", sim.energy());
}

#[test]
fn a_kepler_orbit_takes_fewer_force_evaluations_than_rk4() {
    // RK4 at 1/240 s takes 960 a second and is off by far more than 1e-9.
    let centre = DVec3::splat(5.0);
    let scene =
        empty().attractor(centre, 10.0).body(ball(1, centre + DVec3::X, dvec3(0.0, 0.0, -4.0)).radius(0.15));
    let mut sim = simulation(&scene);
    let until = 25.0 * PI;
    sim.begin(until);
    sim.finish(&mut |_, _| {}).unwrap();
    let a_second = sim.counters().force_evaluations as f64 / until;
    assert!(a_second < 450.0, "{a_second}");
    assert!(residual(&sim) <= 1e-12);
}
