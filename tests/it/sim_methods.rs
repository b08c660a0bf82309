//! The methods that step by Δt, against closed forms of what they get right and of what they lose.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec3, dvec3};
use polyscene::scene::{Force, ForceKind, Scene};
use polyscene::sim::{Event, EventKind, Method, Progress, SimEdit, Simulation, StepLimits};

use crate::common::build::{Build, Shaped, ball, empty, static_ball, thesis};
use crate::common::drive::{Sampling, state_of, watch};

/// The methods whose results depend on Δt.
const STEPPING: [Method; 2] = [Method::Thesis, Method::Fixed];

fn simulation(scene: &Scene, method: Method) -> Simulation {
    Simulation::with_method(scene, method).expect("the scene compiles")
}

/// Runs to `until` in steps of `dt` and gives the events.
fn run(sim: &mut Simulation, until: f64, dt: f64) -> Vec<Event> {
    let mut events = Vec::new();
    watch(sim, until, Sampling::Every(dt), |_, event| events.extend(event));
    events
}

/// A plate across x at `x`, half a side long enough for the map.
fn across(scene: Scene, id: i64, x: f64) -> Scene {
    scene.plate(id, dvec3(x, 5.0, 5.0), dvec3(0.0, FRAC_PI_2, 0.0), 5.0, 5.0)
}

#[test]
fn names_lead_back_to_their_methods() {
    for method in Method::ALL {
        assert_eq!(Method::from_name(method.name()), Some(method));
    }
    assert_eq!(Method::from_name("verlet"), None);
    assert_eq!(Simulation::new(&empty()).unwrap().method(), Method::Exact);
}

#[test]
fn uniform_gravity_is_exact_in_every_method() {
    let (start, velocity) = (dvec3(3.0, 4.0, 5.0), dvec3(2.0, 7.0, -1.5));
    let scene = empty().gravity(-9.8).ball(1, start, velocity);
    for method in STEPPING {
        for dt in [1.0, 1.0 / 60.0, 1e-3] {
            watch(&mut simulation(&scene, method), 1000.0 * dt, Sampling::Every(dt), |sim, _| {
                let (t, state) = (sim.time(), state_of(sim, 1));
                let expected = start + velocity * t + dvec3(0.0, -4.9 * t * t, 0.0);
                let error = (state.position - expected).length() / expected.length();
                assert!(error <= 1e-12, "{method:?}, Δt {dt}, t {t}: {error:e}");
                assert!(sim.energy().residual.unwrap().abs() <= 1e-11);
                assert!(sim.momentum().residual <= 1e-11);
            });
        }
    }
}

#[test]
fn an_impact_comes_early_by_no_more_than_the_bisection_allows() {
    // From 5 m with the radius 0.5 m: √(2·4.5/9.8) s.
    let scene = empty().gravity(-9.8).floor(9, 5.0).ball(1, dvec3(5.0, 5.0, 5.0), DVec3::ZERO);
    let exact = (9.0_f64 / 9.8).sqrt();
    for method in STEPPING {
        for dt in [0.05, 1.0 / 60.0, 1e-3, 0.000_97] {
            let mut sim = simulation(&scene, method);
            let events = run(&mut sim, 1.0, dt);
            let early = exact - events[0].time;
            assert!((-1e-13..=StepLimits::DEFAULT.time).contains(&early), "{method:?}, Δt {dt}: {early:e} s");
            assert_eq!((events[0].kind, events.len()), (EventKind::Impact, 1));
            assert!((events[0].vn_after - 9.8 * events[0].time).abs() <= 1e-12);
            assert!(sim.worst_overlap() == 0.0);
        }
    }
}

#[test]
fn a_bullet_is_seen_exactly_when_a_step_ends_in_the_plate() {
    // Steps end at 1 + k·v·Δt; the plate at 5 m is met iff one of them is nearer to it than the radius.
    let (radius, speed) = (0.05, 10.0);
    let scene = across(empty(), 9, 5.0).body(ball(1, dvec3(1.0, 5.0, 5.0), DVec3::X * speed).radius(radius));
    let (mut seen, mut missed) = (0, 0);
    for nth in 1..=60 {
        let dt = 1e-3 * f64::from(nth);
        let stride = speed * dt;
        let off = (4.0 / stride - (4.0 / stride).round()).abs() * stride;
        if (off - radius).abs() < 1e-9 {
            continue;
        }
        for method in STEPPING {
            let events = run(&mut simulation(&scene, method), 0.7, dt);
            assert_eq!(!events.is_empty(), off < radius, "{method:?}, Δt {dt}: steps end {off} m off");
        }
        let count = if off < radius { &mut seen } else { &mut missed };
        *count += 1;
        if stride < 2.0 * radius {
            assert!(off < radius, "no step shorter than the bullet jumps over a plate");
        }
    }
    assert!(seen > 10 && missed > 10, "both happen: {seen} and {missed}");
}

#[test]
fn only_the_thesis_deflects_a_body_into_one_outside_its_set() {
    // The ball meets the wall at 9 m after 1 m of its 2.9 m and flies back to 6.1 m, where a small static
    // ball lies 0.6 m from its centre and far from the tiles of its trial end.
    let scene = across(empty(), 9, 9.0)
        .body(static_ball(8, dvec3(5.5, 5.0, 5.0), 0.2))
        .body(ball(1, dvec3(7.0, 5.0, 5.0), DVec3::X * 2.9).radius(1.0));
    let mut sim = simulation(&scene, Method::Thesis);
    assert_eq!(run(&mut sim, 1.0, 1.0).len(), 1);
    assert!((state_of(&sim, 1).position.x - 6.1).abs() <= 1e-5);
    assert!((sim.worst_overlap() - 0.6).abs() <= 1e-5, "{}", sim.worst_overlap());

    let mut sim = simulation(&scene, Method::Fixed);
    assert_eq!(run(&mut sim, 1.0, 1.0).len(), 2);
    assert_eq!(sim.worst_overlap(), 0.0);
}

#[test]
fn pairs_exchange_what_the_law_of_impact_says() {
    // v₁' = v₁ − (1+e)m₂/(m₁+m₂)·(v₁−v₂)
    let scene = empty()
        .body(ball(1, dvec3(3.0, 5.0, 5.0), DVec3::X * 2.0).mass(3.0).bounce(0.8))
        .body(ball(2, dvec3(6.0, 5.0, 5.0), DVec3::X * -1.0).bounce(0.5));
    for method in STEPPING {
        let mut sim = simulation(&scene, method);
        let events = run(&mut sim, 2.0, 0.1);
        assert_eq!(events.len(), 1);
        assert!((state_of(&sim, 1).velocity.x - (2.0 - 1.4 * 0.25 * 3.0)).abs() <= 1e-14);
        assert!((state_of(&sim, 2).velocity.x - (-1.0 + 1.4 * 0.75 * 3.0)).abs() <= 1e-14);
        assert!((events[0].impulse - 1.4 * 0.75 * 3.0).abs() <= 1e-14);
        assert!(sim.energy().residual.unwrap().abs() <= 1e-14, "the loss is booked");
        assert!(sim.momentum().residual <= 1e-14);
    }
}

#[test]
fn several_collisions_of_one_step_are_taken_in_order() {
    // Newton's cradle with gaps: three hits within one Δt, all of them caused by the first.
    let mut scene = empty().ball(1, dvec3(1.0, 5.0, 5.0), DVec3::X * 4.0);
    for id in 2..=4 {
        scene = scene.ball(id, dvec3(1.1 * id as f64 + 0.4, 5.0, 5.0), DVec3::ZERO);
    }
    for method in STEPPING {
        let mut sim = simulation(&scene, method);
        let events = run(&mut sim, 1.0, 0.4);
        let pairs: Vec<_> = events.iter().map(|event| (sim.label(event.a), event.b)).collect();
        assert_eq!(events.len(), 3, "{method:?}: {pairs:?}");
        assert!(events.windows(2).all(|pair| pair[0].time < pair[1].time));
        for (id, speed) in [(1, 0.0), (2, 0.0), (3, 0.0), (4, 4.0)] {
            assert!((state_of(&sim, id).velocity.x - speed).abs() <= 1e-12, "{method:?}: ball {id}");
        }
    }
}

/// Position error after one turn of an ellipse of e = 0.3 and the semi-axis 1 m, in `steps` steps.
fn kepler_error(method: Method, steps: u32) -> f64 {
    let centre = DVec3::splat(5.0);
    let (near, speed) = (0.7, (1.3_f64 / 0.7).sqrt());
    let start = centre + DVec3::X * near;
    let scene = empty().attractor(centre, 1.0).body(ball(1, start, dvec3(0.0, 0.0, -speed)).radius(0.01));
    let mut sim = simulation(&scene, method);
    let dt = 2.0 * PI / f64::from(steps);
    for step in 1..=steps {
        sim.begin(f64::from(step) * dt);
        sim.finish(&mut |_, event| panic!("{event:?}")).unwrap();
    }
    (state_of(&sim, 1).position - start).length()
}

#[test]
fn errors_fall_with_the_order_of_the_method() {
    for (method, order) in [(Method::Fixed, 2.0), (Method::Thesis, 1.0)] {
        for steps in [4000, 8000] {
            let slope = (kepler_error(method, steps) / kepler_error(method, 2 * steps)).log2();
            assert!((slope - order).abs() < 0.15, "{method:?} at {steps} steps a turn: slope {slope}");
        }
    }
}

#[test]
fn drag_keeps_the_order_of_verlet() {
    // v = v₀/(1 + k v₀ t), k = ½CρS/m
    let scene = empty().air(100.0).body(ball(1, DVec3::splat(5.0), DVec3::X * 7.0).mass(2.0).radius(0.2));
    let k = 0.5 * 0.5 * 100.0 * PI * 0.04 / 2.0;
    let error = |dt: f64| {
        let mut sim = simulation(&scene, Method::Fixed);
        run(&mut sim, 1.0, dt);
        (state_of(&sim, 1).velocity.x - 7.0 / (1.0 + k * 7.0)).abs()
    };
    let slope = (error(1.0 / 256.0) / error(1.0 / 512.0)).log2();
    assert!((slope - 2.0).abs() < 0.1, "{slope}");
}

#[test]
fn a_lying_ball_runs_into_the_limit_and_shows_its_overlap() {
    let scene = empty().gravity(-9.8).floor(9, 5.0).ball(1, dvec3(5.0, 0.5, 5.0), DVec3::ZERO);
    for method in STEPPING {
        let dt = 1.0 / 60.0;
        let mut sim = simulation(&scene, method);
        sim.begin(dt);
        sim.finish(&mut |_, _| {}).unwrap();
        assert_eq!(sim.counters().given_up, 1, "{method:?}");
        // The rest of the step is fallen through: ½gΔt².
        assert!((sim.worst_overlap() - 4.9 * dt * dt).abs() <= 1e-12, "{method:?}: {}", sim.worst_overlap());
        assert!(sim.counters().pair_tests <= u64::from(StepLimits::DEFAULT.collisions) + 2);
    }
}

#[test]
fn bounces_that_die_out_neither_stall_nor_rest() {
    let scene =
        empty().gravity(-9.8).floor(9, 5.0).body(ball(1, dvec3(5.0, 1.0, 5.0), DVec3::ZERO).bounce(0.5));
    for method in STEPPING {
        let mut sim = simulation(&scene, method);
        assert!(!sim.plan().lasting_contact);
        let events = run(&mut sim, 10.0, 1.0 / 60.0);
        assert!(events.iter().all(|event| event.kind == EventKind::Impact));
        let most = u64::from(StepLimits::DEFAULT.collisions) * 600;
        assert!(sim.counters().given_up > 0 && (events.len() as u64) < most, "{method:?}");
    }
}

#[test]
fn the_scene_of_the_thesis_runs_a_minute() {
    let scene = thesis();
    for method in STEPPING {
        let mut sim = simulation(&scene, method);
        let events = run(&mut sim, 60.0, 1.0 / 60.0);
        assert!(events.windows(2).all(|pair| pair[0].time <= pair[1].time), "{method:?}: in order of time");
        assert!((100..2000).contains(&events.len()), "{method:?}: {}", events.len());
        for body in sim.dynamic_bodies() {
            assert!(sim.state(body).unwrap().position.is_finite());
        }
    }
}

#[test]
fn the_same_steps_give_the_same_bits_however_one_goes_through_them() {
    let scene = thesis();
    for method in STEPPING {
        let whole = {
            let mut sim = simulation(&scene, method);
            run(&mut sim, 6.0, 0.05);
            sim.hash()
        };
        let mut sim = simulation(&scene, method);
        for step in 1..=120 {
            let end = f64::from(step) * 0.05;
            sim.begin(end);
            // One piece of work at a time, with a look from inside and a copy that goes on instead.
            while sim.work(1).unwrap() != Progress::Done {
                sim = {
                    let copy = sim.snapshot();
                    let mut other = simulation(&empty(), Method::Exact);
                    other.restore(&copy);
                    other
                };
            }
            assert_eq!(sim.time(), end);
        }
        assert_eq!(sim.hash(), whole, "{method:?}");

        let mut sim = simulation(&scene, method);
        for step in 1..=120 {
            let (start, end) = (f64::from(step - 1) * 0.05, f64::from(step) * 0.05);
            sim.begin(end);
            for inside in [start + 0.01, start + 0.049, end] {
                sim.begin(inside);
                sim.finish(&mut |_, _| {}).unwrap();
                assert_eq!(sim.time(), inside);
            }
        }
        assert_eq!(sim.hash(), whole, "{method:?}: stopping inside a Δt changes nothing");

        let mut sim = simulation(&scene, method);
        run(&mut sim, 6.0, 0.025);
        assert_ne!(sim.hash(), whole, "{method:?}: Δt matters");
    }
}

#[test]
fn a_later_end_goes_on_with_a_step_of_its_own() {
    let scene = thesis();
    for method in STEPPING {
        let mut sim = simulation(&scene, method);
        sim.begin(0.05);
        sim.begin(0.08);
        sim.finish(&mut |_, _| {}).unwrap();
        let mut other = simulation(&scene, method);
        for end in [0.05, 0.08] {
            other.begin(end);
            other.finish(&mut |_, _| {}).unwrap();
        }
        assert_eq!((sim.time(), sim.hash()), (0.08, other.hash()));
    }
}

#[test]
fn edits_apply_inside_a_step_and_end_it() {
    let scene = empty().gravity(-10.0).ball(1, dvec3(5.0, 9.0, 5.0), DVec3::ZERO);
    for method in STEPPING {
        let mut sim = simulation(&scene, method);
        sim.begin(1.0);
        sim.begin(0.4);
        sim.finish(&mut |_, _| {}).unwrap();
        sim.apply(&SimEdit::Remove(scene.forces[0].key)).unwrap();
        sim.begin(1.0);
        sim.finish(&mut |_, _| {}).unwrap();
        // 0.4 s of fall, 0.6 s of straight flight.
        let expected = 9.0 - 5.0 * 0.16 - 4.0 * 0.6;
        assert!((state_of(&sim, 1).position.y - expected).abs() <= 1e-14, "{method:?}");
        assert!(sim.energy().residual.unwrap().abs() <= 1e-14);

        let lift =
            Force::new(7, ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: DVec3::Y * 10.0 });
        sim.apply(&SimEdit::AddForce(Box::new(lift))).unwrap();
        sim.apply(&SimEdit::AddBody(Box::new(static_ball(3, dvec3(5.0, 9.0, 5.0), 0.5)))).unwrap();
        sim.apply(&SimEdit::AddBody(Box::new(ball(4, dvec3(2.0, 9.0, 5.0), DVec3::ZERO)))).unwrap();
        let events = run(&mut sim, 4.0, 0.01);
        assert!(
            events.iter().any(|event| event.kind == EventKind::Impact),
            "{method:?}: the new body is met"
        );
        assert_eq!(sim.dynamic_count(), 2);
    }
}

#[test]
fn a_field_that_is_not_finite_is_refused_with_the_bodys_name() {
    let scene = empty().attractor(DVec3::splat(5.0), 1e308).ball(1, dvec3(5.0, 5.0, 5.0 + 1e-9), DVec3::ZERO);
    for method in STEPPING {
        let problems = Simulation::with_method(&scene, method).unwrap_err().problems;
        assert!(problems[0].message.contains("body 1") && problems[0].is_error(), "{problems:?}");
    }
}
