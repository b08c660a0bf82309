//! Heaps and racks: a wedge, pegs, a hopper, stacks that are hit, a billiard table, a ramp, attractors.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};

use super::builder::{Builder, GRAVITY, cube_side, lattice, shaken, square_side};
use super::recipe::Recipe;
use crate::scene::{ForceKind, Scene};

/// Share of a radius between bodies that are meant to touch: rounding makes no overlap of it.
const TOUCH: f64 = 1e-9;

/// Dropped between two inclined plates that meet.
pub(super) fn wedge(recipe: &mut Recipe) -> Scene {
    let (radius, pitch) = sizes(recipe);
    let half_angle = recipe.random.range(0.35, 0.9);
    let (sin, cos) = libm::sincos(half_angle);
    let depth = pitch * cube_side(recipe.n);
    // So high that the upper half of it holds all of them twice.
    let height = 2.0 * pitch * cube_side(2 * recipe.n) / libm::tan(half_angle).min(1.0) + 4.0 * pitch;
    let middle = height * sin / cos;
    let size = dvec3(2.0 * middle, height, depth);
    let mut builder = Builder::new(size, recipe.e);
    builder.gravity();
    let half_along = height / cos / 2.0;
    for side in [-1.0, 1.0] {
        let at = dvec3(middle * (1.0 + side / 2.0), height / 2.0, depth / 2.0);
        // Normals have the angle 90° − α from the vertical.
        builder.tilted_wall(at, -side * (FRAC_PI_2 - half_angle), half_along, depth / 2.0);
    }
    builder.wall(dvec3(middle, height / 2.0, 0.0), DVec3::ZERO, middle, height / 2.0);
    builder.wall(dvec3(middle, height / 2.0, depth), dvec3(FRAC_PI_2 * 2.0, 0.0, 0.0), middle, height / 2.0);
    builder.wall(dvec3(middle, height, depth / 2.0), dvec3(FRAC_PI_2, 0.0, 0.0), middle, depth / 2.0);
    let clear = |at: &DVec3| at.y * sin - (at.x - middle).abs() * cos > 0.9 * pitch;
    let places = lattice(DVec3::ZERO, size, pitch).into_iter().filter(clear);
    for place in places.take(recipe.n).collect::<Vec<_>>() {
        let at = shaken(&mut recipe.random, place, radius, pitch);
        builder.ball(at, radius, DVec3::ZERO);
    }
    builder.finish()
}

/// Galton's board: a narrow room with rows of spheres and small plates, and balls above them.
pub(super) fn pegs(recipe: &mut Recipe) -> Scene {
    const ROWS: usize = 6;
    let radius = recipe.random.range(0.02, 0.05);
    let (pitch, spacing, depth) = (2.2 * radius, 5.0 * radius, 2.5 * radius);
    let columns = square_side(recipe.n).max(4.0);
    let (width, floor) = (columns * spacing, 4.0 * spacing);
    let top = floor + ROWS as f64 * spacing + spacing;
    let rows = (recipe.n as f64 / (width / pitch).floor()).ceil();
    let size = dvec3(width, top + (rows + 1.0) * pitch, depth);
    let mut builder = Builder::room(size, recipe.e);
    for row in 0..ROWS {
        let shift = if row % 2 == 0 { 0.5 } else { 1.0 };
        let mut x = shift * spacing;
        while x < width - 0.4 * spacing {
            let at = dvec3(x, floor + row as f64 * spacing, depth / 2.0);
            if recipe.random.unit() < 0.7 {
                builder.fixed_ball(at, 0.5 * radius);
            } else {
                let tilt = recipe.random.range(-1.0, 1.0);
                builder.tilted_plate(at, tilt, 0.5 * radius, depth / 2.0);
            }
            x += spacing;
        }
    }
    for place in lattice(dvec3(0.0, top, 0.0), size, pitch).into_iter().take(recipe.n) {
        let at = shaken(&mut recipe.random, place, radius, pitch);
        builder.ball(at, radius, DVec3::ZERO);
    }
    builder.finish()
}

/// Through the slot between two inclined plates into a box below.
pub(super) fn hopper(recipe: &mut Recipe) -> Scene {
    let (radius, pitch) = sizes(recipe);
    let slot = recipe.random.range(3.0, 5.0) * radius;
    let side = pitch * (cube_side(recipe.n) + 1.0) + slot;
    let tilt = recipe.random.range(0.5, 0.9);
    let (sin, cos) = libm::sincos(tilt);
    // Each plate goes from the wall down to the slot.
    let across = (side - slot) / 2.0;
    let (low, drop) = (side, across * sin / cos);
    let layers = (recipe.n as f64 / (side / pitch).floor().max(1.0) / (side / pitch).floor().max(1.0)).ceil();
    let top = low + drop + pitch;
    let size = dvec3(side, top + (layers + 1.0) * pitch, side);
    let mut builder = Builder::room(size, recipe.e);
    for way in [-1.0, 1.0] {
        let at = dvec3(side / 2.0 + way * (slot + across) / 2.0, low + drop / 2.0, side / 2.0);
        builder.tilted_plate(at, -way * tilt, across / cos / 2.0, side / 2.0);
    }
    for place in lattice(dvec3(0.0, top, 0.0), size, pitch).into_iter().take(recipe.n) {
        let at = shaken(&mut recipe.random, place, radius, pitch);
        builder.ball(at, radius, DVec3::ZERO);
    }
    builder.finish()
}

/// A pyramid, or columns, hit by a ball.
pub(super) fn stack(recipe: &mut Recipe) -> Scene {
    let radius = recipe.random.range(0.02, 0.1);
    let stacked = recipe.n.saturating_sub(1).max(1);
    let places = if recipe.random.below(2) == 0 { pyramid(stacked) } else { columns(stacked) };
    let reach = places.iter().fold(DVec3::ZERO, |reach, place| reach.max(*place));
    let room = 12.0;
    let size = (reach + dvec3(2.0 * room, room, 2.0 * room)) * radius;
    let corner = dvec3(room, 0.0, room) * radius;
    let mut builder = Builder::room(size, recipe.e);
    for place in &places {
        builder.ball(corner + *place * radius, radius, DVec3::ZERO);
    }
    if recipe.n > 1 {
        let aim = dvec3(2.0 * radius, (reach.y / 2.0).max(1.0) * radius, size.z / 2.0);
        let speed = recipe.random.range(2.0, 8.0);
        let aside = recipe.random.range(-0.1, 0.1);
        builder.ball(aim, radius, dvec3(speed, 0.0, aside));
    }
    builder.finish()
}

/// Squares of balls on each other, each ball in the dip between four below; in radii, on the floor y = 0.
fn pyramid(count: usize) -> Vec<DVec3> {
    let base = (1..).find(|side: &usize| side * (side + 1) * (2 * side + 1) / 6 >= count).unwrap_or(1);
    let step = 2.0 * (1.0 + TOUCH);
    let mut places = Vec::new();
    for layer in 0..base {
        let (side, rise) = (base - layer, step * std::f64::consts::FRAC_1_SQRT_2);
        for index in 0..side * side {
            let (x, z) = ((index % side) as f64, (index / side) as f64);
            let inset = layer as f64 / 2.0;
            places.push(dvec3((x + inset) * step, 1.0 + layer as f64 * rise, (z + inset) * step));
        }
    }
    places.truncate(count);
    places
}

/// Single files of up to ten, side by side; in radii.
fn columns(count: usize) -> Vec<DVec3> {
    const HIGH: usize = 10;
    let step = 2.0 * (1.0 + TOUCH);
    let side = square_side(count.div_ceil(HIGH)) as usize;
    let place = |index: usize| {
        let (column, level) = (index / HIGH, index % HIGH);
        dvec3((column % side) as f64 * 3.0, 1.0 + level as f64 * step, (column / side) as f64 * 3.0)
    };
    (0..count).map(place).collect()
}

/// A rack on a table with cushions, a cue ball, and other balls that roll about.
pub(super) fn table(recipe: &mut Recipe) -> Scene {
    const RACK: usize = 15;
    let radius = recipe.random.range(0.025, 0.035);
    let step = 2.0 * radius * (1.0 + TOUCH);
    let others = recipe.n.saturating_sub(1 + RACK);
    let width = 30.0 * radius + 3.0 * radius * square_side(others);
    let size = dvec3(2.0 * width, 10.0 * radius, width);
    let mut builder = Builder::room(size, recipe.e);
    let foot = dvec3(1.2 * width, radius, width / 2.0);
    let in_rack = recipe.n.saturating_sub(1).min(RACK);
    let row = |index: usize| (0..).find(|row| (row + 1) * (row + 2) / 2 > index).unwrap_or(0);
    for index in 0..in_rack {
        let own = row(index);
        let along = own as f64 * step * 3.0_f64.sqrt() / 2.0;
        let across = (index - own * (own + 1) / 2) as f64 - own as f64 / 2.0;
        builder.ball(foot + dvec3(along, 0.0, across * step), radius, DVec3::ZERO);
    }
    let cue = dvec3(width - 2.0 * radius, radius, width / 2.0 + recipe.random.range(-0.5, 0.5) * radius);
    builder.ball(cue, radius, dvec3(recipe.random.range(2.0, 8.0), 0.0, 0.0));
    // They have the head of the table to themselves.
    let pitch = 3.0 * radius;
    let high = dvec3(width - 4.0 * radius, pitch, width);
    let mut places = lattice(DVec3::ZERO, high, pitch);
    recipe.random.shuffle(&mut places);
    for place in places.into_iter().take(others) {
        let push = recipe.random.vector(1.0) * dvec3(1.0, 0.0, 1.0);
        builder.ball(dvec3(place.x, radius, place.z), radius, push);
    }
    builder.finish()
}

/// Down an incline and into a wall.
pub(super) fn ramp(recipe: &mut Recipe) -> Scene {
    let (radius, pitch) = sizes(recipe);
    let tilt = recipe.random.range(0.2, 0.8);
    let (sin, cos) = libm::sincos(tilt);
    let depth = pitch * cube_side(recipe.n);
    let length = 2.0 * depth + 10.0 * radius;
    // From (0, rise) down to (run, 0), and as much flat floor beyond.
    let (run, rise) = (length * cos, length * sin);
    let size = dvec3(1.5 * run + 4.0 * radius, rise + depth * 2.0 + 4.0 * pitch, depth);
    let mut builder = Builder::room(size, recipe.e);
    builder.tilted_plate(dvec3(run / 2.0, rise / 2.0, depth / 2.0), tilt, length / 2.0, depth / 2.0);
    let above = |at: &DVec3| at.x * sin + (at.y - rise) * cos > 0.9 * pitch && at.x < run / 2.0;
    let mut places: Vec<DVec3> = lattice(DVec3::ZERO, size, pitch).into_iter().filter(above).collect();
    // The nearest to the incline first.
    places.sort_by(|a, b| (a.x * sin + a.y * cos).total_cmp(&(b.x * sin + b.y * cos)));
    for place in places.into_iter().take(recipe.n) {
        let at = shaken(&mut recipe.random, place, radius, pitch);
        builder.ball(at, radius, DVec3::ZERO);
    }
    builder.finish()
}

/// Onto a sphere that an attractor sits in.
pub(super) fn planet(recipe: &mut Recipe) -> Scene {
    around_attractor(recipe, true)
}

/// Together around an attractor that nothing shields.
pub(super) fn cluster(recipe: &mut Recipe) -> Scene {
    around_attractor(recipe, false)
}

fn around_attractor(recipe: &mut Recipe, has_core: bool) -> Scene {
    let (radius, pitch) = sizes(recipe);
    let core = if has_core { recipe.random.range(2.0, 5.0) * radius } else { radius };
    let side = pitch * (cube_side(recipe.n) + 2.0) + 4.0 * core;
    let size = DVec3::splat(side);
    let middle = size / 2.0;
    let mut builder = Builder::closed(size, recipe.e);
    // As strong as on Earth, two radii above the core.
    let height = core + 2.0 * radius;
    builder.force(ForceKind::GravityPoint { position: middle, intensity: GRAVITY * height * height });
    if has_core {
        builder.fixed_ball(middle, core);
    }
    let clear = |at: &DVec3| (*at - middle).length() > core + pitch;
    let mut places: Vec<DVec3> = lattice(DVec3::ZERO, size, pitch).into_iter().filter(clear).collect();
    let distance = |at: &DVec3| (*at - middle).length_squared();
    places.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    for place in places.into_iter().take(recipe.n) {
        let at = shaken(&mut recipe.random, place, radius, pitch);
        builder.ball(at, radius, DVec3::ZERO);
    }
    builder.finish()
}

/// The radius of all balls, and the pitch of the lattice they start from, m.
fn sizes(recipe: &mut Recipe) -> (f64, f64) {
    let radius = recipe.random.range(0.02, 0.1);
    (radius, 2.3 * radius)
}
