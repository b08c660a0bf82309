//! Lasting contact against statics and closed forms: inclines, corners, edges, air, lifting off.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, Force, ForceKind, NodeKey, Scene};
use polyscene::sim::{ContactState, Event, EventKind, SimEdit, Simulation};

use crate::common::build::{Build, Shaped, ball, empty, static_ball};
use crate::common::drive::{Sampling, advance, simulation, state_of, watch};

/// The Δt at which every closed form must hold.
const STEPS: [f64; 3] = [1.0, 1.0 / 60.0, 1e-3];

/// Ball 2 with bounce 0.5 and radius 0.5 m.
fn lossy(position: DVec3, velocity: DVec3) -> Body {
    ball(2, position, velocity).bounce(0.5)
}

fn leaning(gravity: DVec3) -> Scene {
    empty().walls(10).force(ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: gravity })
}

#[test]
fn ball_on_an_incline_slides_with_g_sin_alpha() {
    let alpha = 0.3_f64;
    let (sin, cos) = alpha.sin_cos();
    // Touching a plate through the map's middle whose normal is (sin α, cos α, 0), at rest.
    let normal = dvec3(sin, cos, 0.0);
    let downhill = dvec3(cos, -sin, 0.0);
    let start = DVec3::splat(5.0) + normal * 0.5;
    let scene = empty()
        .gravity(-9.8)
        .plate(1, DVec3::splat(5.0), dvec3(-FRAC_PI_2, alpha, 0.0), 300.0, 300.0)
        .body(lossy(start, DVec3::Z));
    for dt in STEPS {
        let mut sim = simulation(&scene);
        watch(&mut sim, 10.0, Sampling::Every(dt), |sim, _| {
            let (t, state) = (sim.time(), state_of(sim, 2));
            let expected = start + downhill * (4.9 * sin * t * t) + DVec3::Z * t;
            let off = (state.position - expected).length();
            assert!(off <= 1e-9 * (1.0 + t * t), "Δt {dt}, t {t}: {off:e} m off");
            let residual = sim.energy().residual.expect("gravity has a potential");
            assert!(residual.abs() <= 1e-10, "Δt {dt}, t {t}: residual {residual:e}");
        });
        assert_eq!(state_of(&sim, 2).contact, ContactState::Slide);
    }
}

#[test]
fn ball_comes_to_rest_in_corners_of_two_and_three_walls() {
    for (gravity, rest) in [
        (dvec3(-1.0, -9.8, 0.0), dvec3(0.5, 0.5, 5.0)),
        (dvec3(-1.0, -9.8, -2.0), dvec3(0.5, 0.5, 0.5)),
        (dvec3(3.0, -9.8, 2.0), dvec3(9.5, 0.5, 9.5)),
    ] {
        let mut sim = simulation(&leaning(gravity).body(lossy(DVec3::splat(5.0), DVec3::ZERO)));
        let events = advance(&mut sim, 30.0, Sampling::Every(0.1));
        let lying = state_of(&sim, 2);
        assert!(events.len() < 500, "{} events", events.len());
        assert_eq!((lying.contact, lying.velocity), (ContactState::Rest, DVec3::ZERO), "{gravity}");
        assert!((lying.position - rest).length() <= 1e-9, "{gravity}: {lying:?}");
        assert_eq!(advance(&mut sim, 1e4, Sampling::Every(1e3)), []);
        assert_eq!(state_of(&sim, 2), lying, "exactly still");
    }
}

#[test]
fn ball_slides_along_a_gutter_of_two_walls() {
    let scene = leaning(dvec3(-1.0, -9.8, 0.0)).body(lossy(dvec3(5.0, 5.0, 2.0), dvec3(0.0, 0.0, 0.2)));
    let mut sim = simulation(&scene);
    advance(&mut sim, 12.0, Sampling::Every(0.1));
    let sliding = state_of(&sim, 2);
    assert_eq!(sliding.contact, ContactState::Slide);
    assert!((sliding.velocity - dvec3(0.0, 0.0, 0.2)).length() <= 1e-12, "{sliding:?}");
    advance(&mut sim, 30.0, Sampling::Every(0.1));
    let later = state_of(&sim, 2);
    assert!((later.position - sliding.position - dvec3(0.0, 0.0, 3.6)).length() <= 1e-9, "{later:?}");
}

/// A ball that slides with this speed on a shelf whose edge is at x = 7, 5 m high.
fn shelf(speed: f64) -> (Simulation, Vec<Event>) {
    let scene = empty()
        .gravity(-9.8)
        .plate(1, DVec3::splat(5.0), dvec3(-FRAC_PI_2, 0.0, 0.0), 2.0, 2.0)
        .body(lossy(dvec3(5.0, 5.5, 5.0), dvec3(speed, 0.0, 0.0)));
    let mut sim = simulation(&scene);
    let events = advance(&mut sim, 4.0, Sampling::Every(0.1));
    (sim, events)
}

fn lift_offs(events: &[Event]) -> Vec<&Event> {
    events.iter().filter(|event| event.kind == EventKind::LiftOff).collect()
}

#[test]
fn fast_ball_leaves_the_end_of_a_shelf_flying_level() {
    // v² / r > g: the edge cannot hold it, so it flies on from where the face ends.
    let (sim, events) = shelf(3.0);
    let t = 4.0 - 2.0 / 3.0;
    let expected = dvec3(7.0 + 3.0 * t, 5.5 - 4.9 * t * t, 5.0);
    let state = state_of(&sim, 2);
    assert!((state.position - expected).length() <= 1e-8, "{state:?}, expected {expected}");
    assert_eq!(state.contact, ContactState::Flight);
    let last = lift_offs(&events).pop().expect("it lifts off");
    assert!((last.time - 2.0 / 3.0).abs() <= 1e-9, "{events:?}");
}

#[test]
fn slow_ball_turns_round_the_edge_before_it_leaves() {
    // On the edge v² = v₀² + 2 g r (1 − cos θ); it leaves when v² = g r cos θ: cos θ = (2 + v₀²/(g r)) / 3.
    let (sim, events) = shelf(1.0);
    let cos = (2.0 + 1.0 / 4.9) / 3.0;
    let leaving = lift_offs(&events).pop().expect("it lifts off");
    assert!((leaving.normal.y - cos).abs() <= 1e-8, "{leaving:?}");
    assert!((leaving.normal.x - (1.0 - cos * cos).sqrt()).abs() <= 1e-8, "{leaving:?}");
    let state = state_of(&sim, 2);
    let energy = state.velocity.length_squared() / 2.0 + 9.8 * state.position.y;
    assert!((energy / (0.5 + 9.8 * 5.5) - 1.0).abs() <= 1e-10, "{state:?}");
    let level = (4.9 * cos).sqrt() * cos;
    assert!((state.velocity.x - level).abs() <= 1e-8, "{state:?}, expected {level} m/s along x");
}

#[test]
fn ball_slides_off_a_static_sphere_at_the_classical_angle() {
    // From the top with v₀: it leaves where cos θ = (2 + v₀²/(g R)) / 3, R the distance of the centres.
    let scene = empty()
        .gravity(-9.8)
        .body(static_ball(1, DVec3::splat(5.0), 1.0))
        .body(lossy(dvec3(5.0, 6.5, 5.0), dvec3(0.1, 0.0, 0.0)));
    let mut sim = simulation(&scene);
    let events = advance(&mut sim, 4.0, Sampling::Every(0.1));
    let cos = (2.0 + 0.01 / (9.8 * 1.5)) / 3.0;
    let leaving = lift_offs(&events).pop().expect("it lifts off");
    assert!((leaving.normal.y - cos).abs() <= 1e-7, "{leaving:?}, expected {cos}");
    let state = state_of(&sim, 2);
    let energy = state.velocity.length_squared() / 2.0 + 9.8 * state.position.y;
    assert!((energy / (0.005 + 9.8 * 6.5) - 1.0).abs() <= 1e-9, "{state:?}");
}

#[test]
fn air_slows_a_sliding_ball_by_the_hyperbola() {
    // On a floor only drag acts along the motion: v = v₀ / (1 + k v₀ t), k = ½ C ρ S / m.
    let scene =
        empty().gravity(-9.8).air(10.0).floor(1, 90.0).body(lossy(dvec3(5.0, 0.5, 5.0), DVec3::X * 4.0));
    let k = 0.5 * 0.5 * 10.0 * PI * 0.25;
    for dt in STEPS {
        let mut sim = simulation(&scene);
        watch(&mut sim, 30.0, Sampling::Every(dt), |sim, _| {
            let (t, state) = (sim.time(), state_of(sim, 2));
            let slowed = 1.0 + k * 4.0 * t;
            assert!((state.velocity.x * slowed / 4.0 - 1.0).abs() <= 1e-8, "Δt {dt}, t {t}: {state:?}");
            assert!((state.position.x - 5.0 - slowed.ln() / k).abs() <= 1e-8, "Δt {dt}, t {t}: {state:?}");
            assert!((state.position.y - 0.5).abs() <= 1e-9, "Δt {dt}, t {t}: {state:?}");
        });
    }
}

#[test]
fn resting_ball_lifts_off_when_gravity_turns() {
    let scene = empty().gravity(-9.8).floor(1, 3.0).body(lossy(dvec3(5.0, 0.5, 5.0), DVec3::ZERO));
    let mut sim = simulation(&scene);
    advance(&mut sim, 2.0, Sampling::Every(0.3));
    assert_eq!(state_of(&sim, 2).contact, ContactState::Rest);
    let up = ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: DVec3::Y * 4.0 };
    sim.apply(&SimEdit::ChangeForce(Box::new(Force::new(1, up)))).expect("the force is there");
    advance(&mut sim, 4.0, Sampling::Every(0.3));
    let state = state_of(&sim, 2);
    assert_eq!(state.contact, ContactState::Flight);
    assert!((state.position.y - 8.5).abs() <= 1e-9, "{state:?}");
}

#[test]
fn resting_ball_is_pushed_by_another() {
    // e = 0.25: the mover keeps 1 − 0.625, the other gets 0.625 of the speed, both go on sliding.
    let other = ball(3, dvec3(2.0, 0.5, 5.0), DVec3::X).bounce(0.5);
    let scene =
        empty().gravity(-9.8).floor(1, 30.0).body(lossy(dvec3(5.0, 0.5, 5.0), DVec3::ZERO)).body(other);
    let mut sim = simulation(&scene);
    advance(&mut sim, 6.0, Sampling::Every(0.3));
    for (id, speed, x) in [(3, 0.375, 4.0 + 4.0 * 0.375), (2, 0.625, 5.0 + 4.0 * 0.625)] {
        let state = state_of(&sim, id);
        assert_eq!(state.contact, ContactState::Slide);
        assert!((state.velocity - DVec3::X * speed).length() <= 1e-12, "{id}: {state:?}");
        assert!((state.position - dvec3(x, 0.5, 5.0)).length() <= 1e-9, "{id}: {state:?}");
    }
}

#[test]
fn ball_in_a_wedge_comes_to_rest() {
    for tilt in [0.4_f64, 0.7, 1.1] {
        let scene = empty()
            .gravity(-9.8)
            .plate(10, dvec3(5.0, 0.0, 5.0), dvec3(-FRAC_PI_2, tilt, 0.0), 30.0, 30.0)
            .plate(11, dvec3(5.0, 0.0, 5.0), dvec3(-FRAC_PI_2, -tilt, 0.0), 30.0, 30.0)
            .body(lossy(dvec3(5.2, 4.0, 5.0), DVec3::ZERO));
        let mut sim = simulation(&scene);
        advance(&mut sim, 30.0, Sampling::Every(0.1));
        let lying = state_of(&sim, 2);
        assert_eq!((lying.contact, lying.velocity), (ContactState::Rest, DVec3::ZERO), "tilt {tilt}");
        // It touches both plates: its centre is r / cos(tilt) above the groove.
        let expected = dvec3(5.0, 0.5 / tilt.cos(), 5.0);
        assert!((lying.position - expected).length() <= 1e-9, "tilt {tilt}: {lying:?}");
        assert_eq!(advance(&mut sim, 1e3, Sampling::Every(1e2)), []);
    }
}

#[test]
fn ball_on_a_ball_on_the_floor_stays_sound() {
    for offset in [0.0, 0.1] {
        let scene = empty()
            .gravity(-9.8)
            .floor(1, 3.0)
            .body(lossy(dvec3(5.0, 1.0, 5.0), DVec3::ZERO))
            .body(ball(3, dvec3(5.0 + offset, 3.0, 5.0), DVec3::ZERO).bounce(0.5));
        crate::sim_random::assert_sound(&scene, 1.2, &format!("offset {offset}"));
    }
}

#[test]
fn heavy_ball_stands_on_a_light_one() {
    for ratio in [1e2, 1e3, 1e6] {
        let scene = empty()
            .gravity(-9.8)
            .floor(1, 3.0)
            .body(lossy(dvec3(5.0, 0.5, 5.0), DVec3::ZERO))
            .body(ball(3, dvec3(5.0, 1.5, 5.0), DVec3::ZERO).bounce(0.5).mass(ratio));
        let mut sim = simulation(&scene);
        let events = advance(&mut sim, 1e3, Sampling::Every(10.0));
        assert!(events.len() <= 8, "{ratio}: {} events", events.len());
        for (id, y) in [(2, 0.5), (3, 1.5)] {
            let state = state_of(&sim, id);
            assert_eq!((state.contact, state.velocity), (ContactState::Rest, DVec3::ZERO), "{ratio}: {id}");
            assert!((state.position.y - y).abs() <= 1e-12, "{ratio}: {state:?}");
        }
    }
}

#[test]
fn heap_lets_go_when_its_middle_is_taken_or_gravity_turns() {
    let stack = || {
        let balls = [(2, 0.5), (3, 1.5), (4, 2.5)]
            .map(|(id, y)| ball(id, dvec3(5.0, y, 5.0), DVec3::ZERO).bounce(0.5));
        balls.into_iter().fold(empty().gravity(-9.8).floor(1, 3.0), Build::body)
    };
    let mut sim = simulation(&stack());
    advance(&mut sim, 1.0, Sampling::Every(0.3));
    assert_eq!(state_of(&sim, 4).contact, ContactState::Rest);
    sim.apply(&SimEdit::Remove(NodeKey(3))).expect("the ball is there");
    advance(&mut sim, 1.2, Sampling::Every(0.3));
    assert!((state_of(&sim, 4).position.y - (2.5 - 4.9 * 0.04)).abs() <= 1e-9, "{:?}", state_of(&sim, 4));
    advance(&mut sim, 6.0, Sampling::Every(0.3));
    assert!((state_of(&sim, 4).position.y - 1.5).abs() <= 1e-9, "{:?}", state_of(&sim, 4));

    let mut sim = simulation(&stack());
    advance(&mut sim, 1.0, Sampling::Every(0.3));
    let up = ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: DVec3::Y * 2.0 };
    sim.apply(&SimEdit::ChangeForce(Box::new(Force::new(1, up)))).expect("the force is there");
    advance(&mut sim, 2.0, Sampling::Every(0.3));
    for (id, y) in [(2, 0.5), (3, 1.5), (4, 2.5)] {
        let state = state_of(&sim, id);
        assert_eq!(state.contact, ContactState::Flight, "{id}");
        assert!((state.position.y - (y + 1.0)).abs() <= 1e-9, "{id}: {state:?}");
    }
    let residual = sim.energy().residual.expect("gravity has a potential");
    assert!(residual.abs() <= 1e-12, "{residual:e}");
}
