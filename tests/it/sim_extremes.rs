//! Scenes at the ends of what can be written: overlaps at the start, huge and tiny numbers, nothing at all.

use glam::{DVec3, dvec3};
use polyscene::scene::Scene;
use polyscene::sim::{ContactState, EventKind, Method, Simulation};
use polyscene::study::closed_form::Bounces;

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball};
use crate::common::drive::{Sampling, advance, impacts, run, simulation, state_of, states, watch};

/// Runs a scene without forces (so all energy is kinetic): finite, energy never up, no fault.
fn assert_calm(scene: &Scene, until: f64, what: &str) -> Simulation {
    let mut sim = simulation(scene);
    let mut last = sim.energy().kinetic;
    watch(&mut sim, until, Sampling::Every(until / 16.0), |sim, _| {
        let now = sim.energy().kinetic;
        assert!(now <= last * (1.0 + 1e-12), "{what}, t {}: energy up from {last} to {now}", sim.time());
        last = now;
        for (body, state) in states(sim) {
            assert!(state.position.is_finite() && state.velocity.is_finite(), "{what}: {body:?} {state:?}");
        }
    });
    sim
}

/// Two overlapping spheres along x with these speeds.
fn overlapping(left: f64, right: f64) -> Scene {
    empty().ball(1, dvec3(4.0, 5.0, 5.0), DVec3::X * left).ball(2, dvec3(4.7, 5.0, 5.0), DVec3::X * right)
}

#[test]
fn overlap_at_the_start_is_reported() {
    let sim = simulation(&overlapping(0.0, 0.0));
    assert_eq!(sim.start_warnings().len(), 1, "{:?}", sim.start_warnings());
    assert!(!sim.start_warnings()[0].is_error());
    assert!((sim.worst_overlap() - 0.3).abs() <= 1e-15, "{}", sim.worst_overlap());
    let apart = empty().ball(1, dvec3(4.0, 5.0, 5.0), DVec3::ZERO).ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO);
    assert!(simulation(&apart).start_warnings().is_empty(), "touching is no overlap");
}

#[test]
fn overlapping_approaching_pair_parts_at_once() {
    let run = run(&overlapping(1.0, -1.0), 1.0, Sampling::Every(0.1));
    assert_eq!(run.events.len(), 1, "{:?}", run.events);
    let event = &run.events[0];
    assert_eq!((event.kind, event.time), (EventKind::Impact, 0.0));
    assert!((event.normal - DVec3::X).length() <= 1e-15 && (event.impulse - 2.0).abs() <= 1e-15, "{event:?}");
    assert_eq!(run.states[0].1.velocity, -DVec3::X);
    assert_eq!(run.states[1].1.velocity, DVec3::X);
}

#[test]
fn overlapping_separating_or_still_pair_has_no_event() {
    for (left, right) in [(-1.0, 1.0), (0.0, 0.0), (2.0, 2.0), (-1e-9, 0.0)] {
        let sim = assert_calm(&overlapping(left, right), 3.0, "overlap");
        assert_eq!(sim.counters().total_events(), 0, "speeds {left} and {right}");
        let expected = [4.0 + 3.0 * left, 4.7 + 3.0 * right];
        for (id, x) in [(1, expected[0]), (2, expected[1])] {
            assert!((state_of(&sim, id).position.x - x).abs() <= 1e-14, "speeds {left} and {right}");
        }
    }
}

#[test]
fn ball_embedded_in_a_plate_leaves_on_its_own_side() {
    for speed in [1.0, -1.0, 0.0] {
        let scene = empty().plate(1, DVec3::splat(5.0), DVec3::ZERO, 1.0, 1.0).ball(
            2,
            dvec3(5.0, 5.0, 5.3),
            dvec3(0.0, 0.0, speed),
        );
        let sim = assert_calm(&scene, 2.0, "embedded");
        assert_eq!(sim.start_warnings().len(), 1);
        let expected = 5.3 + 2.0 * speed.abs();
        assert!((state_of(&sim, 2).position.z - expected).abs() <= 1e-13, "speed {speed}");
    }
}

#[test]
fn embedded_resting_ball_sinks_no_deeper_and_gains_nothing() {
    for bounce in [0.0, 0.5, 1.0] {
        let sunk = ball(2, dvec3(5.0, 0.499, 5.0), DVec3::ZERO).bounce(bounce);
        let scene = empty().gravity(-9.8).floor(1, 3.0).body(sunk);
        let mut sim = simulation(&scene);
        watch(&mut sim, 5.0, Sampling::Every(0.01), |sim, _| {
            let state = state_of(sim, 2);
            let energy = state.velocity.length_squared() / 2.0 + 9.8 * state.position.y;
            assert!(energy <= 9.8 * 0.499 + 1e-9, "bounce {bounce}: {state:?}");
            assert!(state.position.y >= 0.499 - 1e-9, "bounce {bounce}: {state:?}");
        });
    }
}

#[test]
fn ball_placed_on_the_floor_stays_there() {
    // Touching exactly, at rest, pressed on: even an elastic one has no reason to move.
    for bounce in [0.0, 0.5, 1.0] {
        let placed = ball(2, dvec3(5.0, 0.5, 5.0), DVec3::ZERO).bounce(bounce);
        let mut sim = simulation(&empty().gravity(-9.8).floor(1, 3.0).body(placed));
        advance(&mut sim, 10.0, Sampling::Every(0.1));
        let state = state_of(&sim, 2);
        assert!((state.position - dvec3(5.0, 0.5, 5.0)).length() <= 1e-9, "bounce {bounce}: {state:?}");
        assert!(state.velocity.length() <= 1e-9, "bounce {bounce}: {state:?}");
        assert!(sim.counters().total_events() < 100, "bounce {bounce}: {:?}", sim.counters());
    }
}

#[test]
fn touching_bodies_without_forces_have_no_events() {
    let scene = empty()
        .floor(1, 3.0)
        .ball(2, dvec3(5.0, 0.5, 5.0), DVec3::X * 0.1)
        .ball(3, dvec3(4.0, 0.5, 5.0), DVec3::X * 0.1)
        .ball(4, dvec3(4.0, 1.5, 5.0), DVec3::X * 0.1);
    let sim = assert_calm(&scene, 10.0, "touching");
    assert_eq!(impacts(&run(&scene, 10.0, Sampling::Every(1.0)).events).len(), 0);
    assert!((state_of(&sim, 2).position - dvec3(6.0, 0.5, 5.0)).length() <= 1e-12);
}

#[test]
fn coincident_centres_are_survived() {
    let centre = DVec3::splat(5.0);
    for velocity in [DVec3::ZERO, DVec3::X, dvec3(-1.0, 2.0, 0.5)] {
        let pair = empty().ball(1, centre, velocity).ball(2, centre, -velocity);
        let on_static = empty().body(static_ball(1, centre, 1.0)).ball(2, centre, velocity);
        let in_plate = empty().plate(1, centre, DVec3::ZERO, 1.0, 1.0).ball(2, centre, velocity);
        let on_corner = empty().plate(1, centre - dvec3(1.0, 1.0, 0.0), DVec3::ZERO, 1.0, 1.0);
        let on_corner = on_corner.ball(2, centre, velocity);
        let scenes = [("pair", pair), ("static", on_static), ("plate", in_plate), ("corner", on_corner)];
        for (what, scene) in scenes {
            assert_calm(&scene, 5.0, what);
        }
    }
}

#[test]
fn ball_starting_at_an_attractor_is_refused() {
    for velocity in [DVec3::ZERO, DVec3::X] {
        let scene = empty().attractor(DVec3::splat(5.0), 8.0).ball(1, DVec3::splat(5.0), velocity);
        // There the force has no value, so nothing that follows could be right.
        let problems = Simulation::new(&scene).expect_err("a scene that cannot begin").problems;
        let [problem] = &problems[..] else { panic!("{velocity}: {problems:?}") };
        assert_eq!(
            problem.message,
            "body 1: its centre lies on a point attractor, where the force has no value"
        );
        assert_eq!(problem.key, Some(scene.bodies[0].key), "the body is what to select");
        assert!(problem.is_error() && problem.hint.contains("move one of them"), "{velocity}: {problem}");
    }
}

#[test]
fn body_that_leaves_the_map_goes_on_and_comes_back() {
    // Thrown out of the 10 m box, bounced back by a plate 90 m outside it.
    let scene = empty()
        .body(plate(1, dvec3(5.0, 5.0, 100.0), DVec3::ZERO, 2.0, 2.0))
        .ball(2, DVec3::splat(5.0), dvec3(0.0, 0.0, 10.0))
        .ball(3, dvec3(5.0, 5.0, -200.0), DVec3::ZERO);
    for tiles in [1, 10, 1000] {
        let run = run(&scene.clone().tiles([tiles; 3]), 40.0, Sampling::Every(0.7));
        let times: Vec<f64> = run.events.iter().map(|event| event.time).collect();
        // 94.5 m there, then 298.5 m back to the ball that waits at −200.
        assert_eq!(times.len(), 2, "{:?}", run.events);
        assert!((times[0] - 9.45).abs() <= 1e-12 && (times[1] - 39.3).abs() <= 1e-12, "{times:?}");
        assert!((run.states[1].1.velocity - dvec3(0.0, 0.0, -10.0)).length() <= 1e-12);
    }
    assert!(!simulation(&scene).start_warnings().is_empty(), "one starts outside the map");
}

#[test]
fn scene_without_bodies_or_forces_runs() {
    let mut sim = simulation(&empty());
    assert_eq!(advance(&mut sim, 1e6, Sampling::Every(1e5)), []);
    assert_eq!((sim.time(), sim.dynamic_count(), sim.static_count()), (1e6, 0, 0));
    let mut sim = simulation(&empty().gravity(-9.8).attractor(DVec3::ONE, 8.0).air(1.2).floor(1, 2.0));
    assert_eq!(advance(&mut sim, 100.0, Sampling::Every(1.0)), []);
    assert_eq!(sim.energy().kinetic, 0.0);
}

#[test]
fn steps_may_be_huge_tiny_or_nothing() {
    let scene =
        empty().gravity(-9.8).floor(1, 3.0).body(ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO).bounce(0.5));
    let mut sim = simulation(&scene);
    for until in [0.0, -5.0, f64::MIN_POSITIVE, 1e-300, 1e-12, f64::NEG_INFINITY, f64::NAN] {
        sim.begin(until);
        sim.finish(&mut |_, event| panic!("{event:?}")).expect("a run without faults");
        assert!(sim.time() <= 1e-12 && sim.time() >= 0.0, "until {until}: {}", sim.time());
    }
    advance(&mut sim, 1e9, Sampling::Every(1e9));
    let lying = state_of(&sim, 2);
    assert_eq!((lying.contact, lying.velocity), (ContactState::Rest, DVec3::ZERO));
    assert!((lying.position.y - 0.5).abs() <= 1e-9, "{lying:?}");
}

#[test]
fn a_run_without_an_end_ends_when_nothing_is_left_to_happen() {
    let lossy =
        empty().gravity(-9.8).floor(1, 3.0).body(ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO).bounce(0.5));
    for method in [Method::Exact, Method::Thesis, Method::Fixed] {
        let mut sim = Simulation::with_method(&lossy, method).expect("a sound scene");
        sim.begin(f64::INFINITY);
        let mut rests = false;
        sim.finish(&mut |_, event| rests |= event.kind == EventKind::Rest).expect("a run without faults");
        let is_exact = method == Method::Exact;
        assert_eq!(rests, is_exact, "{method:?}: an endless Δt is none");
        assert_eq!(sim.time() > 0.0, is_exact, "{method:?}");
        let settled = sim.time();
        assert!(settled.is_finite() && sim.next_event() == Ok(None), "{method:?}: now is {settled}");
        sim.begin(settled + 1.0);
        sim.finish(&mut |_, event| assert!(!is_exact, "{event:?}")).expect("a run without faults");
        assert_eq!(sim.time(), settled + 1.0, "{method:?} goes on");
    }
}

#[test]
fn tiny_and_huge_bodies_keep_to_newtons_law() {
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        for mass in [1e-12, 1.0, 1e12] {
            // A head-on pair, in units of `scale` metres.
            let scene = empty()
                .body(ball(1, dvec3(0.0, 5.0, 5.0), DVec3::X * scale).radius(0.5 * scale).mass(mass))
                .body(ball(2, dvec3(3.0 * scale, 5.0, 5.0), DVec3::ZERO).radius(1.5 * scale));
            let run = run(&scene, 4.0, Sampling::Every(0.3));
            assert_eq!(run.events.len(), 1, "scale {scale}, mass {mass}");
            assert!((run.events[0].time - 1.0).abs() <= 1e-12, "scale {scale}: {:?}", run.events[0]);
            let speed = 2.0 * mass / (mass + 1.0);
            let found = run.states[1].1.velocity.x / scale;
            assert!((found / speed - 1.0).abs() <= 1e-12, "scale {scale}, mass {mass}: {found}");
        }
    }
}

#[test]
fn ball_bounces_on_a_planet() {
    // A static sphere of 6 371 km: the ball's height is a millionth of its radius, the time is as on a floor.
    let radius = 6.371e6;
    let scene = empty().gravity(-9.8).body(static_ball(1, dvec3(5.0, -radius, 5.0), radius)).ball(
        2,
        dvec3(5.0, 5.0, 5.0),
        DVec3::ZERO,
    );
    let events = run(&scene, 3.0, Sampling::Every(0.5)).events;
    let bounces = Bounces::dropped(4.5, 9.8, 1.0);
    assert_eq!(events.len(), 2, "{events:?}");
    // A centre 6.4e6 m away is known to 1e-9 m.
    let off = [0, 1].map(|k| (events[k as usize].time - bounces.impact_time(k)).abs());
    assert!(off[0] <= 1e-9 && off[1] <= 1e-8, "{events:?}");
}

#[test]
fn far_from_the_origin_only_the_spacing_of_numbers_grows() {
    // At 1e5 m an f64 is 1.5e-11 m, which it falls in 1.6e-12 s.
    let offset = DVec3::splat(1e5);
    let mut scene = empty().gravity(-9.8).floor(1, 3.0).ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO);
    for body in &mut scene.bodies {
        body.position += offset;
    }
    let events = run(&scene, 20.0, Sampling::Every(0.5)).events;
    let bounces = Bounces::dropped(4.5, 9.8, 1.0);
    assert_eq!(events.len(), 10);
    for (k, event) in (0..).zip(&events) {
        let error = event.time - bounces.impact_time(k);
        assert!(error.abs() <= 1e-11 * f64::from(2 * k + 1), "impact {k}: {error:e} s");
    }
}

#[test]
fn ball_without_bounce_stops_at_its_first_impact() {
    let dropped = ball(2, dvec3(5.0, 5.0, 5.0), dvec3(1.0, 0.0, 0.0)).bounce(0.0);
    let mut sim = simulation(&empty().gravity(-9.8).floor(1, 30.0).body(dropped));
    let events = advance(&mut sim, 5.0, Sampling::Every(0.1));
    assert_eq!(impacts(&events).len(), 1, "{events:?}");
    let state = state_of(&sim, 2);
    assert_eq!(state.contact, ContactState::Slide);
    assert!((state.position - dvec3(10.0, 0.5, 5.0)).length() <= 1e-9, "{state:?}");
}

#[test]
fn bounce_above_one_gains_and_runs_on() {
    let hot = ball(2, dvec3(5.0, 1.5, 5.0), DVec3::ZERO).bounce(1.1);
    let scene = empty().gravity(-9.8).floor(1, 3.0).body(hot);
    let events = run(&scene, 20.0, Sampling::Every(0.1)).events;
    let bounces = Bounces::dropped(1.0, 9.8, 1.1);
    for (k, event) in (0..).zip(&events) {
        assert!((event.time / bounces.impact_time(k) - 1.0).abs() <= 1e-12, "impact {k}: {event:?}");
    }
    let next = bounces.impact_time(events.len() as u32);
    assert!(events.len() >= 10 && next > 20.0, "{} impacts", events.len());
}

#[test]
fn scenes_that_cannot_run_are_refused() {
    let nan = empty().ball(1, dvec3(f64::NAN, 0.0, 0.0), DVec3::ZERO);
    let dynamic_plate = {
        let mut scene = empty().ball(1, DVec3::ONE, DVec3::ZERO);
        scene.bodies[0].shape = polyscene::scene::Shape::Plane { half_x: 1.0, half_y: 1.0 };
        scene
    };
    let massless = empty().body(ball(1, DVec3::ONE, DVec3::ZERO).mass(0.0));
    let flat = empty().body(ball(1, DVec3::ONE, DVec3::ZERO).radius(0.0));
    let no_tiles = empty().tiles([0, 1, 1]).ball(1, DVec3::ONE, DVec3::ZERO);
    let scenes = [nan, dynamic_plate, massless, flat, no_tiles];
    for (k, scene) in scenes.iter().enumerate() {
        let err = Simulation::new(scene).err().unwrap_or_else(|| panic!("scene {k} was accepted"));
        assert!(!err.problems.is_empty(), "scene {k}");
    }
}
