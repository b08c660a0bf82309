//! From y up, as scenes are, to z up, as robotics has it: a quarter turn about x, which only swaps numbers.

use glam::{DMat3, DQuat, DVec3};

use crate::scene::rotation_matrix;

/// (x, y, z) → (x, −z, y).
pub(super) fn z_up(v: DVec3) -> DVec3 {
    // Adding 0 makes −0 a plain 0.
    DVec3::new(v.x, -v.z + 0.0, v.y)
}

/// World from local, z up; shapes keep their local axes.
pub(super) fn z_up_rotation(euler: DVec3) -> DMat3 {
    let turned = rotation_matrix(euler);
    DMat3::from_cols(z_up(turned.x_axis), z_up(turned.y_axis), z_up(turned.z_axis))
}

/// A rotation as a unit quaternion with w ≥ 0.
pub(super) fn quaternion(rotation: DMat3) -> DQuat {
    let q = DQuat::from_mat3(&rotation).normalize();
    if q.w < 0.0 { -q } else { q }
}

/// Roll, pitch and yaw with R = Rz(yaw)·Ry(pitch)·Rx(roll). Exact to rounding at pitch ±90° too, where only the
/// sum of the other two matters.
pub(super) fn roll_pitch_yaw(rotation: DMat3) -> DVec3 {
    let (x, y) = (rotation.x_axis, rotation.y_axis);
    let level = libm::hypot(x.x, x.y);
    let pitch = libm::atan2(-x.z, level);
    if level < 1e-9 {
        // Of what is left, yaw alone: R·ŷ = (−sin yaw, cos yaw, 0).
        return DVec3::new(0.0, pitch, libm::atan2(-y.x, y.y));
    }
    DVec3::new(libm::atan2(y.z, rotation.z_axis.z), pitch, libm::atan2(x.y, x.x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_give_the_rotation_back() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let steps = [-quarter, 3e-7 - quarter, -0.3, 0.0, 0.7, quarter - 3e-7, quarter, 2.9];
        for (x, y, z) in steps.iter().flat_map(|x| steps.iter().flat_map(move |y| steps.map(|z| (x, y, z)))) {
            let rotation = z_up_rotation(DVec3::new(*x, *y, z));
            let a = roll_pitch_yaw(rotation);
            let back =
                DMat3::from_rotation_z(a.z) * DMat3::from_rotation_y(a.y) * DMat3::from_rotation_x(a.x);
            assert!(back.abs_diff_eq(rotation, 3e-9), "{rotation} {back}");
            assert!(DMat3::from_quat(quaternion(rotation)).abs_diff_eq(rotation, 1e-14));
        }
    }
}
