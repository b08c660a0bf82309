//! From rotations to the Euler angles that a file has.

use glam::{DMat3, DVec3};

/// Angles nearer than this to those before are those before: the rounding of a few matrix products, radians.
const SAME_ANGLE: f64 = 1e-12;

/// Length below which a row of a rotation says nothing about an angle: gimbal lock.
const LOCKED: f64 = 1e-9;

/// Euler angles (α, β, γ) of R = Rx(α)·Ry(β)·Rz(γ) that are nearest to `near`. An angle that stays keeps its
/// bits; where β is a quarter turn, and α and γ turn about the same line, α stays.
pub fn euler_near(rotation: DMat3, near: DVec3) -> DVec3 {
    let (minus_r12, r22) = (-rotation.z_axis.y, rotation.z_axis.z);
    let alpha = libm::atan2(minus_r12, r22);
    let alphas = if libm::hypot(minus_r12, r22) < LOCKED {
        [near.x, near.x]
    } else {
        [alpha, alpha + std::f64::consts::PI]
    };
    let [a, b] = alphas.map(|alpha| with_alpha(rotation, alpha, near));
    let best = if b.distance(near) < a.distance(near) { b } else { a };
    DVec3::select((best - near).abs().cmplt(DVec3::splat(SAME_ANGLE)), near, best)
}

/// β and γ of a rotation once α is known, all as near to `near` as whole turns allow.
fn with_alpha(rotation: DMat3, alpha: f64, near: DVec3) -> DVec3 {
    let (sine, cosine) = libm::sincos(alpha);
    let [x, y, z] = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
    // Rx(−α) R = Ry(β) Rz(γ)
    let beta = libm::atan2(z.x, cosine * z.z - sine * z.y);
    let gamma = libm::atan2(cosine * x.y + sine * x.z, cosine * y.y + sine * y.z);
    let turns = |angle: f64, near: f64| {
        angle + std::f64::consts::TAU * ((near - angle) / std::f64::consts::TAU).round()
    };
    DVec3::new(turns(alpha, near.x), turns(beta, near.y), turns(gamma, near.z))
}
