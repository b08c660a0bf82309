//! The ledger: events on their way out, numbered, counted, and with their bodies in UserID order.

use super::body::BodyId;
use super::event::{BodyRef, Event, EventKind};
use super::geometry::gap_of;
use super::model::Model;
use super::pair::Pair;
use super::predict::Gap;
use super::state::State;

/// Puts an event into the outbox under the next sequence number.
pub(super) fn record(state: &mut State, mut event: Event) {
    state.sequence += 1;
    event.seq = state.sequence;
    debug_assert_eq!(
        EventKind::ALL[event.kind as usize],
        event.kind,
        "counters are in the order of the kinds"
    );
    state.counters.events[event.kind as usize] += 1;
    state.outbox.push_back(event);
}

/// An event of two bodies that exchanges no impulse.
pub(super) fn record_contact(model: &Model, state: &mut State, time: f64, kind: EventKind, pair: Pair) {
    let gap = gap_of(model, state, pair, time);
    let event = contact_event(time, kind, pair, &gap);
    record(state, in_id_order(model, event));
}

/// An event of two bodies that exchanges no impulse, not yet numbered or in the order of their ids.
pub(super) fn contact_event(time: f64, kind: EventKind, pair: Pair, gap: &Gap) -> Event {
    let (a, b) = pair.refs();
    Event { b: Some(b), bodies: 2, normal: gap.normal, ..Event::of_one(time, kind, a, gap.point) }
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
    let (id, order) = model.body(BodyId::from_ref(body)).rank();
    (id, order, body)
}
