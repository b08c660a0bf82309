//! Random scenes against all pairs, the reference and conservation laws.

use std::f64::consts::PI;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, ForceKind, Motion, Scene};
use polyscene::sim::{EventKind, Simulation};

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball};
use crate::common::drive::{Promise, Sampling, run, simulation, was_stepped, watch};
use crate::common::load::load;
use crate::common::reference::{reference, with_settings};
use polyscene::study::reference::geometry::Surface;
use polyscene::study::reference::{End, ReferenceSettings};
use polyscene::study::{OverlapMonitor, Random};

/// What a random scene is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contents {
    /// No losses: uniform gravity and an attractor.
    Elastic,
    /// Uniform gravity, statics with bounces in 0..1: balls come to rest on them, but not on each other.
    LossyStatics,
    /// Uniform gravity, bounces anywhere in 0..1.
    Lossy,
    /// Gravity, an attractor, air, bounces of 0, anything and 1.
    Everything,
}

/// Seven spheres and six plates and static spheres in a closed box, nothing nearer than 1 cm.
pub fn random_scene(seed: u64, contents: Contents) -> Scene {
    let mut random = Random::new(seed);
    let gravity = random.vector(6.0) - DVec3::Y * 5.0;
    let uniform = ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: gravity };
    let mut scene = empty().walls(1).force(uniform);
    let wall_bounce = if contents == Contents::LossyStatics { 0.6 } else { 1.0 };
    scene.bodies.iter_mut().for_each(|wall| wall.bounce = wall_bounce);
    if matches!(contents, Contents::Elastic | Contents::Everything) {
        scene = scene.attractor(dvec3(5.0, 4.0, 6.0), random.range(-4.0, 8.0));
    }
    if contents == Contents::Everything {
        scene = scene.air(random.range(0.0, 20.0));
    }
    let bounce = |random: &mut Random, is_static: bool| match contents {
        Contents::Elastic => 1.0,
        Contents::LossyStatics => {
            if is_static {
                random.unit()
            } else {
                1.0
            }
        }
        Contents::Lossy => random.unit(),
        Contents::Everything => [0.0, random.unit(), 1.0][random.below(3)],
    };
    for id in 10..14 {
        let rotation = random.vector(PI);
        let (position, half) =
            (DVec3::splat(5.0) + random.vector(3.5), [0, 1].map(|_| random.range(0.3, 2.0)));
        scene = scene.body(plate(id, position, rotation, half[0], half[1]).bounce(bounce(&mut random, true)));
    }
    for id in 14..16 {
        let position = DVec3::splat(5.0) + random.vector(4.0);
        scene =
            scene.body(static_ball(id, position, random.range(0.2, 1.0)).bounce(bounce(&mut random, true)));
    }
    for id in 20..27 {
        let (radius, velocity) = (random.range(0.1, 0.8), random.vector(6.0));
        let position = free_place(&scene, radius, &mut random);
        let mass = 10.0_f64.powf(random.range(-1.5, 1.5));
        scene = scene
            .body(ball(id, position, velocity).radius(radius).mass(mass).bounce(bounce(&mut random, false)));
    }
    scene
}

/// A place inside the box where a sphere is at least 1 cm from everything.
fn free_place(scene: &Scene, radius: f64, random: &mut Random) -> DVec3 {
    let surfaces: Vec<_> = scene.bodies.iter().filter_map(Surface::of).collect();
    loop {
        let place = DVec3::splat(5.0) + random.vector(4.95 - radius);
        if surfaces.iter().all(|surface| surface.gap(place, radius).distance > 0.01) {
            return place;
        }
    }
}

#[test]
fn elastic_scenes_agree_with_the_reference() {
    for seed in 0..10 {
        let scene = random_scene(seed, Contents::Elastic);
        let [mut reference, mut check] = [0.2, 0.07].map(|stride| {
            with_settings(&scene, ReferenceSettings { stride, ..ReferenceSettings::default() })
        });
        let events = run(&scene, 3.0, Sampling::Every(1.0 / 60.0)).events;
        let sim = simulation(&scene);
        assert!(events.len() >= 10, "seed {seed}: only {} events", events.len());
        for event in &events {
            let (impact, again) =
                (reference.next_impact(4.0).ok().flatten(), check.next_impact(4.0).ok().flatten());
            let (impact, again) = (impact.expect("as many impacts"), again.expect("as many impacts"));
            // The scene is chaotic: compare as far as the reference agrees with itself.
            if (impact.time - again.time).abs() > 1e-11 || (impact.a, impact.b) != (again.a, again.b) {
                break;
            }
            let b = event.b.expect("an impact has two bodies");
            let labels = [sim.label(event.a), sim.label(b)];
            assert_eq!(
                labels,
                [impact.a.to_string(), impact.b.to_string()],
                "seed {seed}: {event:?} {impact:?}"
            );
            assert!((event.time - impact.time).abs() <= 1e-8, "seed {seed}: {event:?} {impact:?}");
            assert!((event.point - impact.point).length() <= 1e-7, "seed {seed}: {event:?} {impact:?}");
            assert!((event.normal - impact.normal).length() <= 1e-6, "seed {seed}: {event:?} {impact:?}");
        }
    }
}

#[test]
fn lossy_scenes_begin_like_the_reference() {
    for seed in 0..20 {
        let scene = random_scene(seed, Contents::Lossy);
        let mut reference = reference(&scene);
        let events = run(&scene, 1.0, Sampling::Every(1.0 / 60.0)).events;
        let sim = simulation(&scene);
        for event in events.iter().take(12) {
            // The last of many bounces are too weak to compare, and the reference knows no rest.
            if event.kind != EventKind::Impact || event.vn_before > -1e-3 {
                break;
            }
            let impact = match reference.next_impact(2.0) {
                Err(End::LastingContact) => break,
                other => other.expect("finite").expect("as many impacts"),
            };
            let b = event.b.expect("an impact has two bodies");
            let labels = [sim.label(event.a), sim.label(b)];
            assert_eq!(
                labels,
                [impact.a.to_string(), impact.b.to_string()],
                "seed {seed}: {event:?} {impact:?}"
            );
            assert!((event.time - impact.time).abs() <= 1e-8, "seed {seed}: {event:?} {impact:?}");
            let impulse = (event.impulse / impact.impulse - 1.0).abs();
            assert!(impulse <= 1e-6, "seed {seed}: {event:?} {impact:?}");
        }
    }
}

/// Kinetic and potential energy from what can be seen from outside.
fn energy(sim: &Simulation, scene: &Scene) -> f64 {
    let dynamics = scene.bodies.iter().filter_map(|body| match body.motion {
        Motion::Dynamic { mass, .. } => Some((body.key, mass)),
        Motion::Static => None,
    });
    let one = |(key, mass): (_, f64)| {
        let state = sim.find(key).and_then(|body| sim.state(body)).expect("a body got lost");
        let potential = scene.forces.iter().map(|force| match force.kind {
            ForceKind::GravityPlane { acceleration, .. } => -acceleration.dot(state.position),
            ForceKind::GravityPoint { position, intensity } => {
                -intensity / (position - state.position).length()
            }
            ForceKind::Drag { .. } => 0.0,
        });
        mass * (state.velocity.length_squared() / 2.0 + potential.sum::<f64>())
    };
    dynamics.map(one).sum()
}

/// No overlap, energy never up, the residual small, everything inside and finite.
pub fn assert_sound(scene: &Scene, until: f64, what: &str) {
    let monitor = OverlapMonitor::in_id_order(scene);
    let mut sim = simulation(scene);
    let steps = Promise::of_steps(&sim, scene);
    let mut last = energy(&sim, scene);
    let mut scale = last.abs();
    watch(&mut sim, until, Sampling::Random(17), |sim, _| {
        let t = sim.time();
        let promise = if was_stepped(sim) { steps } else { Promise { overlap: 1e-9, climb: 0.0 } };
        let overlap = monitor.worst_now(sim);
        assert!(overlap <= promise.overlap, "{what}, t {t}: overlap {overlap:e} m");
        let escape = monitor.worst_escape(sim, &[1, 2, 3, 4, 5, 6]);
        assert!(escape <= promise.overlap, "{what}, t {t}: {escape:e} m through a wall");
        let now = energy(sim, scene);
        scale = scale.max(now.abs()).max(sim.energy().kinetic);
        assert!(now <= last + promise.climb + 1e-10 * scale, "{what}, t {t}: energy up from {last} to {now}");
        last = now;
        let residual = sim.energy().residual.expect("built-in forces have a balance");
        assert!(residual.abs() <= 1e-9, "{what}, t {t}: residual {residual:e}");
    });
}

#[test]
fn elastic_scenes_stay_sound() {
    for seed in 100..112 {
        assert_sound(&random_scene(seed, Contents::Elastic), 5.0, &format!("seed {seed}"));
    }
}

#[test]
fn scenes_of_lossy_statics_stay_sound_and_come_to_an_end() {
    for seed in 400..420 {
        assert_sound(&random_scene(seed, Contents::LossyStatics), 8.0, &format!("seed {seed}"));
    }
}

#[test]
fn lossy_scenes_stay_sound_and_come_to_an_end() {
    for seed in 200..220 {
        assert_sound(&random_scene(seed, Contents::Lossy), 3.5, &format!("seed {seed}"));
    }
}

#[test]
fn scenes_of_everything_stay_sound() {
    // In 314 the air lets a ball spiral into the attractor, where it circles a million times a second.
    for seed in (300..320).filter(|seed| *seed != 314) {
        assert_sound(&random_scene(seed, Contents::Everything), 2.5, &format!("seed {seed}"));
    }
}

#[test]
fn gas_stays_sound() {
    let scene = load("gas.xml");
    assert_sound(&scene, 2.0, "gas");
    let mut sim = simulation(&scene);
    let start = sim.energy().kinetic;
    watch(&mut sim, 10.0, Sampling::Every(10.0), |_, _| ());
    let drift = sim.energy().kinetic / start - 1.0;
    assert!(drift.abs() <= 1e-12, "energy drift {drift:e}");
}

#[test]
fn free_gas_keeps_its_momentum() {
    let mut scene = load("gas.xml");
    scene.bodies.retain(Body::is_dynamic);
    let mut sim = simulation(&scene);
    let start = sim.momentum().value;
    watch(&mut sim, 5.0, Sampling::Every(0.5), |sim, _| {
        let change = (sim.momentum().value - start).length();
        assert!(change <= 1e-9, "t {}: momentum changed by {change:e}", sim.time());
        assert!(sim.momentum().residual <= 1e-12, "t {}: {:e}", sim.time(), sim.momentum().residual);
    });
}

/// Symptom: an elastic gas of balls of 0.5 m gained 1.5e-13 of its energy in 2000 impacts of each ball, and gases of most
/// other radii a tenth of that. Expected: what roundings add up to by chance, some 1e-15. Cause: where balls touch at
/// 1 m, the root of the squared distance is rounded down, so that normals were longer than 1.
#[test]
fn elastic_gas_of_balls_that_touch_at_one_meter_keeps_its_energy() {
    let mut random = Random::new(5);
    let mut scene = empty().walls(1);
    for id in 0..125 {
        let place = DVec3::from([id % 5, id / 5 % 5, id / 25].map(|index| 1.8 * index as f64 + 1.4));
        scene = scene.body(ball(100 + id, place, random.vector(2.0)));
    }
    let mut sim = simulation(&scene);
    sim.begin(1000.0);
    let mut impacts = 0;
    while impacts < 60_000 && sim.next_event().expect("it runs").is_some() {
        impacts += 1;
    }
    let residual = sim.energy().residual.expect("no forces");
    assert!(impacts == 60_000 && residual.abs() <= 1e-14, "{residual:e} after {impacts} impacts");
}
