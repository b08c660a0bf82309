//! Close passes of point attractors: within the core radius a body is turned back on its line, or captured.

use glam::DVec3;

use super::held::{Attractor, energy_above};
use super::plunge;
use super::tolerance::PASSED;
use crate::sim::contact::Pair;
use crate::sim::engine::record;
use crate::sim::force::Law;
use crate::sim::island::{From, part, restart};
use crate::sim::model::Model;
use crate::sim::predict;
use crate::sim::queue::{Kind, Predicted};
use crate::sim::state::State;
use crate::sim::{BodyRef, Event, EventKind, Fault};

/// Predicts when a body comes within the core radius of an attractor on its present segment.
pub(in crate::sim) fn predict_core_passes(model: &Model, state: &mut State, body: u32, time: f64) {
    if state.held.contains(body) {
        return;
    }
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
/// radial velocity is reversed. One that is bound to the core is captured.
pub(in crate::sim) fn pass_core(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (body, time) = (next.a, next.time);
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    let Law::Point { center, intensity } = model.forces[next.b as usize].law else { return Ok(()) };
    if (center - x).length() > PASSED * model.params.core_radius {
        predict_core_passes(model, state, body, time);
        return Ok(());
    }
    let inward = (center - x).normalize_or_zero();
    let speed = v.dot(inward);
    if speed <= 0.0 {
        return Ok(());
    }
    if (Attractor { center, intensity }).captures(model, state, body, (x, v)) {
        return capture(model, state, body, time);
    }
    let turned = if plunge::turn_back(model, state, body, time) { -v } else { v - 2.0 * speed * inward };
    let mass = model.movers[body as usize].mass;
    state.account.impulses.add(mass * (turned - v));
    record(state, Event::of_one(time, EventKind::SingularPass, BodyRef::Dynamic(body), x));
    restart(model, state, time, &[From { body, x, v: turned }])
}

/// The body stays where it is. What it lay against may go on: it is met again at once where it closes.
fn capture(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), Fault> {
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    state.account.impact_losses.add(energy_above(model, state, body, time, x));
    state.account.impulses.add(-model.movers[body as usize].mass * v);
    record(state, Event::of_one(time, EventKind::Captured, BodyRef::Dynamic(body), x));
    let pairs: Vec<Pair> =
        state.contacts[body as usize].iter().map(|contact| Pair::new(body, contact.partner)).collect();
    let mut starts = vec![From { body, x, v: DVec3::ZERO }];
    for pair in pairs {
        part(model, state, pair, time);
        starts.extend(pair.bodies().filter(|other| *other != body).map(|other| From {
            body: other,
            x: state.position(other, time),
            v: state.velocity(other, time),
        }));
    }
    state.held.insert(body);
    restart(model, state, time, &starts)
}
