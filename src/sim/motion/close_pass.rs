//! Close passes of point attractors: within the core radius a body is turned back on its line.

use super::plunge;
use super::tolerance::PASSED;
use crate::sim::engine::record;
use crate::sim::force::Law;
use crate::sim::island::{From, restart};
use crate::sim::model::Model;
use crate::sim::predict;
use crate::sim::queue::{Kind, Predicted};
use crate::sim::state::State;
use crate::sim::{BodyRef, Event, EventKind, Fault};

/// Predicts when a body comes within the core radius of an attractor on its present segment.
pub(in crate::sim) fn predict_core_passes(model: &Model, state: &mut State, body: u32, time: f64) {
    for (index, force) in (0u32..).zip(&model.forces) {
        let Law::Point { center, intensity } = force.law else { continue };
        if intensity <= 0.0 {
            continue;
        }
        if let Some(pass) = predict::core_pass(state.path(body), center, model.params.core_radius, time) {
            state.predict_one(pass.max(time), Kind::CorePass, body, index);
        }
    }
}

/// The body is turned back on its line at the core of a point attractor, the limit of ever thinner
/// ellipses, with its energy kept: it retraces its way, or where a force is not the same backwards, its
/// radial velocity is reversed.
pub(in crate::sim) fn pass_core(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (body, time) = (next.a, next.time);
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    let Law::Point { center, .. } = model.forces[next.b as usize].law else { return Ok(()) };
    if (center - x).length() > PASSED * model.params.core_radius {
        predict_core_passes(model, state, body, time);
        return Ok(());
    }
    let inward = (center - x).normalize_or_zero();
    let speed = v.dot(inward);
    if speed <= 0.0 {
        return Ok(());
    }
    let turned = if plunge::turn_back(model, state, body, time) { -v } else { v - 2.0 * speed * inward };
    let mass = model.movers[body as usize].mass;
    state.account.impulses.add(mass * (turned - v));
    record(state, Event::of_one(time, EventKind::SingularPass, BodyRef::Dynamic(body), x));
    restart(model, state, time, &[From { body, x, v: turned }])
}
