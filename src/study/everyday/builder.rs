//! Rooms, plates and balls of everyday scenes, put together in code.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec3, dvec3};

use crate::scene::{Body, Force, ForceKind, Map, Motion, Scene, Shape, SimParams};
use crate::study::Random;

/// UserIDs below this are the walls that close the scene, their normals inwards.
pub(super) const FIRST_OBSTACLE: i64 = 10;
/// UserIDs from here on are balls.
const FIRST_BALL: i64 = 1000;
/// Mass per volume of a ball, kg/m³.
const DENSITY: f64 = 1000.0;
/// m/s².
pub(super) const GRAVITY: f64 = 9.81;
/// Tiles are about so many of the largest radii wide.
const TILE: f64 = 3.0;

/// A scene under construction.
pub(super) struct Builder {
    size: DVec3,
    /// √e: a pair's restitution is the product of two such values.
    bounce: f64,
    walls: i64,
    obstacles: i64,
    largest: f64,
    forces: Vec<Force>,
    statics: Vec<Body>,
    balls: Vec<Body>,
}

impl Builder {
    /// A map from the origin to `size`, m, in which every pair has the restitution `e`.
    pub(super) fn new(size: DVec3, e: f64) -> Self {
        Self {
            size,
            bounce: e.sqrt(),
            walls: 1,
            obstacles: FIRST_OBSTACLE,
            largest: 0.0,
            forces: Vec::new(),
            statics: Vec::new(),
            balls: Vec::new(),
        }
    }

    /// A closed room: the six walls of the map, inside gravity.
    pub(super) fn room(size: DVec3, e: f64) -> Self {
        let mut builder = Self::closed(size, e);
        builder.gravity();
        builder
    }

    /// A closed room without gravity.
    pub(super) fn closed(size: DVec3, e: f64) -> Self {
        let mut builder = Self::new(size, e);
        let half = size / 2.0;
        let walls = [
            (dvec3(half.x, 0.0, half.z), dvec3(-FRAC_PI_2, 0.0, 0.0), half.x, half.z),
            (dvec3(half.x, size.y, half.z), dvec3(FRAC_PI_2, 0.0, 0.0), half.x, half.z),
            (dvec3(0.0, half.y, half.z), dvec3(0.0, FRAC_PI_2, 0.0), half.z, half.y),
            (dvec3(size.x, half.y, half.z), dvec3(0.0, -FRAC_PI_2, 0.0), half.z, half.y),
            (dvec3(half.x, half.y, 0.0), DVec3::ZERO, half.x, half.y),
            (dvec3(half.x, half.y, size.z), dvec3(PI, 0.0, 0.0), half.x, half.y),
        ];
        for (position, rotation, half_x, half_y) in walls {
            builder.wall(position, rotation, half_x, half_y);
        }
        builder
    }

    pub(super) fn gravity(&mut self) {
        let acceleration = dvec3(0.0, -GRAVITY, 0.0);
        self.force(ForceKind::GravityPlane { position: self.size / 2.0, acceleration });
    }

    pub(super) fn force(&mut self, kind: ForceKind) {
        let id = self.forces.len() as i64 + 1;
        self.forces.push(Force::new(id, kind));
    }

    /// A plate that closes the scene; its normal, local +z, points inwards.
    pub(super) fn wall(&mut self, position: DVec3, rotation: DVec3, half_x: f64, half_y: f64) {
        let shape = Shape::Plane { half_x, half_y };
        self.statics.push(Body { rotation, ..self.body(self.walls, position, Motion::Static, shape) });
        self.walls += 1;
    }

    /// As [`Self::wall`], turned about z: `tilt` is the angle of its normal from the vertical towards +x.
    pub(super) fn tilted_wall(&mut self, position: DVec3, tilt: f64, half_along: f64, half_across: f64) {
        self.wall(position, dvec3(-FRAC_PI_2, tilt, 0.0), half_along, half_across);
    }

    /// A plate inside the scene.
    pub(super) fn plate(&mut self, position: DVec3, rotation: DVec3, half_x: f64, half_y: f64) {
        self.obstacle(position, rotation, Shape::Plane { half_x, half_y });
    }

    /// As [`Self::plate`], turned about z as [`Self::tilted_wall`] is.
    pub(super) fn tilted_plate(&mut self, position: DVec3, tilt: f64, half_along: f64, half_across: f64) {
        self.plate(position, dvec3(-FRAC_PI_2, tilt, 0.0), half_along, half_across);
    }

    /// A sphere that stays where it is.
    pub(super) fn fixed_ball(&mut self, position: DVec3, radius: f64) {
        self.obstacle(position, DVec3::ZERO, Shape::Sphere { radius });
    }

    fn obstacle(&mut self, position: DVec3, rotation: DVec3, shape: Shape) {
        self.statics.push(Body { rotation, ..self.body(self.obstacles, position, Motion::Static, shape) });
        self.obstacles += 1;
    }

    /// A ball of a usual density.
    pub(super) fn ball(&mut self, position: DVec3, radius: f64, velocity: DVec3) {
        self.weighed_ball(position, radius, velocity, DENSITY * 4.0 / 3.0 * PI * radius * radius * radius);
    }

    /// A ball of `mass` kg.
    pub(super) fn weighed_ball(&mut self, position: DVec3, radius: f64, velocity: DVec3, mass: f64) {
        let id = FIRST_BALL + self.balls.len() as i64;
        self.largest = self.largest.max(radius);
        let motion = Motion::Dynamic { mass, velocity };
        self.balls.push(self.body(id, position, motion, Shape::Sphere { radius }));
    }

    pub(super) fn finish(self) -> Scene {
        let tile = TILE * self.largest.max(1e-3);
        let tiles = (self.size / tile).ceil().clamp(DVec3::ONE, DVec3::splat(256.0));
        let mut bodies = self.statics;
        bodies.extend(self.balls);
        Scene {
            map: Map { size: self.size, tiles: tiles.to_array().map(|count| count as u32) },
            time_speed: 1.0,
            params: SimParams::default(),
            forces: self.forces,
            bodies: bodies.into(),
        }
    }

    fn body(&self, id: i64, position: DVec3, motion: Motion, shape: Shape) -> Body {
        Body { bounce: self.bounce, ..Body::new(id, position, motion, shape) }
    }
}

/// Places on a lattice, in which balls do not overlap: the middles of cubes of `pitch` metres that fill the box
/// from `low` to `high`, layer upon layer.
pub(super) fn lattice(low: DVec3, high: DVec3, pitch: f64) -> Vec<DVec3> {
    let counts = ((high - low) / pitch + 1e-9).floor().max(DVec3::ZERO);
    let [nx, ny, nz] = counts.to_array().map(|count| count as u32);
    // In the middle of the box, but from its bottom.
    let slack = (high - low - counts * pitch) / 2.0;
    let first = low + slack * dvec3(1.0, 0.0, 1.0) + DVec3::splat(pitch / 2.0);
    let mut places = Vec::new();
    for y in 0..ny {
        for z in 0..nz {
            for x in 0..nx {
                places.push(first + dvec3(f64::from(x), f64::from(y), f64::from(z)) * pitch);
            }
        }
    }
    places
}

/// `place` moved at random as far as a ball of `radius` may be in its cube of `pitch` metres.
pub(super) fn shaken(random: &mut Random, place: DVec3, radius: f64, pitch: f64) -> DVec3 {
    place + random.vector((0.49 * pitch - radius).max(0.0))
}

/// The side of the smallest cube of cells that holds `count` of them.
pub(super) fn cube_side(count: usize) -> f64 {
    libm::ceil(libm::cbrt(count as f64) - 1e-9).max(1.0)
}

/// The side of the smallest square that holds `count`.
pub(super) fn square_side(count: usize) -> f64 {
    (count as f64).sqrt().ceil().max(1.0)
}
