//! Lasting contact of a sphere with a static body or another sphere: it rests, slides or rolls.

use super::body::BodyId;
use super::shape::Surface;

/// One lasting contact of a dynamic body. Two dynamic bodies in contact list each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub other: BodyId,
    pub surface: Surface,
    /// When the last of the skipped bounces would end, until that time has come.
    pub settles_at: Option<f64>,
    /// Whether it does not slip at the end of the present segments.
    pub sticks: bool,
}
