//! Times of impact against bisection: one ball aimed at the rims of plates and spheres, along parabolas and
//! along paths through a field.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use polyscene::scene::{ForceKind, Scene};
use polyscene::study::Random;

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball};
use crate::common::drive::{Sampling, advance, impacts, run, simulation};
use crate::common::reference::reference;

/// What bends the ball's path.
#[derive(Clone, Copy, Debug)]
enum Path {
    Straight,
    Parabola,
    Field,
}

/// What the ball is aimed at.
#[derive(Clone, Copy, Debug)]
enum Target {
    Plate,
    Sphere,
    MovingSphere,
}

/// A ball aimed at, or just past, the rim of one target.
fn shot(random: &mut Random, path: Path, target: Target) -> Scene {
    let mut scene = empty();
    if !matches!(path, Path::Straight) {
        scene =
            scene.force(ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: random.vector(12.0) });
    }
    if matches!(path, Path::Field) {
        scene = scene.attractor(random.vector(3.0), random.range(-6.0, 6.0)).air(random.range(0.0, 4.0));
    }
    let (centre, size) = (random.vector(2.0), random.range(0.2, 1.5));
    scene = scene.body(match target {
        Target::Plate => plate(1, centre, random.vector(PI), size, random.range(0.2, 1.5)),
        Target::Sphere => static_ball(1, centre, size),
        Target::MovingSphere => ball(1, centre, random.vector(2.0)).radius(size).mass(random.range(0.1, 9.0)),
    });
    let radius = random.range(0.05, 0.6);
    let start = centre + random.vector(1.0).normalize() * (4.0 + size);
    let aim = centre + random.vector(1.0).normalize() * (size + radius * random.range(0.0, 1.2));
    let velocity = (aim - start).normalize() * random.range(2.0, 25.0);
    scene.body(ball(2, start, velocity).radius(radius).mass(random.range(0.1, 9.0)))
}

#[test]
fn first_contacts_agree_with_bisection() {
    let (mut hits, mut random) = (0, Random::new(99));
    for path in [Path::Straight, Path::Parabola, Path::Field] {
        for target in [Target::Plate, Target::Sphere, Target::MovingSphere] {
            for shot_number in 0..60 {
                let scene = shot(&mut random, path, target);
                let mut reference = reference(&scene);
                let events = run(&scene, 2.0, Sampling::Every(2.0)).events;
                let expected = reference.next_impact(2.0).expect("finite");
                let got = impacts(&events).first().copied().copied();
                let what = format!("{path:?}, {target:?}, shot {shot_number}: {got:?} and {expected:?}");
                let (Some(got), Some(expected)) = (got, expected) else {
                    assert!(got.is_none() && expected.is_none(), "{what}");
                    continue;
                };
                hits += 1;
                // A rounding of 1e-14 m is crossed in 1e-14 / v_n seconds.
                let tolerance = 1e-13 + 2e-14 / got.vn_before.abs();
                assert!((got.time - expected.time).abs() <= tolerance, "{what}");
                assert!((got.normal - expected.normal).length() <= 1e-9, "{what}");
                assert!((got.point - expected.point).length() <= 1e-10, "{what}");
                assert!((got.impulse / expected.impulse - 1.0).abs() <= 1e-8, "{what}");
            }
        }
    }
    assert!((200..500).contains(&hits), "{hits} hits of 540 shots: aim better");
}

/// Symptom: a ball that fell along a wall that it touched took seconds, in which nothing happened. Expected: one short
/// search for every segment. Cause: through a field the bound of the acceleration let a gap that stays zero be
/// stepped along in steps of √(rounding / acceleration).
#[test]
fn a_ball_that_falls_along_a_wall_through_a_field_is_searched_for_once_per_segment() {
    for gap in [0.0, 1e-15, 1e-13] {
        let place = DVec3::new(4.5 - gap, 8.0, 5.0);
        let scene = empty()
            .tiles([1; 3])
            .gravity(-9.8)
            .attractor(DVec3::new(place.x, -30.0, 5.0), 50.0)
            .plate(1, DVec3::splat(5.0), DVec3::new(0.0, -FRAC_PI_2, 0.0), 5.0, 5.0)
            .body(ball(2, place, DVec3::new(0.0, 0.0, 0.3)));
        let mut sim = simulation(&scene);
        let events = advance(&mut sim, 2.0, Sampling::Every(2.0));
        assert!(events.is_empty(), "{events:?}");
        let counters = sim.counters();
        assert!(counters.segments > 1, "a field");
        assert!(counters.pair_tests <= counters.segments + 1, "{counters:?}");
    }
}
