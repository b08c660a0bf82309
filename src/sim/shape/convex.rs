//! What is to be known about any convex shape.

use glam::DVec3;

use super::near::Near;

/// What is to be known about a convex shape. A plate lies where its own numbers say; others are placed `at` a
/// point, m.
pub(in crate::sim) trait Convex {
    /// Kind of pair that it makes with a dynamic sphere, for people.
    fn pair_name(&self) -> &'static str;

    /// Axis-aligned bounds, m.
    fn bounds(&self, at: DVec3) -> (DVec3, DVec3);

    /// Whether it touches an axis-aligned box. It may say so of a box that it misses by a rounding.
    fn touches_box(&self, at: DVec3, low: DVec3, high: DVec3) -> bool;

    /// What a point sees of it: the nearest feature.
    fn nearest(&self, at: DVec3, point: DVec3) -> Near;

    /// Whether it is one part, which bends alike everywhere.
    fn is_one_part(&self) -> bool {
        false
    }

    /// The sides of its flat faces: a body lies on a face where axis·x ≤ limit for each (axis, limit in m).
    fn sides(&self) -> Vec<(DVec3, f64)> {
        Vec::new()
    }
}
