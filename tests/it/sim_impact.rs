//! Single impacts against closed forms: bouncing, coming to rest, bullets, grazing passes.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::Scene;
use polyscene::sim::{ContactState, Event, EventKind};
use polyscene::study::OverlapMonitor;
use polyscene::study::closed_form::{Bounces, touch_beyond_edge};

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball};
use crate::common::drive::{Sampling, advance, impacts, run, simulation, state_of, watch};
use crate::common::load::load;

/// The Δt at which every closed form must hold.
const STEPS: [f64; 3] = [1.0, 1.0 / 60.0, 1e-3];

/// A ball of radius 0.5 m dropped from y = 5 m: it falls 4.5 m.
fn drop(bounce: f64) -> Scene {
    empty().gravity(-9.8).floor(1, 3.0).body(ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO).bounce(bounce))
}

fn bounces(bounce: f64) -> Bounces {
    Bounces::dropped(4.5, 9.8, bounce)
}

#[test]
fn elastic_ball_bounces_at_closed_form_times() {
    let (bounces, speed) = (bounces(1.0), 9.8 * bounces(1.0).first_fall);
    for dt in STEPS {
        let (scene, mut events) = (drop(1.0), Vec::new());
        let (monitor, mut sim) = (OverlapMonitor::in_id_order(&scene), simulation(&scene));
        watch(&mut sim, 20.0, Sampling::Every(dt), |sim, event| {
            events.extend(event.copied());
            let residual = sim.energy().residual.expect("gravity has a potential");
            assert!(residual.abs() <= 1e-12, "Δt {dt}, t {}: residual {residual:e}", sim.time());
            let overlap = monitor.worst_now(sim);
            assert!(overlap <= 1e-12, "Δt {dt}, t {}: overlap {overlap:e}", sim.time());
        });
        assert_eq!(events.len(), 10, "{events:?}");
        for (k, event) in (0..).zip(&events) {
            assert_eq!(event.kind, EventKind::Impact);
            let error = event.time - bounces.impact_time(k);
            assert!(error.abs() <= 1e-11, "Δt {dt}, impact {k}: {error:e} s");
            assert!((event.point - dvec3(5.0, 0.0, 5.0)).length() <= 1e-12, "{event:?}");
            // The floor has the smaller UserID, so the normal points up.
            assert!((event.normal - DVec3::Y).length() <= 1e-12, "{event:?}");
            assert!((event.impulse - 2.0 * speed).abs() <= 1e-11, "{event:?}");
            assert!((event.vn_before + speed).abs() <= 1e-11, "{event:?}");
            assert!((event.vn_after - speed).abs() <= 1e-11, "{event:?}");
        }
    }
}

#[test]
fn lossy_ball_comes_to_rest_at_the_limit_time() {
    let expected = bounces(0.8);
    for dt in STEPS {
        let mut sim = simulation(&drop(0.8));
        let events = advance(&mut sim, 10.0, Sampling::Every(dt));
        let bounces = impacts(&events);
        assert!(bounces.len() >= 50, "only {} bounces before rest", bounces.len());
        for (k, event) in (0..).zip(&bounces) {
            let error = event.time - expected.impact_time(k);
            assert!(error.abs() <= 1e-9, "Δt {dt}, bounce {k}: {error:e} s");
        }
        let rests: Vec<&Event> = events.iter().filter(|event| event.kind == EventKind::Rest).collect();
        assert_eq!(rests.len(), 1, "Δt {dt}");
        assert!((rests[0].time - expected.end()).abs() <= 1e-6, "Δt {dt}: {:?}", rests[0]);
        assert_eq!(events.last(), Some(rests[0]), "nothing happens after rest");

        let lying = state_of(&sim, 2);
        assert_eq!((lying.velocity, lying.contact), (DVec3::ZERO, ContactState::Rest));
        assert!((lying.position - dvec3(5.0, 0.5, 5.0)).length() <= 1e-9, "{lying:?}");
        assert_eq!(advance(&mut sim, 1000.0, Sampling::Every(dt * 100.0)), []);
        assert_eq!(state_of(&sim, 2), lying, "exactly still");
    }
}

#[test]
fn nearly_elastic_ball_comes_to_rest_too() {
    for e in [0.9, 0.99, 0.999] {
        let dropped = ball(2, dvec3(5.0, 1.0, 5.0), DVec3::ZERO).bounce(e);
        let mut sim = simulation(&empty().gravity(-9.8).floor(1, 3.0).body(dropped));
        let end = Bounces::dropped(0.5, 9.8, e).end();
        let events = advance(&mut sim, end * 1.01, Sampling::Every(1.0));
        let last = events.last().expect("events");
        assert_eq!(last.kind, EventKind::Rest, "e = {e}: {last:?}");
        assert!((last.time - end).abs() <= 1e-6, "e = {e}: {last:?}, expected at {end}");
        assert_eq!(state_of(&sim, 2).velocity, DVec3::ZERO);
    }
}

#[test]
fn residual_counts_what_impacts_and_rest_take() {
    let mut sim = simulation(&drop(0.8));
    watch(&mut sim, 12.0, Sampling::Every(0.1), |sim, _| {
        let residual = sim.energy().residual.expect("gravity has a potential");
        assert!(residual.abs() <= 1e-11, "t {}: {residual:e}", sim.time());
    });
}

#[test]
fn thrown_lossy_ball_ends_sliding_at_constant_speed() {
    let thrown = ball(2, dvec3(-300.0, 2.0, 5.0), dvec3(3.0, 0.0, 0.5)).bounce(0.6);
    let scene = empty().gravity(-9.8).floor(1, 400.0).body(thrown);
    for dt in STEPS {
        let mut sim = simulation(&scene);
        // The bounces end at 2.213 s.
        let events = advance(&mut sim, 4.0, Sampling::Every(dt));
        assert!(events.iter().any(|event| event.kind != EventKind::Impact), "the bounces must end");
        let end = events.last().expect("events").time;
        assert!((end - Bounces::dropped(1.5, 9.8, 0.6).end()).abs() <= 1e-6, "Δt {dt}: ended at {end}");
        let sliding = state_of(&sim, 2);
        assert_eq!(sliding.contact, ContactState::Slide);
        assert_eq!(advance(&mut sim, 100.0, Sampling::Every(dt)), []);
        let later = state_of(&sim, 2);
        let expected = sliding.position + dvec3(3.0, 0.0, 0.5) * 96.0;
        assert!((later.velocity - dvec3(3.0, 0.0, 0.5)).length() <= 1e-12, "Δt {dt}: {later:?}");
        assert!((later.position - expected).length() <= 1e-9, "Δt {dt}: {later:?}");
        assert!((later.position.y - 0.5).abs() <= 1e-9, "Δt {dt}: {later:?}");
    }
}

#[test]
fn sliding_ball_turns_round_at_a_wall() {
    let mut sim = simulation(&load("slide.xml"));
    let events = advance(&mut sim, 10.0, Sampling::Every(0.5));
    let walls: Vec<&Event> = events.iter().filter(|event| event.normal.x.abs() > 0.5).collect();
    // It slides 10.75 m at 3 m/s, then back with 0.6 of that speed.
    assert!((walls[0].time - 10.75 / 3.0).abs() <= 1e-9, "{:?}", walls[0]);
    let way_back = 11.5 / 1.8;
    assert_eq!(walls.len(), 1 + usize::from(10.75 / 3.0 + way_back <= 10.0));
    let expected = if walls.len() == 2 { 1.08 } else { -1.8 };
    let state = state_of(&sim, 4);
    assert_eq!(state.contact, ContactState::Slide);
    assert!((state.velocity - dvec3(expected, 0.0, 0.0)).length() <= 1e-9, "{state:?}");
}

/// A ball of 5 cm at 1000 m/s along x towards a plate at x = 10 whose sides end at y, z = 4 and 6.
fn bullet(y: f64, z: f64) -> Scene {
    empty()
        .body(plate(1, dvec3(10.0, 5.0, 5.0), dvec3(0.0, FRAC_PI_2, 0.0), 1.0, 1.0))
        .body(ball(2, dvec3(1.0, y, z), dvec3(1000.0, 0.0, 0.0)).radius(0.05))
}

fn assert_hit(event: &Event, time: f64, point: DVec3, normal: DVec3) {
    assert!((event.time - time).abs() <= 1e-14, "{event:?}: expected at {time}");
    assert!((event.point - point).length() <= 1e-12, "{event:?}: expected {point}");
    assert!((event.normal - normal).length() <= 1e-12, "{event:?}: expected {normal}");
}

#[test]
fn bullet_meets_face_edge_and_corner_where_geometry_says() {
    let offsets =
        [(0.0, 0.0), (-0.3, 0.7), (1.03, 0.0), (-0.2, -1.04), (1.03, 1.02), (-1.01, 1.03), (1.0499, 0.0)];
    for (y, z) in offsets {
        let beyond = |offset: f64| offset.signum() * (offset.abs() - 1.0).max(0.0);
        // The normal goes from the plate, the smaller UserID, to the ball.
        let (depth, normal) = touch_beyond_edge(0.05, [beyond(y), beyond(z)]);
        let centre = dvec3(10.0 - depth, 5.0 + y, 5.0 + z);
        for dt in STEPS {
            let run = run(&bullet(5.0 + y, 5.0 + z), 0.02, Sampling::Every(dt));
            assert_eq!(run.events.len(), 1, "offset {y}, {z}: {:?}", run.events);
            assert_hit(&run.events[0], (centre.x - 1.0) / 1000.0, centre - normal * 0.05, normal);
            let velocity = dvec3(1000.0, 0.0, 0.0) - normal * (2.0 * 1000.0 * normal.x);
            let state = run.states[0].1;
            assert!((state.velocity - velocity).length() <= 1e-9, "offset {y}, {z}: {state:?}");
            let expected = centre + velocity * (0.02 - (centre.x - 1.0) / 1000.0);
            assert!((state.position - expected).length() <= 1e-9, "offset {y}, {z}: {state:?}");
        }
    }
}

#[test]
fn bullet_meets_slanted_plates_at_glancing_angles() {
    for degrees in [80.0_f64, 45.0, 10.0, 1.0, 0.1] {
        // The plate's normal is (sin β, 0, cos β): the path makes the angle β with the plate.
        let (sin, cos) = degrees.to_radians().sin_cos();
        let scene = empty()
            .body(plate(1, DVec3::splat(5.0), dvec3(0.0, degrees.to_radians(), 0.0), 40.0, 1.0))
            .body(ball(2, dvec3(-60.0, 5.0, 5.0), dvec3(1000.0, 0.0, 0.0)).radius(0.05));
        let contact = 65.0 - 0.05 / sin;
        for dt in STEPS {
            let run = run(&scene, 0.1, Sampling::Every(dt));
            assert_eq!(run.events.len(), 1, "{degrees}°: {:?}", run.events);
            let event = &run.events[0];
            // An error of 1e-13 m across the plate is 1/sin as much along the path.
            assert!((event.time - contact / 1000.0).abs() <= 1e-16 / sin + 1e-16, "{degrees}°: {event:?}");
            assert!((event.normal - dvec3(-sin, 0.0, -cos)).length() <= 1e-12, "{degrees}°: {event:?}");
        }
    }
}

/// Whether a ball on a straight path hits.
fn hits(scene: &Scene) -> bool {
    let events = run(scene, 1.0, Sampling::Every(1.0 / 60.0)).events;
    assert!(events.len() <= 1, "{events:?}");
    events.len() == 1
}

#[test]
fn grazing_passes_tell_hit_from_miss() {
    // Past a sphere, a plate's edge, its corner, a moving ball, at r (1 ∓ 1e-9).
    let thrown = |y: f64, z: f64| ball(2, dvec3(1.0, y, z), dvec3(10.0, 0.0, 0.0));
    let sphere = |y: f64| empty().body(static_ball(1, dvec3(5.0, 0.0, 0.0), 1.5)).body(thrown(y, 0.0));
    let upright = || empty().plate(1, dvec3(5.0, -1.0, -1.0), dvec3(0.0, FRAC_PI_2, 0.0), 1.0, 1.0);
    let edge = |y: f64| upright().body(thrown(y, -0.5));
    let corner = |d: f64| upright().body(thrown(0.6 * d, 0.8 * d));
    let moving = |y: f64| {
        let other = ball(1, dvec3(9.0, 0.0, 0.0), dvec3(-10.0, 0.0, 0.0)).radius(0.25);
        empty().body(other).body(thrown(y, 0.0))
    };
    let (near, far) = (1.0 - 1e-9, 1.0 + 1e-9);
    assert!(hits(&sphere(2.0 * near)) && !hits(&sphere(2.0 * far)), "sphere");
    assert!(hits(&edge(0.5 * near)) && !hits(&edge(0.5 * far)), "edge");
    assert!(hits(&corner(0.5 * near)) && !hits(&corner(0.5 * far)), "corner");
    assert!(hits(&moving(0.75 * near)) && !hits(&moving(0.75 * far)), "two moving spheres");
}

#[test]
fn apex_of_a_throw_tells_hit_from_miss() {
    // Thrown up with v, the top of the ball reaches v²/2g above its start: 1e-9 m below or above a ceiling.
    let ceiling = |height: f64| {
        let scene = empty().gravity(-9.8).plate(
            1,
            dvec3(5.0, 1.5 + height, 5.0),
            dvec3(FRAC_PI_2, 0.0, 0.0),
            2.0,
            2.0,
        );
        scene.ball(2, dvec3(5.0, 1.0, 5.0), dvec3(0.5, 7.0, 0.0))
    };
    assert!(hits(&ceiling(2.5 - 1e-9)));
    assert!(!hits(&ceiling(2.5 + 1e-9)));
}

#[test]
fn plates_are_hit_from_both_sides() {
    for sign in [1.0, -1.0] {
        let scene = empty().plate(1, DVec3::splat(5.0), DVec3::ZERO, 1.0, 1.0).ball(
            2,
            dvec3(5.0, 5.0, 5.0 + sign * 3.0),
            dvec3(0.0, 0.0, -sign),
        );
        let run = run(&scene, 4.0, Sampling::Every(0.3));
        assert_eq!(run.events.len(), 1);
        assert_hit(&run.events[0], 2.5, DVec3::splat(5.0), dvec3(0.0, 0.0, sign));
        assert_eq!(run.states[0].1.velocity, dvec3(0.0, 0.0, sign));
    }
}
