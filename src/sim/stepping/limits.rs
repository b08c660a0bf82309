//! The tolerances of the methods that step by Δt, with unit, value, reason and effect.

/// Tolerances of the bisection, and the bound on collisions in a Δt, of the methods `thesis` and `fixed`.
/// The thesis names them but gives no values: these are ours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimits {
    /// Bisection ends when the time is known to this, s. Impacts come early by up to this, which puts an
    /// error of v·10⁻⁶ s into the place and g·v·10⁻⁶ s per bounce into the energy: below what a Δt of 1 ms
    /// loses otherwise. Smaller costs one halving for each factor 2.
    pub time: f64,
    /// … and when neither body moves farther than this between both ends, m. Matters above 1 m/s.
    pub distance: f64,
    /// … and after so many halvings in any case: 10⁴ s down to the rounding of f64.
    pub halvings: u32,
    /// Collisions that one body (`fixed`) or one local set, per moving body in it (`thesis`), may have in one
    /// Δt; what is left then overlaps, and [`crate::sim::Counters::given_up`] counts it. A lying ball
    /// bounces without end, so no value suffices for it; a flying one rarely needs more than 4.
    pub collisions: u32,
}

impl StepLimits {
    /// The values in use.
    pub const DEFAULT: Self = Self { time: 1e-6, distance: 1e-6, halvings: 64, collisions: 64 };
}

impl Default for StepLimits {
    fn default() -> Self {
        Self::DEFAULT
    }
}
