//! One step of the 15th-order Gauss–Radau integrator for a body in a field.
//!
//! Everhart 1985, "An efficient integrator that uses Gauss-Radau spacings". The acceleration is a polynomial
//! of degree 7 through eight Radau nodes, so the step itself is the dense output: position and velocity are
//! its integrals.

use glam::DVec3;

use super::SegmentError;
use super::collocation::{Differences, NODES, extrapolate, terms_at};
use super::control::{Accepted, Attempt, Passes, accept, first_guess, rounding_of, scale};
use super::tolerance::{LONGEST_STEP, MAX_PASSES, NOISE_GAIN};
use crate::sim::place::Place;
use crate::sim::segment::{SERIES, Segment, Series};
use crate::sim::state::FieldColumn;

/// Where a step begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct RadauStart<'a> {
    pub time: f64,
    pub place: Place,
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

/// One accepted step as a segment, with the step to try next.
pub(super) fn radau_step(
    start: &RadauStart<'_>,
    evaluations: &mut u64,
    mut acceleration: impl FnMut(f64, Place, DVec3) -> DVec3,
) -> Result<(Segment, FieldColumn), SegmentError> {
    let mut field = |time, way, v| {
        *evaluations += 1;
        acceleration(time, start.place.moved(way), v)
    };
    let a0 = field(start.time, DVec3::ZERO, start.v);
    if !(a0.is_finite() && start.place.x.is_finite() && start.v.is_finite()) {
        return Err(SegmentError::NotFinite);
    }
    let first = if start.step > 0.0 {
        start.step.min(LONGEST_STEP)
    } else {
        first_guess(|probe| {
            let ahead = field(start.time + probe, probe * start.v, start.v + probe * a0);
            (a0.length(), (ahead - a0).length())
        })
    };
    let mut guess = start.previous.map(|(series, length)| extrapolate(series, first / length));
    let accepted = accept(start.time, first, start.tolerance, |step| {
        correct(start, a0, step, guess.take().unwrap_or_default(), &mut field)
    });
    let Accepted { step, next_step, series } = accepted?;
    let series = Series { low: start.place.low, ..series };
    let segment = Segment {
        end: start.time + step,
        acceleration_bound: a0.length() + series.bound(),
        step,
        ..Segment::ballistic(start.time, start.place.x, start.v, a0)
    };
    Ok((segment, FieldColumn { series, next_step }))
}

/// Gauss–Seidel passes over the nodes until the last coefficient stands still.
fn correct(
    start: &RadauStart<'_>,
    a0: DVec3,
    step: f64,
    guess: Series,
    field: &mut impl FnMut(f64, DVec3, DVec3) -> DVec3,
) -> Attempt<Series> {
    let mut series = guess;
    let mut differences = Differences::of(&series);
    let mut passes = Passes::new();
    let (mut size, mut noise) = (0.0, 0.0);
    for _ in 0..MAX_PASSES {
        let mut change = 0.0;
        let mut largest = a0.length();
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
            let delta = differences.update(&mut series, n, a - a0);
            if n == SERIES {
                change = delta.length();
                let rounding = f64::EPSILON * a.length();
                noise = NOISE_GAIN
                    * if start.reads_position { rounding_of(a - a0, way, start.place.x) } else { rounding };
            }
        }
        size = scale(largest, start.v, step);
        if passes.end(change / size, noise / size) {
            break;
        }
    }
    let last = (series.b[SERIES - 1].length() - noise).max(0.0);
    Attempt { series, converged: passes.have_converged(start.tolerance), error: last / size }
}
