//! Scenes of contact, each from a seed: seams, corners, squeezes, slots, pits, heaps, lossy floors, at any size.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, ForceKind, Motion, Scene, Shape};
use polyscene::study::Random;

use super::build::{Build, Shaped, ball, empty, plate};

/// What a scene is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Coplanar plates, level or inclined, with no step or a tiny one from each to the next, and a ball that
    /// slides over them.
    Seam,
    /// A ball into a corner of two or three walls of unequal bounce.
    Corner,
    /// Light balls between two heavy ones that close in.
    Squeeze,
    /// Balls between two walls that leave them no room or a little, on a floor.
    Slot,
    /// Balls in a pit of four walls and a floor.
    Pit,
    /// A row of touching balls on a floor beside a wall, some of them pushed.
    WallAndFloor,
    /// Balls that lose nothing, dropped on a floor that does.
    LossyFloor,
}

impl Family {
    pub const ALL: [Self; 7] = [
        Self::Seam,
        Self::Corner,
        Self::Squeeze,
        Self::Slot,
        Self::Pit,
        Self::WallAndFloor,
        Self::LossyFloor,
    ];
}

/// A scene, how long it is worth watching, and what it may cost.
pub struct ContactScene {
    pub what: String,
    pub scene: Scene,
    /// s.
    pub until: f64,
    /// Events that its physics may need until then: with more it has stalled.
    pub most_events: u64,
}

/// Of all balls, before the scene is scaled, m.
const RADIUS: f64 = 0.5;
const GRAVITY: f64 = -9.8;
/// Events that a handful of balls may need in a few seconds until they lie: a stall makes as many in no time.
const FEW: u64 = 50_000;

/// The scene of a family and a seed, of balls of half a metre.
pub fn contact_scene(family: Family, seed: u64) -> ContactScene {
    let random = &mut Random::new(seed ^ ((family as u64) << 32));
    let (scene, until, most_events) = match family {
        Family::Seam => seam(random),
        Family::Corner => corner(random),
        Family::Squeeze => squeeze(random),
        Family::Slot => slot(random),
        Family::Pit => pit(random),
        Family::WallAndFloor => wall_and_floor(random),
        Family::LossyFloor => lossy_floor(random),
    };
    ContactScene { what: format!("{family:?}, seed {seed}"), scene, until, most_events }
}

/// What a scene stands in besides its own gravity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surroundings {
    Nothing,
    /// Air as thick as four times that on Earth.
    Air,
    /// A point attractor some metres away, with half the pull of gravity and less.
    Attractor,
    Both,
}

impl Surroundings {
    pub const ALL: [Self; 4] = [Self::Nothing, Self::Air, Self::Attractor, Self::Both];
}

/// The same scene in air or a field: all motion is integrated then.
pub fn surrounded(from: &ContactScene, by: Surroundings) -> ContactScene {
    let mut scene = from.scene.clone();
    if matches!(by, Surroundings::Air | Surroundings::Both) {
        scene = scene.air(5.0);
    }
    if matches!(by, Surroundings::Attractor | Surroundings::Both) {
        scene = scene.attractor(dvec3(0.7, -3.1, 0.4), 40.0);
    }
    let what = format!("{}, in {by:?}", from.what);
    ContactScene { what, scene, until: from.until, most_events: from.most_events }
}

/// The same scene with masses from 1 to `ratio` times as large, by a seed.
pub fn weighted(from: &ContactScene, ratio: f64, seed: u64) -> ContactScene {
    let mut random = Random::new(seed);
    let mut scene = from.scene.clone();
    for body in &mut scene.bodies {
        if let Motion::Dynamic { mass, .. } = &mut body.motion {
            *mass *= libm::pow(ratio, random.unit());
        }
    }
    let what = format!("{}, masses 1 : {ratio:e}", from.what);
    ContactScene { what, scene, until: from.until, most_events: from.most_events }
}

/// The same scene with all lengths `length` times as long and all times `time` times as long.
pub fn scaled(from: &ContactScene, length: f64, time: f64) -> ContactScene {
    let mut scene = from.scene.clone();
    scene.map.size *= length;
    scene.params.core_radius *= length;
    for body in &mut scene.bodies {
        body.position *= length;
        match &mut body.shape {
            Shape::Sphere { radius } => *radius *= length,
            Shape::Plane { half_x, half_y } => (*half_x, *half_y) = (*half_x * length, *half_y * length),
            Shape::Unbuilt { .. } => {}
        }
        if let Motion::Dynamic { velocity, .. } = &mut body.motion {
            *velocity *= length / time;
        }
    }
    for force in &mut scene.forces {
        match &mut force.kind {
            ForceKind::GravityPlane { acceleration, .. } => *acceleration *= length / (time * time),
            ForceKind::GravityPoint { position, intensity } => {
                *position *= length;
                *intensity *= length * length * length / (time * time);
            }
            ForceKind::Drag { density } => *density /= length * length * length,
        }
    }
    let what = format!("{}, lengths times {length:e}, times times {time:e}", from.what);
    ContactScene { what, scene, until: from.until * time, most_events: from.most_events }
}

fn one_of<T: Copy>(random: &mut Random, choices: &[T]) -> T {
    choices[random.below(choices.len())]
}

fn bounce(random: &mut Random) -> f64 {
    let any = random.unit();
    one_of(random, &[0.0, any, 1.0])
}

fn floor(id: i64, half: f64, bounce: f64) -> Body {
    plate(id, dvec3(0.0, 0.0, 0.0), dvec3(-FRAC_PI_2, 0.0, 0.0), half, half).bounce(bounce)
}

/// A wall at `x` that faces +x or −x.
fn wall(id: i64, x: f64, towards: f64, bounce: f64) -> Body {
    plate(id, dvec3(x, 0.0, 0.0), dvec3(0.0, towards * FRAC_PI_2, 0.0), 10.0, 10.0).bounce(bounce)
}

fn seam(random: &mut Random) -> (Scene, f64, u64) {
    const HALF: f64 = 1.0;
    let angle = one_of(random, &[0.0, 0.1, 0.5, 1.0]);
    let step = one_of(random, &[0.0, 1e-15, 1e-12, 1e-9, 1e-6]);
    let plates = 2 + random.below(4);
    // With 1 the hop that a step gives would be repeated for ever: 1e8 of them after a step of 1e-15 m.
    let lossy = one_of(random, &[0.0, 0.5, 0.9]);
    let (sin, cos) = libm::sincos(angle);
    let (along, normal) = (dvec3(cos, -sin, 0.0), dvec3(sin, cos, 0.0));
    let mut scene = empty().gravity(GRAVITY);
    for k in 0..plates {
        let up = if random.below(2) == 0 { step } else { 0.0 };
        let middle = along * (2.0 * HALF * k as f64) + normal * up;
        let rotation = dvec3(-FRAC_PI_2, angle, 0.0);
        scene = scene.body(plate(1 + k as i64, middle, rotation, HALF, HALF).bounce(lossy));
    }
    let speed = random.range(0.2, 3.0);
    (scene.ball(100, normal * RADIUS - along * 0.5, along * speed), 3.0, FEW)
}

fn corner(random: &mut Random) -> (Scene, f64, u64) {
    let walls = 2 + random.below(2);
    let mut scene = empty();
    if random.below(2) == 0 {
        scene = scene.gravity(GRAVITY);
    }
    let rotations = [dvec3(-FRAC_PI_2, 0.0, 0.0), dvec3(0.0, FRAC_PI_2, 0.0), DVec3::ZERO];
    for (id, rotation) in (1..).zip(rotations).take(walls) {
        scene = scene.body(plate(id, DVec3::ZERO, rotation, 20.0, 20.0).bounce(random.unit()));
    }
    let away = if walls == 2 { dvec3(1.0, 1.0, 0.0) } else { DVec3::ONE };
    let speed = random.range(0.5, 4.0);
    (scene.ball(100, away * RADIUS + away * random.range(0.0, 1.0), away * -speed), 4.0, FEW)
}

fn squeeze(random: &mut Random) -> (Scene, f64, u64) {
    let light = 1 + random.below(3);
    let heavy = libm::pow(10.0, random.range(0.0, 12.0));
    let far = light as f64 + 0.5;
    let mut scene = empty()
        .body(ball(1, dvec3(-far, 0.0, 0.0), DVec3::X).mass(heavy))
        .body(ball(2, dvec3(far, 0.0, 0.0), -DVec3::X).mass(heavy));
    for k in 0..light {
        let x = 1.1 * (k as f64 - (light as f64 - 1.0) / 2.0);
        scene = scene.ball(10 + k as i64, dvec3(x, 0.0, 0.0), DVec3::ZERO);
    }
    // Two heavy balls that turn round on a light one need about π√(M/m) impacts (Galperin 2003).
    (scene, 5.0, FEW + (20.0 * light as f64 * heavy.sqrt()) as u64)
}

fn slot(random: &mut Random) -> (Scene, f64, u64) {
    let room = one_of(random, &[0.0, 1e-12, 1e-6, 0.05]);
    let half = RADIUS * (1.0 + room);
    let lossy = bounce(random);
    let mut scene = empty().gravity(GRAVITY).body(floor(1, 10.0, lossy));
    scene = scene.body(wall(2, -half, 1.0, bounce(random))).body(wall(3, half, -1.0, bounce(random)));
    let mut y = RADIUS;
    for k in 0..=random.below(8) {
        y += random.range(0.0, 0.5);
        let x = (half - RADIUS) * random.range(-1.0, 1.0);
        scene = scene.ball(100 + k as i64, dvec3(x, y, 0.0), DVec3::ZERO);
        y += 2.0 * RADIUS;
    }
    (scene, 4.0, FEW)
}

fn pit(random: &mut Random) -> (Scene, f64, u64) {
    let half = random.range(0.6, 1.5);
    let lossy = bounce(random);
    let mut scene = empty().gravity(GRAVITY).body(floor(1, 10.0, lossy));
    scene = scene.body(wall(2, -half, 1.0, lossy)).body(wall(3, half, -1.0, lossy));
    for (id, z) in [(4, -half), (5, half)] {
        scene = scene.body(plate(id, dvec3(0.0, 0.0, z), DVec3::ZERO, 10.0, 10.0).bounce(lossy));
    }
    let room = half - RADIUS;
    for k in 0..=random.below(8) {
        let place = dvec3(random.range(-room, room), 0.6 + 1.1 * k as f64, random.range(-room, room));
        scene = scene.body(ball(100 + k as i64, place, DVec3::ZERO).bounce(lossy));
    }
    (scene, 4.0, FEW)
}

fn wall_and_floor(random: &mut Random) -> (Scene, f64, u64) {
    let lossy = bounce(random);
    let mut scene = empty().gravity(GRAVITY).body(floor(1, 20.0, lossy)).body(wall(2, 0.0, 1.0, lossy));
    for k in 0..=random.below(8) {
        let place = dvec3(RADIUS + k as f64, RADIUS, 0.0);
        let speed = one_of(random, &[0.0, 0.0, -1.0]);
        scene = scene.body(ball(100 + k as i64, place, DVec3::X * speed).bounce(bounce(random)));
    }
    (scene, 4.0, FEW)
}

fn lossy_floor(random: &mut Random) -> (Scene, f64, u64) {
    let mut scene = empty().gravity(GRAVITY).body(floor(1, 20.0, random.range(0.1, 0.9)));
    for k in 0..=random.below(8) {
        let place = dvec3(1.05 * k as f64 - 4.0, random.range(0.5, 3.0), 0.0);
        let push = random.range(-1.0, 1.0);
        scene = scene.ball(100 + k as i64, place, DVec3::X * push);
    }
    (scene, 6.0, FEW)
}
