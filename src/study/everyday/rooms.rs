//! Balls in rooms and boxes: far apart, poured, in one layer, unlike masses, in air, as a gas.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};

use super::builder::{Builder, cube_side, lattice, shaken, square_side};
use super::recipe::Recipe;
use crate::scene::{ForceKind, Scene};

/// Dropped far apart into a big room.
pub(super) fn hall(recipe: &mut Recipe) -> Scene {
    let Recipe { n, e, random } = recipe;
    let largest = random.range(0.03, 0.1);
    let pitch = random.range(6.0, 12.0) * largest;
    let side = pitch * (cube_side(*n) + 1.0);
    let size = DVec3::splat(side);
    let mut builder = Builder::room(size, *e);
    let mut places = lattice(DVec3::ZERO, size, pitch);
    random.shuffle(&mut places);
    for place in places.into_iter().take(*n) {
        let radius = random.range(0.02_f64.min(largest), largest);
        let at = shaken(random, place, radius, pitch);
        builder.ball(at, radius, random.vector(1.0));
    }
    builder.finish()
}

/// Poured into an open box that stands in a room; what flies over its walls stays in the room.
pub(super) fn crate_of_balls(recipe: &mut Recipe) -> Scene {
    let (radius, pitch, side) = poured_sizes(recipe);
    let height = 0.8 * side;
    let layers = (recipe.n as f64 / (side / pitch * (side / pitch))).ceil();
    let size = dvec3(3.0 * side, height + (layers + 2.0) * pitch, 3.0 * side);
    let mut builder = Builder::room(size, recipe.e);
    let (middle, half) = (size / 2.0, side / 2.0);
    for (way, turn) in [(-DVec3::X, FRAC_PI_2), (DVec3::X, -FRAC_PI_2)] {
        let at = dvec3(middle.x, height / 2.0, middle.z) + way * half;
        builder.plate(at, dvec3(0.0, turn, 0.0), half, height / 2.0);
    }
    for way in [-DVec3::Z, DVec3::Z] {
        let at = dvec3(middle.x, height / 2.0, middle.z) + way * half;
        builder.plate(at, DVec3::ZERO, half, height / 2.0);
    }
    let low = dvec3(middle.x - half, radius, middle.z - half);
    pour(recipe, &mut builder, low, low + dvec3(side, size.y - 2.0 * radius, side), radius, pitch);
    builder.finish()
}

/// One layer dropped into a flat box.
pub(super) fn tray(recipe: &mut Recipe) -> Scene {
    let radius = recipe.random.range(0.02, 0.1);
    let pitch = recipe.random.range(2.3, 3.5) * radius;
    let side = pitch * square_side(recipe.n);
    let size = dvec3(side, 6.0 * radius, side);
    let mut builder = Builder::room(size, recipe.e);
    for place in lattice(DVec3::ZERO, dvec3(side, pitch, side), pitch).into_iter().take(recipe.n) {
        let own = radius * recipe.random.range(0.7, 1.0);
        let at = shaken(&mut recipe.random, place, own, pitch);
        let push = recipe.random.vector(1.0);
        builder.ball(at, own, push);
    }
    builder.finish()
}

/// A closed box of balls whose masses are up to a million times as large as others.
pub(super) fn mixed(recipe: &mut Recipe) -> Scene {
    let radius = recipe.random.range(0.05, 0.1);
    let pitch = 2.1 * radius;
    let side = pitch * (cube_side(recipe.n) + 0.5);
    let size = dvec3(side, 2.0 * side, side);
    let mut builder = Builder::room(size, recipe.e);
    let spread = recipe.random.range(2.0, 6.0);
    for place in lattice(DVec3::ZERO, size, pitch).into_iter().take(recipe.n) {
        let own = radius * recipe.random.range(0.4, 1.0);
        let mass = 0.01 * libm::pow(10.0, recipe.random.range(0.0, spread));
        let at = shaken(&mut recipe.random, place, own, pitch);
        builder.weighed_ball(at, own, DVec3::ZERO, mass);
    }
    builder.finish()
}

/// Poured into a box full of air.
pub(super) fn drag(recipe: &mut Recipe) -> Scene {
    let (radius, pitch, side) = poured_sizes(recipe);
    let layers = (recipe.n as f64 / (side / pitch * (side / pitch))).ceil();
    let size = dvec3(side, (layers + 4.0) * pitch, side);
    let mut builder = Builder::room(size, recipe.e);
    // Up to a tenth of water's: a ball's terminal speed is some metres a second then.
    let density = recipe.random.range(1.0, 100.0);
    builder.force(ForceKind::Drag { density });
    pour(recipe, &mut builder, DVec3::Y * radius, size, radius, pitch);
    builder.finish()
}

/// A gas in a closed box, without gravity.
pub(super) fn gas(recipe: &mut Recipe) -> Scene {
    let radius = recipe.random.range(0.02, 0.1);
    let pitch = recipe.random.range(2.3, 4.0) * radius;
    let size = DVec3::splat(pitch * cube_side(recipe.n));
    let mut builder = Builder::closed(size, recipe.e);
    for place in lattice(DVec3::ZERO, size, pitch).into_iter().take(recipe.n) {
        let own = radius * recipe.random.range(0.7, 1.0);
        let at = shaken(&mut recipe.random, place, own, pitch);
        let random = &mut recipe.random;
        builder.ball(at, own, dvec3(random.normal(), random.normal(), random.normal()));
    }
    builder.finish()
}

/// The largest radius, the pitch of the lattice that balls are poured from, and the side of a box for them, m.
fn poured_sizes(recipe: &mut Recipe) -> (f64, f64, f64) {
    let radius = recipe.random.range(0.02, 0.1);
    let pitch = 2.2 * radius;
    (radius, pitch, pitch * cube_side(recipe.n))
}

/// Fills a box from its bottom with balls of about `radius`.
fn pour(recipe: &mut Recipe, builder: &mut Builder, low: DVec3, high: DVec3, radius: f64, pitch: f64) {
    let alike = recipe.random.below(2) == 0;
    for place in lattice(low, high, pitch).into_iter().take(recipe.n) {
        let own = if alike { radius } else { radius * recipe.random.range(0.6, 1.0) };
        let at = shaken(&mut recipe.random, place, own, pitch);
        builder.ball(at, own, DVec3::ZERO);
    }
}
