//! A view's camera in f64: orbit, pan, zoom to the cursor, rays and projections. World is right-handed, y up.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

use super::Bounds;

/// How depth becomes size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    Perspective,
    Orthographic,
}

/// The six looks along an axis, named as in CAD: `Front` looks along −z, `Right` along −x, `Top` along −y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisView {
    Front,
    Back,
    Right,
    Left,
    Top,
    Bottom,
}

/// A half-line in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// m. On the near side of everything visible; the eye itself in perspective.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
}

impl Ray {
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }
}

/// Looks at `target` from the direction given by `yaw` and `pitch`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    pub projection: Projection,
    /// The point that orbiting keeps in the middle of the view, m.
    pub target: DVec3,
    /// Turn about +y, radians; 0 looks along −z, π/2 along −x.
    pub yaw: f64,
    /// Height of the eye above the horizon, radians, −π/2..=π/2.
    pub pitch: f64,
    /// Height of what is visible at the target, m. Serves both projections, so that switching keeps sizes.
    pub height: f64,
}

/// Tangent of half the vertical field of view of a perspective camera: 20°.
pub(super) const TAN_HALF_FOV: f64 = 0.363_970_234_266_202_4;

/// Near plane over the distance from eye to target. There is no far plane: a 24-bit depth buffer then
/// tells depths apart that differ by 3e-5 of the distance, at the target.
pub(super) const NEAR_OVER_DISTANCE: f64 = 1.0 / 500.0;

/// Half the depth of an orthographic view over its height. What lies beyond is drawn at the limit.
const ORTHO_DEPTH_OVER_HEIGHT: f64 = 1000.0;

/// Smallest and largest [`Camera::height`], m.
const HEIGHT_RANGE: (f64, f64) = (1e-6, 1e9);

/// Coordinates beyond this are not drawn: their differences must fit an f32.
const FARTHEST: f64 = 1e30;

/// Whether something at `place` can be drawn at all.
pub(super) fn is_drawable(place: DVec3) -> bool {
    place.abs().cmple(DVec3::splat(FARTHEST)).all()
}

impl Default for Camera {
    /// Looks at a 10 m map from above its front right corner.
    fn default() -> Self {
        Self {
            projection: Projection::Perspective,
            target: DVec3::splat(5.0),
            yaw: 0.6,
            pitch: 0.42,
            height: 16.0,
        }
    }
}

impl AxisView {
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Right, Self::Left, Self::Top, Self::Bottom];

    pub fn label(self) -> &'static str {
        match self {
            Self::Front => "Front",
            Self::Back => "Back",
            Self::Right => "Right",
            Self::Left => "Left",
            Self::Top => "Top",
            Self::Bottom => "Bottom",
        }
    }

    /// Yaw and pitch.
    pub fn angles(self) -> (f64, f64) {
        use std::f64::consts::{FRAC_PI_2, PI};
        match self {
            Self::Front => (0.0, 0.0),
            Self::Back => (PI, 0.0),
            Self::Right => (FRAC_PI_2, 0.0),
            Self::Left => (-FRAC_PI_2, 0.0),
            Self::Top => (0.0, FRAC_PI_2),
            Self::Bottom => (0.0, -FRAC_PI_2),
        }
    }
}

impl Camera {
    /// An orthographic camera that looks along an axis at the whole of `bounds`.
    pub fn axis(view: AxisView, bounds: Bounds, aspect: f64) -> Self {
        let mut camera = Self { projection: Projection::Orthographic, ..Self::default() };
        camera.set_axis(view);
        camera.frame(bounds, aspect);
        camera
    }

    /// The usual oblique perspective look at the whole of `bounds`.
    pub fn perspective(bounds: Bounds, aspect: f64) -> Self {
        let mut camera = Self::default();
        camera.frame(bounds, aspect);
        camera
    }

    /// Turns to look along an axis; target, size and projection stay.
    pub fn set_axis(&mut self, view: AxisView) {
        (self.yaw, self.pitch) = view.angles();
    }

    /// The axis this camera looks along exactly, if any.
    pub fn axis_view(&self) -> Option<AxisView> {
        let backward = self.backward();
        let right = self.right();
        AxisView::ALL.into_iter().find(|view| {
            let (yaw, pitch) = view.angles();
            let other = Self { yaw, pitch, ..*self };
            other.backward().distance(backward) < 1e-9 && other.right().distance(right) < 1e-9
        })
    }

    /// Unit vector from the target to the eye.
    pub fn backward(&self) -> DVec3 {
        let (sin_yaw, cos_yaw) = libm::sincos(self.yaw);
        let (sin_pitch, cos_pitch) = libm::sincos(self.pitch);
        DVec3::new(cos_pitch * sin_yaw, sin_pitch, cos_pitch * cos_yaw)
    }

    /// Unit vector to the right of the view.
    pub fn right(&self) -> DVec3 {
        let (sin_yaw, cos_yaw) = libm::sincos(self.yaw);
        DVec3::new(cos_yaw, 0.0, -sin_yaw)
    }

    /// Unit vector to the top of the view.
    pub fn up(&self) -> DVec3 {
        self.backward().cross(self.right())
    }

    /// From eye to target, m. In an orthographic view the eye is where a perspective one would be.
    pub fn distance(&self) -> f64 {
        0.5 * self.height / TAN_HALF_FOV
    }

    pub fn eye(&self) -> DVec3 {
        self.target + self.backward() * self.distance()
    }

    /// This camera, or the nearest one whose numbers can be drawn with.
    pub fn usable(self) -> Self {
        let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
        let target = self.target.to_array().map(|value| finite(value).clamp(-FARTHEST, FARTHEST));
        let height = if self.height.is_nan() { 1.0 } else { self.height };
        Self {
            target: DVec3::from_array(target),
            yaw: finite(self.yaw),
            pitch: finite(self.pitch).clamp(-std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2),
            height: height.clamp(HEIGHT_RANGE.0, HEIGHT_RANGE.1),
            ..self
        }
    }

    /// Turns about the target; radians to the right and up that the *scene* seems to turn.
    pub fn orbit(&mut self, right: f64, up: f64) {
        use std::f64::consts::{FRAC_PI_2, PI};
        self.yaw = (self.yaw - right + PI).rem_euclid(2.0 * PI) - PI;
        self.pitch = (self.pitch + up).clamp(-FRAC_PI_2, FRAC_PI_2);
    }

    /// Moves so that the scene follows the pointer by `delta` (points or pixels, y down) in a view of
    /// that many points or pixels of height.
    pub fn pan(&mut self, delta: DVec2, view_height: f64) {
        let scale = self.world_per_pixel(view_height);
        self.target += (self.up() * delta.y - self.right() * delta.x) * scale;
    }

    /// Magnifies by `factor` (> 1 comes nearer) and keeps what is under `ndc` at the target's depth there.
    pub fn zoom_to_cursor(&mut self, ndc: DVec2, aspect: f64, factor: f64) {
        if !(factor.is_finite() && factor > 0.0) {
            return;
        }
        let before = self.height;
        self.height = (before / factor).clamp(HEIGHT_RANGE.0, HEIGHT_RANGE.1);
        let half_change = 0.5 * (before - self.height);
        self.target += (self.right() * ndc.x * aspect + self.up() * ndc.y) * half_change;
    }

    /// Moves (without turning) so that `bounds` fill most of the view.
    pub fn frame(&mut self, bounds: Bounds, aspect: f64) {
        // Around an axis view there is room for the grid's numbers.
        let margin = if self.projection == Projection::Perspective { 1.05 } else { 1.18 };
        self.target = bounds.center();
        let (mut width, mut height) = (0.0_f64, 0.0_f64);
        for corner in bounds.corners() {
            let from_center = corner - self.target;
            let towards_eye = match self.projection {
                Projection::Perspective => from_center.dot(self.backward()),
                Projection::Orthographic => 0.0,
            };
            // A corner at height y and depth d is at the edge when y = (distance − d) tan(fov/2).
            let add = 2.0 * towards_eye * TAN_HALF_FOV;
            width = width.max((2.0 * from_center.dot(self.right()).abs()) + add * aspect);
            height = height.max((2.0 * from_center.dot(self.up()).abs()) + add);
        }
        let fitting = margin * height.max(width / aspect.max(1e-6));
        self.height = if fitting > 0.0 { fitting } else { 1.0 };
        *self = self.usable();
    }

    /// The half-line under a point of the view: `ndc` from (−1, −1) at the bottom left to (1, 1),
    /// `aspect` = width / height.
    pub fn ray(&self, ndc: DVec2, aspect: f64) -> Ray {
        let offset = (self.right() * ndc.x * aspect + self.up() * ndc.y) * (0.5 * self.height);
        let back = self.backward();
        match self.projection {
            Projection::Perspective => {
                let origin = self.eye();
                Ray { origin, direction: (offset - back * self.distance()).normalize() }
            }
            Projection::Orthographic => {
                let depth = ORTHO_DEPTH_OVER_HEIGHT * self.height;
                Ray { origin: self.target + offset + back * depth, direction: -back }
            }
        }
    }

    /// Where a point is seen: x, y in normalised device coordinates and z = distance from the eye's
    /// plane along the view, m. `None` when it is behind the eye of a perspective view.
    pub fn project(&self, point: DVec3, aspect: f64) -> Option<DVec3> {
        let from_target = point - self.target;
        let depth = self.distance() - from_target.dot(self.backward());
        let scale = match self.projection {
            Projection::Perspective if depth <= self.near() => return None,
            Projection::Perspective => 1.0 / (depth * TAN_HALF_FOV),
            Projection::Orthographic => 2.0 / self.height,
        };
        let (x, y) = (from_target.dot(self.right()), from_target.dot(self.up()));
        Some(DVec3::new(x * scale / aspect, y * scale, depth))
    }

    /// The part of a segment that can be seen, with a margin around the view; `None` if there is none.
    /// What is left is near enough to keep its precision as f32.
    pub fn clip_segment(&self, from: DVec3, to: DVec3, aspect: f64) -> Option<(DVec3, DVec3)> {
        const MARGIN: f64 = 1.25;
        let half = match self.projection {
            Projection::Perspective => TAN_HALF_FOV,
            Projection::Orthographic => 0.5 * self.height,
        };
        // How far inside each plane of the view a point lies; linear along the segment.
        let inside = |point: DVec3| {
            let from_target = point - self.target;
            let depth = self.distance() - from_target.dot(self.backward());
            let (x, y) = (from_target.dot(self.right()), from_target.dot(self.up()));
            let (reach, front) = match self.projection {
                Projection::Perspective => (MARGIN * half * depth, depth - self.near()),
                Projection::Orthographic => (MARGIN * half, 1.0),
            };
            [reach * aspect - x, reach * aspect + x, reach - y, reach + y, front]
        };
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for (a, b) in inside(from).into_iter().zip(inside(to)) {
            match (a < 0.0, b < 0.0) {
                (true, true) => return None,
                (true, false) => start = start.max(a / (a - b)),
                (false, true) => end = end.min(a / (a - b)),
                (false, false) => {}
            }
        }
        let (start, end) = (start <= end).then(|| (from.lerp(to, start), from.lerp(to, end)))?;
        (is_drawable(start) && is_drawable(end)).then_some((start, end))
    }

    /// Metres per point (or pixel) at the target, in a view of that height.
    pub fn world_per_pixel(&self, view_height: f64) -> f64 {
        self.height / view_height.max(1.0)
    }

    /// Metres per point (or pixel) at `point`.
    pub fn world_per_pixel_at(&self, point: DVec3, view_height: f64) -> f64 {
        match self.projection {
            Projection::Orthographic => self.world_per_pixel(view_height),
            Projection::Perspective => {
                let depth = self.distance() - (point - self.target).dot(self.backward());
                2.0 * depth.max(self.near()) * TAN_HALF_FOV / view_height.max(1.0)
            }
        }
    }

    /// Depth of the near plane of a perspective view, m.
    pub fn near(&self) -> f64 {
        self.distance() * NEAR_OVER_DISTANCE
    }

    /// View matrix for coordinates relative to `origin`.
    pub fn view_matrix(&self, origin: DVec3) -> DMat4 {
        let to_view = DMat3::from_cols(self.right(), self.up(), self.backward()).transpose();
        DMat4::from_mat3(to_view) * DMat4::from_translation(origin - self.eye())
    }

    /// OpenGL projection (depth −1..1): infinitely far in perspective, symmetric about the target else.
    pub fn projection_matrix(&self, aspect: f64) -> DMat4 {
        match self.projection {
            Projection::Perspective => {
                let f = 1.0 / TAN_HALF_FOV;
                DMat4::from_cols(
                    DVec4::new(f / aspect, 0.0, 0.0, 0.0),
                    DVec4::new(0.0, f, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, -1.0, -1.0),
                    DVec4::new(0.0, 0.0, -2.0 * self.near(), 0.0),
                )
            }
            Projection::Orthographic => {
                let half_depth = ORTHO_DEPTH_OVER_HEIGHT * self.height;
                DMat4::from_cols(
                    DVec4::new(2.0 / (self.height * aspect), 0.0, 0.0, 0.0),
                    DVec4::new(0.0, 2.0 / self.height, 0.0, 0.0),
                    DVec4::new(0.0, 0.0, -1.0 / half_depth, 0.0),
                    DVec4::new(0.0, 0.0, -self.distance() / half_depth, 1.0),
                )
            }
        }
    }
}
