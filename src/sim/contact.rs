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

/// The contacts of a body as they are at a position and velocity.
pub(super) fn touches_at(
    model: &Model,
    contacts: &[Contact],
    radius: f64,
    position: DVec3,
    velocity: DVec3,
) -> Vec<Touch> {
    contacts.iter().map(|contact| contact.touch(model, radius, position, velocity)).collect()
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
        several => nearest_allowed(free, &touches_at(model, several, radius, position, velocity)),
    }
}

/// The acceleration nearest to `free` that enters none of the surfaces: a·towards ≤ centripetal for each
/// (Gauss's principle of least constraint).
///
/// The nearest point of a polyhedron is a projection onto at most three of its faces; few contacts allow
/// to try them all.
fn nearest_allowed(free: DVec3, touches: &[Touch]) -> DVec3 {
    let largest = touches.iter().map(|touch| touch.centripetal).fold(free.length(), f64::max);
    let tolerance = 1e-13 * largest;
    let allowed =
        |w: DVec3| touches.iter().all(|touch| w.dot(touch.towards) <= touch.centripetal + tolerance);
    if allowed(free) {
        return free;
    }
    let mut best: Option<DVec3> = None;
    let mut offer = |faces: &[Touch]| {
        let w = onto_faces(free, faces);
        if allowed(w) && best.is_none_or(|b| (w - free).length_squared() < (b - free).length_squared()) {
            best = Some(w);
        }
    };
    for (i, a) in touches.iter().enumerate() {
        offer(&[*a]);
        for (j, b) in touches.iter().enumerate().skip(i + 1) {
            offer(&[*a, *b]);
            for c in &touches[j + 1..] {
                offer(&[*a, *b, *c]);
            }
        }
    }
    best.unwrap_or_else(|| onto_faces(free, touches))
}

/// The vector nearest to `vector` with w·towards = centripetal on every face, by Gram–Schmidt. A face
/// that depends on those before it is passed over.
fn onto_faces(vector: DVec3, faces: &[Touch]) -> DVec3 {
    const DEPENDENT: f64 = 1e-6;
    let mut basis: Vec<(DVec3, f64)> = Vec::with_capacity(3);
    let mut w = vector;
    for face in faces {
        let (mut fresh, mut offset) = (face.towards, face.centripetal);
        for (unit, at) in &basis {
            let along = face.towards.dot(*unit);
            fresh -= along * *unit;
            offset -= along * at;
        }
        let length = fresh.length();
        if length > DEPENDENT {
            let (unit, at) = (fresh / length, offset / length);
            w -= (w.dot(unit) - at) * unit;
            basis.push((unit, at));
        }
    }
    // What is left in a groove or a corner may be rounding alone, and would creep.
    if w.length() <= 16.0 * f64::EPSILON * vector.length() { DVec3::ZERO } else { w }
}

/// What is left of a velocity that may neither enter nor leave any of the surfaces.
pub(super) fn along_all(velocity: DVec3, towards: &[DVec3]) -> DVec3 {
    let faces: Vec<Touch> =
        towards.iter().map(|towards| Touch { towards: *towards, centripetal: 0.0 }).collect();
    onto_faces(velocity, &faces)
}

/// The velocity nearest to `velocity` that enters none of the surfaces.
pub(super) fn into_cone(velocity: DVec3, towards: &[DVec3]) -> DVec3 {
    let faces: Vec<Touch> =
        towards.iter().map(|towards| Touch { towards: *towards, centripetal: 0.0 }).collect();
    nearest_allowed(velocity, &faces)
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

/// Whether a body under a free acceleration stays in contact `index` of its contacts.
pub(super) fn is_held(touches: &[Touch], index: usize, free: DVec3) -> bool {
    let touch = &touches[index];
    let driven = if touches.len() == 1 { free } else { nearest_allowed(free, touches) };
    free != DVec3::ZERO && pressure(touch, driven) >= -pressure_rounding(touch, free)
}
