//! What is shown of motion beside the present: the ways of bodies, and how they come to an impact and leave it.

use std::sync::Arc;

use glam::DVec3;

use crate::scene::NodeKey;

/// How much of the ways is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSpan {
    /// Seconds of model time before and after the moment shown.
    pub past: f64,
    pub future: f64,
}

/// The way of one body as places on it, m.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyPath {
    pub key: NodeKey,
    /// Up to the place of the moment shown, and from it.
    pub past: Vec<DVec3>,
    pub future: Vec<DVec3>,
}

/// A body at an impact.
#[derive(Clone, Debug, PartialEq)]
pub struct ImpactBody {
    pub key: NodeKey,
    /// Centre, m.
    pub position: DVec3,
    /// m/s.
    pub before: DVec3,
    pub after: DVec3,
    /// Where it is at the start of the Δt and, if that is recorded, at its end, m.
    pub at_start: DVec3,
    pub at_end: Option<DVec3>,
}

/// A body's centre goes through a face between two tiles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    pub key: NodeKey,
    /// s.
    pub time: f64,
    /// 0 to 2: x, y, z.
    pub axis: usize,
    /// Numbers of the tiles along that axis, counted from 0: the one left and the one entered.
    pub tiles: [u32; 2],
}

/// What an event cancelled: impacts that were predicted right before it, and are so no more.
#[derive(Clone, Debug, PartialEq)]
pub struct Cancelled {
    /// Number of the event.
    pub event: u64,
    /// By the time they were predicted for.
    pub impacts: Vec<CancelledImpact>,
    /// Why it cannot be told.
    pub problem: Option<String>,
}

/// An impact that an event prevented or moved.
#[derive(Clone, Debug, PartialEq)]
pub struct CancelledImpact {
    /// The body with the smaller UserID, and the other.
    pub keys: [NodeKey; 2],
    pub labels: [Arc<str>; 2],
    /// When the two were to meet, s.
    pub time: f64,
    /// When they are to meet instead, s, if anything is predicted.
    pub now: Option<f64>,
}
