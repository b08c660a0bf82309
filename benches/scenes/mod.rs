//! Scenes that are made, not read: gases, piles and static spheres in any number.

use glam::{DVec3, dvec3};
use polyscene::random::Random;
use polyscene::scene::{Body, Force, ForceKind, Map, Motion, Scene, Shape, SimParams};

/// N equal spheres of 1 kg at a packing fraction in a box of 10 m, on a lattice, with velocities of 1 m/s in
/// random directions.
pub fn gas(count: u32, packing: f64) -> Scene {
    let size = 10.0_f64;
    let side = (1..).find(|side: &u32| side * side * side >= count).unwrap_or(1);
    let volume = packing * size * size * size / f64::from(count);
    let radius = libm::cbrt(0.75 * volume / std::f64::consts::PI);
    let mut bodies = walls(DVec3::ZERO, size);
    let mut random = Random::new(7);
    for index in 0..count {
        let cell = [index % side, index / side % side, index / (side * side)].map(|i| f64::from(i) + 0.5);
        let position = DVec3::from_array(cell) * (size / f64::from(side));
        let velocity = direction(&mut random);
        bodies.push(body(100 + i64::from(index), position, Motion::Dynamic { mass: 1.0, velocity }, radius));
    }
    scene(size, side, bodies)
}

/// N equal spheres of r = 5 cm and 0.5 kg dropped into a closed box that they fill to about their number's cube root
/// of layers; `e` is the restitution of a pair.
#[allow(dead_code, reason = "not every program that shares this file asks for it")]
pub fn pile(count: u32, e: f64) -> Scene {
    const RADIUS: f64 = 0.05;
    const PITCH: f64 = 2.2 * RADIUS;
    let side = (1..).find(|side: &u32| side * side * side >= count).unwrap_or(1);
    let width = f64::from(side) * PITCH;
    // Twice as high as what is dropped.
    let size = 2.0 * width;
    let mut bodies = walls(DVec3::ZERO, size);
    for (wall, x) in bodies.iter_mut().zip([0.0, width]) {
        wall.position.x = x;
    }
    for (wall, z) in bodies.iter_mut().skip(4).zip([0.0, width]) {
        wall.position.z = z;
    }
    let mut random = Random::new(11);
    for index in 0..count {
        let cell = [index % side, index / (side * side), index / side % side].map(|i| f64::from(i) + 0.5);
        let shift = random.vector(0.09 * RADIUS);
        let position = DVec3::from_array(cell) * PITCH + shift;
        let motion = Motion::Dynamic { mass: 0.5, velocity: DVec3::ZERO };
        bodies.push(body(100 + i64::from(index), position, motion, RADIUS));
    }
    for body in &mut bodies {
        body.bounce = e.sqrt();
    }
    let acceleration = dvec3(0.0, -9.81, 0.0);
    let gravity = Force::new(1, ForceKind::GravityPlane { position: DVec3::ZERO, acceleration });
    Scene { forces: vec![gravity], ..scene(size, 2 * side, bodies) }
}

/// Static spheres of r = 0.3 m on a 1 m lattice, one to a tile, in a box with walls; ten balls near its
/// middle, shut in there or not.
#[allow(dead_code, reason = "not every program that shares this file asks for it")]
pub fn lorentz_gas(count: u32, caged: bool) -> Scene {
    let side = (1..).find(|side: &u32| side * side * side >= count).unwrap_or(1);
    let size = f64::from(side);
    let middle = DVec3::splat((size / 2.0).floor());
    let mut bodies = if caged { walls(middle - 2.0, 4.0) } else { walls(DVec3::ZERO, size) };
    for index in 0..count {
        let [x, y, z] = [index % side, index / side % side, index / (side * side)].map(f64::from);
        let position = dvec3(x, y, z) + 0.5;
        bodies.push(body(10_000 + i64::from(index), position, Motion::Static, 0.3));
    }
    let mut random = Random::new(42);
    for index in 0..10 {
        // Lattice corners have room for a ball.
        let corner =
            middle + dvec3(f64::from(index % 3) - 1.0, f64::from(index / 3 % 3) - 1.0, f64::from(index / 9));
        let velocity = 5.0 * direction(&mut random);
        bodies.push(body(100 + i64::from(index), corner, Motion::Dynamic { mass: 1.0, velocity }, 0.1));
    }
    scene(size, side, bodies)
}

fn scene(size: f64, tiles: u32, bodies: Vec<Body>) -> Scene {
    Scene {
        map: Map { size: DVec3::splat(size), tiles: [tiles; 3] },
        time_speed: 1.0,
        params: SimParams::default(),
        forces: Vec::new(),
        bodies: bodies.into(),
    }
}

fn body(id: i64, position: DVec3, motion: Motion, radius: f64) -> Body {
    Body::new(id, position, motion, Shape::Sphere { radius })
}

fn walls(corner: DVec3, size: f64) -> Vec<Body> {
    let (half, right_angle) = (0.5 * size, std::f64::consts::FRAC_PI_2);
    let places = [
        (dvec3(0.0, half, half), dvec3(0.0, right_angle, 0.0)),
        (dvec3(size, half, half), dvec3(0.0, right_angle, 0.0)),
        (dvec3(half, 0.0, half), dvec3(right_angle, 0.0, 0.0)),
        (dvec3(half, size, half), dvec3(right_angle, 0.0, 0.0)),
        (dvec3(half, half, 0.0), DVec3::ZERO),
        (dvec3(half, half, size), DVec3::ZERO),
    ];
    (1..)
        .zip(places)
        .map(|(id, (position, rotation))| Body {
            rotation,
            shape: Shape::Plane { half_x: half, half_y: half },
            ..body(id, corner + position, Motion::Static, 1.0)
        })
        .collect()
}

fn direction(random: &mut Random) -> DVec3 {
    loop {
        let v = random.vector(1.0);
        if v.length_squared() <= 1.0 && v.length_squared() > 0.01 {
            return v.normalize();
        }
    }
}
