//! The grid of model time on which groups are stepped.

use std::sync::Arc;

use glam::DVec3;

use super::tolerance::{FALL_IN_A_STEP, MOST_HALVINGS_BY_PULL, SHORTEST_STEP, WAY_IN_A_STEP, WAY_OF_RADIUS};
use crate::sim::books::undamped;
use crate::sim::force::{Law, Subject};
use crate::sim::model::{Model, StepSource};
use crate::sim::place::Place;
use crate::sim::state::State;

/// Sets the step of groups at a time; `at` gives where the bodies are and how fast. What is left of motion tells nothing:
/// once there are steps, they are kept when the forces are taken away, and those found from motion grow no longer.
pub(in crate::sim) fn set_step(model: &mut Model, time: f64, at: impl Fn(u32) -> (DVec3, DVec3)) {
    let (length, source) = step_length(model, time, at);
    let is_kept = match (model.step_source, source) {
        (_, StepSource::Nothing) | (StepSource::Forces | StepSource::ForcesAtRest, StepSource::Motion) => {
            true
        }
        (StepSource::Motion, StepSource::Motion) => model.dense_step <= length,
        _ => false,
    };
    if !is_kept {
        (model.dense_step, model.step_source) = (length, source);
    }
    model.plan.group_step = model.dense_step;
}

/// Sets it where nothing told it for certain before something happened; whether it was so.
pub(in crate::sim) fn find_step(model: &mut Arc<Model>, state: &State) -> bool {
    let is_found = matches!(model.step_source, StepSource::Motion | StepSource::Forces);
    if is_found || !model.plan.stepped_groups {
        return false;
    }
    let (time, now) = (state.reached, |body| state.path(body));
    let at = |body| (now(body).position(time), now(body).velocity(time));
    if matches!(step_length(model, time, at).1, StepSource::Motion | StepSource::Forces) {
        set_step(Arc::make_mut(model), time, at);
    }
    true
}

/// Length of a step, s: a power of two, so that grid times are exact, of at most √(2e-4·r/g) for the smallest radius
/// and the largest acceleration of the bodies where they are. The pull of a point attractor, which grows as they come
/// near, shortens steps where it is felt ([`step_at`]), but no further than for bodies that touch at its centre. Without
/// forces, or with ones so weak that most bodies fly faster than a fall through the map makes them, they pass a fiftieth of
/// the radius in a step. Under forces of the user's own alone, which may be next to nothing
/// just now, they pass a quarter at most.
fn step_length(model: &Model, time: f64, at: impl Fn(u32) -> (DVec3, DVec3)) -> (f64, StepSource) {
    if model.params.dense_step > 0.0 {
        return (model.params.dense_step, StepSource::Forces);
    }
    let smallest = model.bodies.range_of_radii().0;
    let (mut without, mut within, mut fastest) = (0.0_f64, 0.0_f64, 0.0_f64);
    // How many fly faster than a fall through the whole map makes them, and how many do not.
    let (across, mut flying) = (model.grid.size.max_element(), [0, 0]);
    for body in model.present() {
        let (x, v) = at(body);
        let subject = model.subject(body, time, Place::exact(x), v);
        fastest = fastest.max(v.length());
        let driven = acceleration(model, &subject, |_| 0.0);
        without = without.max(driven);
        flying[usize::from(v.length_squared() > 2.0 * driven * across)] += 1;
        within =
            within.max(acceleration(model, &subject, |intensity| intensity / (4.0 * smallest * smallest)));
    }
    let passed = |part: f64| power_of_two_below(part * smallest / fastest);
    if within == 0.0 {
        return known(passed(WAY_IN_A_STEP), StepSource::Motion);
    }
    let longest = power_of_two_below(fall_time(smallest, within)) * f64::from(1_u32 << MOST_HALVINGS_BY_PULL);
    let length =
        if without > 0.0 { power_of_two_below(fall_time(smallest, without)).min(longest) } else { longest };
    if model.forces.iter().any(|force| lasts(&force.law)) {
        let is_flight = within == without && flying[1] > flying[0];
        known(if is_flight { length.min(passed(WAY_IN_A_STEP)) } else { length }, StepSource::Forces)
    } else if fastest > 0.0 {
        known(length.min(passed(WAY_OF_RADIUS)), StepSource::Forces)
    } else {
        known(length, StepSource::ForcesAtRest)
    }
}

/// Whether a law drives what lies still, and goes on to.
fn lasts(law: &Law) -> bool {
    match *law {
        Law::Uniform { acceleration } => acceleration != DVec3::ZERO,
        Law::Point { intensity, .. } => intensity != 0.0,
        Law::Drag { .. } | Law::Custom(_) => false,
    }
}

/// A step and what it was found from, unless it is out of range.
fn known(length: f64, source: StepSource) -> (f64, StepSource) {
    if length > 0.0 { (length, source) } else { (0.0, StepSource::Nothing) }
}

/// How often the step of a body is halved for what drives it at a time, where it is as fast as it is.
pub(super) fn halvings_by_pull(model: &Model, body: u32, time: f64, (x, v): (DVec3, DVec3)) -> u8 {
    if model.params.dense_step > 0.0 || model.is_ballistic() {
        return 0;
    }
    let longest = fall_time(model.bodies.range_of_radii().0, undamped(model, body, time, (x, v)).length());
    // At a centre the pull is not a number: the shortest step there too.
    let is_short_enough = |halvings: &u8| halved(model.dense_step, *halvings) <= longest;
    (0..MOST_HALVINGS_BY_PULL).find(is_short_enough).unwrap_or(MOST_HALVINGS_BY_PULL)
}

/// The longest step of a body in a state at a time, s.
pub(in crate::sim) fn step_at(model: &Model, body: u32, time: f64, at: (DVec3, DVec3)) -> f64 {
    halved(model.dense_step, halvings_by_pull(model, body, time, at))
}

/// s.
pub(super) fn halved(step: f64, halvings: u8) -> f64 {
    step / f64::from(1_u32 << halvings)
}

/// How long a body needs to fall by what a step may leave unsolved, √(2e-4·r/g), s.
fn fall_time(radius: f64, acceleration: f64) -> f64 {
    (FALL_IN_A_STEP * radius / acceleration).sqrt()
}

/// What drives a body, without drag, m/s²; attractors by a pull of their intensity.
fn acceleration(model: &Model, subject: &Subject<'_>, pull: impl Fn(f64) -> f64) -> f64 {
    let of_law = |law: &Law| match *law {
        Law::Point { intensity, .. } => DVec3::X * pull(intensity.abs()),
        Law::Drag { .. } => DVec3::ZERO,
        Law::Uniform { .. } | Law::Custom(_) => law.force(subject) / subject.mass,
    };
    model.forces.iter().map(|force| of_law(&force.law)).sum::<DVec3>().length()
}

/// The largest power of two not above a time; 0 where that is out of range.
fn power_of_two_below(time: f64) -> f64 {
    if !time.is_normal() {
        return 0.0;
    }
    f64::from_bits(time.to_bits() & (0x7ff << 52))
}

/// End of a step that begins at a time: the next time of the grid of steps halved so often, or the one after if that
/// is too near.
pub(super) fn step_end(step: f64, halvings: u8, time: f64) -> f64 {
    let length = halved(step, halvings);
    let count = ((time + SHORTEST_STEP * length) / length).floor() + 1.0;
    let end = count * length;
    // Where a step is below the resolution of time, time must go on all the same.
    if end > time { end } else { time + length.max(time.abs() * f64::EPSILON * 2.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_on_the_grid_and_are_never_too_short() {
        let step = 1.0 / 1024.0;
        assert_eq!(step_end(step, 0, 0.0), step);
        assert_eq!(step_end(step, 0, step), 2.0 * step);
        assert_eq!(step_end(step, 0, 0.5 * step), step);
        assert_eq!(step_end(step, 0, 0.95 * step), 2.0 * step);
        assert_eq!(step_end(step, 1, step), 1.5 * step);
        assert_eq!(step_end(step, 2, 1.25 * step), 1.5 * step);
    }

    #[test]
    fn powers_of_two_scale() {
        assert_eq!(power_of_two_below(0.0013), 1.0 / 1024.0);
        assert_eq!(power_of_two_below(0.25), 0.25);
        assert_eq!(power_of_two_below(f64::INFINITY), 0.0);
    }
}
