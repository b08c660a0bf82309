//! Distances between surfaces, from the closest point.

use super::flight::Sum;
use crate::scene::{Body, Motion, Shape};
use glam::{DMat3, DVec3, dvec3};

/// A surface a sphere can meet.
#[derive(Clone, Debug)]
pub enum Surface {
    Sphere { centre: DVec3, radius: f64 },
    Plate { centre: DVec3, world_from_local: DMat3, half_x: f64, half_y: f64 },
}

/// How far a sphere is from something, and which way.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceGap {
    /// Metres, negative when they overlap.
    pub distance: f64,
    /// Unit vector from the sphere's centre to the nearest point of the other body.
    pub towards: DVec3,
}

impl Surface {
    /// The surface of a body; `None` for a shape that the reference does not know.
    pub fn of(body: &Body) -> Option<Self> {
        Some(match body.shape {
            Shape::Sphere { radius } => Self::Sphere { centre: body.position, radius },
            Shape::Plane { half_x, half_y } => Self::Plate {
                centre: body.position,
                world_from_local: euler_matrix(body.rotation),
                half_x,
                half_y,
            },
            Shape::Unbuilt { .. } => return None,
        })
    }

    /// The gap to a sphere.
    pub fn gap(&self, point: DVec3, radius: f64) -> SurfaceGap {
        self.gap_of(Sum::new(point), radius)
    }

    /// The gap to a sphere whose centre is known better than an f64 holds it.
    pub(super) fn gap_of(&self, point: Sum, radius: f64) -> SurfaceGap {
        match *self {
            Self::Sphere { centre, radius: own } => gap_along(Sum::new(centre).minus(point), radius + own),
            Self::Plate { centre, world_from_local, half_x, half_y } => {
                let local = world_from_local.transpose() * point.minus(Sum::new(centre));
                let nearest = dvec3(local.x.clamp(-half_x, half_x), local.y.clamp(-half_y, half_y), 0.0);
                let offset = nearest - local;
                let towards = world_from_local * offset.normalize_or_zero();
                SurfaceGap { distance: offset.length() - radius, towards }
            }
        }
    }

    /// The normal of a plate on the side of a point, where the foot of that lies between its edges.
    pub(super) fn face_under(&self, point: DVec3) -> Option<DVec3> {
        let Self::Plate { centre, world_from_local, half_x, half_y } = *self else { return None };
        let local = world_from_local.transpose() * (point - centre);
        let is_over = local.x.abs() < half_x && local.y.abs() < half_y;
        is_over.then(|| world_from_local.z_axis * local.z.signum())
    }

    /// How far a sphere reaches through a plate's infinite plane, seen from the side its normal points to;
    /// negative when it is clear of it.
    pub fn depth_behind(&self, point: DVec3, radius: f64) -> Option<f64> {
        let Self::Plate { centre, world_from_local, .. } = *self else { return None };
        Some(radius - (point - centre).dot(world_from_local.z_axis))
    }
}

/// The gap between two spheres, seen from the first.
pub fn sphere_gap(a: DVec3, radius_a: f64, b: DVec3, radius_b: f64) -> SurfaceGap {
    gap_along(b - a, radius_a + radius_b)
}

/// The gap of two spheres whose centres are `offset` apart.
pub(super) fn gap_along(offset: DVec3, radii: f64) -> SurfaceGap {
    SurfaceGap { distance: offset.length() - radii, towards: offset.normalize_or_zero() }
}

/// Whether a body moves, and its radius.
pub fn dynamic_radius(body: &Body) -> Option<f64> {
    match (body.motion, &body.shape) {
        (Motion::Dynamic { .. }, &Shape::Sphere { radius }) => Some(radius),
        _ => None,
    }
}

/// R = Rx(α)·Ry(β)·Rz(γ), multiplied out.
fn euler_matrix(angles: DVec3) -> DMat3 {
    let ((sa, ca), (sb, cb), (sc, cc)) =
        (libm::sincos(angles.x), libm::sincos(angles.y), libm::sincos(angles.z));
    DMat3::from_cols(
        dvec3(cb * cc, ca * sc + sa * sb * cc, sa * sc - ca * sb * cc),
        dvec3(-cb * sc, ca * cc - sa * sb * sc, sa * cc + ca * sb * sc),
        dvec3(sb, -sa * cb, ca * cb),
    )
}
