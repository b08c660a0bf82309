//! When lasting contacts settle or end: bounces that are over, faces that end, pressure that ceases.

use super::contact::Contact;
use super::island::{connected, first_parting};
use super::model::Model;
use super::pair::Pair;
use super::predict::{first_beyond, touch_tolerance};
use super::queue::Kind;
use super::shape::Surface;
use super::state::State;
use super::turn::Hold;

/// Predicts when the contacts of a body settle or end on its present segment.
pub(super) fn predict_contact_events(model: &Model, state: &mut State, body: u32, time: f64) {
    for index in 0..state.contacts[body as usize].len() {
        let contact = state.contacts[body as usize][index];
        let pair = Pair::of(body, contact.other);
        if pair.first() != body {
            continue;
        }
        if let Some(settled) = contact.settles_at {
            state.predict(settled.max(time), Kind::Settled, pair);
        }
        if let Some(end) = end_of_face(model, state, body, &contact, time) {
            state.predict(end, Kind::ContactEnd, pair);
        }
    }
    predict_parting(model, state, body);
}

/// Predicts where the island of a body comes apart, once for all its bodies.
fn predict_parting(model: &Model, state: &mut State, body: u32) {
    if state.contacts[body as usize].is_empty() || state.segments[body as usize].step == 0.0 {
        return;
    }
    // Where bodies rub, a segment ends with what it holds for.
    if state.hold(body) != Hold::Free {
        return;
    }
    let ids = connected(state, [body]);
    if ids.first() != Some(&body) {
        return;
    }
    if let Some((time, pairs)) = first_parting(model, state, &ids) {
        for pair in pairs {
            state.predict(time, Kind::ContactEnd, pair);
        }
    }
}

/// First time at which the body slides off the flat face of a static body.
fn end_of_face(model: &Model, state: &State, body: u32, contact: &Contact, time: f64) -> Option<f64> {
    if contact.surface == Surface::Round || !contact.other.is_static() {
        return None;
    }
    let path = state.path(body);
    // A rounding beyond the edge, so that what comes next meets the edge and not the face again.
    let beyond = touch_tolerance(path.segment.x, model.radius(body));
    let sides = model.body(contact.other).shape.convex().sides();
    sides
        .into_iter()
        .filter_map(|(axis, limit)| first_beyond(path, axis, limit + beyond, 0.0, time))
        .reduce(f64::min)
}
