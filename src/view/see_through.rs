//! See-through walls: a plate that stands between the eye and the scene is drawn as glass and not picked,
//! so that a closed box shows its inside from everywhere.
//!
//! A *wall* is a plate with the whole scene on one side of it: a plate at the map's border, or a large one
//! with the centres of all static bodies on one side and of nearly all that move, for some may have left a box. Other plates
//! hide little and stay solid.

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

/// Part of the moving bodies that may lie beyond a wall, and at each end of each axis beyond what counts as the scene: those
/// that have left it.
const LEFT: f64 = 0.15;

/// At most this many bodies vote, so that a scene of 100 000 plates stays quick.
const VOTERS: usize = 96;

/// What the scene's extent says about walls.
pub(super) struct Walls {
    map: Bounds,
    /// Centres, m.
    fixed: Vec<DVec3>,
    moving: Vec<DVec3>,
    /// Half the diagonal of the box around the centres but those that have left, m.
    spread: f64,
    tolerance: f64,
}

impl Walls {
    pub fn new(map: Bounds, bodies: &[Posed<'_>]) -> Self {
        let centers = |dynamic: bool| {
            let of_kind = || bodies.iter().filter(move |posed| posed.body.is_dynamic() == dynamic);
            let stride = of_kind().count().div_ceil(VOTERS / 2).max(1);
            of_kind().step_by(stride).map(|posed| posed.position).collect::<Vec<DVec3>>()
        };
        let (fixed, moving) = (centers(false), centers(true));
        let staying = without_left(&moving);
        let around = fixed.iter().chain(&staying).copied().map(Bounds::of_point).reduce(Bounds::union);
        let spread = around.map_or(0.0, |around| 0.5 * around.size().length());
        Self { map, fixed, moving, spread, tolerance: TOLERANCE * map.size().length() }
    }

    /// The unit normal of a wall towards the scene; `None` for a body that is no wall.
    pub fn inward(&self, body: &Body, position: DVec3) -> Option<DVec3> {
        let Shape::Plane { half_x, half_y } = body.shape else { return None };
        let normal = rotation_matrix(body.rotation).z_axis;
        let is_large = libm::hypot(half_x, half_y) >= LEAST_SIZE * self.spread;
        let by_bodies = || self.side_of_bodies(position, normal).filter(|_| is_large);
        let by_map = || {
            let [below, above] = self.beside(&self.map.corners(), position, normal);
            one_side(below, above).filter(|_| self.is_in_map(position))
        };
        by_bodies().or_else(by_map).map(|side| normal * side)
    }

    fn is_in_map(&self, position: DVec3) -> bool {
        let margin = DVec3::splat(self.tolerance);
        position.cmpge(self.map.min - margin).all() && position.cmple(self.map.max + margin).all()
    }

    /// The side of a plane on which all fixed bodies lie, and nearly all that move.
    fn side_of_bodies(&self, place: DVec3, normal: DVec3) -> Option<f64> {
        let few = (LEFT * self.moving.len() as f64) as usize;
        let fixed = self.beside(&self.fixed, place, normal);
        let moving = self.beside(&self.moving, place, normal);
        let [below, above] = [0, 1].map(|side| fixed[side] + moving[side].saturating_sub(few));
        one_side(below, above)
    }

    /// How many points lie below and above a plane, of those that do not lie in it.
    fn beside(&self, points: &[DVec3], place: DVec3, normal: DVec3) -> [usize; 2] {
        let heights = || points.iter().map(|point| (*point - place).dot(normal));
        let below = heights().filter(|height| *height < -self.tolerance).count();
        [below, heights().filter(|height| *height > self.tolerance).count()]
    }
}

/// +1 or −1 for the side on which anything lies; `None` for both or none.
fn one_side(below: usize, above: usize) -> Option<f64> {
    match (below > 0, above > 0) {
        (false, true) => Some(1.0),
        (true, false) => Some(-1.0),
        _ => None,
    }
}

/// The points without those that lie at the ends along some axis, a part of them at each.
fn without_left(points: &[DVec3]) -> Vec<DVec3> {
    let few = (LEFT * points.len() as f64) as usize;
    let (mut low, mut high) = (DVec3::NEG_INFINITY, DVec3::INFINITY);
    for axis in 0..3 {
        let mut places: Vec<f64> = points.iter().map(|point| point[axis]).collect();
        places.sort_unstable_by(f64::total_cmp);
        let last = places.len().checked_sub(few + 1);
        if let (Some(first), Some(last)) = (places.get(few), last.and_then(|last| places.get(last))) {
            (low[axis], high[axis]) = (*first, *last);
        }
    }
    points.iter().copied().map(|point| point.clamp(low, high)).collect()
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
