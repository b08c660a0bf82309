//! Shapes: one file each with all that is known about it alone, and the table of them. Times of impact, which
//! are about two shapes, are in `predict`.

mod near;
mod plate;
mod sphere;

use glam::DVec3;

pub(super) use near::{Feature, Near, Surface};
pub(super) use plate::Plate;
pub(super) use sphere::{Sphere, direction};

/// What is to be known about a convex shape. A plate lies where its own numbers say; others are placed `at` a
/// point, m.
pub(super) trait Convex {
    /// Kind of pair that it makes with a dynamic sphere, for people.
    fn pair_name(&self) -> &'static str;

    /// Axis-aligned bounds, m.
    fn bounds(&self, at: DVec3) -> (DVec3, DVec3);

    /// Whether it touches an axis-aligned box. It may say so of a box that it misses by a rounding.
    fn touches_box(&self, at: DVec3, low: DVec3, high: DVec3) -> bool;

    /// What a point sees of it: the nearest feature.
    fn nearest(&self, at: DVec3, point: DVec3) -> Near;

    /// The sides of its flat faces: a body lies on a face where axis·x ≤ limit for each (axis, limit in m).
    fn sides(&self) -> Vec<(DVec3, f64)> {
        Vec::new()
    }
}

/// The table of shapes.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    Sphere(Sphere),
    /// Apart, so that a body stays small.
    Plate(Box<Plate>),
}

impl Shape {
    /// The table: one line for each shape.
    pub fn convex(&self) -> &dyn Convex {
        match self {
            Self::Sphere(sphere) => sphere,
            Self::Plate(plate) => &**plate,
        }
    }

    /// Radius of a sphere, m; 0 for what is none.
    pub fn radius(&self) -> f64 {
        match self {
            Self::Sphere(sphere) => sphere.radius,
            Self::Plate(_) => 0.0,
        }
    }
}
