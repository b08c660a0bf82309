//! The sphere.

use glam::DVec3;

use super::convex::Convex;
use super::near::{Feature, Near};

/// A ball round the place of its body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) struct Sphere {
    /// m.
    pub radius: f64,
}

impl Convex for Sphere {
    fn pair_name(&self) -> &'static str {
        "sphere–static sphere"
    }

    fn bounds(&self, at: DVec3) -> (DVec3, DVec3) {
        (at - self.radius, at + self.radius)
    }

    fn touches_box(&self, at: DVec3, low: DVec3, high: DVec3) -> bool {
        (at.clamp(low, high) - at).length() <= self.radius
    }

    fn is_one_part(&self) -> bool {
        true
    }

    fn nearest(&self, at: DVec3, point: DVec3) -> Near {
        let (to_center, towards) = direction(at - point);
        Near { distance: to_center - self.radius, towards, feature: Feature::Corner, to_center }
    }
}

/// Length and direction of a vector between centres. Coincident centres have no direction: a fixed one lets them
/// part, where one taken from the velocity would turn with every impact.
pub(in crate::sim) fn direction(apart: DVec3) -> (f64, DVec3) {
    let distance = apart.length();
    (distance, if distance > 0.0 { apart / distance } else { DVec3::X })
}
