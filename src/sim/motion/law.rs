//! The law of motion of one body: which acceleration it has, and the segment that follows from it.

use glam::DVec3;

use super::plunge::{self, Next, Point};
use super::radau::{RadauError, RadauStart, radau_step};
use crate::sim::books::book_segment;
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
    model.applied_force(subject)
}

/// Lets a body without lasting contacts go on from (x, v) at `time`: books the old segment, begins the new
/// one, and makes every prediction about the old one stale. An error leaves all as it was.
pub(in crate::sim) fn begin_segment(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
    v: DVec3,
) -> Result<(), SegmentError> {
    let (segment, column) = if model.is_ballistic() {
        let subject = subject_at(model, body, time, x, v);
        (Segment::ballistic(time, x, v, applied_force(model, &subject) / subject.mass), None)
    } else {
        integrated(model, state, body, time, x, v)?
    };
    check(model, &segment)?;
    place(model, state, body, segment, column);
    Ok(())
}

/// Whether a body can follow a segment.
pub(in crate::sim) fn check(model: &Model, segment: &Segment) -> Result<(), SegmentError> {
    if in_core(model, segment.x) {
        return Err(SegmentError::InCore);
    }
    // The squares too: searches work with lengths, and do not end on infinite ones.
    if [segment.x, segment.v, segment.a].iter().all(|vector| vector.length_squared().is_finite()) {
        Ok(())
    } else {
        Err(SegmentError::NotFinite)
    }
}

/// Books a body's old segment and puts a sound new one in its place.
pub(in crate::sim) fn place(
    model: &Model,
    state: &mut State,
    body: u32,
    segment: Segment,
    column: Option<FieldColumn>,
) {
    book_segment(model, state, body, segment.start);
    state.forget_touching(body);
    let index = body as usize;
    if let Some(column) = column {
        if state.fields.len() <= index {
            state.fields.resize(state.segments.len(), FieldColumn::default());
        }
        state.fields[index] = column;
    }
    state.segments[index] = segment;
    state.stamps[index] = state.stamps[index].wrapping_add(1);
    state.counters.segments += 1;
}

/// The step that the integrator would try next for a body in contact whose segment ends; 0 if unknown.
pub(in crate::sim) fn step_hint(state: &State, body: u32, time: f64) -> f64 {
    let old = &state.segments[body as usize];
    if old.constrained && old.step > 0.0 && old.end == time {
        state.fields[body as usize].next_step
    } else {
        0.0
    }
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

/// One step of the field integrator. Its length comes from the state and the parameters only, so that it
/// does not depend on when somebody looks.
fn integrated(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
    v: DVec3,
) -> Result<(Segment, Option<FieldColumn>), SegmentError> {
    let old = state.segments[body as usize];
    let column = state.fields.get(body as usize).copied().unwrap_or_default();
    let goes_on = old.step > 0.0 && old.end == time && !old.constrained;
    let from = match plunge::next(state, body, time, v) {
        Some(Next::Leg(leg)) => {
            let (segment, series) = *leg;
            return Ok((segment, Some(FieldColumn { series, next_step: segment.step })));
        }
        Some(Next::Out(from)) => from,
        None => {
            plunge::remember(model, state, body, time);
            Point { x, low: low_part(state, body, time, x), v }
        }
    };
    let start = RadauStart {
        time,
        x: from.x,
        low: from.low,
        v: from.v,
        reads_position: model.forces.iter().any(|force| matches!(force.law, Law::Custom(_))),
        step: column.next_step,
        previous: goes_on.then_some((&column.series, old.step)),
        tolerance: model.params.field_tolerance,
    };
    let step = radau_step(&start, &mut state.counters.force_evaluations, |time, at, v| {
        let subject = Subject { low: at.low, ..subject_at(model, body, time, at.x, v) };
        applied_force(model, &subject) / subject.mass
    });
    let (segment, series, next_step) = step.map_err(|error| match error {
        RadauError::NotFinite => SegmentError::NotFinite,
        RadauError::Stalled => SegmentError::Stalled,
    })?;
    Ok((segment, Some(FieldColumn { series, next_step })))
}

/// What a body that goes on from where it is has beyond the digits of its position, m.
fn low_part(state: &State, body: u32, time: f64, x: DVec3) -> DVec3 {
    let path = state.path(body);
    let (at, low) = path.position_split(time);
    if path.series.is_some() && at == x { low } else { DVec3::ZERO }
}

pub(in crate::sim) fn subject_at(
    model: &Model,
    body: u32,
    time: f64,
    position: DVec3,
    velocity: DVec3,
) -> Subject<'_> {
    let dynamic = model.dynamic(body);
    Subject {
        time,
        position,
        low: DVec3::ZERO,
        velocity,
        mass: dynamic.mass(),
        radius: model.radius(body),
        material: dynamic.material.as_deref(),
    }
}
