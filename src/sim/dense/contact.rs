//! The contacts of a component in one step, as bounds on the velocities in the middle of it.
//!
//! With u the velocity in the middle of the step before, u' in the middle of this one of length h, a the acceleration
//! of the applied forces and P the impulses given at its start,
//!
//! u' = u + h a + P/m,  x(τ) = x + (u' − h a/2) τ + a τ²/2.
//!
//! For a contact with the normal n from a to b, gap g and s = n·(u_b − u_a), the impulse λ ≥ 0 obeys
//! λ ⊥ n·(u'_b − u'_a) ≥ b. The distance of convex bodies is convex, so that g + h b ≥ 0 keeps them apart during the
//! whole step; and b ≤ −s, so that no impulse does work, λ(s + s')/2 ≤ 0.

use glam::DVec3;

use super::stepped::{Contact, Near, Stepped};
use super::tolerance::{LAZY, PARTING, ROOM, SLOWEST_REBOUND};
use crate::sim::body::BodyId;
use crate::sim::geometry::restitution_at;
use crate::sim::model::Model;
use crate::sim::shape::direction;
use crate::sim::state::State;

/// Whether two moving bodies are surely too far apart to count in a step of length h, unless a force is between them.
pub(super) fn is_far(near: &Near, bodies: &[Stepped], h: f64) -> bool {
    let one = &bodies[near.a as usize];
    let Some(other) = bodies.get(near.b as usize) else { return false };
    let reach = one.radius + other.radius + reach(one, other, one.radius.min(other.radius), h);
    (other.x - one.x).length_squared() > reach * reach
}

/// Whether two moving bodies surely stay apart in a step of length h with these velocities in its middle:
/// (d + h Δu)·d > (r_a + r_b) |d|.
pub(super) fn stays_apart(near: &Near, bodies: &[Stepped], velocity: impl Fn(u32) -> DVec3, h: f64) -> bool {
    let one = &bodies[near.a as usize];
    let Some(other) = bodies.get(near.b as usize) else { return false };
    let apart = other.x - one.x;
    let touch = one.radius + other.radius;
    let least = (apart + h * (velocity(near.b) - velocity(near.a))).dot(apart);
    least > 0.0 && least * least > touch * touch * apart.length_squared()
}

/// The contact of a listed pair in a step of length h, with the force of the last one, or `None` if neither body can
/// move.
pub(super) fn contact(
    model: &Model,
    state: &State,
    near: &Near,
    force: f64,
    bodies: &[Stepped],
    h: f64,
) -> Option<Contact> {
    let Near { pair, listed, a, b } = *near;
    let one = &bodies[a as usize];
    let other = bodies.get(b as usize);
    let (normal, gap) = match other {
        Some(other) => between(one, other),
        None => against(model, state, one, pair.other(one.body)),
    };
    // Steps are as long as the smallest body allows, and so is what they leave.
    let radius = model.bodies.range_of_radii().0;
    let other = other.unwrap_or(&Stepped::FIXED);
    let inverse_mass = one.inverse_mass + other.inverse_mass;
    if inverse_mass == 0.0 {
        return None;
    }
    let rate = normal.dot(other.u - one.u);
    let driven = h * normal.dot(other.a - one.a);
    let strongest = one.drive.max(other.drive);
    let landing = landing(gap, rate, h, (ROOM * radius, h * strongest));
    let rebounds = rate < -SLOWEST_REBOUND * strongest * h && gap + h * (rate + driven) < 0.0;
    let bound = if rebounds { landing.max(-restitution_at(model, pair, -rate) * rate) } else { landing };
    let impulse = force * h;
    let is_lazy = gap > reach(one, other, radius, h) && impulse == 0.0;
    Some(Contact { listed, a, b, normal, gap, rate, bound, inverse_mass, radius, impulse, is_lazy })
}

/// The gap from which two bodies need not be looked at before they are seen to meet, m.
fn reach(one: &Stepped, other: &Stepped, radius: f64, h: f64) -> f64 {
    h * (one.speed + other.speed) + 2.0 * h * h * one.drive.max(other.drive) + LAZY * radius
}

/// Normal and gap of two spheres.
fn between(one: &Stepped, other: &Stepped) -> (DVec3, f64) {
    let (distance, normal) = direction(other.x - one.x);
    (normal, distance - one.radius - other.radius)
}

/// Normal and gap of a sphere and what does not move.
fn against(model: &Model, state: &State, one: &Stepped, other: BodyId) -> (DVec3, f64) {
    let place = state.path_of(model, other).segment.x;
    let near = model.body(other).shape.convex().nearest(place, one.x);
    (near.towards, near.distance - one.radius)
}

/// The bound that keeps bodies apart: they may come as near as they are. Those that overlap part no faster than they
/// met, and where that is within `room` and slow, at a share of it: else they would tremble for ever, in and out by turns.
fn landing(gap: f64, rate: f64, h: f64, (room, slow): (f64, f64)) -> f64 {
    if gap <= -room {
        (-gap / h).min((-rate).max(0.0))
    } else if rate < 0.0 {
        let share = if -rate < slow { PARTING } else { 1.0 };
        -gap.max(share * h * rate) / h
    } else {
        -gap.max((h * rate).min(gap + room)) / h
    }
}
