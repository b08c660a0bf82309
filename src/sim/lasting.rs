//! Events of lasting contact: bounces that settle, surfaces that end, pressure that ceases.

use glam::DVec3;

use super::account::subject;
use super::contact::{
    Contact, Surface, along_all, constrain, into_cone, is_held, pressure, pressure_rounding, touches_at,
};
use super::engine::record_contact;
use super::model::{FixtureShape, Model};
use super::motion::applied_force;
use super::neighbours::first_beyond;
use super::predict::touch_tolerance;
use super::queue::Kind;
use super::state::State;
use super::{ContactState, EventKind};

/// Predicts when the contacts of a body settle or end on its present segment.
pub(super) fn predict_contact_events(model: &Model, state: &mut State, body: u32, time: f64) {
    for index in 0..state.contacts[body as usize].len() {
        let contact = state.contacts[body as usize][index];
        if let Some(settled) = contact.settles_at {
            state.predict_one(settled.max(time), Kind::Settled, body, contact.fixture);
        }
        if let Some(end) = contact_end(model, state, body, &contact, time) {
            state.predict_one(end, Kind::ContactEnd, body, contact.fixture);
        }
    }
}

/// First time at which the body slides off the face, or is no longer pressed on.
fn contact_end(model: &Model, state: &State, body: u32, contact: &Contact, time: f64) -> Option<f64> {
    let off = match (contact.surface, &model.fixtures[contact.fixture as usize].shape) {
        (Surface::Flat(_), FixtureShape::Plate(plate)) => {
            let path = state.path(body);
            // A rounding beyond the edge, so that what comes next meets the edge and not the face again.
            let beyond = touch_tolerance(path.segment.x, model.movers[body as usize].radius);
            let sides = [
                (plate.axis_x, plate.half_x),
                (-plate.axis_x, plate.half_x),
                (plate.axis_y, plate.half_y),
                (-plate.axis_y, plate.half_y),
            ];
            sides
                .into_iter()
                .filter_map(|(axis, half)| {
                    first_beyond(path, axis, axis.dot(plate.center) + half + beyond, 0.0, time)
                })
                .reduce(f64::min)
        }
        _ => None,
    };
    let lifted =
        if state.path(body).series.is_some() { lift_time(model, state, body, contact) } else { None };
    [off, lifted].into_iter().flatten().reduce(f64::min)
}

/// Parts of a field segment at whose ends the pressure is looked at. A step of the integrator is short
/// against the time in which a smooth force turns round twice.
const PRESSURE_SAMPLES: u32 = 8;

/// First time on a field segment at which nothing presses the body into the contact any more.
fn lift_time(model: &Model, state: &State, body: u32, contact: &Contact) -> Option<f64> {
    let segment = &state.segments[body as usize];
    let contacts = &state.contacts[body as usize];
    let index = contacts.iter().position(|other| other.fixture == contact.fixture)?;
    let pressed = |time: f64| {
        let subject = subject(model, state, body, time);
        let touches = touches_at(model, contacts, subject.radius, subject.position, subject.velocity);
        is_held(&touches, index, applied_force(model, &subject) / subject.mass)
    };
    let mut low = segment.start;
    for sample in 1..=PRESSURE_SAMPLES {
        let high = segment.start + segment.step * f64::from(sample) / f64::from(PRESSURE_SAMPLES);
        if !pressed(high) {
            return Some(bisect(low, high, pressed));
        }
        low = high;
    }
    None
}

/// The earliest representable time in low..=high at which `holds` no longer holds.
fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        if holds(middle) { low = middle } else { high = middle }
    }
}

/// How a body that has just hit a static one may go on in lasting contact.
pub(super) struct Settling {
    pub contact: Contact,
    /// Velocity with nothing left that enters a surface, m/s.
    pub velocity: DVec3,
}

/// A hit as the question of rest sees it.
pub(super) struct Hit {
    pub time: f64,
    pub position: DVec3,
    /// Velocity after the impact, m/s.
    pub velocity: DVec3,
    /// Normal speed before the impact, m/s, ≥ 0.
    pub closing: f64,
    pub restitution: f64,
}

/// Whether the bounces after a hit are over: they are if their sum has a near limit, or if they are lower
/// than the rounding of the position. Then the body rests or slides, and the event comes at the limit
/// time t + Σ flights = t + 2v'/(g(1−e)).
pub(super) fn settle(model: &Model, state: &State, body: u32, fixture: u32, hit: &Hit) -> Option<Settling> {
    let mover = &model.movers[body as usize];
    let mut contact = Contact::new(fixture, &model.fixtures[fixture as usize], hit.position);
    let mut at_hit = subject(model, state, body, hit.time);
    at_hit.velocity = hit.velocity;
    let touch = contact.touch(model, mover.radius, hit.position, hit.velocity);
    // What drives it against this surface may be another one that it slides along.
    let free = applied_force(model, &at_hit) / mover.mass;
    let contacts = &state.contacts[body as usize];
    let driven = constrain(model, contacts, mover.radius, hit.position, hit.velocity, free);
    let pressing = pressure(&touch, driven);
    if pressing <= pressure_rounding(&touch, driven) {
        return None;
    }
    let speed = hit.restitution * hit.closing;
    let flights = 2.0 * speed / (pressing * (1.0 - hit.restitution));
    let has_limit =
        hit.restitution < 1.0 && speed <= model.params.rest_speed && flights <= model.params.rest_time;
    let below_rounding = speed * speed <= 2.0 * pressing * touch_tolerance(hit.position, mover.radius);
    if !has_limit && !below_rounding {
        return None;
    }
    contact.settles_at = Some(hit.time + if has_limit { flights } else { 0.0 });
    let others: Vec<DVec3> = state.contacts[body as usize]
        .iter()
        .map(|contact| contact.touch(model, mover.radius, hit.position, hit.velocity).towards)
        .collect();
    let velocity = level_velocity(hit.velocity, touch.towards, &others, model.params.rest_speed);
    Some(Settling { contact, velocity })
}

/// In a wedge the last bounces off its sides differ in speed by the wedge's angles, not by more than this.
const WEDGE_SPEEDS: f64 = 10.0;

/// What is left of a velocity once its part along `towards` is taken whole, and the parts along the other
/// surfaces too if they are about as small: bounces in a wedge end together.
fn level_velocity(velocity: DVec3, towards: DVec3, others: &[DVec3], rest_speed: f64) -> DVec3 {
    let level = velocity - velocity.dot(towards) * towards;
    if others.iter().any(|other| level.dot(*other).abs() > WEDGE_SPEEDS * rest_speed) {
        let all: Vec<DVec3> = others.iter().copied().chain([towards]).collect();
        return into_cone(level, &all);
    }
    let all: Vec<DVec3> = [towards].into_iter().chain(others.iter().copied()).collect();
    let left = along_all(level, &all);
    if left.length() <= VELOCITY_ROUNDING * velocity.length() { DVec3::ZERO } else { left }
}

/// The rounding of a velocity: below this fraction of it a normal component is no motion.
const VELOCITY_ROUNDING: f64 = 1e-13;

/// Drops the contacts that a new velocity leaves or runs into (the impact follows at once), and takes
/// the rounding of the others out of it. Gives the velocity.
pub(super) fn keep_contacts(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    position: DVec3,
    velocity: DVec3,
) -> DVec3 {
    if state.contacts[body as usize].is_empty() {
        return velocity;
    }
    let radius = model.movers[body as usize].radius;
    let tolerance = VELOCITY_ROUNDING * velocity.length();
    let mut kept = Vec::new();
    let mut velocity_left = velocity;
    for contact in std::mem::take(&mut state.contacts[body as usize]) {
        let touch = contact.touch(model, radius, position, velocity);
        let entering = velocity.dot(touch.towards);
        if entering.abs() <= tolerance {
            velocity_left -= velocity_left.dot(touch.towards) * touch.towards;
            kept.push(contact);
        } else if entering < 0.0 {
            record_contact(model, state, time, EventKind::LiftOff, body, contact.fixture);
        }
    }
    state.contacts[body as usize] = kept;
    velocity_left
}

/// Drops the contacts that nothing presses on at the start of a segment, and brings the others up to date
/// (a body rolls from an edge onto the face).
pub(super) fn prune_contacts(model: &Model, state: &mut State, body: u32, time: f64, x: DVec3, v: DVec3) {
    if state.contacts[body as usize].is_empty() {
        return;
    }
    let radius = model.movers[body as usize].radius;
    let mut at = subject(model, state, body, time);
    (at.position, at.low, at.velocity) = (x, DVec3::ZERO, v);
    let free = applied_force(model, &at) / at.mass;
    let old = std::mem::take(&mut state.contacts[body as usize]);
    let touches = touches_at(model, &old, radius, x, v);
    let mut kept = Vec::new();
    for (index, contact) in old.into_iter().enumerate() {
        if is_held(&touches, index, free) {
            let fresh = Contact::new(contact.fixture, &model.fixtures[contact.fixture as usize], x);
            let surface = if contact.is_round() { fresh.surface } else { contact.surface };
            kept.push(Contact { surface, ..contact });
        } else {
            record_contact(model, state, time, EventKind::LiftOff, body, contact.fixture);
        }
    }
    state.contacts[body as usize] = kept;
}

/// How a body moves at a time, for people: a body in contact that neither moves nor is driven rests.
pub(super) fn contact_state(state: &State, body: u32, time: f64) -> ContactState {
    if state.contacts[body as usize].is_empty() {
        return ContactState::Flight;
    }
    let path = state.path(body);
    let still = path.velocity(time) == DVec3::ZERO && path.acceleration(time) == DVec3::ZERO;
    if still { ContactState::Rest } else { ContactState::Slide }
}
