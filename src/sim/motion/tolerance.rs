//! The thresholds of the integrators. Those that a scene can set are in
//! [`crate::scene::PARAMS`]; these are bound to the method or to rounding.

/// Step ratio below which a step is repeated, and whose inverse bounds growth (Rein & Spiegel 2015). Larger
/// repeats more steps, smaller lets the error jump by (1/SAFETY)⁷.
pub(super) const SAFETY: f64 = 0.25;

/// A step is cut to this part of itself at most, so that one wild attempt does not end in a crawl.
pub(super) const DEEPEST_CUT: f64 = 0.02;

/// Corrector passes before a step counts as not convergent; smooth fields need 2 to 6.
pub(super) const MAX_PASSES: u32 = 12;

/// A change of b₆ this small against the acceleration ends the corrector: it enters the velocity by an eighth
/// and the position by a 72nd, so that is rounding.
pub(super) const CONVERGED: f64 = 5e-16;

/// Changes below this part of the acceleration that no longer shrink are rounding. Smaller repeats passes
/// that change nothing, larger takes slow convergence for the end of it.
pub(super) const STAGNANT: f64 = 1e-12;

/// A change this many times the one before means that the passes diverge: the step is too long.
pub(super) const DIVERGING: f64 = 1e3;

/// What the last pass may have changed, as part of the field tolerance, for a step to count as convergent.
pub(super) const SHARE_OF_TOLERANCE: f64 = 1e-3;

/// The acceleration counts as at least this fraction of speed per step when the error is judged, so that
/// a body whose acceleration fades (drag at terminal speed) is not integrated to digits nobody can see.
pub(super) const SPEED_FLOOR: f64 = 1e-3;

/// By how much the divided differences enlarge the rounding of an acceleration in b₆: 1/Π(h₇ − hₖ) and a
/// few of the same size. An error below that is none.
pub(super) const NOISE_GAIN: f64 = 1e3;

/// A series is carried on to steps at most so many times as long: farther off its guess is worse than none.
pub(super) const LONGEST_GUESS: f64 = 4.5;

/// Under a force of the user's own steps are never longer than this, s: it may vary in time, which nothing shows
/// before it does. A slower one is followed in more steps than it needs, a pulse between two steps is missed.
pub(super) const LONGEST_STEP: f64 = 100.0;

/// A body of which drag leaves less acceleration than this part of its own falls at its terminal speed, to half of that. Smaller
/// is lost in what the rounding of a step makes of the speed, and missed for ever; larger is seen.
pub(super) const TERMINAL: f64 = 64.0 * f64::EPSILON;

/// Steps of a body that nothing moves are never longer than this, s: it stands for ever.
pub(super) const FOR_EVER: f64 = 1e100;

/// Steps below this part of the time are no steps: the field is singular or not smooth.
pub(super) const RESOLUTION: f64 = 1e-15;

/// A step that had to be cut to less than this part of the first one tried has no end either.
pub(super) const SHORTEST_PART: f64 = 1e-18;

/// After an impact the step of the motion before is tried first, unless it would carry the body more than so many radii:
/// one that stood still had steps without end, which say nothing about a body that flies. Smaller asks the field more
/// often, larger cuts steps down from where none can be long enough.
pub(super) const FARTHEST_HINT: f64 = 1e6;

/// How far ahead the field is looked at for a first step: the way in it, as part of the body's radius. Shorter
/// loses the change of the field to rounding, longer may look past what changes.
pub(super) const PROBE: f64 = 1.0 / 1024.0;

/// In a first step no body comes farther than this part of its radius. Longer is cut on round surfaces, shorter
/// takes a few steps to grow.
pub(super) const FIRST_WAY: f64 = 0.125;

/// A first step is this part of the time in which the acceleration changes by itself.
pub(super) const FIRST_SHARE: f64 = 0.1;

/// Squares of lengths, speeds and accelerations stay below this, so that searches and integrators, which add
/// products of two of them, have room before infinity.
pub(super) const LARGEST_SQUARE: f64 = 1e300;

/// Steps through drag are at most this part of the time in which it is smooth, |v|/|a|: its series then
/// shrinks by 4.6 from one term to the next, and is at rounding where drag is a thousandth of the acceleration.
/// Where it is more, b₆ shows it.
pub(super) const RESOLVED: f64 = 1.0;

/// A step that was made is left as it is up to this part of that time: between it and [`RESOLVED`] the guess
/// before the step was a little off, and a repetition would cost more than it gains.
pub(super) const RESOLVED_AFTER: f64 = 1.5;

/// A kink nearer to the start of a step than this part of it, or than [`RESOLUTION`], is the one at which the step began.
pub(super) const KINK_AT_START: f64 = 1e-9;

/// A step cut at a kink looks for it so far: the first look, along a step across it, is a little off.
pub(super) const KINK_REACH: f64 = 1.02;

/// Of a step that ends at its kink all nodes lie before it: the last one is at 0.978.
pub(super) const KINK_AT_END: f64 = 0.98;

/// Within so many core radii of an attractor the way is remembered. Farther off the potential is flat
/// enough to lose nothing to rounding.
pub(super) const REMEMBERED: f64 = 1e4;

/// A centre within this part of the core radius was put there: one that falls in turns back at the core.
pub(super) const INSIDE: f64 = 0.5;
