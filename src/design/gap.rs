//! The gap between two bodies and the shortest way apart, straight from the scene.

use glam::DVec3;

use crate::scene::{Body, HEAP_OVERLAP, Scene, Shape, rotation_matrix};

/// Rounding of a place: units in the last place of a coordinate that a gap may be off by.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// How far two bodies are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// m; negative where they overlap.
    pub distance: f64,
    /// Unit vector from the first to the second, along which they part quickest.
    pub towards: DVec3,
}

/// The gap of two bodies; `None` for two plates, which never collide, and for shapes that cannot be simulated.
pub fn gap(a: &Body, b: &Body) -> Option<Gap> {
    match (&a.shape, &b.shape) {
        (Shape::Sphere { radius: one }, Shape::Sphere { radius: other }) => {
            let apart = b.position - a.position;
            let distance = apart.length();
            Some(Gap { distance: distance - one - other, towards: direction(apart, DVec3::X) })
        }
        (Shape::Sphere { radius }, Shape::Plane { .. }) => {
            let Gap { distance, towards } = plate_to_point(b, a.position)?;
            Some(Gap { distance: distance - radius, towards: -towards })
        }
        (Shape::Plane { .. }, Shape::Sphere { radius }) => {
            let Gap { distance, towards } = plate_to_point(a, b.position)?;
            Some(Gap { distance: distance - radius, towards })
        }
        _ => None,
    }
}

/// From a plate's nearest point to a point; along the normal where the point lies in the plate.
fn plate_to_point(plate: &Body, point: DVec3) -> Option<Gap> {
    let Shape::Plane { half_x, half_y } = plate.shape else { return None };
    let matrix = rotation_matrix(plate.rotation);
    let local = matrix.transpose() * (point - plate.position);
    let nearest = DVec3::new(local.x.clamp(-half_x, half_x), local.y.clamp(-half_y, half_y), 0.0);
    let apart = local - nearest;
    Some(Gap { distance: apart.length(), towards: matrix * direction(apart, DVec3::Z) })
}

fn direction(apart: DVec3, otherwise: DVec3) -> DVec3 {
    apart.try_normalize().unwrap_or(otherwise)
}

/// How deep two bodies overlap, m; `None` where they do not, touching included, or where neither of them moves.
pub(super) fn overlap(scene: &Scene, a: &Body, b: &Body) -> Option<f64> {
    if !a.is_dynamic() && !b.is_dynamic() {
        return None;
    }
    let depth = -gap(a, b)?.distance;
    (depth > tolerance(scene, a, b)).then_some(depth)
}

/// How deep two bodies overlap, m, where that is more than a heap at rest does.
pub(super) fn deep_overlap(scene: &Scene, a: &Body, b: &Body) -> Option<f64> {
    overlap(scene, a, b).filter(|depth| *depth > HEAP_OVERLAP * smaller_radius(a, b))
}

/// How near or deep two bodies may be and still count as touching, m.
pub(super) fn tolerance(scene: &Scene, a: &Body, b: &Body) -> f64 {
    let radius = smaller_radius(a, b);
    let place = a.position.abs().max_element().max(b.position.abs().max_element());
    (scene.params.contact_distance * radius).max(ROUNDING * (place + radius))
}

fn smaller_radius(a: &Body, b: &Body) -> f64 {
    [a, b].into_iter().filter_map(radius).fold(f64::INFINITY, f64::min)
}

pub(super) fn radius(body: &Body) -> Option<f64> {
    match body.shape {
        Shape::Sphere { radius } => Some(radius),
        Shape::Plane { .. } | Shape::Unbuilt { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Motion;

    fn ball(at: DVec3, radius: f64) -> Body {
        Body::new(1, at, Motion::Static, Shape::Sphere { radius })
    }

    #[test]
    fn gaps_of_spheres_and_plates() {
        let plate = Body {
            rotation: DVec3::new(-std::f64::consts::FRAC_PI_2, 0.0, 0.0),
            ..Body::new(2, DVec3::ZERO, Motion::Static, Shape::Plane { half_x: 2.0, half_y: 1.0 })
        };
        let cases = [
            (DVec3::new(0.0, 3.0, 0.0), 2.5, DVec3::Y),
            (DVec3::new(0.0, -0.25, 0.0), -0.25, DVec3::NEG_Y),
            (DVec3::new(5.0, 4.0, 0.0), 4.5, DVec3::new(0.6, 0.8, 0.0)),
            (DVec3::new(0.0, 0.0, 4.0), 2.5, DVec3::Z),
        ];
        for (at, distance, towards) in cases {
            let ball = ball(at, 0.5);
            let found = gap(&plate, &ball).unwrap();
            assert!((found.distance - distance).abs() < 1e-14, "{at}: {found:?}");
            assert!((found.towards - towards).length() < 1e-14, "{at}: {found:?}");
            assert_eq!(gap(&ball, &plate).unwrap().towards, -found.towards);
        }
        let pair = gap(&ball(DVec3::ZERO, 1.0), &ball(DVec3::new(0.0, 0.0, 3.0), 1.5)).unwrap();
        assert_eq!(pair, Gap { distance: 0.5, towards: DVec3::Z });
        assert_eq!(gap(&plate, &plate), None);
        assert!(gap(&ball(DVec3::ZERO, 1.0), &ball(DVec3::ZERO, 1.0)).unwrap().towards.is_normalized());
    }
}
