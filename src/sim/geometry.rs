//! Geometry of the bodies where the state has them: gaps, surfaces, contacts as bounds on motion.

use glam::DVec3;

use super::body::BodyId;
use super::link::Link;
use super::model::Model;
use super::pair::Pair;
use super::predict::{self, Ball, Gap, Target};
use super::restitution::{of_pair, sticking};
use super::shape::{Part, Surface, direction};
use super::state::State;
use super::tolerance::TOUCHES;
use crate::scene::Roughness;

/// A dynamic body as prediction sees it.
pub(super) fn ball<'a>(model: &Model, state: &'a State, body: u32) -> Ball<'a> {
    Ball { path: state.path(body), radius: model.radius(body) }
}

/// Any body as prediction sees it.
pub(super) fn target<'a>(model: &'a Model, state: &'a State, id: BodyId) -> Target<'a> {
    if let Some(body) = id.dynamic() {
        return Target::Dynamic(ball(model, state, body));
    }
    let path = state.path_of(model, id);
    Target::at_rest(&model.body(id).shape, path)
}

/// What a body at `position` touches of a static one.
pub(super) fn surface_of(model: &Model, id: BodyId, position: DVec3) -> Surface {
    model.body(id).shape.convex().nearest(model.bodies.static_segment(id.index()).x, position).surface()
}

/// The edge or corner of a static shape that a body at `position` lies on; `None` where the shape is one part.
pub(super) fn part_of(model: &Model, id: BodyId, position: DVec3) -> Option<Part> {
    let shape = model.body(id).shape.convex();
    let near = shape.nearest(model.bodies.static_segment(id.index()).x, position);
    (!shape.is_one_part()).then(|| near.part(position))
}

/// Whether a body at `position` sees this part of a static shape.
pub(super) fn sees_part(model: &Model, id: BodyId, part: &Part, position: DVec3) -> bool {
    let near = model.body(id).shape.convex().nearest(model.bodies.static_segment(id.index()).x, position);
    part.is_seen(&near, position)
}

/// The gap of two bodies, with the normal from `a` to `b`.
pub(super) fn gap_of(model: &Model, state: &State, pair: Pair, time: f64) -> Gap {
    predict::gap(ball(model, state, pair.first()), target(model, state, pair.b), time)
}

/// Product of the two Bounce values.
pub(super) fn restitution_of(model: &Model, pair: Pair) -> f64 {
    of_pair(model.body(pair.a).bounce, model.body(pair.b).bounce)
}

/// What a pair has of friction: the geometric mean of both.
pub(super) fn rubbing_of(model: &Model, pair: Pair) -> Roughness {
    let (a, b) = (model.body(pair.a).roughness(), model.body(pair.b).roughness());
    let mean = |a: f64, b: f64| (a * b).sqrt();
    Roughness {
        friction: mean(a.friction, b.friction),
        rolling: mean(a.rolling, b.rolling),
        tangential: mean(a.tangential, b.tangential),
    }
}

/// Radii of both bodies of a pair as far as they turn, m: what is fixed does not.
pub(super) fn normal_arms(model: &Model, pair: Pair) -> [f64; 2] {
    [model.radius(pair.first()), pair.second().map_or(0.0, |other| model.radius(other))]
}

/// The same at a closing speed, m/s.
pub(super) fn restitution_at(model: &Model, pair: Pair, closing: f64) -> f64 {
    sticking(restitution_of(model, pair), closing, model.params.stick_speed)
}

/// Radius of the smaller dynamic body of a pair, m: the length that its contacts are measured by.
pub(super) fn smaller_radius(model: &Model, pair: Pair) -> f64 {
    pair.dynamic().map(|body| model.radius(body)).fold(f64::INFINITY, f64::min)
}

/// Radius of the larger dynamic body of a pair, m.
pub(super) fn larger_radius(model: &Model, pair: Pair) -> f64 {
    pair.dynamic().map(|body| model.radius(body)).fold(0.0, f64::max)
}

/// Distance within which a pair near `at` touches, m.
pub(super) fn contact_distance(model: &Model, pair: Pair, at: DVec3) -> f64 {
    let radius = smaller_radius(model, pair);
    (model.params.contact_distance * radius).max(TOUCHES * predict::touch_tolerance(at, radius))
}

/// Some bodies at one time, in the order of their indices.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodiesAt<'a> {
    pub ids: &'a [u32],
    pub x: &'a [DVec3],
    pub v: &'a [DVec3],
}

impl BodiesAt<'_> {
    fn row(&self, body: u32) -> usize {
        let row = self.ids.partition_point(|id| *id < body);
        debug_assert_eq!(self.ids.get(row), Some(&body), "contacts are between bodies of one set");
        row
    }

    /// A contact among these bodies as a bound on their accelerations. The limit is the centripetal
    /// acceleration |v⊥|²/ρ that keeps them on a curved surface of radius ρ: less than that and they part.
    pub fn link(&self, model: &Model, pair: Pair, surface: Surface) -> Link {
        self.link_on(model, pair, surface, None)
    }

    /// A contact as [`Self::link_on`] has it, with the change of its direction, 1/s.
    pub fn turning_link(
        &self,
        model: &Model,
        pair: Pair,
        surface: Surface,
        part: Option<&Part>,
    ) -> (Link, DVec3) {
        let link = self.link_on(model, pair, surface, part);
        let turning = match (link.b, surface) {
            (Some(b), _) => {
                let (apart, rate) = (self.x[b] - self.x[link.a], self.v[b] - self.v[link.a]);
                (rate - rate.dot(link.towards) * link.towards) / apart.length().max(f64::MIN_POSITIVE)
            }
            (None, Surface::Flat(_)) => DVec3::ZERO,
            (None, Surface::Round) => {
                let at = model.bodies.static_segment(pair.b.index()).x;
                let near = model.body(pair.b).shape.convex().nearest(at, self.x[link.a]);
                let other = part.filter(|part| !part.is_seen(&near, self.x[link.a]));
                other.map_or(near, |part| part.seen_from(self.x[link.a])).turning(self.v[link.a])
            }
        };
        (link, turning)
    }

    /// The same on a part of the shape alone, wherever the body is.
    pub fn link_on(&self, model: &Model, pair: Pair, surface: Surface, part: Option<&Part>) -> Link {
        let a = self.row(pair.first());
        let b = pair.second().map(|other| self.row(other));
        let (towards, limit) = match (b, surface) {
            (Some(b), _) => on_sphere(self.x[b] - self.x[a], self.v[a] - self.v[b]),
            (None, Surface::Flat(towards)) => (towards, 0.0),
            (None, Surface::Round) => {
                let at = model.bodies.static_segment(pair.b.index()).x;
                let near = model.body(pair.b).shape.convex().nearest(at, self.x[a]);
                let other = part.filter(|part| !part.is_seen(&near, self.x[a]));
                let near = other.map_or(near, |part| part.seen_from(self.x[a]));
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
