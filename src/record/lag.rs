//! How far playing falls behind the speed asked for, and what the time goes to: stepped heaps and fields by what
//! was counted, events for the rest.

use std::cmp::Reverse;

use rustc_hash::FxHashMap;

use super::run::Run;
use crate::scene::NodeKey;
use crate::sim::{ContactState, Counters};

/// Playing that reaches less than the speed asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lag {
    /// Share of the speed asked for that is reached, 0 to 1.
    pub share: f64,
    pub cause: LagCause,
}

/// What most of the time goes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LagCause {
    /// So many bodies that are stepped together.
    Stepped { bodies: usize },
    /// Events: how many per second of model time, and of which bodies most are in the Δt being looked at.
    Events { per_model_s: f64, busiest: Option<Busiest> },
    /// The integration of bodies in fields, of the one with the largest acceleration most.
    Field { body: Option<NodeKey> },
}

/// The bodies that most events are of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Busiest {
    pub a: NodeKey,
    pub b: Option<NodeKey>,
    /// Of all events listed, 0 to 1.
    pub share: f64,
}

/// Playing that loses less of its time is not said to fall behind.
const NOTED: f64 = 0.05;

/// Wall-clock seconds of one contact of a step, of one in one sweep, and of one evaluation of a field with what is
/// computed from it, on a machine of 2020. They only decide which cause is named: a factor of two changes nothing where
/// one cause stands out.
const CONTACT_S: f64 = 150e-9;
const SWEEP_S: f64 = 15e-9;
const EVALUATION_S: f64 = 250e-9;

/// What was measured between two looks.
pub(super) struct Measured {
    pub(super) before: Counters,
    /// Wall-clock seconds of computing.
    pub(super) worked: f64,
    /// Model seconds simulated and given up, and events reached.
    pub(super) gained: f64,
    pub(super) lost: f64,
    pub(super) events: f64,
}

pub(super) fn lag_of(run: &Run, measured: &Measured) -> Option<Lag> {
    let Measured { gained, lost, .. } = *measured;
    let is_noted = lost > NOTED * (gained + lost);
    is_noted.then(|| Lag { share: gained / (gained + lost), cause: cause(run, measured) })
}

fn cause(run: &Run, measured: &Measured) -> LagCause {
    let (now, before) = (run.simulation.counters(), &measured.before);
    // Counters go back with the simulation.
    let since = |of: fn(&Counters) -> u64| of(&now).saturating_sub(of(before)) as f64;
    let contacts = since(|counters| counters.contacts);
    let solved = since(|counters| counters.steps) + since(|counters| counters.halvings);
    let sweeps = since(|counters| counters.sweeps) / solved.max(1.0);
    let stepped = contacts * (CONTACT_S + sweeps * SWEEP_S);
    let field = since(|counters| counters.force_evaluations) * EVALUATION_S;
    let events = measured.worked - stepped - field;
    if stepped >= field.max(events) {
        return LagCause::Stepped { bodies: run.simulation.stepped().map_or(0, |stepped| stepped.count) };
    }
    if field >= events {
        return LagCause::Field { body: most_accelerated(run) };
    }
    let per_model_s = if measured.gained > 0.0 { measured.events / measured.gained } else { 0.0 };
    LagCause::Events { per_model_s, busiest: busiest(run) }
}

fn most_accelerated(run: &Run) -> Option<NodeKey> {
    let simulation = &run.simulation;
    let states = simulation.dynamic_bodies().filter_map(|body| Some((body, simulation.state(body)?)));
    let flying = states.filter(|(_, state)| state.contact == ContactState::Flight);
    let size = |acceleration: glam::DVec3| acceleration.length_squared();
    let most = flying.max_by(|(_, a), (_, b)| size(a.acceleration).total_cmp(&size(b.acceleration)));
    most.map(|(body, _)| simulation.key(body))
}

fn busiest(run: &Run) -> Option<Busiest> {
    let mut counts: FxHashMap<(NodeKey, Option<NodeKey>), u32> = FxHashMap::default();
    for row in &run.rows.list {
        *counts.entry((row.a_key, row.b_key)).or_default() += 1;
    }
    let most = counts.into_iter().max_by_key(|(bodies, count)| (*count, Reverse(*bodies)));
    most.map(|((a, b), count)| Busiest { a, b, share: f64::from(count) / run.rows.list.len() as f64 })
}
