//! When bodies are to be stepped: where they are struck more often than events can follow, or held together in a way
//! that costs more than steps would.

use super::clock::step_at;
use super::data::{Activity, Decaying};
use super::tolerance::{
    CROWDED, CROWDED_IN_FIELDS, HALF_LIFE, HALF_LIFE_OF_WORK, LARGE_ISLAND, LEAST_CROWD, LEAST_STRUCK,
    LEAST_STRUCK_IN_FIELDS, MOST_AT_ONE_INSTANT, SHARE_OF_STEP, SMALLEST_CROWD, SMALLEST_ELASTIC_CROWD,
    STRUCK_OFTEN, STUCK, TOO_MUCH_WORK, WORK_OF_CUBE,
};
use crate::sim::body::BodyId;
use crate::sim::model::Model;
use crate::sim::state::State;

/// Notes an impact of a body at a time: one row of the ledger.
pub(in crate::sim) fn note_impact(model: &Model, state: &mut State, body: u32, time: f64, is_lossy: bool) {
    let half_life = HALF_LIFE * step_of(model, state, body, time);
    if let Some(dense) = &mut state.dense {
        let activity = &mut dense.activity[body as usize];
        activity.impacts.add(1.0, time, half_life);
        if is_lossy {
            activity.lossy.add(1.0, time, half_life);
            if activity.instant != time {
                (activity.instant, activity.at_once) = (time, 0);
            }
            activity.at_once += 1;
        }
    }
}

/// Notes that lossy bodies were resolved or integrated together.
pub(in crate::sim) fn note_work(model: &Model, state: &mut State, bodies: &[u32], time: f64) {
    let size = bodies.len() as f64;
    for body in bodies {
        let step = step_of(model, state, *body, time);
        let Some(dense) = &mut state.dense else { return };
        let work = &mut dense.activity[*body as usize].work;
        work.add(WORK_OF_CUBE * size * size * size, time, HALF_LIFE_OF_WORK * step);
    }
}

/// Notes a lossy impact of a body that touches nothing else: in a pit it meets one that does not move after the other. One that
/// moves may squeeze it against something, and it rebounds after ever so many impacts.
pub(in crate::sim) fn note_met(model: &Model, state: &mut State, body: u32, other: BodyId, time: f64) {
    let Some(dense) = &mut state.dense else { return };
    if other.is_static() && dense.activity[body as usize].met.replace(other) != Some(other) {
        note_held(model, state, &[body], time);
    }
}

/// Notes that bodies go on in contact, or met several at once.
pub(in crate::sim) fn note_held(model: &Model, state: &mut State, bodies: &[u32], time: f64) {
    if state.dense.as_ref().is_none_or(|dense| dense.is_beginning) {
        return;
    }
    for body in bodies {
        let was_integrated = state.segments[*body as usize].step > 0.0;
        // A stiff slip takes hundreds of steps of the integrator until it is gone, and gets on.
        if was_integrated && model.plan.spin {
            continue;
        }
        let half_life = HALF_LIFE * step_of(model, state, *body, time);
        let Some(dense) = &mut state.dense else { return };
        let weight = if was_integrated { SHARE_OF_STEP } else { 1.0 };
        dense.activity[*body as usize].held.add(weight, time, half_life);
    }
}

/// Whether events do not get on with one of some bodies: it goes on anew all the time.
pub(in crate::sim) fn is_stuck(
    model: &Model,
    state: &State,
    mut bodies: impl Iterator<Item = u32>,
    time: f64,
) -> bool {
    let Some(dense) = &state.dense else { return false };
    bodies.any(|body| {
        let held = &dense.activity[body as usize].held;
        held.sum >= STUCK && held.at(time, HALF_LIFE * step_of(model, state, body, time)) >= STUCK
    })
}

/// Forgets that it was so; whether it was.
pub(super) fn take_stuck(activity: &mut Activity) -> bool {
    std::mem::take(&mut activity.held).sum >= STUCK
}

/// Of how many moving bodies a component must be to be stepped, as this one is struck so often or its motion costs so
/// much; `None` if it is not.
pub(in crate::sim) fn least_crowd(model: &Model, state: &State, body: u32, time: f64) -> Option<usize> {
    let Activity { lossy, work, instant, at_once, .. } = &state.dense.as_ref()?.activity[body as usize];
    let step = step_of(model, state, body, time);
    let is_stuck = *instant == time && *at_once >= MOST_AT_ONE_INSTANT;
    if is_stuck || work.at(time, HALF_LIFE_OF_WORK * step) >= TOO_MUCH_WORK {
        return Some(LEAST_CROWD);
    }
    crowd(model, lossy.at(time, HALF_LIFE * step))
}

/// The same for a body of an elastic pair: by all its impacts, for elastic ones come without end too.
pub(in crate::sim) fn least_elastic_crowd(
    model: &Model,
    state: &State,
    body: u32,
    time: f64,
) -> Option<usize> {
    let impacts = &state.dense.as_ref()?.activity[body as usize].impacts;
    let half_life = HALF_LIFE * step_of(model, state, body, time);
    crowd(model, impacts.at(time, half_life)).map(|least| least.max(SMALLEST_ELASTIC_CROWD))
}

/// Whether a crowd of so many is to be looked for around bodies: not again within a step after that was in vain, unless the
/// least will do.
pub(in crate::sim) fn may_be_crowd(
    state: &State,
    mut bodies: impl Iterator<Item = u32>,
    least: usize,
    time: f64,
) -> bool {
    let Some(dense) = &state.dense else { return false };
    least <= LEAST_CROWD || bodies.any(|body| time >= dense.activity[body as usize].alone_until)
}

/// Notes that some bodies are all that touch each other, and too few.
pub(in crate::sim) fn note_too_few(model: &Model, state: &mut State, bodies: &[u32], time: f64) {
    for body in bodies {
        let until = time + step_of(model, state, *body, time);
        let Some(dense) = &mut state.dense else { return };
        dense.activity[*body as usize].alone_until = until;
    }
}

/// The step of a body where it is, s.
fn step_of(model: &Model, state: &State, body: u32, time: f64) -> f64 {
    if model.is_ballistic() {
        return model.dense_step;
    }
    step_at(model, body, time, (state.position(body, time), state.velocity(body, time)))
}

/// How many bodies must move together that are struck this often.
fn crowd(model: &Model, struck: f64) -> Option<usize> {
    if struck >= STRUCK_OFTEN {
        return Some(SMALLEST_CROWD);
    }
    if model.is_ballistic() {
        return (struck >= LEAST_STRUCK).then(|| (CROWDED / struck).ceil() as usize);
    }
    let large = (CROWDED_IN_FIELDS / struck).max(LARGE_ISLAND as f64);
    (struck >= LEAST_STRUCK_IN_FIELDS).then(|| large.min(CROWDED / struck).ceil() as usize)
}

impl Decaying {
    /// The sum as it is at a time.
    fn at(&self, time: f64, half_life: f64) -> f64 {
        if self.sum == 0.0 { 0.0 } else { self.sum * libm::exp2((self.last - time) / half_life) }
    }

    fn add(&mut self, weight: f64, time: f64, half_life: f64) {
        *self = Self { sum: weight + self.at(time, half_life), last: time };
    }
}
