//! The reference against closed forms and itself: it must be right before it may judge.

use std::f64::consts::PI;

use glam::{DVec3, dvec3};

use crate::common::build::{Build, Shaped, ball, empty, static_ball, thesis};
use crate::common::reference::{reference, with_settings};
use crate::sim_chain::counting_pi;
use polyscene::study::reference::{End, Settings};

#[test]
fn kepler_orbit_closes() {
    // a = 2.5 m, e = 0.6, G = 10 m³/s²: T = 2π·√(a³/G) = 2.5π s.
    let scene = empty()
        .attractor(DVec3::splat(5.0), 10.0)
        .body(ball(1, dvec3(6.0, 5.0, 5.0), dvec3(0.0, 0.0, -4.0)).radius(0.15));
    let mut reference = reference(&scene);
    assert!(reference.next_impact(25.0 * PI) == Ok(None));
    let orbiter = reference.ball(1).expect("ball 1");
    assert!((orbiter.position.value - dvec3(6.0, 5.0, 5.0)).length() < 1e-12, "{orbiter:?}");
    assert!((orbiter.velocity.value - dvec3(0.0, 0.0, -4.0)).length() < 1e-12, "{orbiter:?}");
}

#[test]
fn drag_follows_the_hyperbolic_tangent() {
    let scene = empty().gravity(-9.8).air(1.276).body(ball(1, DVec3::ZERO, DVec3::ZERO).radius(0.1));
    let mut reference = reference(&scene);
    assert!(reference.next_impact(5.0) == Ok(None));
    let terminal = (2.0 * 9.8 / (0.5 * 1.276 * PI * 0.01_f64)).sqrt();
    let x = 9.8 * 5.0 / terminal;
    let fallen = terminal * terminal / 9.8 * x.cosh().ln();
    let body = reference.ball(1).expect("ball 1");
    assert!((body.velocity.value.y / (-terminal * x.tanh()) - 1.0).abs() < 1e-14, "{body:?}");
    assert!((body.position.value.y / -fallen - 1.0).abs() < 1e-14, "{body:?}");
}

#[test]
fn bounces_come_at_their_times() {
    let scene = empty().gravity(-9.8).floor(1, 3.0).ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO);
    let impacts = reference(&scene).impacts(10.0).expect("finite");
    let first = (2.0 * 4.5 / 9.8_f64).sqrt();
    assert_eq!(impacts.len(), 5);
    for (k, impact) in impacts.iter().enumerate() {
        assert!((impact.time - first * (2 * k + 1) as f64).abs() < 1e-13, "{impact:?}");
        assert!((impact.normal - DVec3::Y).length() < 1e-15, "{impact:?}");
        assert!((impact.impulse - 2.0 * 9.8 * first).abs() < 1e-12, "{impact:?}");
    }
}

#[test]
fn spheres_meet_where_geometry_says() {
    // An offset of 0.6 between centres that touch at 1: the line of centres leans by (0.8, 0.6).
    let scene = empty()
        .ball(1, dvec3(1.0, 5.0, 5.0), dvec3(2.0, 0.0, 0.0))
        .body(static_ball(2, dvec3(5.0, 5.6, 5.0), 0.5))
        .ball(3, dvec3(8.2, 4.4, 5.0), dvec3(-4.0, 0.0, 0.0));
    let impacts = reference(&scene).impacts(1.6).expect("finite");
    assert_eq!(impacts.len(), 1);
    let (hit, gap_closed_at) = (impacts[0], (7.2 - 0.8) / 6.0);
    assert_eq!((hit.a, hit.b), (1, 3));
    assert!((hit.time - gap_closed_at).abs() < 1e-15, "{hit:?}");
    assert!((hit.normal - dvec3(0.8, -0.6, 0.0)).length() < 1e-14, "{hit:?}");
}

#[test]
fn energy_stays_on_the_thesis_scene() {
    let mut reference = reference(&thesis());
    assert!((reference.energy() - 47.0107).abs() < 5e-5, "{}", reference.energy());
    let start = reference.energy();
    let impacts = reference.impacts(20.0).expect("finite");
    assert!((60..110).contains(&impacts.len()), "{} impacts", impacts.len());
    let drift = (reference.energy() / start - 1.0).abs();
    assert!(drift < 1e-11, "energy drift {drift:e}");
}

#[test]
fn thirty_events_do_not_depend_on_the_step() {
    let [coarse, fine] = [0.3, 0.05].map(|stride| {
        let mut reference = with_settings(&thesis(), Settings { stride, ..Settings::default() });
        (0..30).filter_map(|_| reference.next_impact(60.0).ok().flatten()).collect::<Vec<_>>()
    });
    assert_eq!((coarse.len(), fine.len()), (30, 30));
    for (left, right) in coarse.iter().zip(&fine) {
        assert_eq!((left.a, left.b), (right.a, right.b));
        assert!((left.time - right.time).abs() < 1e-10, "{left:?} {right:?}");
    }
}

#[test]
fn collisions_count_the_digits_of_pi() {
    for (k, expected) in [(0, 3), (1, 31), (2, 314), (3, 3141)] {
        assert_eq!(reference(&counting_pi(k)).impacts(20.0).expect("finite").len(), expected);
    }
}

#[test]
fn touching_balls_pass_a_blow_on() {
    let scene = (1..=5).fold(empty(), |scene, k| {
        let speed = if k == 1 { 2.0 } else { 0.0 };
        scene.ball(k, dvec3(k as f64, 5.0, 5.0), dvec3(speed, 0.0, 0.0))
    });
    for settings in [Settings::default(), Settings::check()] {
        let mut reference = with_settings(&scene, settings);
        assert_eq!(reference.impacts(1.0).expect("finite").len(), 4);
        for (k, ball) in reference.balls().iter().enumerate() {
            let expected = if k == 4 { 2.0 } else { 0.0 };
            assert!((ball.velocity.value.x - expected).abs() < 1e-15, "{ball:?}");
        }
    }
}

#[test]
fn says_where_bouncing_ends() {
    let scene =
        empty().gravity(-9.8).floor(1, 3.0).body(ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO).bounce(0.8));
    // The first fall, then bounces that take 2·0.8^k of it: nine falls in all.
    let limit = (2.0 * 4.5 / 9.8_f64).sqrt() * (1.0 + 2.0 * 0.8 / 0.2);
    let mut reference = reference(&scene);
    let ended = loop {
        match reference.next_impact(20.0) {
            Ok(Some(_)) => {}
            other => break other,
        }
    };
    assert_eq!(ended, Err(End::LastingContact));
    assert!((limit - reference.time()).abs() < 2e-4, "{} and {limit}", reference.time());
}
