//! Where something that is dragged may go: along a line or in a plane.

use glam::{DVec2, DVec3};

use super::{Axis, snap_value};
use crate::view::{Camera, Ray};

/// Sine of the smallest angle between a ray and a plane, or a ray and a line, at which the pointer still has
/// a sensible place there: below about 2°, a point on the screen is metres in the scene.
const SMALLEST_SINE: f64 = 0.035;

/// Sine of the camera's smallest elevation at which bodies are dragged over the ground instead of in the
/// plane of the view: about 10°.
const GROUND_SINE: f64 = 0.17;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Freedom {
    /// Unit vector.
    Line(DVec3),
    /// Two unit vectors at right angles.
    Plane(DVec3, DVec3),
}

impl Freedom {
    /// In the plane of the picture.
    pub fn facing(camera: &Camera) -> Self {
        Self::Plane(clean(camera.right()), clean(camera.up()))
    }

    /// Where a body goes that is dragged as it is: in the plane of the picture if that is a plane of the
    /// drawing, else at its height, over the ground. A view from the horizon does not see the ground.
    pub fn natural(camera: &Camera) -> Self {
        let backward = camera.backward();
        if Axis::of_unit(backward).is_some() || backward.y.abs() < GROUND_SINE {
            Self::facing(camera)
        } else {
            Self::Plane(DVec3::X, DVec3::Z)
        }
    }

    /// How far what was grabbed at `grabbed` goes when the pointer goes from one `ndc` to another. `None`
    /// where the pointer has no place: the line points at the viewer, the plane is seen edge-on.
    pub fn offset(
        self,
        camera: &Camera,
        aspect: f64,
        grabbed: DVec3,
        (from, to): (DVec2, DVec2),
    ) -> Option<DVec3> {
        let place = |ndc| self.place(&camera.ray(ndc, aspect), grabbed);
        let moved = place(to)? - place(from)?;
        moved.is_finite().then_some(moved)
    }

    /// The point of this line or plane through `grabbed` that a ray meets or passes nearest.
    fn place(self, ray: &Ray, grabbed: DVec3) -> Option<DVec3> {
        let w = grabbed - ray.origin;
        match self {
            Self::Line(unit) => {
                // s = ((u·d)(d·w) − u·w) / (1 − (u·d)²) for the ray o + t d and the line grabbed + s u.
                let sine_squared = unit.cross(ray.direction).length_squared();
                let s = unit.dot(ray.direction) * ray.direction.dot(w) - unit.dot(w);
                (sine_squared > SMALLEST_SINE * SMALLEST_SINE).then(|| grabbed + unit * (s / sine_squared))
            }
            Self::Plane(u, v) => {
                let normal = u.cross(v);
                let slope = ray.direction.dot(normal);
                let distance = w.dot(normal) / slope;
                (slope.abs() > SMALLEST_SINE && distance > 0.0).then(|| ray.at(distance))
            }
        }
    }

    /// An offset from `origin` of which nothing leads out of this line or plane, and whose end lies on
    /// multiples of `step`: of the coordinates along the world's axes, of the way along others.
    pub fn snapped(self, origin: DVec3, offset: DVec3, step: f64) -> DVec3 {
        self.snapped_to_tiles(origin, offset, DVec3::splat(step))
    }

    /// The same with a step of its own along each axis; the shortest counts along other ways.
    pub fn snapped_to_tiles(self, origin: DVec3, offset: DVec3, steps: DVec3) -> DVec3 {
        self.directions().fold(DVec3::ZERO, |sum, unit| sum + snapped_along(unit, origin, offset, steps))
    }

    /// Only what leads along this line or plane.
    pub fn within(self, offset: DVec3) -> DVec3 {
        self.directions().fold(DVec3::ZERO, |sum, unit| sum + unit * offset.dot(unit))
    }

    pub fn directions(self) -> impl Iterator<Item = DVec3> {
        let second = match self {
            Self::Line(_) => None,
            Self::Plane(_, v) => Some(v),
        };
        let (Self::Line(first) | Self::Plane(first, _)) = self;
        std::iter::once(first).chain(second)
    }
}

fn snapped_along(unit: DVec3, origin: DVec3, offset: DVec3, steps: DVec3) -> DVec3 {
    match Axis::of_unit(unit) {
        Some(axis) => {
            let from = origin[axis as usize];
            axis.unit() * (snap_value(from + offset[axis as usize], steps[axis as usize]) - from)
        }
        None => unit * snap_value(offset.dot(unit), steps.min_element()),
    }
}

/// An axis of the world as itself, without the rounding of sines.
fn clean(unit: DVec3) -> DVec3 {
    match Axis::of_unit(unit) {
        Some(axis) => axis.unit() * unit[axis as usize].signum(),
        None => unit,
    }
}
