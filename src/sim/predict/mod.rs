//! Times of impact: the first root of a gap function along two segments, and the dispatcher of shape pairs.
//!
//! A pair of shapes may have a file of its own with what is known in closed form. Any other convex shape is met
//! by conservative advancement from its nearest feature alone ([`sphere_convex`]).

mod advance;
mod approach;
mod beyond;
mod gap;
mod sphere_convex;
mod sphere_plate;
mod sphere_sphere;
#[cfg(test)]
mod tests;

use glam::DVec3;

use advance::Skip;

use super::segment::{Path, Segment};
use super::shape::{Convex, Plate, Shape};

pub(super) use beyond::first_beyond;
pub(super) use gap::{Ball, Gap, touch_tolerance};
pub(super) use sphere_sphere::{surely_pass, surely_stay_apart};

/// What a dynamic sphere may meet: another body as prediction sees it. The list of pairs.
#[derive(Clone, Copy)]
pub(super) enum Target<'a> {
    Dynamic(Ball<'a>),
    Sphere(Ball<'a>),
    Plate(&'a Plate),
    /// Any other shape, placed at a point.
    Convex(&'a dyn Convex, DVec3),
}

impl<'a> Target<'a> {
    /// A static body: one arm for each shape with a file of its own here.
    #[allow(
        unreachable_patterns,
        clippy::match_wildcard_for_single_variants,
        reason = "all shapes so far, but for one of the tests, have closed forms"
    )]
    pub fn at_rest(shape: &'a Shape, path: Path<'a>) -> Self {
        match shape {
            Shape::Sphere(sphere) => Self::Sphere(Ball { path, radius: sphere.radius }),
            Shape::Plate(plate) => Self::Plate(plate),
            other => Self::Convex(other.convex(), path.segment.x),
        }
    }
}

/// First time, not before `from` nor before both segments begin and not after either ends, at which a dynamic
/// sphere touches another body while closing. A pure function of its arguments; `from` is −∞ but for a search
/// that goes on from where an earlier one gave up.
pub(super) fn first_contact(ball: Ball<'_>, target: Target<'_>, from: f64) -> Option<f64> {
    match target {
        Target::Dynamic(other) => {
            sphere_sphere::first_contact(ball, other, from, || ball.tolerance().max(other.tolerance()))
        }
        Target::Sphere(fixed) => sphere_sphere::first_contact(ball, fixed, from, || ball.tolerance()),
        Target::Plate(plate) => sphere_plate::first_contact(ball, plate, from),
        Target::Convex(shape, at) => sphere_convex::first_contact(ball, shape, at, from),
    }
}

/// From when on two surfaces that touch at a time may be nearer than then by more than the rounding of places; `None` if
/// they are not while both segments last. Bounds of the acceleration in any direction say next to nothing of that.
pub(super) fn first_deeper(ball: Ball<'_>, target: Target<'_>, time: f64) -> Option<f64> {
    let skip = match target {
        Target::Dynamic(other) => {
            sphere_sphere::skip_from(ball, other, ball.tolerance().max(other.tolerance()), time)
        }
        Target::Sphere(fixed) => sphere_sphere::skip_from(ball, fixed, ball.tolerance(), time),
        Target::Plate(plate) => sphere_plate::skip(ball, plate, sphere_plate::slack(ball, plate), time),
        Target::Convex(..) => Skip::Unknown,
    };
    match skip {
        Skip::Never => None,
        Skip::Unknown => Some(time),
        Skip::To(later) => Some(later),
    }
}

/// The gap of a dynamic sphere and another body at a time.
pub(super) fn gap(ball: Ball<'_>, target: Target<'_>, time: f64) -> Gap {
    match target {
        Target::Dynamic(other) | Target::Sphere(other) => sphere_sphere::gap(ball, other, time),
        Target::Plate(plate) => sphere_plate::gap(ball, plate, time),
        Target::Convex(shape, at) => sphere_convex::gap(ball, |point, _| shape.nearest(at, point), time),
    }
}

/// First time at which the centre of a body comes within `core` of a point attractor.
pub(super) fn core_pass(path: Path<'_>, center: DVec3, core: f64, from: f64) -> Option<f64> {
    let segment = Segment::resting(center);
    let attractor = Ball { path: Path { segment: &segment, series: None }, radius: core };
    first_contact(Ball { path, radius: 0.0 }, Target::Sphere(attractor), from)
}
