//! The gap of two surfaces: their distance along two segments, and how it changes.

use glam::DVec3;

use crate::sim::segment::Path;
use crate::sim::tolerance::{PRESSURE_ROUNDING, STILL, TOUCH};

/// Distance of two surfaces along two segments at one time, and its first two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) struct Gap {
    /// m; negative where they overlap.
    pub distance: f64,
    /// m/s; negative when closing.
    pub rate: f64,
    /// Second derivative of the distance, m/s²: negative when driven together.
    pub bend: f64,
    /// The part of it that the acceleration gives, without the curvature of the surfaces.
    pub drive: f64,
    /// Unit vector from the first body to the second.
    pub normal: DVec3,
    /// Nearest point on the surface of the first body (a sphere), m.
    pub point: DVec3,
}

impl Gap {
    /// Whether the surfaces come nearer: now, or at once because they are pressed.
    pub fn is_closing(&self) -> bool {
        self.rate < 0.0 || (self.rate == 0.0 && self.bend < 0.0)
    }
}

/// A sphere on its way, or at rest for ever.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Ball<'a> {
    pub path: Path<'a>,
    /// m.
    pub radius: f64,
}

impl Ball<'_> {
    /// [`touch_tolerance`] where the segment begins, m.
    pub fn tolerance(&self) -> f64 {
        touch_tolerance(self.path.segment.x, self.radius)
    }
}

/// Zero if `value` is no more than the rounding of something of this size. Without it a body that glides
/// along a surface would seem to hit or leave it, now and then, by 1e-17.
pub(super) fn snap(value: f64, size: f64) -> f64 {
    if value.abs() <= STILL * size { 0.0 } else { value }
}

/// As [`snap`], for accelerations: surfaces at rest against each other are pressed above the rounding, parted below
/// its negative, and neither between.
pub(super) fn snap_pressure(value: f64, size: f64) -> f64 {
    if value.abs() <= PRESSURE_ROUNDING * size { 0.0 } else { value }
}

/// Surfaces at rest against each other to within this are taken to touch, m.
pub(in crate::sim) fn touch_tolerance(at: DVec3, radius: f64) -> f64 {
    TOUCH * at.abs().max_element().max(radius)
}
