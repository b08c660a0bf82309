//! Times of impact: the first root of a gap function along two segments. One file per shape pair.

mod advance;
mod sphere_plane;
mod sphere_sphere;

use glam::DVec3;

use super::model::{Fixture, FixtureShape};
use super::segment::Path;

pub(super) use sphere_plane::{Feature, closest_on_plate};

/// Distance of two surfaces along two segments at one time, and its first two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gap {
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

/// Zero if `value` is no more than the rounding of something of this size. Without it a body that glides
/// along a surface would seem to hit or leave it, now and then, by 1e-17.
fn snap(value: f64, size: f64) -> f64 {
    const ROUNDING: f64 = 16.0 * f64::EPSILON;
    if value.abs() <= ROUNDING * size { 0.0 } else { value }
}

/// The rounding of the acceleration that presses bodies together, as a fraction of their accelerations:
/// surfaces at rest against each other are pressed above it, parted below its negative, and neither between.
pub(super) const PRESSURE_ROUNDING: f64 = 1e-12;

/// As [`snap`], for accelerations.
fn snap_pressure(value: f64, size: f64) -> f64 {
    if value.abs() <= PRESSURE_ROUNDING * size { 0.0 } else { value }
}

/// A sphere on its way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mover<'a> {
    pub path: Path<'a>,
    pub radius: f64,
}

/// Surfaces at rest against each other to within this are taken to touch, m. A few roundings at the
/// coordinate size.
pub(super) fn touch_tolerance(at: DVec3, radius: f64) -> f64 {
    8.0 * f64::EPSILON * at.abs().max_element().max(radius)
}

/// First time, not before `from` nor before both segments begin and not after either ends, at which two
/// dynamic spheres touch while closing. A pure function of its arguments; `from` is −∞ but for a search
/// that goes on from where an earlier one gave up.
pub(super) fn sphere_sphere(a: Mover<'_>, b: Mover<'_>, from: f64) -> Option<f64> {
    sphere_sphere::first_contact(a, b, from)
}

/// Whether two dynamic spheres fly straight as seen from each other and pass or part: a quick look that is
/// sure where it says so. It says so of no pair nearer than `near`, m.
pub(super) fn surely_pass(a: Mover<'_>, b: Mover<'_>, near: f64) -> bool {
    sphere_sphere::surely_pass(a, b, near)
}

pub(super) fn sphere_sphere_gap(a: Mover<'_>, b: Mover<'_>, time: f64) -> Gap {
    sphere_sphere::gap(a, b, time)
}

/// As [`sphere_sphere`], against a static body. The match is the list of supported pairs.
pub(super) fn sphere_fixture(mover: Mover<'_>, fixture: &Fixture, from: f64) -> Option<f64> {
    match &fixture.shape {
        FixtureShape::Sphere { radius } => {
            sphere_sphere::first_contact_fixed(mover, fixture.position, *radius, from)
        }
        FixtureShape::Plate(plate) => sphere_plane::first_contact(mover, plate, from),
    }
}

pub(super) fn sphere_fixture_gap(mover: Mover<'_>, fixture: &Fixture, time: f64) -> Gap {
    match &fixture.shape {
        FixtureShape::Sphere { radius } => sphere_sphere::gap_fixed(mover, fixture.position, *radius, time),
        FixtureShape::Plate(plate) => sphere_plane::gap(mover, plate, time),
    }
}

/// First time at which the centre of a body comes within `core` of a point attractor.
pub(super) fn core_pass(path: Path<'_>, center: DVec3, core: f64, from: f64) -> Option<f64> {
    sphere_sphere::first_contact_fixed(Mover { path, radius: 0.0 }, center, core, from)
}
