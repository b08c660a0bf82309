//! The law of motion of one body: which acceleration it has, and the segment that follows from it.

use glam::DVec3;

use super::radau::{RadauError, RadauStart, radau_step};
use crate::sim::account::book_segment;
use crate::sim::contact::{Contact, constrain};
use crate::sim::force::{Law, Subject};
use crate::sim::model::Model;
use crate::sim::segment::Segment;
use crate::sim::state::{FieldColumn, State};

/// Why a body has no motion from here on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::sim) enum SegmentError {
    NotFinite,
    Stalled,
    /// The centre lies within the core of a point attractor, where its force has no meaning.
    InCore,
}

/// Sum of the applied forces, N.
pub(in crate::sim) fn applied_force(model: &Model, subject: &Subject<'_>) -> DVec3 {
    model.forces.iter().map(|force| force.law.force(subject)).sum()
}

/// Acceleration under the applied forces and the body's lasting contacts, m/s².
fn acceleration_of(model: &Model, contacts: &[Contact], subject: &Subject<'_>) -> DVec3 {
    let free = applied_force(model, subject) / subject.mass;
    constrain(model, contacts, subject.radius, subject.position, subject.velocity, free)
}

/// Lets a body go on from (x, v) at `time`: books the old segment, begins the new one, and makes every
/// prediction about the old one stale.
pub(in crate::sim) fn begin_segment(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
    v: DVec3,
) -> Result<(), SegmentError> {
    book_segment(model, state, body, time);
    if in_core(model, x) {
        return Err(SegmentError::InCore);
    }
    let mut segment = if needs_integration(model, state, body) {
        integrated(model, state, body, time, x, v)?
    } else {
        let subject = subject_at(model, body, time, x, v);
        Segment::ballistic(time, x, v, acceleration_of(model, &state.contacts[body as usize], &subject))
    };
    // The squares too: searches work with lengths, and do not end on infinite ones.
    if ![segment.x, segment.v, segment.a].iter().all(|vector| vector.length_squared().is_finite()) {
        return Err(SegmentError::NotFinite);
    }
    let index = body as usize;
    segment.constrained = !state.contacts[index].is_empty();
    state.segments[index] = segment;
    state.stamps[index] = state.stamps[index].wrapping_add(1);
    state.counters.segments += 1;
    Ok(())
}

/// Whether a point lies well inside the core of an attractor: a body that falls there turns back at the
/// core's surface, so only one that was put there can be inside.
fn in_core(model: &Model, at: DVec3) -> bool {
    model.forces.iter().any(|force| match force.law {
        Law::Point { center, intensity } if intensity > 0.0 => {
            (at - center).length() < 0.5 * model.params.core_radius
        }
        Law::Point { center, intensity } if intensity < 0.0 => at == center,
        _ => false,
    })
}

fn needs_integration(model: &Model, state: &State, body: u32) -> bool {
    !model.is_ballistic() || state.contacts[body as usize].iter().any(Contact::is_round)
}

/// One step of the field integrator. Its length comes from the state and the parameters only, so that it
/// does not depend on when somebody looks.
fn integrated(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
    v: DVec3,
) -> Result<Segment, SegmentError> {
    let index = body as usize;
    if state.fields.len() <= index {
        state.fields.resize(state.segments.len(), FieldColumn::default());
    }
    let old = state.segments[index];
    let goes_on = old.step > 0.0 && old.end == time;
    let column = state.fields[index];
    let start = RadauStart {
        time,
        x,
        v,
        step: column.next_step,
        previous: goes_on.then_some((&column.series, old.step)),
        tolerance: model.params.field_tolerance,
    };
    let contacts = &state.contacts[index];
    let step = radau_step(&start, &mut state.counters.force_evaluations, |time, x, v| {
        acceleration_of(model, contacts, &subject_at(model, body, time, x, v))
    });
    let (segment, series, next_step) = step.map_err(|error| match error {
        RadauError::NotFinite => SegmentError::NotFinite,
        RadauError::Stalled => SegmentError::Stalled,
    })?;
    state.fields[index] = FieldColumn { series, next_step };
    Ok(segment)
}

fn subject_at(model: &Model, body: u32, time: f64, position: DVec3, velocity: DVec3) -> Subject<'_> {
    let mover = &model.movers[body as usize];
    Subject {
        time,
        position,
        velocity,
        mass: mover.mass,
        radius: mover.radius,
        material: mover.material.as_deref(),
    }
}
