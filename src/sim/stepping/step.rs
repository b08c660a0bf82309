//! One Δt: trial steps, collisions in order of time, the end.

use super::register::register;
use super::trial;
use crate::sim::fault::Fault;
use crate::sim::method::Method;
use crate::sim::model::Model;
use crate::sim::open_step::{Collisions, Hit, OpenStep, PairSearch, SetSearch};
use crate::sim::state::State;

/// Opens a Δt from `state.now` to `state.until` unless one is open: that one keeps its end.
pub(in crate::sim) fn plan(state: &mut State) {
    if state.step.is_none() && state.until > state.now {
        state.step = Some(Box::new(OpenStep { end: state.until, search: Collisions::Planned }));
    }
}

/// The table of contents of a Δt; each call does one line of it. False when `state.until` is reached.
pub(in crate::sim) fn advance(model: &Model, state: &mut State) -> Result<bool, Fault> {
    let Some(mut step) = state.step.take() else { return Ok(false) };
    if let Collisions::Planned = step.search {
        step.search = match model.method {
            Method::Fixed => Collisions::Pairs(PairSearch::begin(model, state, step.end)),
            _ => Collisions::Sets(SetSearch::begin(model, state, step.end)),
        };
        state.step = Some(step);
        return Ok(true);
    }
    match step.search.earliest() {
        Some(hit) if hit.time <= state.until => {
            state.reached = hit.time;
            step.search.resolve(model, state, &hit, step.end)?;
            state.step = Some(step);
            Ok(true)
        }
        _ if state.until < step.end => {
            state.step = Some(step);
            Ok(false)
        }
        _ => {
            close(model, state, step.end)?;
            plan(state);
            Ok(state.step.is_some())
        }
    }
}

impl Collisions {
    fn earliest(&self) -> Option<Hit> {
        match self {
            Self::Planned => None,
            Self::Sets(sets) => sets.earliest(),
            Self::Pairs(pairs) => pairs.earliest(),
        }
    }

    fn resolve(&mut self, model: &Model, state: &mut State, hit: &Hit, end: f64) -> Result<(), Fault> {
        match self {
            Self::Planned => Ok(()),
            Self::Sets(sets) => sets.resolve(model, state, hit, end),
            Self::Pairs(pairs) => pairs.resolve(model, state, hit, end),
        }
    }
}

/// Makes all motion up to the end of the Δt real.
fn close(model: &Model, state: &mut State, end: f64) -> Result<(), Fault> {
    for body in model.present() {
        trial::move_to(model, state, body, end)?;
        register(model, state, body, end);
    }
    (state.now, state.reached) = (end, end);
    Ok(())
}

/// All bodies go on from where they are now. A Δt that was open ends here: the rest of it is one of its own.
pub(in crate::sim) fn begin_all(model: &Model, state: &mut State) -> Result<(), Fault> {
    state.step = None;
    let time = state.now;
    for body in model.present() {
        let (x, v) = (state.position(body, time), state.velocity(body, time));
        trial::begin(model, state, body, time, x, v)?;
        register(model, state, body, time);
    }
    Ok(())
}
