//! How far playing falls behind the speed asked for, and what the time goes to, by what was counted.

use std::cmp::Reverse;

use rustc_hash::FxHashMap;

use super::frame::{Busiest, Lag, LagCause};
use super::run::Run;
use crate::scene::NodeKey;
use crate::sim::{ContactState, Counters};

/// Playing that loses less of its time is not said to fall behind.
const NOTED: f64 = 0.05;

/// Wall-clock seconds of one contact of a step, of one in one sweep, of one evaluation of a field with what is
/// computed from it, of a pair whose impact is predicted, and of an event, on a machine of 2020. They only decide which cause is named: a factor of two changes nothing where
/// one cause stands out.
const CONTACT_S: f64 = 150e-9;
const SWEEP_S: f64 = 15e-9;
const EVALUATION_S: f64 = 250e-9;
const PAIR_S: f64 = 100e-9;
const EVENT_S: f64 = 10e-6;

/// The last events, among which the busiest bodies are looked for.
const LOOKED_AT: usize = 2000;

/// What was measured between two looks.
pub(super) struct Measured {
    pub(super) before: Counters,
    /// Model seconds played and given up, and events reached.
    pub(super) gained: f64,
    pub(super) lost: f64,
    pub(super) events: f64,
}

/// What is only looked up costs no simulating that could be told of.
pub(super) fn lag_of(run: &Run, measured: &Measured) -> Option<Lag> {
    let Measured { gained, lost, .. } = *measured;
    let is_noted = lost > NOTED * (gained + lost) && run.simulation.counters() != measured.before;
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
    let events = since(|counters| counters.pair_tests) * PAIR_S + measured.events * EVENT_S;
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
    let rows = &run.recording.ledger;
    let listed = rows.len().min(LOOKED_AT);
    for row in rows.iter_from(rows.len() - listed) {
        *counts.entry((row.a_key, row.b_key)).or_default() += 1;
    }
    let most = counts.into_iter().max_by_key(|(bodies, count)| (*count, Reverse(*bodies)));
    most.map(|((a, b), count)| Busiest { a, b, share: f64::from(count) / listed as f64 })
}
