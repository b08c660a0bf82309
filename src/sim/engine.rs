//! The step: one predicted event after the other. [`advance`] is its table of contents.

use glam::DVec3;

use super::account::present;
use super::contact::{Pair, Partner, gap_of};
use super::group::SAME_INSTANT;
use super::impact::{self, contact_event};
use super::island::{From, part, restart};
use super::model::Model;
use super::motion::{SegmentError, free_unheld, pass_core};
use super::neighbours::{predict_fixture, predict_pair, reregister};
use super::predict::{self, Gap};
use super::queue::{Kind, Predicted};
use super::state::State;
use super::{BodyRef, Event, EventKind, Fault};

/// Carries out the next predicted event that is not after `state.until`; false when there is none.
/// What it has to report is left in the outbox.
pub(super) fn advance(model: &Model, state: &mut State) -> Result<bool, Fault> {
    let Some(next) = pop(state, state.until) else { return Ok(false) };
    state.reached = next.time;
    match next.kind {
        Kind::SegmentEnd => go_on(model, state, next.a, next.time)?,
        Kind::LeaveTiles => reregister(model, state, next.a, next.time),
        Kind::CorePass => pass_core(model, state, &next)?,
        Kind::Settled | Kind::PairSettled => settled(model, state, &next),
        Kind::ContactEnd | Kind::PairEnd => leave_contact(model, state, &next)?,
        Kind::Impact | Kind::FixtureImpact => meet(model, state, &next)?,
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
    free_unheld(model, state);
    let starts: Vec<From> = present(model)
        .map(|body| (body, state.segments[body as usize]))
        .map(|(body, segment)| From { body, x: segment.x, v: segment.v })
        .collect();
    restart(model, state, state.now, &starts)
}

/// The end of a segment: the next one goes on from there.
fn go_on(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), Fault> {
    restart(model, state, time, &[from_now(state, body, time)])
}

/// Where a body is on its segment.
fn from_now(state: &State, body: u32, time: f64) -> From {
    From { body, x: state.position(body, time), v: state.velocity(body, time) }
}

/// Who a prediction of two bodies is about.
fn pair_of(next: &Predicted) -> Pair {
    let partner = if next.kind.is_of_pair() { Partner::Dynamic(next.b) } else { Partner::Static(next.b) };
    Pair::new(next.a, partner)
}

/// Two bodies are due to touch.
fn meet(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (pair, time) = (pair_of(next), next.time);
    let gap = gap_of(model, state, pair, time);
    if !(gap.is_closing() && is_closed(&gap, reach(model, pair), time)) {
        let from = if gap.is_closing() { time } else { a_little_after(time) };
        look_again(model, state, pair, from, time);
        return Ok(());
    }
    let [also, rest] = simultaneous(model, state, pair, time, &gap);
    let mut left: Vec<Pair> = also.iter().map(pair_of).collect();
    let outcome = impact::resolve(model, state, time, pair, &gap, &mut left);
    // What was not part of it is due as before.
    let unmet = also.into_iter().filter(|predicted| left.contains(&pair_of(predicted)));
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
        let is_impact = matches!(next.kind, Kind::Impact | Kind::FixtureImpact);
        if is_impact && pair_of(&next) == pair {
            continue;
        }
        let meets = || {
            let gap = gap_of(model, state, pair_of(&next), time);
            gap.rate < 0.0 && gap.distance <= params.contact_distance
        };
        if is_impact && meets() { also.push(next) } else { rest.push(next) }
    }
    [also, rest]
}

/// The larger radius of a pair, m.
fn reach(model: &Model, pair: Pair) -> f64 {
    pair.bodies().map(|body| model.movers[body as usize].radius).fold(0.0, f64::max)
}

/// Predicts again what was no contact.
pub(super) fn look_again(model: &Model, state: &mut State, pair: Pair, from: f64, time: f64) {
    match pair.partner {
        Partner::Dynamic(other) => predict_pair(model, state, pair.a, other, from, time),
        Partner::Static(fixture) => predict_fixture(model, state, pair.a, fixture, from, time),
    }
}

/// Where to go on looking after a prediction that led to nothing: the same time would only give the same
/// answer.
pub(super) fn a_little_after(time: f64) -> f64 {
    const LATER: f64 = 1e-9;
    time + LATER.max(4.0 * f64::EPSILON * time)
}

/// Whether surfaces are as near as a found root leaves them: a search that gave up is farther off. A root
/// is known to the rounding of the time, in which they come nearer by |ḋ| times that.
fn is_closed(gap: &Gap, radius: f64, time: f64) -> bool {
    let rounding_of_time = 16.0 * f64::EPSILON * time * gap.rate.abs();
    gap.distance <= 1e3 * predict::touch_tolerance(gap.point, radius) + rounding_of_time
}

/// The limit time of the bounces of two bodies has come.
fn settled(model: &Model, state: &mut State, next: &Predicted) {
    let (pair, time) = (pair_of(next), next.time);
    let mut was_due = false;
    for (body, partner) in pair.ends() {
        let contacts = &mut state.contacts[body as usize];
        let contact = contacts.iter_mut().find(|contact| contact.partner == partner);
        was_due |= contact.is_some_and(|contact| contact.settles_at.take().is_some());
    }
    if was_due {
        record_contact(model, state, time, EventKind::Rest, pair);
        let speed = pair.other().map_or(DVec3::ZERO, |other| state.velocity(other, time));
        if state.velocity(pair.a, time) != speed {
            record_contact(model, state, time, EventKind::Slide, pair);
        }
    }
}

/// A surface ends under a body, or nothing presses two bodies together any more.
fn leave_contact(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (pair, time) = (pair_of(next), next.time);
    part(model, state, pair, time);
    let starts: Vec<From> = pair.bodies().map(|body| from_now(state, body, time)).collect();
    restart(model, state, time, &starts)
}

pub(super) fn fault(model: &Model, body: u32, time: f64, error: SegmentError) -> Fault {
    let name = &model.movers[body as usize].identity.name;
    let message = match error {
        SegmentError::NotFinite => {
            format!(
                "body {name}: position, velocity or force is not a finite number; look at its forces and start"
            )
        }
        SegmentError::InCore => {
            format!(
                "body {name}: its centre lies on a point attractor, where the force has no value; move one of them"
            )
        }
        SegmentError::Stalled => {
            format!(
                "body {name}: the integrator's step has shrunk to nothing; a force is singular or not smooth there"
            )
        }
    };
    Fault { time, message }
}

/// Puts an event into the outbox under the next sequence number.
pub(super) fn record(state: &mut State, mut event: Event) {
    state.sequence += 1;
    event.seq = state.sequence;
    let kind = EventKind::ALL.iter().position(|kind| *kind == event.kind).unwrap_or(0);
    state.counters.events[kind] += 1;
    state.outbox.push_back(event);
}

/// An event of two bodies that exchanges no impulse.
pub(super) fn record_contact(model: &Model, state: &mut State, time: f64, kind: EventKind, pair: Pair) {
    let gap = gap_of(model, state, pair, time);
    let event = contact_event(time, kind, pair, &gap);
    record(state, in_id_order(model, event));
}

/// The same event with the body of the smaller UserID first and the normal from it to the other.
pub(super) fn in_id_order(model: &Model, mut event: Event) -> Event {
    if let Some(b) = event.b
        && rank(model, b) < rank(model, event.a)
    {
        (event.a, event.b, event.normal) = (b, Some(event.a), -event.normal);
    }
    event
}

/// UserID order.
pub(super) fn rank(model: &Model, body: BodyRef) -> (i64, u32, BodyRef) {
    let identity = match body {
        BodyRef::Dynamic(index) => &model.movers[index as usize].identity,
        BodyRef::Static(index) => &model.fixtures[index as usize].identity,
    };
    (identity.id, identity.order, body)
}
