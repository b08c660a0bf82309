//! Step control, after Rein & Spiegel 2015 (IAS15, MNRAS 446, eq. 9–11): when the corrector has converged,
//! when a step is accepted, and how long the next one is.

use glam::DVec3;

use super::SegmentError;
use super::smoothness::Smooth;
use super::tolerance::{
    CONVERGED, DEEPEST_CUT, DIVERGING, FIRST_SHARE, FIRST_WAY, FOR_EVER, KINK_AT_END, KINK_REACH,
    LARGEST_SQUARE, PROBE, RESOLUTION, SAFETY, SHARE_OF_TOLERANCE, SHORTEST_PART, SPEED_FLOOR, STAGNANT,
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
    /// Length of the step that the series is given over, s.
    pub step: f64,
    /// Part of it after which the segment ends: 1 but at a kink.
    pub share: f64,
    /// Step to try next, s.
    pub next_step: f64,
    pub series: S,
}

/// What bounds the steps of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Largest accepted |b₆|/|a|: `SimParams::field_tolerance`.
    pub tolerance: f64,
    /// s.
    pub longest: f64,
}

/// Shortens a step until an attempt is good enough and the field is smooth along it.
pub(super) fn accept<S>(
    time: f64,
    first: f64,
    limits: Limits,
    mut attempt: impl FnMut(f64) -> Attempt<S>,
    smooth: impl Fn(f64, &S, f64) -> Smooth,
) -> Result<Accepted<S>, SegmentError> {
    let shortest = (RESOLUTION * time.abs()).max(SHORTEST_PART * first);
    let (mut step, mut reach) = (first, 1.0);
    loop {
        if step.is_nan() || step <= shortest {
            return Err(SegmentError::Stalled);
        }
        let Attempt { series, converged, error } = attempt(step);
        // ẍ is a power series in the step, so b₆ scales with step⁷.
        let ratio = if error == 0.0 { f64::INFINITY } else { libm::pow(limits.tolerance / error, 1.0 / 7.0) };
        if !converged || ratio.is_nan() || ratio < SAFETY {
            // What b₆ shows may be a kink.
            if converged && let Smooth::Until(kink) = smooth(step, &series, reach) {
                (step, reach) = (kink.min(KINK_AT_END * step), KINK_REACH);
            } else {
                step *= if converged && !ratio.is_nan() { ratio.max(DEEPEST_CUT) } else { SAFETY };
            }
            continue;
        }
        let share = match smooth(step, &series, reach) {
            Smooth::Yes => 1.0,
            Smooth::For(length) => {
                step = length.min(KINK_AT_END * step);
                continue;
            }
            Smooth::Until(kink) if kink < KINK_AT_END * step => {
                (step, reach) = (kink, KINK_REACH);
                continue;
            }
            Smooth::Until(kink) => kink / step,
        };
        let next_step = (step * ratio.min(1.0 / SAFETY)).min(limits.longest);
        return Ok(Accepted { step, share, next_step, series });
    }
}

/// Whether vectors leave room to infinity.
pub(in crate::sim) fn are_sound<'a>(mut vectors: impl Iterator<Item = &'a DVec3>) -> bool {
    vectors.all(|vector| vector.length_squared() < LARGEST_SQUARE)
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

/// A body at the start of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    /// m.
    pub radius: f64,
    /// Speed and size of the acceleration, in contact without what the surfaces take of it.
    pub speed: f64,
    pub acceleration: f64,
}

impl Beginning {
    /// Time in which it comes this part of its radius, s.
    fn time_to(&self, part: f64) -> f64 {
        let way = part * self.radius;
        (way / self.speed).min((2.0 * way / self.acceleration).sqrt()).min(FOR_EVER)
    }
}

/// A tenth of the time in which the acceleration changes by itself along the motion, s, but not more than it takes
/// bodies to move by a part of their size. `ahead` gives the size of the acceleration and its change after some
/// time.
pub(super) fn first_guess(
    bodies: &(impl Iterator<Item = Beginning> + Clone),
    mut ahead: impl FnMut(f64) -> (f64, f64),
) -> f64 {
    let time_to = |part: f64| bodies.clone().map(|body| body.time_to(part)).fold(FOR_EVER, f64::min);
    let mut probe = time_to(PROBE);
    let (mut size, mut change) = ahead(probe);
    // A change as large as the acceleration itself (thick air) tells nothing yet.
    while change > size && probe > 0.0 {
        probe *= PROBE;
        (size, change) = ahead(probe);
    }
    let own = if change > 0.0 { FIRST_SHARE * size * (probe / change) } else { FOR_EVER };
    own.min(time_to(FIRST_WAY))
}
