//! What is demanded of every everyday scene, and what one of them misses.

use super::judge::{Ending, Outcome};

/// Over the smallest radius.
const OVERLAP: f64 = 1e-3;
/// In the mean body's m g r.
const GAIN: f64 = 1e-2;
/// Of energy and momentum.
const RESIDUAL: f64 = 1e-9;
/// Of energy where bodies were stepped through a field or air: the error of the leapfrog, second order in the step.
const RESIDUAL_OF_STEPS: f64 = 1e-2;
/// Of momentum near an attractor, whose pull is summed up along the way by quadrature to check the motion.
const RESIDUAL_OF_QUADRATURE: f64 = 1e-5;

/// A demand that was not met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Miss {
    /// It took longer than real time.
    Stall,
    /// It ended on a numerical fault, or did not begin.
    Fault,
    Gain,
    Overlap,
    /// Something left the container.
    Escape,
    /// The books do not add up.
    Books,
}

impl Miss {
    pub const ALL: [Self; 6] =
        [Self::Stall, Self::Fault, Self::Gain, Self::Overlap, Self::Escape, Self::Books];

    pub fn name(self) -> &'static str {
        match self {
            Self::Stall => "stall",
            Self::Fault => "fault",
            Self::Gain => "gain",
            Self::Overlap => "overlap",
            Self::Escape => "escape",
            Self::Books => "books",
        }
    }
}

/// The demands that a scene misses. What cannot be measured (NaN) is missed.
pub fn misses(outcome: &Outcome) -> Vec<Miss> {
    let within = |value: f64, limit: f64| value <= limit;
    let held = |miss: Miss| match miss {
        Miss::Stall => outcome.ending != Ending::Stalled,
        Miss::Fault => !matches!(outcome.ending, Ending::Faulted(_) | Ending::Refused(_)),
        Miss::Gain => within(outcome.gain, GAIN),
        Miss::Overlap => within(outcome.overlap, OVERLAP),
        Miss::Escape => within(outcome.escape, OVERLAP),
        Miss::Books => {
            let is_leapfrog = outcome.is_in_field && outcome.was_stepped;
            let energy = if is_leapfrog { RESIDUAL_OF_STEPS } else { RESIDUAL };
            let momentum = if outcome.is_in_field { RESIDUAL_OF_QUADRATURE } else { RESIDUAL };
            within(outcome.energy_residual, energy) && within(outcome.momentum_residual, momentum)
        }
    };
    Miss::ALL.into_iter().filter(|miss| !held(*miss)).collect()
}
