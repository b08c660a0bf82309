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

use super::tolerance::{LAZY, PARTING, ROOM, SLOWEST_REBOUND};
use crate::sim::body::BodyId;
use crate::sim::geometry::{restitution_at, smaller_radius};
use crate::sim::model::Model;
use crate::sim::pair::Pair;
use crate::sim::shape::direction;
use crate::sim::state::State;

/// One body of a component in one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stepped {
    pub body: u32,
    /// m.
    pub x: DVec3,
    /// Velocity at the end of the step before, m/s, with the second half of its kick.
    pub v: DVec3,
    /// What that kick is beyond what the segment says, m/s.
    pub kick: DVec3,
    /// Velocity in the middle of the step before, m/s.
    pub u: DVec3,
    /// Acceleration of the applied forces, m/s².
    pub a: DVec3,
    /// 1/kg; 0 for one that is held.
    pub inverse_mass: f64,
    /// How fast the pull of attractors changes, 1/s².
    pub stiffness: f64,
}

impl Stepped {
    /// What never moves.
    const FIXED: Self = Self {
        body: u32::MAX,
        x: DVec3::ZERO,
        v: DVec3::ZERO,
        kick: DVec3::ZERO,
        u: DVec3::ZERO,
        a: DVec3::ZERO,
        inverse_mass: 0.0,
        stiffness: 0.0,
    };
}

/// What touches or may come to in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Place in the list of pairs.
    pub listed: u32,
    /// Places in the component; `b` is the number of its bodies for one that does not move.
    pub a: u32,
    pub b: u32,
    /// Unit vector from a to b.
    pub normal: DVec3,
    /// m.
    pub gap: f64,
    /// n·(u_b − u_a), m/s: negative when closing.
    pub rate: f64,
    /// m/s.
    pub bound: f64,
    /// 1/m_a + 1/m_b.
    pub inverse_mass: f64,
    /// Of the smaller body, m.
    pub radius: f64,
    /// N·s.
    pub impulse: f64,
    /// Whether it is too far off to count until it is seen to meet.
    pub is_lazy: bool,
}

/// The contact of a listed pair in a step of length h, or `None` if neither body can move.
pub(super) fn contact(
    model: &Model,
    state: &State,
    (listed, pair, force): (u32, Pair, f64),
    (a, b): (u32, u32),
    bodies: &[Stepped],
    h: f64,
) -> Option<Contact> {
    let one = &bodies[a as usize];
    let fixed = Stepped::FIXED;
    let other = bodies.get(b as usize).unwrap_or(&fixed);
    let inverse_mass = one.inverse_mass + other.inverse_mass;
    if inverse_mass == 0.0 {
        return None;
    }
    let (normal, gap) = if (b as usize) < bodies.len() {
        between(model, one, other)
    } else {
        against(model, state, one, pair.other(one.body))
    };
    let radius = smaller_radius(model, pair);
    let rate = normal.dot(other.u - one.u);
    let driven = h * normal.dot(other.a - one.a);
    let strongest = one.a.length().max(other.a.length());
    let reach = h * (one.u.length() + other.u.length()) + 2.0 * h * h * strongest + LAZY * radius;
    let landing = landing(gap, rate, h, (ROOM * radius, h * strongest));
    let rebounds = rate < -SLOWEST_REBOUND * strongest * h && gap + h * (rate + driven) < 0.0;
    let bound = if rebounds { landing.max(-restitution_at(model, pair, -rate) * rate) } else { landing };
    let impulse = force * h;
    let is_lazy = gap > reach && impulse == 0.0;
    Some(Contact { listed, a, b, normal, gap, rate, bound, inverse_mass, radius, impulse, is_lazy })
}

/// Normal and gap of two spheres.
fn between(model: &Model, one: &Stepped, other: &Stepped) -> (DVec3, f64) {
    let (distance, normal) = direction(other.x - one.x);
    (normal, distance - model.radius(one.body) - model.radius(other.body))
}

/// Normal and gap of a sphere and what does not move.
fn against(model: &Model, state: &State, one: &Stepped, other: BodyId) -> (DVec3, f64) {
    let place = state.path_of(model, other).segment.x;
    let near = model.body(other).shape.convex().nearest(place, one.x);
    (near.towards, near.distance - model.radius(one.body))
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
