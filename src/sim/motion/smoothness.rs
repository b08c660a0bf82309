//! Where a force is not smooth: drag, −½CρS|v|v, at v = 0.
//!
//! Along v + at the speed |v + at| has branch points at the distance |v|/|a| from here, in complex time. No
//! polynomial follows it over a longer step, and b₆ does not show it: near an apex drag is a small part of the
//! acceleration. So steps stay below that distance, unless the drag at the apex is lost in rounding: then
//! |v|v is a kink between two smooth halves, and a step ends there.

use std::f64::consts::PI;

use glam::DVec3;

use super::tolerance::{KINK_AT_START, RESOLUTION, RESOLVED, RESOLVED_AFTER};
use crate::sim::force::Law;
use crate::sim::model::Model;
use crate::sim::segment::Series;

/// ½CρS/m of a body, 1/m: its drag is that times |v|v.
pub(super) fn drag_of(model: &Model, body: u32) -> f64 {
    let (mass, radius) = (model.mass(body), model.radius(body));
    let area = PI * radius * radius;
    let drags = model.forces.iter().map(|force| match force.law {
        Law::Drag { coefficient } => coefficient * area / mass,
        _ => 0.0,
    });
    drags.sum()
}

/// Whether a field is smooth along a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Smooth {
    Yes,
    /// Not over more than about this length, s.
    For(f64),
    /// Up to a kink at this time since its start, s.
    Until(f64),
}

/// A body on a step: when it starts, velocity and acceleration there, and the drag of [`drag_of`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// s.
    pub time: f64,
    pub drag: f64,
    pub v: DVec3,
    pub a: DVec3,
}

impl Course {
    /// Longest step in which drag is smooth, s, judged from its start.
    pub fn resolved(&self) -> f64 {
        let distance = RESOLVED * self.distance();
        if self.v.dot(self.a) >= 0.0 || distance == f64::INFINITY {
            return distance;
        }
        // The apex lies ahead: half way there, but not nearer than it is far off in imaginary time.
        let across = RESOLVED * self.across().length() / self.a.length();
        across.max(distance / (1.0 + RESOLVED))
    }

    /// Distance of the nearest point in time at which drag is not smooth, s; infinite where that is lost in
    /// rounding.
    fn distance(&self) -> f64 {
        if self.is_negligible(self.across()) { f64::INFINITY } else { self.v.length() / self.a.length() }
    }

    /// The velocity that is left at the apex, m/s.
    fn across(&self) -> DVec3 {
        let square = self.a.length_squared();
        if square > 0.0 { self.v - (self.v.dot(self.a) / square) * self.a } else { DVec3::ZERO }
    }

    /// Whether the drag at a velocity is lost in the rounding of the acceleration.
    fn is_negligible(&self, v: DVec3) -> bool {
        self.drag * v.length_squared() <= f64::EPSILON * self.a.length()
    }

    /// The same body, a part s into the step.
    fn at(&self, series: &Series, step: f64, s: f64) -> Self {
        let v = self.v + (s * step) * (self.a + series.velocity_term(s));
        Self { v, a: self.a + series.acceleration_term(s), ..*self }
    }

    /// Whether drag was smooth along a step that was made. A kink is looked for in the first `reach` of it.
    pub fn look(&self, series: &Series, step: f64, reach: f64) -> Smooth {
        if self.drag == 0.0 {
            return Smooth::Yes;
        }
        let end = self.at(series, step, reach);
        if self.is_negligible(self.v) && end.is_negligible(end.v) {
            return Smooth::Yes;
        }
        let mut distance = self.distance().min(end.distance());
        if self.v.dot(self.a) < 0.0 && end.v.dot(end.a) > 0.0 {
            let (s, apex) = self.apex(series, step, reach);
            if apex.is_negligible(apex.v) {
                let is_at_start = s <= KINK_AT_START || s * step <= RESOLUTION * self.time.abs();
                return if is_at_start { Smooth::Yes } else { Smooth::Until(s * step) };
            }
            distance = distance.min(apex.v.length() / apex.a.length());
        }
        if step <= RESOLVED_AFTER * distance { Smooth::Yes } else { Smooth::For(RESOLVED * distance) }
    }

    /// Where the speed is least, v·a = 0, and what it is there.
    fn apex(&self, series: &Series, step: f64, reach: f64) -> (f64, Self) {
        let (mut low, mut high) = (0.0, reach);
        loop {
            let middle = 0.5 * (low + high);
            let there = self.at(series, step, middle);
            if middle <= low || middle >= high {
                return (middle, there);
            }
            if there.v.dot(there.a) < 0.0 { low = middle } else { high = middle }
        }
    }
}

impl Smooth {
    /// What holds for two bodies.
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::For(a), Self::For(b)) => Self::For(a.min(b)),
            (Self::For(a), _) | (_, Self::For(a)) => Self::For(a),
            (Self::Until(a), Self::Until(b)) => Self::Until(a.min(b)),
            (Self::Until(a), Self::Yes) | (Self::Yes, Self::Until(a)) => Self::Until(a),
            (Self::Yes, Self::Yes) => Self::Yes,
        }
    }
}
