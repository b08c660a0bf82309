//! Lasting contact of a sphere with a static body or another sphere: it rests, or slides without friction.

use glam::DVec3;

use super::BodyRef;
use super::constraint::Link;
use super::model::{Fixture, FixtureShape, Model};
use super::predict::{Feature, Gap, closest_on_plate, sphere_fixture_gap, sphere_sphere_gap};
use super::restitution::of_pair;
use super::state::State;

/// What a body touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Partner {
    Dynamic(u32),
    Static(u32),
}

/// Two bodies that touch; of two dynamic ones `a` is the one with the smaller index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub a: u32,
    pub partner: Partner,
}

impl Pair {
    pub fn new(body: u32, partner: Partner) -> Self {
        match partner {
            Partner::Dynamic(other) if other < body => Self { a: other, partner: Partner::Dynamic(body) },
            _ => Self { a: body, partner },
        }
    }

    /// The other dynamic body.
    pub fn other(&self) -> Option<u32> {
        match self.partner {
            Partner::Dynamic(other) => Some(other),
            Partner::Static(_) => None,
        }
    }

    /// The dynamic bodies.
    pub fn bodies(&self) -> impl Iterator<Item = u32> + use<> {
        [Some(self.a), self.other()].into_iter().flatten()
    }

    /// Each dynamic body with what it touches.
    pub fn ends(&self) -> impl Iterator<Item = (u32, Partner)> + use<> {
        let back = self.other().map(|other| (other, Partner::Dynamic(self.a)));
        [Some((self.a, self.partner)), back].into_iter().flatten()
    }

    pub fn refs(&self) -> (BodyRef, BodyRef) {
        let other = match self.partner {
            Partner::Dynamic(other) => BodyRef::Dynamic(other),
            Partner::Static(fixture) => BodyRef::Static(fixture),
        };
        (BodyRef::Dynamic(self.a), other)
    }
}

/// One lasting contact of a dynamic body. Two dynamic bodies in contact list each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub partner: Partner,
    pub surface: Surface,
    /// When the last of the skipped bounces would end, until that time has come.
    pub settles_at: Option<f64>,
}

/// What is touched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Surface {
    /// A face; the unit vector points from the body into it.
    Flat(DVec3),
    /// A sphere, an edge or a corner.
    Round,
}

/// What a body at `position` touches of a static one.
pub(super) fn surface_of(fixture: &Fixture, position: DVec3) -> Surface {
    match &fixture.shape {
        FixtureShape::Sphere { .. } => Surface::Round,
        FixtureShape::Plate(plate) => {
            let near = closest_on_plate(plate, position);
            if near.feature == Feature::Face { Surface::Flat(near.towards) } else { Surface::Round }
        }
    }
}

/// The gap of two bodies, with the normal from the first to the partner.
pub(super) fn gap_of(model: &Model, state: &State, pair: Pair, time: f64) -> Gap {
    let mover = state.mover(model, pair.a);
    match pair.partner {
        Partner::Dynamic(other) => sphere_sphere_gap(mover, state.mover(model, other), time),
        Partner::Static(fixture) => sphere_fixture_gap(mover, &model.fixtures[fixture as usize], time),
    }
}

/// Product of the two Bounce values.
pub(super) fn restitution_of(model: &Model, pair: Pair) -> f64 {
    let other = match pair.partner {
        Partner::Dynamic(other) => model.movers[other as usize].bounce,
        Partner::Static(fixture) => model.fixtures[fixture as usize].bounce,
    };
    of_pair(model.movers[pair.a as usize].bounce, other)
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
        let a = self.place(pair.a);
        let (b, (towards, limit)) = match pair.partner {
            Partner::Dynamic(other) => {
                let b = self.place(other);
                (Some(b), on_sphere(self.x[b] - self.x[a], self.v[a] - self.v[b]))
            }
            Partner::Static(fixture) => (None, self.on_static(model, a, fixture, surface)),
        };
        Link { a, b, towards, limit }
    }

    fn on_static(&self, model: &Model, a: usize, fixture: u32, surface: Surface) -> (DVec3, f64) {
        if let Surface::Flat(towards) = surface {
            return (towards, 0.0);
        }
        let fixture = &model.fixtures[fixture as usize];
        match &fixture.shape {
            FixtureShape::Sphere { .. } => on_sphere(fixture.position - self.x[a], self.v[a]),
            FixtureShape::Plate(plate) => {
                let near = closest_on_plate(plate, self.x[a]);
                (near.towards, near.turn_away(self.v[a]))
            }
        }
    }
}

/// Direction to the other centre, and |v⊥|²/distance.
fn on_sphere(apart: DVec3, velocity: DVec3) -> (DVec3, f64) {
    let distance = apart.length();
    // As for gaps: coincident centres have no direction.
    let towards = if distance > 0.0 { apart / distance } else { DVec3::X };
    let across = velocity - velocity.dot(towards) * towards;
    (towards, across.length_squared() / distance.max(f64::MIN_POSITIVE))
}
