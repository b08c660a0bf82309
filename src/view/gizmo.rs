//! Dragging in f64: in the plane of a view, along an axis, and snapping to a step.

use glam::{DVec2, DVec3};

use super::{Camera, Viewport, format::round_down_125};

/// A world axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    pub fn unit(self) -> DVec3 {
        [DVec3::X, DVec3::Y, DVec3::Z][self as usize]
    }

    pub fn label(self) -> &'static str {
        ["x", "y", "z"][self as usize]
    }
}

/// One arrow of the move gizmo on the screen, points from the view's top left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    pub axis: Axis,
    pub from: DVec2,
    pub to: DVec2,
}

/// Length of a gizmo arrow that lies in the view's plane, points.
const HANDLE_POINTS: f64 = 64.0;

/// Arrows seen shorter than this point at the viewer and cannot be dragged sensibly, points.
const SHORTEST_HANDLE: f64 = 14.0;

/// The arrows to drag a body at `place` along the axes; those that point at the viewer are left out.
pub fn gizmo_handles(camera: &Camera, viewport: Viewport, place: DVec3) -> Vec<Handle> {
    let length = HANDLE_POINTS * camera.world_per_pixel_at(place, viewport.height);
    let seen = |point| Some(viewport.points(camera.project(point, viewport.aspect())?.truncate()));
    Axis::ALL
        .into_iter()
        .filter_map(|axis| {
            let (from, to) = (seen(place)?, seen(place + axis.unit() * length)?);
            (from.distance(to) >= SHORTEST_HANDLE).then_some(Handle { axis, from, to })
        })
        .collect()
}

/// How far a body grabbed at `grabbed` moves, staying in the plane through it that faces the view, when
/// the pointer goes from one `ndc` to another. Zero where the pointer has no place in that plane.
pub fn drag_in_plane(camera: &Camera, aspect: f64, grabbed: DVec3, from: DVec2, to: DVec2) -> DVec3 {
    let normal = camera.backward();
    let place = |ndc| {
        let ray = camera.ray(ndc, aspect);
        let slope = ray.direction.dot(normal);
        ray.at((grabbed - ray.origin).dot(normal) / slope)
    };
    let moved = place(to) - place(from);
    if moved.is_finite() { moved } else { DVec3::ZERO }
}

/// How far a body grabbed at `grabbed` moves along `axis` when the pointer goes from one `ndc` to
/// another: the way between the points of the axis nearest to both rays. Zero where axis and ray are parallel.
pub fn drag_along_axis(
    camera: &Camera,
    aspect: f64,
    grabbed: DVec3,
    axis: Axis,
    from: DVec2,
    to: DVec2,
) -> f64 {
    let unit = axis.unit();
    // s = ((u·d)(d·w) − u·w) / (1 − (u·d)²), w = grabbed − o, for the ray o + t d and the line grabbed + s u.
    let along = |ndc| {
        let ray = camera.ray(ndc, aspect);
        let w = grabbed - ray.origin;
        let cosine = unit.dot(ray.direction);
        let sine_squared = unit.cross(ray.direction).length_squared();
        (cosine * ray.direction.dot(w) - unit.dot(w)) / sine_squared
    };
    let moved = along(to) - along(from);
    if moved.is_finite() { moved } else { 0.0 }
}

/// Each coordinate to the nearest multiple of `step` metres; unchanged when `step` is not positive.
pub fn snap(position: DVec3, step: f64) -> DVec3 {
    if !(step.is_finite() && step > 0.0) {
        return position;
    }
    // Multiples of 0.1 as quotients by 10 give the decimal that a person would type.
    let inverse = (1.0 / step).round();
    if (inverse * step - 1.0).abs() < 1e-12 && inverse >= 1.0 {
        (position * inverse).round() / inverse
    } else {
        (position / step).round() * step
    }
}

/// A snapping step that suits the magnification: about eight points, rounded to 1, 2 or 5 × 10^k metres.
pub fn snap_step(camera: &Camera, viewport: Viewport) -> f64 {
    round_down_125(12.0 * camera.world_per_pixel(viewport.height))
}
