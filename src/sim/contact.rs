//! Lasting contact of a sphere with static bodies: it rests, or slides without friction.
//!
//! On flat faces the motion stays a parabola: the acceleration is projected onto the cone of directions
//! that do not enter a surface (Moreau's tangent cone), which is where the contact forces that only push,
//! and only where pressed, leave it. On an edge, a corner or a static sphere the path is curved and is
//! integrated like a field, with the centripetal acceleration |v⊥|²/ρ towards the centre of curvature.

use glam::DVec3;

use super::model::{Fixture, FixtureShape, Model};
use super::predict::{Feature, closest_on_plate};

/// One lasting contact of a dynamic body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    /// Index of the static body.
    pub fixture: u32,
    pub surface: Surface,
    /// When the last of the skipped bounces would end, until that time has come.
    pub settles_at: Option<f64>,
}

/// What is touched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Surface {
    /// A face; the unit vector points from the body into it.
    Flat(DVec3),
    /// A static sphere, an edge or a corner.
    Round,
}

/// The geometry of a contact where the body is now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// Unit vector from the body into the surface.
    pub towards: DVec3,
    /// Acceleration towards the surface that keeps the body on its curve at this velocity, m/s².
    pub centripetal: f64,
}

impl Contact {
    pub fn is_round(&self) -> bool {
        self.surface == Surface::Round
    }

    /// The contact that a body at `position` makes with a static body.
    pub fn new(index: u32, fixture: &Fixture, position: DVec3) -> Self {
        let surface = match &fixture.shape {
            FixtureShape::Sphere { .. } => Surface::Round,
            FixtureShape::Plate(plate) => {
                let near = closest_on_plate(plate, position);
                if near.feature == Feature::Face { Surface::Flat(near.towards) } else { Surface::Round }
            }
        };
        Self { fixture: index, surface, settles_at: None }
    }

    pub fn touch(&self, model: &Model, radius: f64, position: DVec3, velocity: DVec3) -> Touch {
        if let Surface::Flat(towards) = self.surface {
            return Touch { towards, centripetal: 0.0 };
        }
        match &model.fixtures[self.fixture as usize].shape {
            FixtureShape::Sphere { radius: fixed } => {
                let away = model.fixtures[self.fixture as usize].position - position;
                let towards = away.try_normalize().unwrap_or(DVec3::X);
                let across = velocity - velocity.dot(towards) * towards;
                Touch { towards, centripetal: across.length_squared() / (radius + fixed) }
            }
            FixtureShape::Plate(plate) => {
                let near = closest_on_plate(plate, position);
                Touch { towards: near.towards, centripetal: near.turn_away(velocity) }
            }
        }
    }
}

/// The acceleration that the contacts leave of a free acceleration.
pub(super) fn constrain(
    model: &Model,
    contacts: &[Contact],
    radius: f64,
    position: DVec3,
    velocity: DVec3,
    free: DVec3,
) -> DVec3 {
    match contacts {
        [] => free,
        [only] => {
            let touch = only.touch(model, radius, position, velocity);
            // a·towards = |v⊥|²/ρ; less pressure than that and the body leaves, which is an event.
            free - (free.dot(touch.towards) - touch.centripetal) * touch.towards
        }
        several => {
            let normals: Vec<DVec3> = several
                .iter()
                .map(|contact| contact.touch(model, radius, position, velocity).towards)
                .collect();
            into_cone(free, &normals)
        }
    }
}

/// The vector nearest to `vector` among those that enter none of the surfaces: w·towards ≤ 0 for each.
///
/// The nearest point of a cone is the remainder of a projection onto at most three of the normals, with
/// non-negative multipliers; few contacts allow to try them all.
pub(super) fn into_cone(vector: DVec3, towards: &[DVec3]) -> DVec3 {
    let tolerance = 1e-13 * vector.length();
    let allowed = |w: DVec3| towards.iter().all(|n| w.dot(*n) <= tolerance);
    if allowed(vector) {
        return vector;
    }
    let mut best: Option<DVec3> = None;
    let mut offer = |w: DVec3| {
        if allowed(w) && best.is_none_or(|b| (w - vector).length_squared() < (b - vector).length_squared()) {
            best = Some(w);
        }
    };
    for (i, a) in towards.iter().enumerate() {
        if vector.dot(*a) > 0.0 {
            offer(vector - vector.dot(*a) * *a);
        }
        for b in &towards[i + 1..] {
            if let Some(along) = a.cross(*b).try_normalize() {
                offer(vector.dot(along) * along);
            }
        }
    }
    // Where no line is left, the cone is a point.
    best.unwrap_or(DVec3::ZERO)
}

/// Acceleration that presses the body into the contact, m/s²; not above zero when nothing holds it there.
pub(super) fn pressure(touch: &Touch, free: DVec3) -> f64 {
    free.dot(touch.towards) - touch.centripetal
}

/// The rounding of [`pressure`]: a contact is made above it and left below its negative, so that a body
/// on the point of lifting off does not do both for ever.
pub(super) fn pressure_rounding(touch: &Touch, free: DVec3) -> f64 {
    1e-12 * (free.length() + touch.centripetal)
}
