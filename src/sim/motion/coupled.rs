//! One step of the Gauss–Radau integrator for bodies that move together in contact: the method of
//! [`super::radau`] with the coefficients of all bodies found at once.

use glam::DVec3;

use super::SegmentError;
use super::collocation::{Differences, NODES};
use super::control::{Accepted, Attempt, Passes, accept, first_guess, rounding_of, scale};
use super::tolerance::{LONGEST_STEP, MAX_PASSES, NOISE_GAIN};
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
    let first =
        if hint > 0.0 { hint.min(LONGEST_STEP) } else { first_guess(|probe| start.ahead(probe, &mut field)) };
    let accepted = accept(time, first, tolerance, |step| correct(&start, step, tolerance, &mut field))?;
    Ok(start.segments(&accepted))
}

/// Where all bodies begin.
struct Start<'a> {
    time: f64,
    x: &'a [DVec3],
    v: &'a [DVec3],
    a0: &'a [DVec3],
}

impl Start<'_> {
    /// Size of the accelerations a little later, and their largest change.
    fn ahead(&self, probe: f64, field: &mut impl FnMut(f64, &[DVec3], &[DVec3]) -> Field) -> (f64, f64) {
        let x: Vec<DVec3> = self.x.iter().zip(self.v).map(|(x, v)| *x + probe * *v).collect();
        let v: Vec<DVec3> = self.v.iter().zip(self.a0).map(|(v, a)| *v + probe * *a).collect();
        let (ahead, size) = field(self.time + probe, &x, &v);
        let changes = ahead.iter().zip(self.a0).map(|(ahead, a0)| (*ahead - *a0).length());
        (size, changes.fold(0.0, f64::max))
    }

    fn segments(&self, accepted: &Accepted<Vec<Series>>) -> Vec<Step> {
        let Accepted { step, next_step, series } = accepted;
        let one = |(body, series): (usize, &Series)| {
            let segment = Segment {
                end: self.time + step,
                acceleration_bound: self.a0[body].length() + series.bound(),
                step: *step,
                ..Segment::ballistic(self.time, self.x[body], self.v[body], self.a0[body])
            };
            (segment, Some(FieldColumn { series: *series, next_step: *next_step }))
        };
        series.iter().enumerate().map(one).collect()
    }
}

/// Gauss–Seidel passes over the nodes until the last coefficients stand still. The error is judged by the
/// largest applied acceleration of the step.
fn correct(
    start: &Start<'_>,
    step: f64,
    tolerance: f64,
    field: &mut impl FnMut(f64, &[DVec3], &[DVec3]) -> Field,
) -> Attempt<Vec<Series>> {
    let mut series = vec![Series::default(); start.x.len()];
    let mut differences: Vec<Differences> = series.iter().map(Differences::of).collect();
    let (mut x, mut v) = (start.x.to_vec(), start.v.to_vec());
    let mut passes = Passes::new();
    let (mut noise, mut size) = (0.0_f64, 0.0_f64);
    for _ in 0..MAX_PASSES {
        let mut change = 0.0_f64;
        (noise, size) = (0.0, f64::MIN_POSITIVE);
        for n in 1..=SERIES {
            let tau = NODES[n] * step;
            for body in 0..x.len() {
                let (a0, b) = (start.a0[body], &series[body]);
                x[body] =
                    start.x[body] + tau * (start.v[body] + tau * (0.5 * a0 + b.position_term(NODES[n])));
                v[body] = start.v[body] + tau * (a0 + b.velocity_term(NODES[n]));
            }
            let (a, applied) = field(start.time + tau, &x, &v);
            if !a.iter().all(|a| a.is_finite()) {
                return Attempt { series, converged: false, error: f64::INFINITY };
            }
            for body in 0..x.len() {
                let rise = a[body] - start.a0[body];
                let delta = differences[body].update(&mut series[body], n, rise);
                size = size.max(scale(applied, start.v[body], step));
                if n == SERIES {
                    change = change.max(delta.length());
                    noise = noise.max(NOISE_GAIN * rounding_of(rise, x[body] - start.x[body], start.x[body]));
                    noise = noise.max(NOISE_GAIN * f64::EPSILON * applied);
                }
            }
        }
        if passes.end(change / size, noise / size) {
            break;
        }
    }
    let last = series.iter().map(|series| series.b[SERIES - 1].length()).fold(0.0, f64::max);
    let error = (last - noise).max(0.0) / size;
    Attempt { series, converged: passes.have_converged(tolerance), error }
}
