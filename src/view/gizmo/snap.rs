//! Round numbers while dragging: steps that suit the magnification, and what lies on them.

use std::f64::consts::PI;

use glam::DVec3;

use crate::view::format::round_down_125;
use crate::view::{Camera, Viewport};

/// Points that a snapping step measures at most; a step smaller than a few points could not be aimed at.
const STEP_POINTS: f64 = 12.0;

/// Points that free dragging is rounded to: finer than a hand, so that no one notices but the file, which
/// then says 4.02 and not 4.0213374613.
const FINE_POINTS: f64 = 0.5;

/// Snapped angles are multiples of this: 15°, as drawing boards have it.
const ANGLE_STEP: f64 = PI / 12.0;

/// Factors of a size that is dragged freely are multiples of this, and of the other where it snaps: what a person would
/// type.
pub(super) const FINE_FACTOR: f64 = 0.01;
pub(super) const ROUND_FACTOR: f64 = 0.1;

/// Each coordinate to the nearest multiple of `step` metres; unchanged when `step` is not positive.
pub fn snap(position: DVec3, step: f64) -> DVec3 {
    DVec3::from_array(position.to_array().map(|value| snap_value(value, step)))
}

/// The nearest multiple of `step`; unchanged when `step` is not positive.
pub fn snap_value(value: f64, step: f64) -> f64 {
    if !(step.is_finite() && step > 0.0) {
        return value;
    }
    // Multiples of 0.1 as quotients by 10 give the decimal that a person would type.
    let inverse = (1.0 / step).round();
    let snapped = if (inverse * step - 1.0).abs() < 1e-12 && inverse >= 1.0 {
        (value * inverse).round() / inverse
    } else {
        (value / step).round() * step
    };
    // no -0
    snapped + 0.0
}

/// The nearest multiple of 15°, radians.
pub fn snap_angle(angle: f64) -> f64 {
    (angle / ANGLE_STEP).round() * ANGLE_STEP
}

/// The nearest tenth of a degree, radians.
pub(super) fn fine_angle(angle: f64) -> f64 {
    (angle.to_degrees() * 10.0).round().to_radians() / 10.0
}

/// A snapping step that suits the magnification: twelve points, rounded down to 1, 2 or 5 × 10^k metres.
pub fn snap_step(camera: &Camera, viewport: Viewport) -> f64 {
    round_down_125(STEP_POINTS * camera.world_per_pixel(viewport.height))
}

/// The step that free dragging is rounded to at `place`.
pub fn fine_step(camera: &Camera, viewport: Viewport, place: DVec3) -> f64 {
    round_down_125(FINE_POINTS * camera.world_per_pixel_at(place, viewport.height))
}
