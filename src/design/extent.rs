//! Boxes along the axes around bodies.

use glam::DVec3;

use crate::scene::{Body, Shape, rotation_matrix};

/// A box along the axes, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    pub min: DVec3,
    pub max: DVec3,
}

impl Extent {
    pub fn of(body: &Body) -> Self {
        let half = match body.shape {
            Shape::Sphere { radius } => DVec3::splat(radius),
            Shape::Plane { half_x, half_y } => {
                let matrix = rotation_matrix(body.rotation);
                matrix.x_axis.abs() * half_x + matrix.y_axis.abs() * half_y
            }
            Shape::Unbuilt { .. } => DVec3::ZERO,
        };
        Self { min: body.position - half, max: body.position + half }
    }

    /// Around all of these; `None` for none.
    pub fn around<'a>(bodies: impl IntoIterator<Item = &'a Body>) -> Option<Self> {
        bodies.into_iter().map(Self::of).reduce(Self::with)
    }

    pub fn with(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    pub fn size(self) -> DVec3 {
        self.max - self.min
    }

    pub fn middle(self) -> DVec3 {
        (self.min + self.max) / 2.0
    }

    pub fn moved(self, by: DVec3) -> Self {
        Self { min: self.min + by, max: self.max + by }
    }

    /// Whether two boxes share a point when both are widened by `margin` together.
    pub fn meets(self, other: Self, margin: f64) -> bool {
        let margin = DVec3::splat(margin);
        (self.min - margin).cmple(other.max).all() && (other.min - margin).cmple(self.max).all()
    }

    /// Whether the other lies inside.
    pub fn holds(self, other: Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }
}
