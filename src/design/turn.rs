//! Turning: orientations are matrices while one turns, Euler angles only where they are written.

use glam::{DMat3, DVec3};

use crate::scene::{Body, BodyChange, Motion, Shape, euler_near, rotation_matrix};

/// Angles nearer than this to those before are those before: the rounding of a few matrix products, radians.
const SAME_ANGLE: f64 = 1e-12;

/// The rotation by `angle` about a unit vector; quarter turns are exact.
pub fn turn(axis: DVec3, angle: f64) -> DMat3 {
    let quarters = angle / std::f64::consts::FRAC_PI_2;
    let (sine, cosine) = if (quarters - quarters.round()).abs() < SAME_ANGLE {
        [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarters.round().rem_euclid(4.0) as usize & 3]
    } else {
        libm::sincos(angle)
    };
    // Rodrigues: R = cos I + sin [a]× + (1 − cos) a aᵀ
    let DVec3 { x, y, z } = axis;
    let cross = DMat3::from_cols(DVec3::new(0.0, z, -y), DVec3::new(-z, 0.0, x), DVec3::new(y, -x, 0.0));
    let outer = DMat3::from_cols(axis * x, axis * y, axis * z);
    DMat3::IDENTITY * cosine + cross * sine + outer * (1.0 - cosine)
}

/// The Euler angles of a plate with this normal whose x side runs along `across`, as far as they are perpendicular.
pub fn facing(normal: DVec3, across: DVec3) -> DVec3 {
    let normal = normal.normalize_or(DVec3::Z);
    let across = across - across.dot(normal) * normal;
    let across = across.normalize_or(normal.any_orthonormal_vector());
    euler_near(DMat3::from_cols(across, normal.cross(across), normal), DVec3::ZERO)
}

/// A body turned about a pivot, and its velocity with it. What stays is not written; a ball looks the same
/// from all sides.
pub fn turned(body: &Body, turn: DMat3, pivot: DVec3) -> Vec<BodyChange> {
    let mut changes = Vec::new();
    if body.position != pivot {
        changes.push(BodyChange::Position(pivot + turn * (body.position - pivot)));
    }
    if !matches!(body.shape, Shape::Sphere { .. }) {
        let rotation = euler_near(turn * rotation_matrix(body.rotation), body.rotation);
        changes.push(BodyChange::Rotation(rotation));
    }
    if let Motion::Dynamic { velocity, .. } = body.motion
        && velocity != DVec3::ZERO
    {
        changes.push(BodyChange::Velocity(turn * velocity));
    }
    if body.spin != DVec3::ZERO {
        changes.push(BodyChange::Spin(turn * body.spin));
    }
    changes
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use glam::dvec3;

    use super::*;

    fn off(a: DMat3, b: DMat3) -> f64 {
        (a - b).to_cols_array().iter().fold(0.0, |most, value| value.abs().max(most))
    }

    #[test]
    fn euler_angles_give_back_the_rotation_also_in_gimbal_lock() {
        let angles = [-PI, -FRAC_PI_2, -1.0, -1e-9, 0.0, 0.3, FRAC_PI_2, 2.5];
        for (x, y, z) in triples(&angles) {
            let rotation = rotation_matrix(dvec3(x, y, z));
            for near in [DVec3::ZERO, dvec3(x, y, z), dvec3(4.0, -3.0, 0.7)] {
                let found = euler_near(rotation, near);
                assert!(off(rotation_matrix(found), rotation) < 1e-14, "{x} {y} {z}: {found}");
            }
            assert_eq!(euler_near(rotation, dvec3(x, y, z)), dvec3(x, y, z), "they stay to the bit");
        }
    }

    fn triples(values: &[f64]) -> Vec<(f64, f64, f64)> {
        let mut all = Vec::new();
        for x in values {
            for y in values {
                all.extend(values.iter().map(|z| (*x, *y, *z)));
            }
        }
        all
    }

    #[test]
    fn angles_stay_near_to_those_before_on_a_long_way_around() {
        let start = dvec3(-FRAC_PI_2, 0.2, 0.1);
        let mut before = start;
        for step in 1..=400 {
            let rotation = turn(DVec3::Y, 0.05 * f64::from(step)) * rotation_matrix(start);
            let now = euler_near(rotation, before);
            assert!(now.distance(before) < 0.6, "a jump at {step}: {before} to {now}");
            before = now;
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(turn(DVec3::Z, FRAC_PI_2) * DVec3::X, DVec3::Y);
        assert_eq!(turn(DVec3::Y, -PI) * dvec3(1.0, 2.0, 3.0), dvec3(-1.0, 2.0, -3.0));
    }

    #[test]
    fn angles_give_the_directions_they_were_made_of() {
        let directions = [-1.0, -0.3, 0.0, 0.5, 1.0];
        for x in directions {
            for y in directions {
                for z in directions {
                    let Some(normal) = DVec3::new(x, y, z).try_normalize() else { continue };
                    for across in [DVec3::X, DVec3::Y, DVec3::new(0.2, -0.7, 0.4)] {
                        let matrix = rotation_matrix(facing(normal, across));
                        assert!((matrix.z_axis - normal).length() < 1e-14, "{normal} {across}");
                        let side = matrix.x_axis.dot(across - across.dot(normal) * normal);
                        assert!(side > -1e-14, "{normal} {across}: {side}");
                    }
                }
            }
        }
        assert_eq!(facing(DVec3::Z, DVec3::X), DVec3::ZERO);
        assert_eq!(facing(DVec3::Y, DVec3::X).x, -FRAC_PI_2);
    }
}
