//! See-through walls: a plate that stands between the eye and the scene is drawn as glass and not picked,
//! so that a closed box shows its inside from everywhere.
//!
//! A *wall* is a plate with the whole scene on one side of it: a plate at the map's border, or a large one
//! with the centres of all other bodies on one side. Other plates hide little and stay solid.

use glam::DVec3;

use super::stage::{Posed, Stage};
use super::{Bounds, Camera, Projection, ViewInput};
use crate::scene::{Body, NodeKey, Shape, rotation_matrix};

/// How far past a wall the scene may reach, over the size of the scene: walls meet at their edges and
/// files write rotations with six digits.
const TOLERANCE: f64 = 1e-3;

/// Half diagonal of a wall inside the map over the spread of the bodies, at least.
const LEAST_SIZE: f64 = 0.4;

/// Sine of the angle below which a wall is seen edge-on: it hides nothing then, and must not flicker.
const EDGE_ON: f64 = 1e-4;

/// At most this many bodies vote, so that a scene of 100 000 plates stays quick.
const VOTERS: usize = 96;

/// What the scene's extent says about walls.
pub(super) struct Walls {
    map: Bounds,
    centers: Vec<DVec3>,
    /// Half the diagonal of the box around the centres, m.
    spread: f64,
    tolerance: f64,
}

impl Walls {
    pub fn new(map: Bounds, bodies: &[Posed<'_>]) -> Self {
        let stride = bodies.len().div_ceil(VOTERS).max(1);
        let centers: Vec<DVec3> = bodies.iter().step_by(stride).map(|posed| posed.position).collect();
        let around = centers.iter().copied().map(Bounds::of_point).reduce(Bounds::union);
        let spread = around.map_or(0.0, |around| 0.5 * around.size().length());
        Self { map, centers, spread, tolerance: TOLERANCE * map.size().length() }
    }

    /// The unit normal of a wall towards the scene; `None` for a body that is no wall.
    pub fn inward(&self, body: &Body, position: DVec3) -> Option<DVec3> {
        let Shape::Plane { half_x, half_y } = body.shape else { return None };
        let normal = rotation_matrix(body.rotation).z_axis;
        let is_large = libm::hypot(half_x, half_y) >= LEAST_SIZE * self.spread;
        let by_bodies = || self.one_side(&self.centers, position, normal).filter(|_| is_large);
        let by_map =
            || self.one_side(&self.map.corners(), position, normal).filter(|_| self.is_in_map(position));
        by_bodies().or_else(by_map).map(|side| normal * side)
    }

    fn is_in_map(&self, position: DVec3) -> bool {
        let margin = DVec3::splat(self.tolerance);
        position.cmpge(self.map.min - margin).all() && position.cmple(self.map.max + margin).all()
    }

    /// +1 or −1: the side on which all points lie; `None` if they lie on both or in the plane.
    fn one_side(&self, points: &[DVec3], place: DVec3, normal: DVec3) -> Option<f64> {
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for point in points {
            let height = (*point - place).dot(normal);
            (low, high) = (low.min(height), high.max(height));
        }
        match (low < -self.tolerance, high > self.tolerance) {
            (false, true) => Some(1.0),
            (true, false) => Some(-1.0),
            _ => None,
        }
    }
}

/// Whether a wall with this inward normal stands between the eye and the scene.
pub(super) fn is_between(inward: DVec3, position: DVec3, camera: &Camera) -> bool {
    match camera.projection {
        Projection::Perspective => (camera.eye() - position).dot(inward) < 0.0,
        Projection::Orthographic => camera.backward().dot(inward) < -EDGE_ON,
    }
}

/// Whether the plate `key` is drawn as glass in this view.
pub fn is_see_through(input: &ViewInput<'_>, key: NodeKey) -> bool {
    let stage = Stage::new(input);
    stage.bodies.iter().any(|posed| posed.body.key == key && stage.is_see_through(posed))
}
