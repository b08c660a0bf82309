//! The step: one predicted event after the other. [`advance`] is its table of contents.

use super::body::BodyId;
use super::event::{Event, EventKind};
use super::fault::Fault;
use super::force::Law;
use super::geometry::gap_of;
use super::impact;
use super::island::part;
use super::ledger::{record, record_contact};
use super::model::Model;
use super::motion::turn_back;
use super::neighbours::{a_little_after, predict_core_passes, predict_pair, reregister};
use super::pair::Pair;
use super::predict::{Gap, touch_tolerance};
use super::queue::{Kind, Predicted};
use super::restart::{Start, restart};
use super::state::State;
use super::tolerance::{FOUND, SAME_INSTANT, TIME_ROUNDING};

/// Carries out the next predicted event that is not after `state.until`; false when there is none.
/// What it has to report is left in the outbox.
pub(super) fn advance(model: &Model, state: &mut State) -> Result<bool, Fault> {
    let Some(next) = pop(state, state.until) else { return Ok(false) };
    debug_assert!(next.time >= state.reached, "predictions come in the order of time: {next:?}");
    state.reached = next.time;
    match next.kind {
        Kind::SegmentEnd => go_on(model, state, next.a, next.time)?,
        Kind::LeaveTiles => reregister(model, state, next.a, next.time),
        Kind::CorePass => pass_core(model, state, &next)?,
        Kind::Settled => settled(model, state, &next),
        Kind::ContactEnd => leave_contact(model, state, &next)?,
        Kind::Impact => meet(model, state, &next)?,
    }
    tidy(state);
    Ok(true)
}

fn pop(state: &mut State, until: f64) -> Option<Predicted> {
    let mut queue = std::mem::take(&mut state.queue);
    let mut dropped = 0;
    let next = queue.pop(until, &mut dropped, |predicted| state.holds(predicted));
    state.queue = queue;
    state.counters.stale_events += dropped;
    next
}

fn tidy(state: &mut State) {
    let mut queue = std::mem::take(&mut state.queue);
    queue.tidy(|predicted| state.holds(predicted));
    state.queue = queue;
}

/// Begins segments for all bodies at `state.now` and predicts everything: any of them may be concerned.
pub(super) fn begin_all(model: &Model, state: &mut State) -> Result<(), Fault> {
    let starts: Vec<Start> = model
        .present()
        .map(|body| (body, state.segments[body as usize]))
        .map(|(body, segment)| Start { body, x: segment.x, v: segment.v })
        .collect();
    restart(model, state, state.now, &starts)
}

/// The end of a segment: the next one goes on from there.
fn go_on(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), Fault> {
    restart(model, state, time, &[from_now(state, body, time)])
}

/// Where a body is on its segment.
fn from_now(state: &State, body: u32, time: f64) -> Start {
    Start { body, x: state.position(body, time), v: state.velocity(body, time) }
}

/// Two bodies are due to touch.
fn meet(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (pair, time) = (next.pair(), next.time);
    let gap = gap_of(model, state, pair, time);
    if !(gap.is_closing() && is_closed(&gap, reach(model, pair), time)) {
        let from = if gap.is_closing() { time } else { a_little_after(time) };
        predict_pair(model, state, pair, from, time);
        return Ok(());
    }
    let [also, rest] = simultaneous(model, state, pair, time, &gap);
    let mut left: Vec<Pair> = also.iter().map(Predicted::pair).collect();
    let outcome = impact::resolve(model, state, time, pair, &gap, &mut left);
    // What was not part of it is due as before.
    let unmet = also.into_iter().filter(|predicted| left.contains(&predicted.pair()));
    rest.into_iter().chain(unmet).for_each(|predicted| state.queue.push(predicted));
    outcome
}

/// Other impacts that are due at the same instant, for all that can be measured: their surfaces touch to
/// within the contact distance and close. And the other predictions of that instant. (A pair may have been
/// predicted twice.)
fn simultaneous(model: &Model, state: &mut State, pair: Pair, time: f64, gap: &Gap) -> [Vec<Predicted>; 2] {
    let params = &model.params;
    let longest = SAME_INSTANT * params.contact_duration;
    let window = (params.contact_distance / gap.rate.abs()).min(longest);
    let (mut also, mut rest) = (Vec::new(), Vec::new());
    while let Some(next) = pop(state, time + window) {
        let is_impact = next.kind == Kind::Impact;
        if is_impact && next.pair() == pair {
            continue;
        }
        let meets = || {
            let gap = gap_of(model, state, next.pair(), time);
            gap.rate < 0.0 && gap.distance <= params.contact_distance
        };
        if is_impact && meets() { also.push(next) } else { rest.push(next) }
    }
    [also, rest]
}

/// The larger radius of a pair, m.
fn reach(model: &Model, pair: Pair) -> f64 {
    pair.dynamic().map(|body| model.radius(body)).fold(0.0, f64::max)
}

/// Whether surfaces are as near as a found root leaves them: a search that gave up is farther off. A root
/// is known to the rounding of the time, in which they come nearer by |ḋ| times that.
fn is_closed(gap: &Gap, radius: f64, time: f64) -> bool {
    let rounding_of_time = TIME_ROUNDING * time * gap.rate.abs();
    gap.distance <= FOUND * touch_tolerance(gap.point, radius) + rounding_of_time
}

/// The body is turned back on its line at the core of a point attractor, the limit of ever thinner
/// ellipses, with its energy kept: it retraces its way, or where a force is not the same backwards, its
/// radial velocity is reversed.
fn pass_core(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (body, time) = (next.a, next.time);
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    let Law::Point { center, .. } = model.forces[next.b.index() as usize].law else {
        return Ok(());
    };
    if (center - x).length() > 2.0 * model.params.core_radius {
        predict_core_passes(model, state, body, time);
        return Ok(());
    }
    let inward = (center - x).normalize_or_zero();
    let speed = v.dot(inward);
    if speed <= 0.0 {
        return Ok(());
    }
    let turned = if turn_back(model, state, body, time) { -v } else { v - 2.0 * speed * inward };
    let mass = model.mass(body);
    state.account.impulses.add(mass * (turned - v));
    record(state, Event::of_one(time, EventKind::SingularPass, BodyId::of_dynamic(body).to_ref(), x));
    restart(model, state, time, &[Start { body, x, v: turned }])
}

/// The limit time of the bounces of two bodies has come.
fn settled(model: &Model, state: &mut State, next: &Predicted) {
    let (pair, time) = (next.pair(), next.time);
    let mut was_due = false;
    for (body, other) in pair.ends() {
        let contacts = &mut state.contacts[body as usize];
        let contact = contacts.iter_mut().find(|contact| contact.other == other);
        was_due |= contact.is_some_and(|contact| contact.settles_at.take().is_some());
    }
    if was_due {
        record_contact(model, state, time, EventKind::Rest, pair);
        let speed = state.path_of(model, pair.b).velocity(time);
        if state.velocity(pair.first(), time) != speed {
            record_contact(model, state, time, EventKind::Slide, pair);
        }
    }
}

/// A surface ends under a body, or nothing presses two bodies together any more.
fn leave_contact(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (pair, time) = (next.pair(), next.time);
    part(model, state, pair, time);
    let starts: Vec<Start> = pair.dynamic().map(|body| from_now(state, body, time)).collect();
    restart(model, state, time, &starts)
}
