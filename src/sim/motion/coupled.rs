//! One step of the Gauss–Radau integrator for bodies that move together in contact: the method of
//! [`super::radau`] with the coefficients of all bodies found at once.

use glam::DVec3;

use super::law::SegmentError;
use super::radau::{
    CONVERGED, LONGEST_STEP, MAX_PASSES, NODES, SAFETY, TO_POWERS, rounding_of, scale, update_difference,
};
use crate::sim::segment::{SERIES, Segment, Series};
use crate::sim::state::FieldColumn;

/// A segment, with its series if it is integrated.
pub(in crate::sim) type Step = (Segment, Option<FieldColumn>);

/// Accelerations of all bodies, and the largest of the accelerations that they are the difference of: the
/// applied and the contact forces may all but cancel, and their rounding does not.
pub(in crate::sim) type Field = (Vec<DVec3>, f64);

/// One accepted step of all bodies from (x, v) at a time, of the same length. `hint` is the step to try
/// first, s; 0 asks for one from the field itself.
pub(in crate::sim) fn coupled_step(
    (time, x, v): (f64, &[DVec3], &[DVec3]),
    hint: f64,
    tolerance: f64,
    evaluations: &mut u64,
    mut accelerations: impl FnMut(f64, &[DVec3], &[DVec3]) -> Field,
) -> Result<Vec<Step>, SegmentError> {
    let mut field = |time: f64, x: &[DVec3], v: &[DVec3]| {
        *evaluations += x.len() as u64;
        accelerations(time, x, v)
    };
    let (a0, _) = field(time, x, v);
    if !a0.iter().chain(x).chain(v).all(|vector| vector.is_finite()) {
        return Err(SegmentError::NotFinite);
    }
    let start = Start { time, x, v, a0: &a0 };
    let mut step = if hint > 0.0 { hint.min(LONGEST_STEP) } else { first_guess(&start, &mut field) };
    loop {
        if step < 1e-15 * time.abs().max(1e-3) {
            return Err(SegmentError::Stalled);
        }
        let attempt = correct(&start, step, tolerance, &mut field);
        let ratio = match attempt.error {
            0.0 => f64::INFINITY,
            error => libm::pow(tolerance / error, 1.0 / 7.0),
        };
        if !attempt.converged || ratio < SAFETY {
            step *= if attempt.converged { ratio.max(0.02) } else { SAFETY };
            continue;
        }
        let next_step = (step * ratio.min(1.0 / SAFETY)).min(LONGEST_STEP);
        return Ok(start.segments(step, next_step, &attempt.series));
    }
}

/// Where all bodies begin.
struct Start<'a> {
    time: f64,
    x: &'a [DVec3],
    v: &'a [DVec3],
    a0: &'a [DVec3],
}

impl Start<'_> {
    fn segments(&self, step: f64, next_step: f64, series: &[Series]) -> Vec<Step> {
        let one = |(body, series): (usize, &Series)| {
            let segment = Segment {
                end: self.time + step,
                acceleration_bound: self.a0[body].length() + series.bound(),
                step,
                ..Segment::ballistic(self.time, self.x[body], self.v[body], self.a0[body])
            };
            (segment, Some(FieldColumn { series: *series, next_step }))
        };
        series.iter().enumerate().map(one).collect()
    }
}

struct Attempt {
    series: Vec<Series>,
    converged: bool,
    /// Largest |b₆| over the largest applied acceleration of the step.
    error: f64,
}

/// Gauss–Seidel passes over the nodes until the last coefficients stand still.
fn correct(
    start: &Start<'_>,
    step: f64,
    tolerance: f64,
    field: &mut impl FnMut(f64, &[DVec3], &[DVec3]) -> Field,
) -> Attempt {
    let count = start.x.len();
    let mut series = vec![Series::default(); count];
    let mut differences = vec![[DVec3::ZERO; SERIES]; count];
    let (mut x, mut v) = (start.x.to_vec(), start.v.to_vec());
    let mut attempt = Attempt { series: Vec::new(), converged: false, error: f64::INFINITY };
    let (mut last_change, mut noise, mut size) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    for _ in 0..MAX_PASSES {
        let mut change = 0.0_f64;
        (noise, size) = (0.0, f64::MIN_POSITIVE);
        for n in 1..=SERIES {
            let tau = NODES[n] * step;
            for body in 0..count {
                let (a0, b) = (start.a0[body], &series[body]);
                x[body] =
                    start.x[body] + tau * (start.v[body] + tau * (0.5 * a0 + b.position_term(NODES[n])));
                v[body] = start.v[body] + tau * (a0 + b.velocity_term(NODES[n]));
            }
            let (a, applied) = field(start.time + tau, &x, &v);
            if !a.iter().all(|a| a.is_finite()) {
                return attempt;
            }
            for body in 0..count {
                let rise = a[body] - start.a0[body];
                let delta = update_difference(&mut differences[body], n, rise);
                for (b, power) in series[body].b.iter_mut().zip(TO_POWERS[n - 1]).take(n) {
                    *b += power * delta;
                }
                size = size.max(scale(applied, start.v[body], step));
                if n == SERIES {
                    change = change.max(delta.length());
                    noise = noise.max(NOISE_GAIN * rounding_of(rise, x[body] - start.x[body], start.x[body]));
                    noise = noise.max(NOISE_GAIN * f64::EPSILON * applied);
                }
            }
        }
        let relative = change / size;
        let stagnant = (noise / size).max(1e-12);
        if relative <= CONVERGED || (relative < stagnant && relative >= last_change) {
            last_change = 0.0;
            break;
        }
        if relative > 1e3 * last_change {
            break;
        }
        last_change = relative;
    }
    attempt.converged = last_change < 1e-3 * tolerance;
    let last = series.iter().map(|series| series.b[SERIES - 1].length()).fold(0.0, f64::max);
    attempt.error = (last - noise).max(0.0) / size;
    attempt.series = series;
    attempt
}

/// By how much the divided differences enlarge the rounding of an acceleration in b₆, with contacts.
const NOISE_GAIN: f64 = 1e3;

/// A tenth of the time in which the accelerations change by themselves along the motion.
fn first_guess(start: &Start<'_>, field: &mut impl FnMut(f64, &[DVec3], &[DVec3]) -> Field) -> f64 {
    const PROBE: f64 = 1e-6;
    let x: Vec<DVec3> = start.x.iter().zip(start.v).map(|(x, v)| *x + PROBE * *v).collect();
    let v: Vec<DVec3> = start.v.iter().zip(start.a0).map(|(v, a)| *v + PROBE * *a).collect();
    let (ahead, size) = field(start.time + PROBE, &x, &v);
    let rise = ahead.iter().zip(start.a0).map(|(ahead, a0)| (*ahead - *a0).length()).fold(0.0, f64::max);
    if rise > 0.0 && size > 0.0 { (0.1 * size * PROBE / rise).clamp(1e-5, 0.1) } else { 0.01 }
}
