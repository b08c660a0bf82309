//! Step control, after Rein & Spiegel 2015 (IAS15, MNRAS 446, eq. 9–11): when the corrector has converged,
//! when a step is accepted, and how long the next one is.

use glam::DVec3;

use super::SegmentError;
use super::tolerance::{
    CONVERGED, DEEPEST_CUT, DIVERGING, EARLIEST, FIRST_SHARE, FIRST_STEP, FIRST_STEPS, LONGEST_STEP, PROBE,
    RESOLUTION, SAFETY, SHARE_OF_TOLERANCE, SPEED_FLOOR, STAGNANT,
};

/// What the corrector made of a step.
pub(super) struct Attempt<S> {
    pub series: S,
    pub converged: bool,
    /// Largest |b₆| over the largest acceleration of the step.
    pub error: f64,
}

/// A step that is good enough.
pub(super) struct Accepted<S> {
    /// s.
    pub step: f64,
    /// Step to try next, s.
    pub next_step: f64,
    pub series: S,
}

/// Shortens a step until an attempt is good enough.
pub(super) fn accept<S>(
    time: f64,
    first: f64,
    tolerance: f64,
    mut attempt: impl FnMut(f64) -> Attempt<S>,
) -> Result<Accepted<S>, SegmentError> {
    let mut step = first;
    loop {
        if step < RESOLUTION * time.abs().max(EARLIEST) {
            return Err(SegmentError::Stalled);
        }
        let Attempt { series, converged, error } = attempt(step);
        // ẍ is a power series in the step, so b₆ scales with step⁷.
        let ratio = if error == 0.0 { f64::INFINITY } else { libm::pow(tolerance / error, 1.0 / 7.0) };
        if !converged || ratio < SAFETY {
            step *= if converged { ratio.max(DEEPEST_CUT) } else { SAFETY };
            continue;
        }
        return Ok(Accepted { step, next_step: (step * ratio.min(1.0 / SAFETY)).min(LONGEST_STEP), series });
    }
}

/// How far the passes of a corrector have come. Changes are relative to the acceleration.
pub(super) struct Passes {
    last_change: f64,
    stands_still: bool,
}

impl Passes {
    pub fn new() -> Self {
        Self { last_change: f64::INFINITY, stands_still: false }
    }

    /// Whether the pass that made this change is the last one. `noise` is what rounding changes.
    pub fn end(&mut self, change: f64, noise: f64) -> bool {
        // The corrector stops at rounding, or when rounding keeps it from coming nearer.
        let stagnant = noise.max(STAGNANT);
        // Passes converge linearly: the next change is about this one times the ratio of the last two.
        let next_change =
            if self.last_change.is_finite() { change * (change / self.last_change) } else { change };
        self.stands_still =
            change.min(next_change) <= CONVERGED || (change < stagnant && change >= self.last_change);
        if self.stands_still || change > DIVERGING * self.last_change {
            return true;
        }
        self.last_change = change;
        false
    }

    pub fn have_converged(&self, tolerance: f64) -> bool {
        self.stands_still || self.last_change < SHARE_OF_TOLERANCE * tolerance
    }
}

/// What an error of a step is measured by, m/s².
pub(super) fn scale(largest_acceleration: f64, v: DVec3, step: f64) -> f64 {
    largest_acceleration.max(SPEED_FLOOR * v.length() / step).max(f64::MIN_POSITIVE)
}

/// What the rounding of the position does to an acceleration that changes by `rise` over `way`, m/s².
/// Near the core of an attractor far from the origin it exceeds any tolerance, and no step is short
/// enough to meet that.
pub(super) fn rounding_of(rise: DVec3, way: DVec3, position: DVec3) -> f64 {
    let way = way.length();
    if way > 0.0 { f64::EPSILON * position.length() * rise.length() / way } else { 0.0 }
}

/// A tenth of the time in which an acceleration changes by itself along the motion, s. `ahead` gives the
/// size of the acceleration and its change after some time.
pub(super) fn first_guess(ahead: impl FnOnce(f64) -> (f64, f64)) -> f64 {
    let (size, change) = ahead(PROBE);
    if change > 0.0 && size > 0.0 {
        (FIRST_SHARE * size / (change / PROBE)).clamp(FIRST_STEPS.0, FIRST_STEPS.1)
    } else {
        FIRST_STEP
    }
}
