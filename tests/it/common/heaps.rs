//! Heaps: balls dropped into an open box.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, Scene, Shape};
use polyscene::sim::Simulation;
use polyscene::study::Random;

use super::build::{Build, Shaped, ball, empty, plate};

/// Balls in layers above the floor of a box that is about as wide as they are many.
#[derive(Clone, Copy, Debug)]
pub struct Heap {
    pub balls: usize,
    /// Of each pair.
    pub restitution: f64,
    pub seed: u64,
    /// Radii are between this part of the largest and the whole.
    pub smallest: f64,
    /// Masses are up to so many times that of an equally dense ball.
    pub heaviest: f64,
    /// m; 0 for a box as wide as the cube root of the number.
    pub width: f64,
}

/// Radius of the largest ball, m.
pub const RADIUS: f64 = 0.05;
pub const GRAVITY: f64 = -9.81;
/// UserIDs of the floor and the walls.
pub const BOX: [i64; 5] = [10_001, 10_002, 10_003, 10_004, 10_005];
/// The corner of the box.
const CORNER: DVec3 = dvec3(2.0, 1.0, 2.0);
const HEIGHT: f64 = 6.0;

impl Heap {
    pub fn of(balls: usize, restitution: f64, seed: u64) -> Self {
        Self { balls, restitution, seed, smallest: 1.0, heaviest: 1.0, width: 0.0 }
    }

    pub fn width(&self) -> f64 {
        if self.width > 0.0 { self.width } else { (self.balls as f64).cbrt().ceil() * 2.3 * RADIUS }
    }

    pub fn scene(&self) -> Scene {
        let mut scene = self.walls(empty().gravity(GRAVITY));
        scene.map.size = DVec3::splat(8.0);
        scene.map.tiles = [40; 3];
        let mut random = Random::new(self.seed);
        let width = self.width();
        let across = ((width / (2.3 * RADIUS) + 1e-9) as usize).max(1);
        let pitch = width / across as f64;
        for k in 0..self.balls {
            let (layer, cell) = (k / (across * across), k % (across * across));
            let mut jitter = |size: f64| size * RADIUS * random.range(-0.5, 0.5);
            let at = CORNER
                + dvec3(
                    ((cell % across) as f64 + 0.5) * pitch + jitter(0.2),
                    (1.55 + 2.3 * layer as f64) * RADIUS + jitter(0.1),
                    ((cell / across) as f64 + 0.5) * pitch + jitter(0.2),
                );
            let size = random.range(self.smallest, 1.0).min(1.0);
            let mass = size.powi(3) * self.heaviest.powf(random.unit());
            let ball = ball(k as i64 + 1, at, DVec3::ZERO).radius(size * RADIUS).mass(mass);
            scene = scene.body(ball.bounce(self.restitution.sqrt()));
        }
        scene
    }

    /// How far the centre of some ball lies outside the box, m; negative when all are inside.
    pub fn escape(&self, sim: &Simulation) -> f64 {
        let width = self.width();
        let size = dvec3(width, HEIGHT, width);
        let states = sim.dynamic_bodies().filter_map(|body| sim.state(body));
        let outside = |at: DVec3| (CORNER - at).max(at - CORNER - size).max_element();
        states.map(|state| outside(state.position)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Deepest overlap of balls with each other and with the box, over the radius of the smaller.
    pub fn overlap(&self, sim: &Simulation, scene: &Scene) -> f64 {
        let balls: Vec<(DVec3, f64)> = scene.bodies.iter().filter_map(|body| placed(sim, body)).collect();
        let width = self.width();
        let mut worst = f64::NEG_INFINITY;
        for (k, (at, radius)) in balls.iter().enumerate() {
            let low = *at - CORNER;
            let high = CORNER + dvec3(width, HEIGHT, width) - *at;
            worst = worst.max((radius - low.min(high).min_element()) / radius);
            for (other, other_radius) in &balls[k + 1..] {
                let depth = radius + other_radius - at.distance(*other);
                worst = worst.max(depth / radius.min(*other_radius));
            }
        }
        worst
    }

    fn walls(&self, scene: Scene) -> Scene {
        let (width, middle) = (self.width(), CORNER + 0.5 * dvec3(self.width(), HEIGHT, self.width()));
        let side = dvec3(0.0, FRAC_PI_2, 0.0);
        let plates = [
            (dvec3(middle.x, CORNER.y, middle.z), dvec3(FRAC_PI_2, 0.0, 0.0), width, width),
            (dvec3(CORNER.x, middle.y, middle.z), side, width, HEIGHT),
            (dvec3(CORNER.x + width, middle.y, middle.z), side, width, HEIGHT),
            (dvec3(middle.x, middle.y, CORNER.z), DVec3::ZERO, width, HEIGHT),
            (dvec3(middle.x, middle.y, CORNER.z + width), DVec3::ZERO, width, HEIGHT),
        ];
        let bounce = self.restitution.sqrt();
        let plates = BOX.into_iter().zip(plates);
        plates.fold(scene, |scene, (id, (at, rotation, half_x, half_y))| {
            scene.body(plate(id, at, rotation, half_x, half_y).bounce(bounce))
        })
    }
}

/// Where a ball is, and its radius.
fn placed(sim: &Simulation, body: &Body) -> Option<(DVec3, f64)> {
    match body.shape {
        Shape::Sphere { radius } => Some((sim.state(sim.find(body.key)?)?.position, radius)),
        Shape::Plane { .. } | Shape::Unbuilt { .. } => None,
    }
}
