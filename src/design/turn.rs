//! Rotations as the file has them: Euler angles of a plate whose directions are known.

use glam::{DMat3, DVec3};

/// Below this cosine of β only the sum of the other two angles matters.
const GIMBAL: f64 = 1e-12;

/// The Euler angles (α, β, γ) of R = Rx(α)·Ry(β)·Rz(γ), from R. Where β is ±90° α is 0.
///
/// The first row of R is (cos β cos γ, −cos β sin γ, sin β), its last column (sin β, −sin α cos β, cos α cos β).
pub fn euler(matrix: DMat3) -> DVec3 {
    let (x, y, z) = (matrix.x_axis, matrix.y_axis, matrix.z_axis);
    let cos_beta = libm::hypot(x.x, y.x);
    let beta = libm::atan2(z.x, cos_beta);
    let angles = if cos_beta > GIMBAL {
        DVec3::new(libm::atan2(-z.y, z.z), beta, libm::atan2(-y.x, x.x))
    } else {
        DVec3::new(0.0, beta, libm::atan2(x.y, y.y))
    };
    // A zero without sign: what was rounded away from 0 stands in no file.
    DVec3::from_array(angles.to_array().map(|angle| if angle.abs() < 1e-15 { 0.0 } else { angle }))
}

/// The Euler angles of a plate with this normal whose x side runs along `across`, as far as they are perpendicular.
pub fn facing(normal: DVec3, across: DVec3) -> DVec3 {
    let normal = normal.normalize_or(DVec3::Z);
    let across = across - across.dot(normal) * normal;
    let across = across.normalize_or(normal.any_orthonormal_vector());
    euler(DMat3::from_cols(across, normal.cross(across), normal))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::rotation_matrix;

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
        assert_eq!(facing(DVec3::Y, DVec3::X).x, -std::f64::consts::FRAC_PI_2);
    }
}
