//! Numbers at the ends of what an f64 holds: a run or a fault that says why, in bounded work.

use glam::DVec3;
use polyscene::scene::{ForceKind, Scene};
use polyscene::sim::{Progress, Simulation};

use crate::common::build::{Build, Shaped, ball, empty, static_ball};

const EXPONENTS: [i32; 10] = [-300, -200, -160, -150, -100, 100, 150, 160, 200, 300];

/// Predictions carried out at most, and what they may cost.
const WORK: u32 = 2000;
const MOST_EVALUATIONS: u64 = 100 * WORK as u64;

/// Symptom: a point gravity of ±1e160 to ±1e300 never ended, not even its check. Expected: a fault or a run, soon.
/// Cause: ∞/∞ in the guess of the first step is no number, and that is below no bound.
fn assert_ends(scene: &Scene, what: &str) {
    // A scene that is refused is refused at once.
    let Ok(mut sim) = Simulation::new(scene) else { return };
    sim.begin(0.5);
    let outcome = (0..WORK).find_map(|_| match sim.work(1) {
        Ok(Progress::Done) => Some(Ok(())),
        Ok(_) => None,
        Err(fault) => Some(Err(fault)),
    });
    let counters = sim.counters();
    assert!(counters.force_evaluations < MOST_EVALUATIONS, "{what}: {counters:?}");
    match outcome {
        // What turns round an attractor 1e50 times a second is not done in half a second, but it gets on.
        None => assert!(sim.time() > 0.0 && counters.segments > 100, "{what}: {counters:?}"),
        Some(Ok(())) => {
            for body in sim.dynamic_bodies() {
                let state = sim.state(body).expect("a listed body has a state");
                assert!(state.position.is_finite() && state.velocity.is_finite(), "{what}: {state:?}");
            }
        }
        Some(Err(fault)) => assert!(fault.message.contains("body"), "{what}: {fault}"),
    }
}

/// The forces that a scene can have, with a number of this size.
fn forces(size: f64) -> Vec<ForceKind> {
    let position = DVec3::splat(5.0);
    vec![
        ForceKind::GravityPoint { position, intensity: size },
        ForceKind::GravityPoint { position, intensity: -size },
        ForceKind::GravityPlane { position, acceleration: DVec3::NEG_Y * size },
        ForceKind::Drag { density: size },
    ]
}

#[test]
fn forces_of_every_size_come_to_an_end() {
    for exponent in EXPONENTS {
        for kind in forces(10.0_f64.powi(exponent)) {
            let flying = ball(1, DVec3::new(7.0, 5.0, 5.0), DVec3::Y).radius(0.1);
            assert_ends(&empty().force(kind).body(flying.clone()), &format!("{kind:?}"));
            let both = empty().gravity(-9.8).air(1.2).force(kind).body(flying);
            let both = both.body(ball(2, DVec3::new(7.0, 4.5, 5.0), DVec3::ZERO).bounce(0.5).radius(0.1));
            assert_ends(&both.floor(3, 5.0), &format!("{kind:?} with others"));
            // Lying on a sphere: bodies in contact are integrated together.
            let lying = ball(1, DVec3::new(5.0, 6.1, 5.0), DVec3::X * 1e-3).radius(0.1).bounce(0.0);
            let on_sphere = empty().gravity(-9.8).force(kind).body(static_ball(2, DVec3::splat(5.0), 1.0));
            assert_ends(&on_sphere.body(lying), &format!("{kind:?} on a sphere"));
        }
    }
}

#[test]
fn bodies_of_every_size_mass_and_speed_come_to_an_end() {
    for exponent in EXPONENTS {
        let size = 10.0_f64.powi(exponent);
        for kind in forces(8.0) {
            let start = DVec3::new(7.0, 5.0, 5.0);
            let scene = empty().force(kind);
            assert_ends(&scene.clone().body(ball(1, start, DVec3::Y * size)), &format!("speed, {kind:?}"));
            assert_ends(&scene.clone().body(ball(1, start, DVec3::Y).mass(size)), &format!("mass, {kind:?}"));
            let large = ball(1, start, DVec3::Y).radius(size);
            assert_ends(&scene.clone().body(large), &format!("radius {size:e}, {kind:?}"));
            assert_ends(&scene.body(ball(1, start * size, DVec3::Y)), &format!("place {size:e}, {kind:?}"));
        }
    }
}

/// A scene in other units of length, time and mass.
fn in_units(length: f64, time: f64, mass: f64) -> Scene {
    let (speed, acceleration) = (length / time, length / (time * time));
    let mut scene = empty()
        .attractor(DVec3::splat(5.0 * length), 8.0 * length * length * acceleration)
        .air(1.3 * mass / (length * length * length))
        .force(ForceKind::GravityPlane {
            position: DVec3::ZERO,
            acceleration: DVec3::X * (2.0 * acceleration),
        })
        .body(ball(1, DVec3::new(7.0, 5.0, 5.0) * length, DVec3::new(0.1, 0.3, 0.0) * speed))
        .body(ball(2, DVec3::new(5.0, 3.0, 5.5) * length, DVec3::ZERO));
    scene.map.size *= length;
    scene.params.core_radius *= length;
    scene.params.contact_distance *= length;
    scene.params.rest_time *= time;
    for body in &mut scene.bodies {
        *body = body.clone().radius(0.1 * length).mass(0.7 * mass);
    }
    scene
}

/// Symptom: the same scene in other units took other steps. Expected: the same bits, scaled. Cause: the first step,
/// the longest and the shortest one were given in seconds.
#[test]
fn units_change_no_bit() {
    let run = |scene: &Scene, unit: f64| {
        let mut sim = Simulation::new(scene).expect("a sound scene");
        let mut states = Vec::new();
        for step in 1..=40 {
            sim.begin(0.05 * f64::from(step) * unit);
            sim.finish(&mut |_, _| {}).expect("a run without faults");
            states.extend(sim.dynamic_bodies().filter_map(|body| sim.state(body)));
        }
        (states, sim.counters().force_evaluations)
    };
    let (expected, work) = run(&in_units(1.0, 1.0, 1.0), 1.0);
    for (length, time, mass) in
        [(1024.0, 1.0, 1.0), (1.0, 1.0 / 4096.0, 1.0), (1.0, 1.0, 256.0), (0.125, 64.0, 8.0)]
    {
        let (states, evaluations) = run(&in_units(length, time, mass), time);
        assert_eq!(evaluations, work, "{length} m, {time} s, {mass} kg");
        for (state, expected) in states.iter().zip(&expected) {
            assert_eq!(state.position, expected.position * length, "{length} m, {time} s, {mass} kg");
            assert_eq!(
                state.velocity,
                expected.velocity * (length / time),
                "{length} m, {time} s, {mass} kg"
            );
        }
    }
}

/// Symptom: a ball that a floor throws back 1e18 times as fast stood still in time for ever. Expected: a fault that says why.
/// Cause: it left its tile at the very time at which it was found in it.
#[test]
fn what_outruns_the_resolution_of_time_is_a_fault() {
    for bounce in [1e18, 1e30] {
        let dropped = ball(1, DVec3::new(5.0, 5.0, 5.0), DVec3::ZERO).bounce(bounce);
        let mut sim = Simulation::new(&empty().gravity(-9.8).body(dropped).floor(2, 5.0)).unwrap();
        sim.begin(5.0);
        let ended = (0..WORK).find_map(|_| match sim.work(1) {
            Ok(Progress::Done) => Some(None),
            Ok(_) => None,
            Err(fault) => Some(Some(fault)),
        });
        let fault = ended.expect("it ends").expect("by a fault");
        assert!(fault.message.contains("so fast"), "{fault}");
    }
}

/// Symptom: a ball of 1e-30 m fell through the floor without a word. Expected: a warning.
#[test]
fn a_ball_smaller_than_the_rounding_of_its_place_is_warned_of() {
    for (radius, warnings) in [(1e-30, 1), (1e-16, 1), (1e-12, 0), (0.1, 0)] {
        let scene = empty().gravity(-9.8).body(ball(1, DVec3::splat(5.0), DVec3::ZERO).radius(radius));
        assert_eq!(Simulation::new(&scene).unwrap().start_warnings().len(), warnings, "{radius}");
    }
}

/// Symptom: a ramp with friction let balls without any slide on as if it had none, and nobody said so.
#[test]
fn friction_on_one_side_alone_is_warned_of() {
    for (of_ball, of_floor, warnings) in [(0.0, 0.3, 1), (0.3, 0.3, 0), (0.3, 0.0, 0), (0.0, 0.0, 0)] {
        let floor = static_ball(2, DVec3::new(5.0, 1.0, 5.0), 1.0).friction(of_floor);
        let alone = Simulation::new(&empty().body(floor.clone())).unwrap();
        assert!(alone.start_warnings().is_empty(), "nothing could rub");
        let scene = empty().body(floor).body(ball(1, DVec3::splat(5.0), DVec3::ZERO).friction(of_ball));
        let sim = Simulation::new(&scene).unwrap();
        assert_eq!(sim.start_warnings().len(), warnings, "{of_ball}, {of_floor}: {:?}", sim.start_warnings());
    }
}

#[test]
fn a_spin_whose_energy_is_no_number_is_refused() {
    let mut scene = empty().body(ball(1, DVec3::splat(5.0), DVec3::ZERO).radius(0.5));
    scene.bodies[0].spin = DVec3::new(1e300, 0.0, 0.0);
    let error = Simulation::new(&scene).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("angular velocity"), "{error}");
}
