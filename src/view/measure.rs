//! What lies between two things that are selected: the gap of their surfaces, the way between their centres, the angle of
//! plates.

use glam::DVec3;

use crate::design::{Gap, gap};
use crate::scene::{Body, Force, ForceKind, Motion, Shape, rotation_matrix};

/// Angles of plates below this count as parallel, radians: turning by Euler angles leaves as much by rounding.
const PARALLEL: f64 = 1e-9;

/// Something to measure from, where it is now, m.
#[derive(Clone, Copy, Debug)]
pub enum Measurable<'a> {
    Body(&'a Body, DVec3),
    /// The place of a force.
    Place(DVec3),
}

/// What was measured between two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Where the gap begins and ends, m; the centres where there is none.
    pub ends: [DVec3; 2],
    /// Between the surfaces; `None` for plates that are not parallel.
    pub gap: Option<Gap>,
    /// Between the centres, m.
    pub centres: f64,
    /// Of two plates, radians from 0 to π/2.
    pub angle: Option<f64>,
}

impl<'a> Measurable<'a> {
    /// A force that has a place, which uniform ones and air have not.
    pub fn of_force(force: &Force) -> Option<Self> {
        match force.kind {
            ForceKind::GravityPoint { position, .. } => Some(Self::Place(position)),
            _ => None,
        }
    }

    pub fn place(self) -> DVec3 {
        match self {
            Self::Body(_, at) | Self::Place(at) => at,
        }
    }

    /// As a body that can be measured; a place is a sphere without size.
    fn body(self) -> Body {
        match self {
            Self::Body(body, position) => Body { position, ..body.clone() },
            Self::Place(at) => Body::new(0, at, Motion::Static, Shape::Sphere { radius: 0.0 }),
        }
    }
}

impl Measured {
    pub fn between(one: Measurable<'_>, other: Measurable<'_>) -> Self {
        let (a, b) = (one.body(), other.body());
        let ends = [a.position, b.position];
        let bare = Self { ends, gap: None, centres: ends[0].distance(ends[1]), angle: None };
        match (&a.shape, &b.shape) {
            (Shape::Plane { .. }, Shape::Plane { .. }) => bare.of_plates(&a, &b),
            // A place may lie within a body.
            _ if [one, other].iter().any(|thing| matches!(thing, Measurable::Place(_))) => {
                Some(bare.of_surfaces(&a, &b)).filter(Self::is_apart).unwrap_or(bare)
            }
            _ => bare.of_surfaces(&a, &b),
        }
    }

    fn is_apart(&self) -> bool {
        self.gap.is_some_and(|gap| gap.distance >= 0.0)
    }

    fn of_surfaces(self, a: &Body, b: &Body) -> Self {
        let Some(gap) = gap(a, b) else { return self };
        let way = gap.distance * gap.towards;
        // The end on a sphere is known; the other is as far away as the gap is wide.
        let ends = match (&a.shape, &b.shape) {
            (Shape::Sphere { radius }, _) => {
                let on_a = a.position + *radius * gap.towards;
                [on_a, on_a + way]
            }
            (_, Shape::Sphere { radius }) => {
                let on_b = b.position - *radius * gap.towards;
                [on_b - way, on_b]
            }
            _ => self.ends,
        };
        Self { ends, gap: Some(gap), ..self }
    }

    fn of_plates(self, a: &Body, b: &Body) -> Self {
        let [one, other] = [a, b].map(|plate| rotation_matrix(plate.rotation).z_axis);
        // By the sine too: the cosine of small angles has half the digits.
        let angle = libm::atan2(one.cross(other).length(), one.dot(other).abs());
        let height = (b.position - a.position).dot(one);
        let towards = if height < 0.0 { -one } else { one };
        if angle > PARALLEL {
            return Self { angle: Some(angle), ..self };
        }
        Self {
            ends: [a.position, a.position + height * one],
            gap: Some(Gap { distance: height.abs(), towards }),
            angle: Some(0.0),
            ..self
        }
    }
}

/// The angle at the middle one of three places, radians; `None` where two of them coincide.
pub fn angle_at(before: DVec3, middle: DVec3, after: DVec3) -> Option<f64> {
    let (one, other) = (before - middle, after - middle);
    let apart = one.length() > 0.0 && other.length() > 0.0;
    apart.then(|| libm::atan2(one.cross(other).length(), one.dot(other)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

    use super::*;
    use crate::scene::Motion;

    fn ball(at: DVec3, radius: f64) -> Body {
        Body::new(1, at, Motion::Static, Shape::Sphere { radius })
    }

    fn plate(at: DVec3, rotation: DVec3) -> Body {
        Body { rotation, ..Body::new(2, at, Motion::Static, Shape::Plane { half_x: 1.0, half_y: 1.0 }) }
    }

    fn between(a: &Body, b: &Body) -> Measured {
        Measured::between(Measurable::Body(a, a.position), Measurable::Body(b, b.position))
    }

    #[test]
    fn gaps_end_on_both_surfaces_in_either_order() {
        let floor = plate(DVec3::ZERO, DVec3::new(-FRAC_PI_2, 0.0, 0.0));
        let one = ball(DVec3::new(0.0, 2.0, 0.0), 0.5);
        let other = ball(DVec3::new(3.0, 2.0, 0.0), 1.0);
        for (a, b, gap, ends) in [
            (&one, &other, 1.5, [DVec3::new(0.5, 2.0, 0.0), DVec3::new(2.0, 2.0, 0.0)]),
            (&one, &floor, 1.5, [DVec3::new(0.0, 1.5, 0.0), DVec3::ZERO]),
        ] {
            for (a, b, ends) in [(a, b, ends), (b, a, [ends[1], ends[0]])] {
                let measured = between(a, b);
                assert!((measured.gap.unwrap().distance - gap).abs() < 1e-14, "{measured:?}");
                for (found, expected) in measured.ends.into_iter().zip(ends) {
                    assert!((found - expected).length() < 1e-14, "{measured:?}");
                }
            }
        }
    }

    #[test]
    fn plates_have_an_angle_and_parallel_ones_a_gap() {
        let floor = plate(DVec3::ZERO, DVec3::new(-FRAC_PI_2, 0.0, 0.0));
        let slope = plate(DVec3::X, DVec3::new(-FRAC_PI_2 + FRAC_PI_3, 0.0, 0.0));
        let found = between(&floor, &slope);
        assert!((found.angle.unwrap() - FRAC_PI_3).abs() < 1e-15 && found.gap.is_none(), "{found:?}");
        let ceiling = plate(DVec3::new(1.0, 3.0, 0.0), DVec3::new(FRAC_PI_2, 0.0, 0.0));
        let found = between(&floor, &ceiling);
        assert!((found.gap.unwrap().distance - 3.0).abs() < 1e-14 && found.angle == Some(0.0), "{found:?}");
    }

    #[test]
    fn three_places_have_an_angle_unless_two_coincide() {
        let angle = angle_at(DVec3::X, DVec3::ZERO, DVec3::Y).unwrap();
        assert!((angle - FRAC_PI_2).abs() < 1e-15);
        assert_eq!(angle_at(DVec3::X, DVec3::X, DVec3::Y), None);
    }
}
