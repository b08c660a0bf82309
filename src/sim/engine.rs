//! The step: one predicted event after the other. [`advance`] is its table of contents.

use glam::DVec3;

use super::account::present;
use super::impact;
use super::lasting::{keep_contacts, prune_contacts};
use super::model::Model;
use super::motion::{SegmentError, begin_segment, turn_back};
use super::neighbours::{predict_all, predict_core_passes, predict_fixture, predict_pair, reregister};
use super::predict::{self, sphere_fixture_gap, sphere_sphere_gap};
use super::queue::{Kind, Predicted};
use super::state::State;
use super::{BodyRef, Event, EventKind, Fault};

/// Carries out the next predicted event that is not after `state.until`; false when there is none.
/// What it has to report is left in the outbox.
pub(super) fn advance(model: &Model, state: &mut State) -> Result<bool, Fault> {
    let Some(next) = pop(state) else { return Ok(false) };
    state.reached = next.time;
    match next.kind {
        Kind::SegmentEnd => go_on(model, state, next.a, next.time)?,
        Kind::LeaveTiles => reregister(model, state, next.a, next.time),
        Kind::CorePass => pass_core(model, state, &next)?,
        Kind::Settled => settled(model, state, &next),
        Kind::ContactEnd => leave_contact(model, state, &next)?,
        Kind::Impact => meet(model, state, &next)?,
        Kind::FixtureImpact => meet_fixture(model, state, &next)?,
    }
    tidy(state);
    Ok(true)
}

fn pop(state: &mut State) -> Option<Predicted> {
    let mut queue = std::mem::take(&mut state.queue);
    let mut dropped = 0;
    let next = queue.pop(state.until, &mut dropped, |predicted| state.holds(predicted));
    state.queue = queue;
    state.counters.stale_events += dropped;
    next
}

fn tidy(state: &mut State) {
    let mut queue = std::mem::take(&mut state.queue);
    queue.tidy(|predicted| state.holds(predicted));
    state.queue = queue;
}

/// Lets a body go on from (x, v): contacts that no longer hold are dropped, a segment begins, and
/// everything about it is predicted.
pub(super) fn restart(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
    v: DVec3,
) -> Result<(), Fault> {
    begin(model, state, body, time, x, v)?;
    predict_all(model, state, body, time);
    Ok(())
}

/// The first half of [`restart`], for several bodies that start together.
pub(super) fn begin(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
    v: DVec3,
) -> Result<(), Fault> {
    prune_contacts(model, state, body, time, x, v);
    begin_segment(model, state, body, time, x, v).map_err(|error| fault(model, body, time, error))
}

/// Begins segments for all bodies at `state.now` and predicts everything: any of them may be concerned.
pub(super) fn begin_all(model: &Model, state: &mut State) -> Result<(), Fault> {
    let time = state.now;
    for body in present(model) {
        let segment = state.segments[body as usize];
        begin(model, state, body, time, segment.x, segment.v)?;
    }
    for body in present(model) {
        predict_all(model, state, body, time);
    }
    Ok(())
}

/// The end of a segment: the next one goes on from there.
fn go_on(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), Fault> {
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    restart(model, state, body, time, x, v)
}

/// Two dynamic bodies are due to touch.
fn meet(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (a, b, time) = (next.a, next.b, next.time);
    let gap = sphere_sphere_gap(state.mover(model, a), state.mover(model, b), time);
    let reach = model.movers[a as usize].radius.max(model.movers[b as usize].radius);
    if gap.rate < 0.0 && is_closed(&gap, reach, time) {
        return impact::of_pair(model, state, a, b, time, &gap);
    }
    predict_pair(model, state, a, b, later(time, &gap), time);
    Ok(())
}

/// Where to go on looking after a prediction that was no contact: at a surface that is not being closed
/// in on a little later, for the same time would only give the same answer.
fn later(time: f64, gap: &predict::Gap) -> f64 {
    const LATER: f64 = 1e-9;
    if gap.is_closing() { time } else { time + LATER.max(4.0 * f64::EPSILON * time) }
}

/// A dynamic body is due to touch a static one.
fn meet_fixture(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (body, index, time) = (next.a, next.b, next.time);
    let gap = sphere_fixture_gap(state.mover(model, body), &model.fixtures[index as usize], time);
    if gap.is_closing() && is_closed(&gap, model.movers[body as usize].radius, time) {
        return impact::on_fixture(model, state, body, index, time, &gap);
    }
    predict_fixture(model, state, body, index, later(time, &gap), time);
    Ok(())
}

/// Whether surfaces are as near as a found root leaves them: a search that gave up is farther off. A root
/// is known to the rounding of the time, in which they come nearer by |ḋ| times that.
fn is_closed(gap: &predict::Gap, radius: f64, time: f64) -> bool {
    let rounding_of_time = 16.0 * f64::EPSILON * time * gap.rate.abs();
    gap.distance <= 1e3 * predict::touch_tolerance(gap.point, radius) + rounding_of_time
}

/// The body is turned back on its line at the core of a point attractor, the limit of ever thinner
/// ellipses, with its energy kept: it retraces its way, or where a force is not the same backwards, its
/// radial velocity is reversed.
fn pass_core(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (body, time) = (next.a, next.time);
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    let super::force::Law::Point { center, .. } = model.forces[next.b as usize].law else { return Ok(()) };
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
    let mass = model.movers[body as usize].mass;
    state.account.impulses.add(mass * (turned - v));
    record(
        state,
        Event {
            seq: 0,
            time,
            kind: EventKind::SingularPass,
            a: BodyRef::Dynamic(body),
            b: None,
            point: x,
            normal: DVec3::ZERO,
            impulse: 0.0,
            vn_before: 0.0,
            vn_after: 0.0,
            group: 0,
        },
    );
    restart(model, state, body, time, x, turned)
}

/// The limit time of a body's bounces has come.
fn settled(model: &Model, state: &mut State, next: &Predicted) {
    let contacts = &mut state.contacts[next.a as usize];
    let Some(contact) = contacts.iter_mut().find(|contact| contact.fixture == next.b) else { return };
    if contact.settles_at.take().is_some() {
        record_contact(model, state, next.time, EventKind::Rest, next.a, next.b);
        if state.velocity(next.a, next.time) != DVec3::ZERO {
            record_contact(model, state, next.time, EventKind::Slide, next.a, next.b);
        }
    }
}

/// A surface ends under a body, or nothing presses it on any more.
fn leave_contact(model: &Model, state: &mut State, next: &Predicted) -> Result<(), Fault> {
    let (body, time) = (next.a, next.time);
    state.contacts[body as usize].retain(|contact| contact.fixture != next.b);
    record_contact(model, state, time, EventKind::LiftOff, body, next.b);
    let (x, v) = (state.position(body, time), state.velocity(body, time));
    let v = keep_contacts(model, state, body, time, x, v);
    restart(model, state, body, time, x, v)
}

fn fault(model: &Model, body: u32, time: f64, error: SegmentError) -> Fault {
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

/// An event of a dynamic body at a static one that exchanges no impulse. A collapse is listed once, not
/// with each of the contacts it makes and breaks.
pub(super) fn record_contact(
    model: &Model,
    state: &mut State,
    time: f64,
    kind: EventKind,
    body: u32,
    fixture: u32,
) {
    if state.is_in_collapse(model, body, time) {
        return;
    }
    let gap = sphere_fixture_gap(state.mover(model, body), &model.fixtures[fixture as usize], time);
    let event = Event {
        seq: 0,
        time,
        kind,
        a: BodyRef::Dynamic(body),
        b: Some(BodyRef::Static(fixture)),
        point: gap.point,
        normal: gap.normal,
        impulse: 0.0,
        vn_before: 0.0,
        vn_after: 0.0,
        group: 0,
    };
    record(state, in_id_order(model, event));
}

/// The same event with the body of the smaller UserID first and the normal from it to the other.
pub(super) fn in_id_order(model: &Model, mut event: Event) -> Event {
    let rank = |body: BodyRef| {
        let identity = match body {
            BodyRef::Dynamic(index) => &model.movers[index as usize].identity,
            BodyRef::Static(index) => &model.fixtures[index as usize].identity,
        };
        (identity.id, identity.order, body)
    };
    if let Some(b) = event.b
        && rank(b) < rank(event.a)
    {
        (event.a, event.b, event.normal) = (b, Some(event.a), -event.normal);
    }
    event
}
