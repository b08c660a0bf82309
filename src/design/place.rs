//! Sizes and places to begin with: round numbers for the map at hand, on the floor where there is one.

use glam::DVec3;

use super::plan::Given;
use crate::scene::{Body, Scene, Shape, rotation_matrix};

/// How much a level plate may be tilted and still be a floor, rad.
const LEVEL: f64 = 1e-6;

/// 0.5 for 0.47: a size that a person would have typed.
pub fn round(value: f64) -> f64 {
    format!("{value:.0e}").parse().unwrap_or(value)
}

/// A step that takes a copy clear of what is this large: a tenth more, as a number with two digits (1.1 for a ball of
/// 1 m), but no less than `least`.
pub(super) fn clear_step(size: f64, least: f64) -> f64 {
    let clear = size * 1.1;
    if clear > least { format!("{clear:.1e}").parse().unwrap_or(clear) } else { least }
}

/// A share of the map's smallest side, rounded.
pub(super) fn of_map(given: &Given<'_>, share: f64) -> f64 {
    round(given.scene.map.size.min_element() * share)
}

/// The height of the highest level plate below a point, or 0.
pub(super) fn floor_under(scene: &Scene, at: DVec3) -> f64 {
    plate_under(scene, at).map_or(0.0, |plate| plate.position.y)
}

/// The highest level plate below a point.
pub(super) fn plate_under(scene: &Scene, at: DVec3) -> Option<&Body> {
    let is_floor = |body: &&Body| {
        let Shape::Plane { half_x, half_y } = body.shape else { return false };
        let matrix = rotation_matrix(body.rotation);
        let is_level = (matrix.z_axis.y.abs() - 1.0).abs() < LEVEL;
        let local = matrix.transpose() * (at - body.position);
        is_level && local.x.abs() <= half_x && local.y.abs() <= half_y && body.position.y <= at.y
    };
    let floors = scene.bodies.iter().filter(is_floor);
    floors.max_by(|a, b| a.position.y.total_cmp(&b.position.y))
}

/// Where a part stands by default: in the middle of the map, on the floor.
pub(super) fn stand(given: &Given<'_>) -> DVec3 {
    let middle = given.scene.map.size / 2.0;
    DVec3::new(middle.x, floor_under(given.scene, middle), middle.z)
}
