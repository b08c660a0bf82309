//! The way of a body into a point attractor, kept for its way back.

use glam::DVec3;

use super::place::Place;
use super::segment::{Segment, Series};

/// A body on its way into an attractor, or back.
#[derive(Clone, Debug, Default)]
pub(super) struct Plunge {
    pub legs: Vec<Leg>,
    pub back: Option<Turn>,
}

/// A step on the way in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub segment: Segment,
    pub series: Series,
    /// How long it lasted, s.
    pub length: f64,
}

/// Where the next leg of the way back begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// s.
    pub time: f64,
    pub from: Point,
}

/// A start of the integrator.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub place: Place,
    /// m/s.
    pub v: DVec3,
}
