//! A scene whose lengths, times and masses are scaled by powers of two gives the scaled bits: nothing but
//! parameters of the scene decides by an absolute size.

use glam::DVec3;
use polyscene::scene::{ForceKind, Motion, Scene, Shape};
use polyscene::sim::{Event, EventKind};

use crate::common::build::{Build, Shaped, ball, empty};
use crate::common::drive::{Run, Sampling, run};
use crate::common::load::load;

/// Factors of length, time and mass.
#[derive(Clone, Copy, Debug)]
struct Scale {
    length: f64,
    time: f64,
    mass: f64,
}

impl Scale {
    fn speed(self) -> f64 {
        self.length / self.time
    }

    fn acceleration(self) -> f64 {
        self.speed() / self.time
    }

    fn scene(self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.map.size *= self.length;
        scene.params.core_radius *= self.length;
        for force in &mut scene.forces {
            match &mut force.kind {
                ForceKind::GravityPlane { position, acceleration } => {
                    *position *= self.length;
                    *acceleration *= self.acceleration();
                }
                ForceKind::GravityPoint { position, intensity } => {
                    *position *= self.length;
                    *intensity *= self.acceleration() * self.length * self.length;
                }
                ForceKind::Drag { density } => {
                    *density *= self.mass / (self.length * self.length * self.length);
                }
            }
        }
        for body in &mut scene.bodies {
            body.position *= self.length;
            match &mut body.shape {
                Shape::Sphere { radius } => *radius *= self.length,
                Shape::Plane { half_x, half_y } => {
                    *half_x *= self.length;
                    *half_y *= self.length;
                }
                Shape::Unbuilt { .. } => {}
            }
            body.spin /= self.time;
            if let Motion::Dynamic { mass, velocity } = &mut body.motion {
                *mass *= self.mass;
                *velocity *= self.speed();
            }
        }
        scene
    }

    fn event(self, event: &Event) -> Event {
        Event {
            time: event.time * self.time,
            point: event.point * self.length,
            gap: event.gap * self.length,
            impulse: event.impulse * self.mass * self.speed(),
            vn_before: event.vn_before * self.speed(),
            vn_after: event.vn_after * self.speed(),
            ..*event
        }
    }
}

/// 2^±20 in length, time and mass, one at a time and all at once.
fn scales() -> Vec<Scale> {
    let (up, down) = (1_048_576.0, 1.0 / 1_048_576.0);
    let one = Scale { length: 1.0, time: 1.0, mass: 1.0 };
    let mut scales = Vec::new();
    for factor in [up, down] {
        scales.push(Scale { length: factor, ..one });
        scales.push(Scale { time: factor, ..one });
        scales.push(Scale { mass: factor, ..one });
    }
    scales.push(Scale { length: down, time: up, mass: up });
    scales
}

/// What differs first between a run and the run of the scaled scene; `None` if all bits are the scaled ones.
fn difference(plain: &Run, scaled: &Run, scale: Scale) -> Option<String> {
    for (plain, scaled) in plain.events.iter().zip(&scaled.events) {
        let expected = scale.event(plain);
        if format!("{expected:?}") != format!("{scaled:?}") {
            return Some(format!("{expected:?} and {scaled:?}"));
        }
    }
    if plain.events.len() != scaled.events.len() {
        return Some(format!("{} events and {}", plain.events.len(), scaled.events.len()));
    }
    let bits = |v: DVec3| v.to_array().map(f64::to_bits);
    for ((body, plain), (_, scaled)) in plain.states.iter().zip(&scaled.states) {
        let same = bits(plain.position * scale.length) == bits(scaled.position)
            && bits(plain.velocity * scale.speed()) == bits(scaled.velocity);
        if !same {
            return Some(format!("{body:?}: {plain:?} and {scaled:?}"));
        }
    }
    None
}

/// Sample scenes and hard cases: either the large gases and heaps, or all others.
fn scenes(large: bool) -> Vec<String> {
    let mut names = Vec::new();
    for folder in ["", "hard"] {
        let path = crate::common::load::scene_path(folder);
        for entry in std::fs::read_dir(path).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let is_large = ["gas-1000", "pour-"].iter().any(|large| name.starts_with(large));
            if name.ends_with(".xml") && is_large == large {
                names.push(if folder.is_empty() { name } else { format!("{folder}/{name}") });
            }
        }
    }
    names.sort();
    names
}

/// Parts that share the work.
const PARTS: usize = 3;

/// Every third of the small scenes, from one on.
fn small_ones(part: usize) -> impl Iterator<Item = String> {
    scenes(false).into_iter().skip(part).step_by(PARTS)
}

fn assert_scales(names: impl Iterator<Item = String>, until: f64) {
    let mut wrong = Vec::new();
    for name in names {
        let scene = load(&name);
        let plain = run(&scene, until, Sampling::Every(until));
        for scale in scales() {
            let until = until * scale.time;
            let scaled = run(&scale.scene(&scene), until, Sampling::Every(until));
            if let Some(difference) = difference(&plain, &scaled, scale) {
                wrong.push(format!("{name}, {scale:?}: {difference}"));
                break;
            }
        }
    }
    assert!(wrong.is_empty(), "{} scenes:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn scaled_scenes_give_the_scaled_bits_1() {
    assert_scales(small_ones(0), 2.0);
}

#[test]
fn scaled_scenes_give_the_scaled_bits_2() {
    assert_scales(small_ones(1), 2.0);
}

#[test]
fn scaled_scenes_give_the_scaled_bits_3() {
    assert_scales(small_ones(2), 2.0);
}

#[test]
fn large_scenes_give_the_scaled_bits() {
    // What is poured is stepped from 0.11 s on.
    assert_scales(scenes(true).into_iter(), 0.125);
}

/// A heap of lossy balls that nothing drives, struck by one, is stepped: how long a step is must come from motion.
#[test]
fn a_heap_without_forces_gives_the_scaled_bits() {
    let heap = (0..80_i64).map(|k| {
        let cell = DVec3::new((k % 4) as f64, (k / 4 % 4) as f64, (k / 16) as f64);
        ball(k + 1, DVec3::splat(3.0) + cell, DVec3::ZERO).bounce(0.2)
    });
    let scene = heap.fold(empty(), Build::body);
    let scene = scene.body(ball(81, DVec3::new(1.5, 4.25, 5.25), 4.0 * DVec3::X).bounce(0.2));
    let plain = run(&scene, 0.5, Sampling::Every(0.5));
    assert!(plain.events.iter().any(|event| event.kind == EventKind::Dense), "{} events", plain.events.len());
    for scale in scales() {
        let until = 0.5 * scale.time;
        let scaled = run(&scale.scene(&scene), until, Sampling::Every(until));
        assert_eq!(difference(&plain, &scaled, scale), None, "{scale:?}");
    }
}
