//! One step of the 15th-order Gauss–Radau integrator for a body in a field.
//!
//! Everhart 1985, "An efficient integrator that uses Gauss-Radau spacings". The acceleration is a polynomial
//! of degree 7 through eight Radau nodes, so the step itself is the dense output: position and velocity are
//! its integrals.

use glam::DVec3;

use super::SegmentError;
use super::collocation::{Differences, NODES, beginning, extrapolate, terms_at};
use super::control::{
    Accepted, Attempt, Beginning, Limits, Passes, accept, are_sound, first_guess, rounding_of, scale,
};
use super::smoothness::Course;
use super::tolerance::{FARTHEST_HINT, MAX_PASSES, NOISE_GAIN};
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
    /// m: what a length is short or long against.
    pub radius: f64,
    /// See [`super::smoothness::drag_of`].
    pub drag: f64,
    pub limits: Limits,
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
    if !are_sound([a0, start.place.x, start.v].iter()) {
        return Err(SegmentError::NotFinite);
    }
    let course = Course { time: start.time, drag: start.drag, v: start.v, a: a0 };
    let first = first_step(start, a0, &mut field).min(start.limits.longest).min(course.resolved());
    let mut guess = start.previous.map(|(series, length)| extrapolate(series, first / length));
    let accepted = accept(
        start.time,
        first,
        start.limits,
        |step| correct(start, a0, step, guess.take().unwrap_or_default(), &mut field),
        |step, series, reach| course.look(series, step, reach),
    );
    let Accepted { step, share, next_step, series } = accepted?;
    let step = share * step;
    let series = Series { low: start.place.low, ..beginning(&series, share) };
    let segment = Segment {
        end: start.time + step,
        acceleration_bound: a0.length() + series.bound(),
        step,
        ..Segment::ballistic(start.time, start.place.x, start.v, a0)
    };
    Ok((segment, FieldColumn { series, next_step }))
}

/// The step to try first, s.
fn first_step(start: &RadauStart<'_>, a0: DVec3, field: &mut impl FnMut(f64, DVec3, DVec3) -> DVec3) -> f64 {
    let way = start.step * (start.v.length() + start.step * a0.length());
    let is_known = start.previous.is_some() || way <= FARTHEST_HINT * start.radius;
    if start.step > 0.0 && is_known {
        return start.step;
    }
    let body = Beginning { radius: start.radius, speed: start.v.length(), acceleration: a0.length() };
    first_guess(&std::iter::once(body), |probe| {
        let way = probe * (start.v + (0.5 * probe) * a0);
        let ahead = field(start.time + probe, way, start.v + probe * a0);
        (a0.length(), (ahead - a0).length())
    })
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
        for (n, node) in NODES.iter().enumerate().skip(1) {
            let tau = node * step;
            let (position_term, velocity_term) = terms_at(&series, n);
            let way = tau * (start.v + tau * (0.5 * a0 + position_term));
            let v = start.v + tau * (a0 + velocity_term);
            let a = field(start.time + tau, way, v);
            if !are_sound([a].iter()) {
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
    Attempt { series, converged: passes.have_converged(start.limits.tolerance), error: last / size }
}
