//! Axis-aligned boxes around what is to be seen.

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::ViewInput;
use super::stage::Stage;
use crate::scene::{Body, NodeKey, Scene, Shape, rotation_matrix};

/// An axis-aligned box in world coordinates, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub min: DVec3,
    pub max: DVec3,
}

impl Bounds {
    pub fn of_point(point: DVec3) -> Self {
        Self { min: point, max: point }
    }

    pub fn around(center: DVec3, half: DVec3) -> Self {
        Self { min: center - half, max: center + half }
    }

    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    pub fn center(self) -> DVec3 {
        // Not (min + max) / 2, which overflows at the ends of the f64 range.
        self.min + (self.max - self.min) * 0.5
    }

    pub fn size(self) -> DVec3 {
        self.max - self.min
    }

    pub fn corners(self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, low: f64, high: f64| if i & bit == 0 { low } else { high };
            DVec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            )
        })
    }
}

/// The box around a body whose centre is at `position`.
pub(super) fn body_bounds(body: &Body, position: DVec3) -> Bounds {
    match body.shape {
        Shape::Sphere { radius } => Bounds::around(position, DVec3::splat(radius)),
        Shape::Plane { half_x, half_y } => {
            let r = rotation_matrix(body.rotation);
            Bounds::around(position, r.x_axis.abs() * half_x + r.y_axis.abs() * half_y)
        }
        Shape::Unbuilt { .. } => Bounds::of_point(position),
    }
}

/// What "frame all" shows: the map and every visible body, or only the bodies named by `keys`.
pub fn scene_bounds(input: &ViewInput<'_>, keys: Option<&[NodeKey]>) -> Bounds {
    let stage = Stage::new(input);
    let keys: Option<FxHashSet<NodeKey>> = keys.map(|keys| keys.iter().copied().collect());
    let is_meant = |key: NodeKey| keys.as_ref().is_none_or(|keys| keys.contains(&key));
    let bodies = stage
        .bodies
        .iter()
        .filter(|posed| is_meant(posed.body.key))
        .map(|posed| body_bounds(posed.body, posed.position));
    let forces = input
        .scene
        .forces
        .iter()
        .filter(|force| keys.is_some() && is_meant(force.key))
        .filter_map(|force| force.kind.position())
        .map(|place| {
            Bounds::around(place, DVec3::splat(0.05 * map_bounds(input.scene).size().max_element()))
        });
    let all = bodies.chain(forces).reduce(Bounds::union);
    match (&keys, all) {
        (Some(_), Some(bounds)) => bounds,
        (None, Some(bounds)) => bounds.union(map_bounds(input.scene)),
        (_, None) => map_bounds(input.scene),
    }
}

/// The map box.
pub(super) fn map_bounds(scene: &Scene) -> Bounds {
    Bounds { min: DVec3::ZERO, max: scene.map.size }
}
