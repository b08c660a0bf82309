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

use super::stepped::{Contact, Moving, Near, Step, Stepped, velocity};
use super::tolerance::{DEEP, LAZY, PARTING, ROOM, SLOWEST_REBOUND};
use crate::sim::body::BodyId;
use crate::sim::geometry::restitution_at;
use crate::sim::model::Model;
use crate::sim::pair::Pair;
use crate::sim::shape::direction;
use crate::sim::state::State;

/// What the contacts of a component are found from.
pub(super) struct Finder<'a> {
    pub model: &'a Model,
    pub state: &'a State,
    pub bodies: &'a [Stepped],
    pub step: Step,
}

impl Finder<'_> {
    /// Whether two moving bodies are surely too far apart to count in the step, unless a force is between them.
    #[inline]
    pub fn is_far(&self, near: &Near) -> bool {
        let one = &self.bodies[near.a as usize];
        let Some(other) = self.bodies.get(near.b as usize) else { return false };
        let far = one.radius + other.radius + self.reach(one, other);
        (other.x - one.x).length_squared() > far * far
    }

    /// Whether two moving bodies surely stay apart in the step with these velocities in its middle:
    /// (d + h Δu)·d > (r_a + r_b) |d|.
    pub fn stays_apart(&self, near: &Near, moving: &[Moving]) -> bool {
        let one = &self.bodies[near.a as usize];
        let Some(other) = self.bodies.get(near.b as usize) else { return false };
        let apart = other.x - one.x;
        let touch = one.radius + other.radius;
        let velocity = |body: u32| velocity(&moving[body as usize]);
        let least = (apart + self.step.h * (velocity(near.b) - velocity(near.a))).dot(apart);
        least > 0.0 && least * least > touch * touch * apart.length_squared()
    }

    /// Whether one of a listed pair can move.
    #[inline]
    pub fn can_move(&self, near: &Near) -> bool {
        let inverse_mass = |body: u32| self.bodies.get(body as usize).map_or(0.0, |body| body.inverse_mass);
        inverse_mass(near.a) + inverse_mass(near.b) > 0.0
    }

    /// The contact of a listed pair of which one can move, the pair at this place, with the force of the last step.
    #[inline]
    pub fn contact(&self, place: u32, near: &Near) -> Contact {
        let mut contact = self.unbound(place, near);
        self.bind(&mut contact, near.pair);
        contact
    }

    /// Where it is, without the rate and its bound. These are found for all contacts after each other, so that the
    /// processor need not wait for one before it begins the next.
    #[inline(always)]
    pub fn unbound(&self, place: u32, near: &Near) -> Contact {
        let Near { pair, listed, a, b, force } = *near;
        let one = &self.bodies[a as usize];
        let (other, (normal, gap)) = match self.bodies.get(b as usize) {
            Some(other) => (other, between(one, other)),
            None => (&Stepped::FIXED, self.against(one, pair.other(one.body))),
        };
        let inverse_mass = one.inverse_mass + other.inverse_mass;
        let impulse = force * self.step.h;
        Contact { near: place, listed, a, b, normal, gap, rate: 0.0, bound: 0.0, inverse_mass, impulse }
    }

    /// Finds the rate of a contact and its bound.
    #[inline(always)]
    pub fn bind(&self, contact: &mut Contact, pair: Pair) {
        let Contact { a, b, normal, gap, .. } = *contact;
        let one = &self.bodies[a as usize];
        let other = self.bodies.get(b as usize).unwrap_or(&Stepped::FIXED);
        let Step { h, radius } = self.step;
        let rate = normal.dot(other.u - one.u);
        let driven = h * normal.dot(other.a - one.a);
        let strongest = one.drive.max(other.drive);
        let landing = landing(gap, rate, h, (ROOM * radius, h * strongest));
        let rebounds = rate < -SLOWEST_REBOUND * strongest * h && gap + h * (rate + driven) < 0.0;
        contact.rate = rate;
        let own = || -restitution_at(self.model, pair, -rate) * rate;
        contact.bound = match rebounds {
            false => landing,
            // Bodies that were put into each other part as those that meet.
            true if gap < -DEEP * radius => own(),
            true => landing.max(own()),
        };
    }

    /// Whether a contact is too far off to count until it is seen to meet.
    #[inline]
    pub fn is_lazy(&self, contact: &Contact) -> bool {
        let one = &self.bodies[contact.a as usize];
        let other = self.bodies.get(contact.b as usize).unwrap_or(&Stepped::FIXED);
        contact.impulse == 0.0 && contact.gap > self.reach(one, other)
    }

    /// The gap from which two bodies need not be looked at before they are seen to meet, m.
    fn reach(&self, one: &Stepped, other: &Stepped) -> f64 {
        let Step { h, radius } = self.step;
        h * (one.speed + other.speed) + 2.0 * h * h * one.drive.max(other.drive) + LAZY * radius
    }

    /// Normal and gap of a sphere and what does not move.
    fn against(&self, one: &Stepped, other: BodyId) -> (DVec3, f64) {
        let place = self.state.path_of(self.model, other).segment.x;
        let near = self.model.body(other).shape.convex().nearest(place, one.x);
        (near.towards, near.distance - one.radius)
    }
}

/// Normal and gap of two spheres.
fn between(one: &Stepped, other: &Stepped) -> (DVec3, f64) {
    let (distance, normal) = direction(other.x - one.x);
    (normal, distance - one.radius - other.radius)
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
