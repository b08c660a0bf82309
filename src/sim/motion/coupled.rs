//! One step of the Gauss–Radau integrator for bodies that move together in contact: the method of
//! [`super::radau`] with the coefficients of all bodies found at once.

use glam::DVec3;

use super::SegmentError;
use super::collocation::{Differences, NODES, beginning};
use super::control::{
    Accepted, Attempt, Beginning, Passes, accept, are_sound, first_guess, rounding_of, scale,
};
use super::law::limits;
use super::smoothness::{Course, Smooth, drag_of};
use super::tolerance::{MAX_PASSES, NOISE_GAIN};
use crate::sim::model::Model;
use crate::sim::segment::{SERIES, Segment, Series};
use crate::sim::state::FieldColumn;

/// A segment, with its series if it is integrated.
pub(in crate::sim) type Step = (Segment, Option<FieldColumn>);

/// Accelerations of all bodies, and the largest of the accelerations that they are the difference of: the
/// applied and the contact forces may all but cancel, and their rounding does not.
pub(in crate::sim) type Field = (Vec<DVec3>, f64);

/// Where bodies in contact begin a step.
pub(in crate::sim) struct CoupledStart<'a> {
    pub model: &'a Model,
    pub ids: &'a [u32],
    pub time: f64,
    pub x: &'a [DVec3],
    pub v: &'a [DVec3],
    /// The step to try first, s; 0 asks for one from the field itself.
    pub hint: f64,
    /// The longest step, s. Behind the bodies there may be more vectors that are integrated with them.
    pub longest: f64,
    /// How many times the accelerations are rounded as much as their sizes are: 1, or more where a force has the direction
    /// of a small vector.
    pub noise: f64,
}

/// One accepted step of all bodies, of the same length. `accelerations` are asked for at nodes, by number, time,
/// positions and velocities: again and again at each, where they hardly change.
pub(in crate::sim) fn coupled_step(
    start: &CoupledStart<'_>,
    evaluations: &mut u64,
    mut accelerations: impl FnMut(usize, f64, &[DVec3], &[DVec3]) -> Field,
) -> Result<Vec<Step>, SegmentError> {
    let mut field = |node: usize, time: f64, x: &[DVec3], v: &[DVec3]| {
        *evaluations += x.len() as u64;
        accelerations(node, time, x, v)
    };
    let (a0, size) = field(0, start.time, start.x, start.v);
    if !(are_sound(a0.iter().chain(start.x).chain(start.v)) && size.is_finite()) {
        return Err(SegmentError::NotFinite);
    }
    let courses = start.courses(&a0);
    let resolved = courses.iter().map(Course::resolved).fold(f64::INFINITY, f64::min);
    let mut limits = limits(start.model);
    limits.longest = limits.longest.min(start.longest);
    let first = start.first_step(&a0, size, &mut field).min(limits.longest).min(resolved);
    let accepted = accept(
        start.time,
        first,
        limits,
        |step| correct(start, &a0, step, limits.tolerance, &mut field),
        |step, series: &Vec<Series>, reach| {
            let looks = courses.iter().zip(series).map(|(course, series)| course.look(series, step, reach));
            looks.fold(Smooth::Yes, Smooth::and)
        },
    );
    Ok(start.segments(&a0, &accepted?))
}

impl CoupledStart<'_> {
    fn courses(&self, a0: &[DVec3]) -> Vec<Course> {
        let bodies = self.ids.iter().zip(self.v.iter().zip(a0));
        let course =
            |body: u32, v: DVec3, a: DVec3| Course { time: self.time, drag: drag_of(self.model, body), v, a };
        bodies.map(|(body, (v, a))| course(*body, *v, *a)).collect()
    }

    /// The step to try first, s.
    fn first_step(
        &self,
        a0: &[DVec3],
        size: f64,
        field: &mut impl FnMut(usize, f64, &[DVec3], &[DVec3]) -> Field,
    ) -> f64 {
        if self.hint > 0.0 {
            return self.hint;
        }
        // At rest the accelerations are what rounding leaves of the applied ones.
        let bodies = self.ids.iter().zip(self.v).map(|(body, v)| Beginning {
            radius: self.model.radius(*body),
            speed: v.length(),
            acceleration: size,
        });
        first_guess(&bodies, |probe| {
            let ways = self.v.iter().zip(a0).map(|(v, a)| probe * (*v + (0.5 * probe) * *a));
            let x: Vec<DVec3> = self.x.iter().zip(ways).map(|(x, way)| *x + way).collect();
            let v: Vec<DVec3> = self.v.iter().zip(a0).map(|(v, a)| *v + probe * *a).collect();
            let (ahead, size) = field(0, self.time + probe, &x, &v);
            let changes = ahead.iter().zip(a0).map(|(ahead, a0)| (*ahead - *a0).length());
            (size, changes.fold(0.0, f64::max))
        })
    }

    fn segments(&self, a0: &[DVec3], accepted: &Accepted<Vec<Series>>) -> Vec<Step> {
        let Accepted { step, share, next_step, series } = accepted;
        let step = share * step;
        let one = |(body, series): (usize, &Series)| {
            let series = beginning(series, *share);
            let segment = Segment {
                end: self.time + step,
                acceleration_bound: a0[body].length() + series.bound(),
                step,
                ..Segment::ballistic(self.time, self.x[body], self.v[body], a0[body])
            };
            (segment, Some(FieldColumn { series, next_step: *next_step }))
        };
        series.iter().enumerate().map(one).collect()
    }
}

/// Gauss–Seidel passes over the nodes until the last coefficients stand still. The error is judged by the
/// largest applied acceleration of the step.
fn correct(
    start: &CoupledStart<'_>,
    a0: &[DVec3],
    step: f64,
    tolerance: f64,
    field: &mut impl FnMut(usize, f64, &[DVec3], &[DVec3]) -> Field,
) -> Attempt<Vec<Series>> {
    let mut series = vec![Series::default(); start.x.len()];
    let mut differences: Vec<Differences> = series.iter().map(Differences::of).collect();
    let (mut x, mut v) = (start.x.to_vec(), start.v.to_vec());
    let mut passes = Passes::new();
    let (mut noise, mut size) = (0.0_f64, 0.0_f64);
    for _ in 0..MAX_PASSES {
        let mut change = 0.0_f64;
        (noise, size) = (0.0, f64::MIN_POSITIVE);
        for (n, node) in NODES.iter().enumerate().skip(1) {
            let tau = node * step;
            for body in 0..x.len() {
                let (a0, b) = (a0[body], &series[body]);
                x[body] = start.x[body] + tau * (start.v[body] + tau * (0.5 * a0 + b.position_term(*node)));
                v[body] = start.v[body] + tau * (a0 + b.velocity_term(*node));
            }
            let (a, applied) = field(n, start.time + tau, &x, &v);
            if !(are_sound(a.iter()) && applied.is_finite()) {
                return Attempt { series, converged: false, error: f64::INFINITY };
            }
            for body in 0..x.len() {
                let rise = a[body] - a0[body];
                let delta = differences[body].update(&mut series[body], n, rise);
                size = size.max(scale(applied, start.v[body], step));
                if n == SERIES {
                    change = change.max(delta.length());
                    noise = noise.max(NOISE_GAIN * rounding_of(rise, x[body] - start.x[body], start.x[body]));
                    noise = noise.max(start.noise * NOISE_GAIN * f64::EPSILON * applied);
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
