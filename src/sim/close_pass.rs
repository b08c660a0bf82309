//! Close passes of point attractors: within the core radius a body is turned back on its line, or captured.

use glam::DVec3;

use super::account::angular;
use super::body::BodyId;
use super::capture::{Attractor, hold};
use super::event::{Event, EventKind};
use super::fault::Fault;
use super::force::Law;
use super::island::part;
use super::ledger::record;
use super::model::Model;
use super::motion::turn_back;
use super::neighbours::predict_core_passes;
use super::pair::Pair;
use super::queue::Predicted;
use super::restart::{Start, restart};
use super::state::State;
use super::tolerance::PASSED;

/// The body is turned back on its line at the core of a point attractor, the limit of ever thinner
/// ellipses, with its energy kept: it retraces its way, or where a force is not the same backwards, its
/// radial velocity is reversed. One that is bound to the core is captured.
pub(super) fn pass_core(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (body, time) = (next.a, next.time);
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    let Law::Point { center, intensity } = model.forces[next.b.index() as usize].law else { return Ok(()) };
    if (center - x).length() > PASSED * model.params.core_radius {
        predict_core_passes(model, state, body, time);
        return Ok(());
    }
    let inward = (center - x).normalize_or_zero();
    let speed = v.dot(inward);
    if speed <= 0.0 {
        return Ok(());
    }
    if (Attractor { center, intensity }).captures(model, state, body, time) {
        return capture(model, state, body, time);
    }
    let turned = if turn_back(model, state, body, time) { -v } else { v - 2.0 * speed * inward };
    state.account.impulses.add(model.mass(body) * (turned - v));
    if model.plan.spin {
        state.account.angular.impulses.add(angular(x, model.mass(body) * (turned - v)));
    }
    record(state, Event::of_one(time, EventKind::SingularPass, BodyId::of_dynamic(body).to_ref(), x));
    restart(model, state, time, &[Start { body, x, v: turned }])
}

/// The body stays where it is. What it lay against may go on: it is met again at once where it closes.
pub(super) fn capture(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), Fault> {
    let x = state.position(body, time);
    hold(model, state, body, time);
    let pairs: Vec<Pair> =
        state.contacts[body as usize].iter().map(|contact| Pair::of(body, contact.other)).collect();
    let mut starts = vec![Start { body, x, v: DVec3::ZERO }];
    for pair in pairs {
        part(model, state, pair, time);
        starts.extend(pair.dynamic().filter(|other| *other != body).map(|other| Start {
            body: other,
            x: state.position(other, time),
            v: state.velocity(other, time),
        }));
    }
    restart(model, state, time, &starts)
}
