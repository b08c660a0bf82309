//! One step of the 15th-order Gauss–Radau integrator for a body in a field.
//!
//! Everhart 1985, "An efficient integrator that uses Gauss-Radau spacings"; step control after Rein &
//! Spiegel 2015 (IAS15, MNRAS 446, eq. 9–11). The acceleration is a polynomial of degree 7 through eight
//! Radau nodes, so the step itself is the dense output: position and velocity are its integrals.

use glam::DVec3;

use crate::sim::segment::{SERIES, Segment, Series, split};

/// Left Radau nodes on [0, 1]: 0 and the zeros of a Jacobi polynomial (Everhart 1985, table 1).
#[allow(clippy::excessive_precision, reason = "the digits as published; the compiler rounds them")]
pub(super) const NODES: [f64; SERIES + 1] = [
    0.0,
    0.056_262_560_536_922_146_465_652_191_031_8,
    0.180_240_691_736_892_364_987_579_942_780,
    0.352_624_717_113_169_637_373_907_769_648,
    0.547_153_626_330_555_383_001_448_554_766,
    0.734_210_177_215_410_531_523_210_605_558,
    0.885_320_946_839_095_768_090_359_771_030,
    0.977_520_613_561_287_501_891_174_488_626,
];

/// `TO_POWERS[n][i]`: coefficient of s^(i+1) in s(s−h₁)…(s−hₙ), which turns divided differences into b.
pub(super) const TO_POWERS: [[f64; SERIES]; SERIES] = to_powers();

const fn to_powers() -> [[f64; SERIES]; SERIES] {
    let mut table = [[0.0; SERIES]; SERIES];
    table[0][0] = 1.0;
    let mut n = 1;
    while n < SERIES {
        let mut i = 0;
        while i <= n {
            let raised = if i > 0 { table[n - 1][i - 1] } else { 0.0 };
            table[n][i] = raised - NODES[n] * table[n - 1][i];
            i += 1;
        }
        n += 1;
    }
    table
}

/// Reciprocals of the spacings, `SPACINGS[n][k]` = 1/(hₙ − hₖ): a product is several times quicker than a
/// quotient.
static SPACINGS: [[f64; SERIES]; SERIES + 1] = {
    let mut table = [[0.0; SERIES]; SERIES + 1];
    let mut n = 1;
    while n <= SERIES {
        let mut k = 0;
        while k < n {
            table[n][k] = 1.0 / (NODES[n] - NODES[k]);
            k += 1;
        }
        n += 1;
    }
    table
};

/// Weights of b[k] at each node: hₙ^(k+1)/((k+2)(k+3)) for the position, hₙ^(k+1)/(k+2) for the velocity.
static WEIGHTS: [[(f64, f64); SERIES]; SERIES + 1] = {
    let mut table = [[(0.0, 0.0); SERIES]; SERIES + 1];
    let mut n = 0;
    while n <= SERIES {
        let (mut power, mut k) = (NODES[n], 0);
        while k < SERIES {
            table[n][k] = (power / ((k + 2) * (k + 3)) as f64, power / (k + 2) as f64);
            power *= NODES[n];
            k += 1;
        }
        n += 1;
    }
    table
};

/// Step ratio below which a step is repeated, and whose inverse bounds growth (Rein & Spiegel 2015).
pub(super) const SAFETY: f64 = 0.25;
/// Corrector passes before a step counts as not convergent; smooth fields need 2 to 6.
pub(super) const MAX_PASSES: u32 = 12;
/// A change of b₆ this small against the acceleration ends the corrector: it enters the velocity by an eighth
/// and the position by a 72nd, so that is rounding.
pub(super) const CONVERGED: f64 = 5e-16;
/// Steps are never longer than this, s: a field may vary in time.
pub(super) const LONGEST_STEP: f64 = 100.0;
/// The acceleration counts as at least this fraction of speed per step when the error is judged, so that
/// a body whose acceleration fades (drag at terminal speed) is not integrated to digits nobody can see.
const SPEED_FLOOR: f64 = 1e-3;

/// By how much the divided differences enlarge the rounding of an acceleration in b₆: 1/Π(h₇ − hₖ) and a
/// few of the same size.
const NOISE_GAIN: f64 = 1e3;

/// Where a step begins.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct RadauStart<'a> {
    pub time: f64,
    pub x: DVec3,
    /// See [`Series::low`].
    pub low: DVec3,
    pub v: DVec3,
    /// Whether a force looks at the rounded position.
    pub reads_position: bool,
    /// First guess of the step, s; 0 asks for one from the field itself.
    pub step: f64,
    /// The series of the step just ended (with its length), to extrapolate from.
    pub previous: Option<(&'a Series, f64)>,
    /// Largest accepted |b₆|/|a|: `SimParams::field_tolerance`.
    pub tolerance: f64,
}

/// A position with what it has beyond its own digits, m.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Place {
    pub x: DVec3,
    pub low: DVec3,
}

/// Why no step could be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) enum RadauError {
    NotFinite,
    /// The step fell below the resolution of time: the field is singular or not smooth here.
    Stalled,
}

/// One accepted step as a segment, and the step to try next.
pub(in crate::sim) fn radau_step(
    start: &RadauStart<'_>,
    evaluations: &mut u64,
    mut acceleration: impl FnMut(f64, Place, DVec3) -> DVec3,
) -> Result<(Segment, Series, f64), RadauError> {
    let mut field = |time, way, v| {
        *evaluations += 1;
        let (x, low) = split(start.x, start.low + way);
        acceleration(time, Place { x, low }, v)
    };
    let a0 = field(start.time, DVec3::ZERO, start.v);
    if !(a0.is_finite() && start.x.is_finite() && start.v.is_finite()) {
        return Err(RadauError::NotFinite);
    }
    let mut step = match start.step {
        given if given > 0.0 => given.min(LONGEST_STEP),
        _ => first_guess(start, a0, &mut field),
    };
    let mut guess =
        start.previous.map_or(Series::default(), |(series, length)| extrapolate(series, step / length));
    loop {
        let resolution = 1e-15 * start.time.abs().max(1e-3);
        if step < resolution {
            return Err(RadauError::Stalled);
        }
        let Attempt { series, converged, error } = correct(start, a0, step, guess, &mut field);
        // ẍ is a power series in the step, so b₆ scales with step⁷.
        let ratio = if error == 0.0 { f64::INFINITY } else { libm::pow(start.tolerance / error, 1.0 / 7.0) };
        if !converged || ratio < SAFETY {
            step *= if converged { ratio.max(0.02) } else { SAFETY };
            guess = Series::default();
            continue;
        }
        let series = Series { low: start.low, ..series };
        let segment = Segment {
            start: start.time,
            end: start.time + step,
            x: start.x,
            v: start.v,
            a: a0,
            acceleration_bound: a0.length() + series.bound(),
            acceleration_size: a0.length(),
            step,
            constrained: false,
        };
        return Ok((segment, series, (step * ratio.min(1.0 / SAFETY)).min(LONGEST_STEP)));
    }
}

struct Attempt {
    series: Series,
    converged: bool,
    /// |b₆| over the largest acceleration of the step.
    error: f64,
}

/// Gauss–Seidel passes over the nodes until the last coefficient stands still.
fn correct(
    start: &RadauStart<'_>,
    a0: DVec3,
    step: f64,
    guess: Series,
    field: &mut impl FnMut(f64, DVec3, DVec3) -> DVec3,
) -> Attempt {
    let mut series = guess;
    let mut differences = differences_of(&series);
    let mut last_change = f64::INFINITY;
    let mut converged = false;
    let mut largest = a0.length();
    let mut noise = 0.0;
    for _ in 0..MAX_PASSES {
        let mut change = 0.0;
        largest = a0.length();
        for n in 1..=SERIES {
            let tau = NODES[n] * step;
            let (position_term, velocity_term) = terms_at(&series, n);
            let way = tau * (start.v + tau * (0.5 * a0 + position_term));
            let v = start.v + tau * (a0 + velocity_term);
            let a = field(start.time + tau, way, v);
            if !a.is_finite() {
                return Attempt { series, converged: false, error: f64::INFINITY };
            }
            largest = largest.max(a.length());
            let delta = update_difference(&mut differences, n, a - a0);
            for (b, power) in series.b.iter_mut().zip(TO_POWERS[n - 1]).take(n) {
                *b += power * delta;
            }
            if n == SERIES {
                change = delta.length();
                let rounding = f64::EPSILON * a.length();
                noise = NOISE_GAIN
                    * if start.reads_position { rounding_of(a - a0, way, start.x) } else { rounding };
            }
        }
        let relative = change / scale(largest, start.v, step);
        // The corrector stops at rounding, or when rounding keeps it from coming nearer.
        let stagnant = (noise / scale(largest, start.v, step)).max(1e-12);
        // Passes converge linearly: the next change is about this one times the ratio of the last two.
        let next_change =
            if last_change.is_finite() { relative * (relative / last_change) } else { relative };
        if relative.min(next_change) <= CONVERGED || (relative < stagnant && relative >= last_change) {
            converged = true;
            break;
        }
        if relative > 1e3 * last_change {
            break;
        }
        last_change = relative;
    }
    converged |= last_change < 1e-3 * start.tolerance;
    let last = (series.b[SERIES - 1].length() - noise).max(0.0);
    Attempt { series, converged, error: last / scale(largest, start.v, step) }
}

/// [`Series::position_term`] and [`Series::velocity_term`] at a node, summed from the smallest term up.
fn terms_at(series: &Series, node: usize) -> (DVec3, DVec3) {
    let (mut position, mut velocity) = (DVec3::ZERO, DVec3::ZERO);
    for (b, (for_position, for_velocity)) in series.b.iter().zip(&WEIGHTS[node]).rev() {
        position += *for_position * b;
        velocity += *for_velocity * b;
    }
    (position, velocity)
}

/// What the rounding of the position does to an acceleration that changes by `rise` over `way`, m/s².
/// Near the core of an attractor far from the origin it exceeds any tolerance, and no step is short
/// enough to meet that.
pub(super) fn rounding_of(rise: DVec3, way: DVec3, position: DVec3) -> f64 {
    let way = way.length();
    if way > 0.0 { f64::EPSILON * position.length() * rise.length() / way } else { 0.0 }
}

pub(super) fn scale(largest_acceleration: f64, v: DVec3, step: f64) -> f64 {
    largest_acceleration.max(SPEED_FLOOR * v.length() / step).max(f64::MIN_POSITIVE)
}

/// The n-th divided difference of the accelerations; gives its change.
pub(super) fn update_difference(differences: &mut [DVec3; SERIES], n: usize, rise: DVec3) -> DVec3 {
    let mut value = rise * SPACINGS[n][0];
    for (difference, spacing) in differences.iter().zip(&SPACINGS[n][1..n]) {
        value = (value - difference) * *spacing;
    }
    let delta = value - differences[n - 1];
    differences[n - 1] = value;
    delta
}

/// Divided differences of a series given by powers: inverts [`TO_POWERS`], which is unit triangular.
fn differences_of(series: &Series) -> [DVec3; SERIES] {
    let mut g = series.b;
    for n in (0..SERIES).rev() {
        for i in 0..n {
            let top = g[n];
            g[i] -= TO_POWERS[n][i] * top;
        }
    }
    g
}

/// The same polynomial, seen from the end of its step and scaled to a step `q` times as long.
pub(super) fn extrapolate(series: &Series, q: f64) -> Series {
    if q > 4.5 {
        return Series::default();
    }
    // a(1 + s) = Σ b_k (1 + s)^(k+1): binomial expansion, without the constant term.
    let mut shifted = Series::default();
    let mut power = 1.0;
    for i in 0..SERIES {
        power *= q;
        let mut sum = DVec3::ZERO;
        let mut binomial = 1.0; // C(k+1, i+1) for k = i
        for k in i..SERIES {
            sum += binomial * series.b[k];
            binomial *= (k + 2) as f64 / (k + 1 - i) as f64;
        }
        shifted.b[i] = power * sum;
    }
    shifted
}

/// A tenth of the time in which the acceleration changes by itself along the velocity.
fn first_guess(start: &RadauStart<'_>, a0: DVec3, field: &mut impl FnMut(f64, DVec3, DVec3) -> DVec3) -> f64 {
    const PROBE: f64 = 1e-6;
    let ahead = field(start.time + PROBE, PROBE * start.v, start.v + PROBE * a0);
    let jerk = (ahead - a0).length() / PROBE;
    let size = a0.length();
    if jerk > 0.0 && size > 0.0 { (0.1 * size / jerk).clamp(1e-5, 0.1) } else { 0.01 }
}
