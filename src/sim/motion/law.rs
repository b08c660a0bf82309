//! The law of motion of one body: which acceleration it has, and the segment that follows from it.

use glam::DVec3;

use super::SegmentError;
use super::control::{Limits, are_sound};
use super::plunge::{Onward, way_on};
use super::radau::{RadauStart, radau_step};
use super::smoothness::drag_of;
use super::tolerance::{FOR_EVER, INSIDE, LONGEST_STEP, TERMINAL};
use crate::sim::books::book_segment;
use crate::sim::force::Law;
use crate::sim::model::Model;
use crate::sim::place::Place;
use crate::sim::segment::Segment;
use crate::sim::state::{FieldColumn, State};

/// Lets a body fly on from (x, v) at `time`: books the old segment, begins the new
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
        let subject = model.subject(body, time, Place::exact(x), v);
        (Segment::ballistic(time, x, v, model.applied_acceleration(&subject)), None)
    } else if is_terminal(model, body, x, v) {
        (Segment::ballistic(time, x, v, DVec3::ZERO), None)
    } else {
        let why = |error| if in_core(model, x) { SegmentError::InCore } else { error };
        integrated(model, state, body, time, (x, v)).map_err(why)?
    };
    check(model, &segment)?;
    place(model, state, body, segment, column);
    Ok(())
}

/// Whether a body in a uniform field has its terminal velocity, to rounding. Then it flies straight on for ever, which steps
/// would follow at most at the pace at which thick drag brings it back there, ever so slow as it falls.
fn is_terminal(model: &Model, body: u32, x: DVec3, v: DVec3) -> bool {
    let is_drag = |law: &Law| matches!(law, Law::Drag { .. });
    if !model.forces.iter().all(|force| force.law.is_uniform() || is_drag(&force.law)) {
        return false;
    }
    let subject = model.subject(body, 0.0, Place::exact(x), v);
    let drag = drag_of(model, body) * v.length_squared();
    model.applied_acceleration(&subject).length() <= TERMINAL * drag
}

/// Lets a body stay where it is from `time` on. An error leaves all as it was.
pub(in crate::sim) fn begin_stay(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
) -> Result<(), SegmentError> {
    let still = Segment::ballistic(time, x, DVec3::ZERO, DVec3::ZERO);
    let segment = Segment { constrained: true, ..still };
    check(model, &segment)?;
    place(model, state, body, segment, None);
    Ok(())
}

/// Whether a body can follow a segment.
pub(in crate::sim) fn check(model: &Model, segment: &Segment) -> Result<(), SegmentError> {
    if in_core(model, segment.x) {
        return Err(SegmentError::InCore);
    }
    let bounds = segment.acceleration_bound * DVec3::X;
    if are_sound([segment.x, segment.v, segment.a, bounds].iter()) {
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
    state.turn_freely(body, segment.start);
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
    state.note_begun(body);
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
            (at - center).length() < INSIDE * model.params.core_radius
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
    start: (DVec3, DVec3),
) -> Result<(Segment, Option<FieldColumn>), SegmentError> {
    let old = state.segments[body as usize];
    let column = state.fields.get(body as usize).copied().unwrap_or_default();
    let goes_on = old.step > 0.0 && old.end == time && !old.constrained;
    let from = match way_on(model, state, body, time, start) {
        Onward::Back(step) => {
            let (segment, series) = *step;
            return Ok((segment, Some(FieldColumn { series, next_step: segment.step })));
        }
        Onward::On(from) => from,
    };
    let start = RadauStart {
        time,
        place: from.place,
        v: from.v,
        reads_position: model.forces.iter().any(|force| matches!(force.law, Law::Custom(_))),
        step: column.next_step,
        previous: goes_on.then_some((&column.series, old.step)),
        radius: model.radius(body),
        drag: drag_of(model, body),
        limits: limits(model),
    };
    let (segment, column) = radau_step(&start, &mut state.counters.force_evaluations, |time, place, v| {
        model.applied_acceleration(&model.subject(body, time, place, v))
    })?;
    Ok((segment, Some(column)))
}

/// What bounds the steps of the integrators.
pub(super) fn limits(model: &Model) -> Limits {
    Limits {
        tolerance: model.params.field_tolerance,
        longest: if model.may_depend_on_time() { LONGEST_STEP } else { FOR_EVER },
    }
}
