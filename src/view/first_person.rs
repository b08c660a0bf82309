//! A perspective camera as an eye: it stands at a place, looks along a direction, turns its head and flies.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::camera::{NEAR_OVER_DISTANCE, TAN_HALF_FOV};
use super::{Camera, Projection};

/// A direction whose horizontal part is a smaller share of it than this has no yaw: there it would be rounding.
const UPRIGHT: f64 = 1e-9;

impl Camera {
    /// Puts the eye at a place, in perspective; nothing nearer than `near` (m) is drawn.
    pub fn stand_at(&mut self, eye: DVec3, near: f64) {
        self.projection = Projection::Perspective;
        self.height = 2.0 * TAN_HALF_FOV * near / NEAR_OVER_DISTANCE;
        *self = self.usable();
        self.target = eye - self.backward() * self.distance();
    }

    /// The yaw and pitch that look along `direction`. Straight up or down the yaw stays; `None` for no direction.
    pub fn angles_along(&self, direction: DVec3) -> Option<[f64; 2]> {
        let DVec3 { x, y, z } = -direction.try_normalize()?;
        let level = libm::hypot(x, z);
        let yaw = if level > UPRIGHT { libm::atan2(x, z) } else { self.yaw };
        Some([yaw, libm::atan2(y, level)])
    }

    /// Turns about the eye, radians to the right and up.
    pub fn turn_head(&mut self, right: f64, up: f64) {
        let eye = self.eye();
        self.yaw = (self.yaw - right + PI).rem_euclid(2.0 * PI) - PI;
        self.pitch = (self.pitch - up).clamp(-FRAC_PI_2, FRAC_PI_2);
        self.target = eye - self.backward() * self.distance();
    }

    /// Moves without turning: to the right, up along the world's y, and ahead, m.
    pub fn fly(&mut self, right: f64, up: f64, ahead: f64) {
        self.target += self.right() * right + DVec3::Y * up - self.backward() * ahead;
        *self = self.usable();
    }
}
