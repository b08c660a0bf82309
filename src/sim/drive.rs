//! Goes through time as the method says: the one place where the methods part.

use std::sync::Arc;

use super::fault::Fault;
use super::method::Method;
use super::model::Model;
use super::state::State;
use super::{engine, stepping};

/// Tells that time is to go on from `state.now` to `state.until`.
pub(super) fn plan(model: &Model, state: &mut State) {
    match model.method {
        Method::Exact => {}
        Method::Thesis | Method::Fixed => stepping::plan(state),
    }
}

/// Goes on by one prediction or one collision, not beyond `state.until`; false when nothing is left.
pub(super) fn advance(model: &Model, state: &mut State) -> Result<bool, Fault> {
    match model.method {
        Method::Exact => engine::advance(model, state),
        Method::Thesis | Method::Fixed => stepping::advance(model, state),
    }
}

/// Whether it is known that nothing will ever happen; methods that step by Δt look no further than its end.
pub(super) fn is_over(model: &Model, state: &mut State) -> bool {
    model.method == Method::Exact && state.outbox.is_empty() && engine::is_over(state)
}

/// After an event: finds what only motion tells.
pub(super) fn look(model: &mut Arc<Model>, state: &mut State) {
    if model.method == Method::Exact {
        engine::find_group_step(model, state);
    }
}

/// Lets all bodies go on from where their segments begin, at `state.now`: at the start and after an edit.
pub(super) fn begin_all(model: &Model, state: &mut State) -> Result<(), Fault> {
    match model.method {
        Method::Exact => engine::begin_all(model, state),
        Method::Thesis | Method::Fixed => stepping::begin_all(model, state),
    }
}
