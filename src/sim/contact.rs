//! Lasting contact of a sphere with a static body or another sphere: it rests, or slides without friction.

use glam::DVec3;

use super::body::BodyId;
use super::constraint::Link;
use super::model::Model;
use super::pair::Pair;
use super::predict::{self, Gap};
use super::restitution::of_pair;
use super::shape::{Surface, direction};
use super::state::State;

/// One lasting contact of a dynamic body. Two dynamic bodies in contact list each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub other: BodyId,
    pub surface: Surface,
    /// When the last of the skipped bounces would end, until that time has come.
    pub settles_at: Option<f64>,
}

/// What a body at `position` touches of a static one.
pub(super) fn surface_of(model: &Model, id: BodyId, position: DVec3) -> Surface {
    model.body(id).shape.convex().nearest(model.bodies.place(id.index()).x, position).surface()
}

/// The gap of two bodies, with the normal from the first to the partner.
pub(super) fn gap_of(model: &Model, state: &State, pair: Pair, time: f64) -> Gap {
    predict::gap(state.ball(model, pair.first()), state.target(model, pair.b), time)
}

/// Product of the two Bounce values.
pub(super) fn restitution_of(model: &Model, pair: Pair) -> f64 {
    of_pair(model.body(pair.a).bounce, model.body(pair.b).bounce)
}

/// Some bodies at one time, in the order of their indices.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bodies<'a> {
    pub ids: &'a [u32],
    pub x: &'a [DVec3],
    pub v: &'a [DVec3],
}

impl Bodies<'_> {
    fn place(&self, body: u32) -> usize {
        self.ids.binary_search(&body).unwrap_or(0)
    }

    /// A contact among these bodies as a bound on their accelerations. The limit is the centripetal
    /// acceleration |v⊥|²/ρ that keeps them on a curved surface of radius ρ: less than that and they part.
    pub fn link(&self, model: &Model, pair: Pair, surface: Surface) -> Link {
        let a = self.place(pair.first());
        let b = pair.second().map(|other| self.place(other));
        let (towards, limit) = match (b, surface) {
            (Some(b), _) => on_sphere(self.x[b] - self.x[a], self.v[a] - self.v[b]),
            (None, Surface::Flat(towards)) => (towards, 0.0),
            (None, Surface::Round) => {
                let place = model.bodies.place(pair.b.index());
                let near = model.body(pair.b).shape.convex().nearest(place.x, self.x[a]);
                (near.towards, near.turn_away(self.v[a]))
            }
        };
        Link { a, b, towards, limit }
    }
}

/// Direction to the other centre, and |v⊥|²/distance.
fn on_sphere(apart: DVec3, velocity: DVec3) -> (DVec3, f64) {
    let (distance, towards) = direction(apart);
    let across = velocity - velocity.dot(towards) * towards;
    (towards, across.length_squared() / distance.max(f64::MIN_POSITIVE))
}
