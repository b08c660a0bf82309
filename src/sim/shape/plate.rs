//! The plate: a bounded plane. The distance to it covers two faces, four edges and four corners.

use glam::DVec3;

use super::convex::Convex;
use super::near::{Feature, Near};

/// A bounded plane in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) struct Plate {
    pub center: DVec3,
    /// Unit vectors of its own frame.
    pub axis_x: DVec3,
    pub axis_y: DVec3,
    pub normal: DVec3,
    /// m.
    pub half_x: f64,
    pub half_y: f64,
}

impl Plate {
    /// A point in the plate's own frame: Q' = R⁻¹(Q − P).
    pub fn local_of(&self, at: DVec3) -> DVec3 {
        let d = at - self.center;
        DVec3::new(self.axis_x.dot(d), self.axis_y.dot(d), self.normal.dot(d))
    }

    /// Whether the foot of a point given in the plate's frame lies on the plate.
    pub fn covers(&self, local: DVec3) -> bool {
        local.x.abs() <= self.half_x && local.y.abs() <= self.half_y
    }

    fn corners(&self) -> [DVec3; 4] {
        let (x, y) = (self.half_x * self.axis_x, self.half_y * self.axis_y);
        [self.center - x - y, self.center + x - y, self.center - x + y, self.center + x + y]
    }

    /// The nearest part of the plate. A point in the plate itself counts as above it, whatever its velocity:
    /// else an impact there would repeat for ever.
    pub fn nearest(&self, at: DVec3) -> Near {
        let local = self.local_of(at);
        let over_x = local.x.abs() - self.half_x;
        let over_y = local.y.abs() - self.half_y;
        let feature = match (over_x > 0.0, over_y > 0.0) {
            (false, false) => {
                let side = if local.z < 0.0 { -1.0 } else { 1.0 };
                let distance = local.z.abs();
                let towards = -side * self.normal;
                return Near { distance, towards, feature: Feature::Face, to_center: distance };
            }
            (true, false) => Feature::Edge(self.axis_y),
            (false, true) => Feature::Edge(self.axis_x),
            (true, true) => Feature::Corner,
        };
        let out_x = over_x.max(0.0).copysign(local.x);
        let out_y = over_y.max(0.0).copysign(local.y);
        let distance = DVec3::new(out_x, out_y, local.z).length();
        let towards = -(out_x * self.axis_x + out_y * self.axis_y + local.z * self.normal) / distance;
        Near { distance, towards, feature, to_center: distance }
    }
}

impl Convex for Plate {
    fn pair_name(&self) -> &'static str {
        "sphere–plane"
    }

    fn bounds(&self, _: DVec3) -> (DVec3, DVec3) {
        let [first, rest @ ..] = self.corners();
        rest.iter().fold((first, first), |(low, high), corner| (low.min(*corner), high.max(*corner)))
    }

    /// Separating axes of a rectangle and a box (Akenine-Möller 2001, for a rectangle instead of a triangle):
    /// the box's three, the plate's normal, and the nine cross products of their edges.
    fn touches_box(&self, _: DVec3, low: DVec3, high: DVec3) -> bool {
        let center = 0.5 * (low + high) - self.center;
        let half = 0.5 * (high - low);
        let separated = |axis: DVec3| {
            let reach = half.dot(axis.abs())
                + self.half_x * self.axis_x.dot(axis).abs()
                + self.half_y * self.axis_y.dot(axis).abs();
            // Rounding of nearly parallel edges must not separate what touches.
            axis.dot(center).abs() > reach + 1e-12 * (half.element_sum() + center.abs().element_sum())
        };
        let crosses =
            DVec3::AXES.into_iter().flat_map(|edge| [edge.cross(self.axis_x), edge.cross(self.axis_y)]);
        !DVec3::AXES.into_iter().chain([self.normal]).chain(crosses).any(separated)
    }

    fn nearest(&self, _: DVec3, point: DVec3) -> Near {
        Self::nearest(self, point)
    }

    fn sides(&self) -> Vec<(DVec3, f64)> {
        let side = |axis: DVec3, half: f64| (axis, axis.dot(self.center) + half);
        vec![
            side(self.axis_x, self.half_x),
            side(-self.axis_x, self.half_x),
            side(self.axis_y, self.half_y),
            side(-self.axis_y, self.half_y),
        ]
    }
}
