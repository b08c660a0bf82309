//! The tentative motion of one body, and how it becomes real.

use glam::DVec3;

use crate::sim::body::BodyId;
use crate::sim::books::{book_segment, subject};
use crate::sim::fault::Fault;
use crate::sim::force::{Law, Subject};
use crate::sim::method::Method;
use crate::sim::model::Model;
use crate::sim::segment::Segment;
use crate::sim::state::State;

/// Lets a body go on from (x, v): s = s₀ + v₀t + ½at² with a = F/m here. Books what it did so far.
pub(super) fn begin(
    model: &Model,
    state: &mut State,
    body: u32,
    time: f64,
    x: DVec3,
    v: DVec3,
) -> Result<(), Fault> {
    let mut here = subject(model, state, body, time);
    (here.position, here.low, here.velocity) = (x, DVec3::ZERO, v);
    let acceleration = acceleration(model, state, &here);
    replace(model, state, body, Segment::ballistic(time, x, v, acceleration))
}

/// Makes the motion up to `time` real: the body goes on from there.
pub(super) fn move_to(model: &Model, state: &mut State, body: u32, time: f64) -> Result<(), Fault> {
    let tau = time - state.segments[body as usize].start;
    if tau <= 0.0 {
        return Ok(());
    }
    match model.method {
        Method::Fixed => verlet(model, state, body, time, tau),
        _ => begin(model, state, body, time, state.position(body, time), state.velocity(body, time)),
    }
}

/// Velocity Verlet (Swope, Andersen, Berens & Wilson 1982): v₁ = v₀ + ½(a₀ + a₁)t. A force that depends on
/// the velocity is given v₀ + a₀t at the end, which keeps the order 2.
fn verlet(model: &Model, state: &mut State, body: u32, time: f64, tau: f64) -> Result<(), Fault> {
    let old = state.segments[body as usize];
    let mut end = subject(model, state, body, time);
    let at_end = acceleration(model, state, &end);
    end.velocity = old.v + (0.5 * tau) * (old.a + at_end);
    let fresh = if model.forces.iter().any(|force| reads_velocity(&force.law)) {
        acceleration(model, state, &end)
    } else {
        at_end
    };
    replace(model, state, body, Segment::ballistic(time, end.position, end.velocity, fresh))
}

fn reads_velocity(law: &Law) -> bool {
    matches!(law, Law::Drag { .. } | Law::Custom(_))
}

fn acceleration(model: &Model, state: &mut State, at: &Subject<'_>) -> DVec3 {
    state.counters.force_evaluations += 1;
    model.applied_acceleration(at)
}

fn replace(model: &Model, state: &mut State, body: u32, segment: Segment) -> Result<(), Fault> {
    // The squares too: an infinite length compares with nothing.
    if ![segment.x, segment.v, segment.a].iter().all(|vector| vector.length_squared().is_finite()) {
        let identity = model.identity(BodyId::of_dynamic(body));
        let name = identity.name();
        let message = format!("body {name}: position, velocity or force is not a finite number");
        return Err(Fault { time: segment.start, message, key: Some(identity.key) });
    }
    book_segment(model, state, body, segment.start);
    state.turn_freely(body, segment.start);
    state.segments[body as usize] = segment;
    state.counters.segments += 1;
    state.note_begun(body);
    Ok(())
}
