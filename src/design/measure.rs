//! What both troubles and repairs go by: what may move, what lies outside, which tiles fit; and the ways to repair.

use super::gap::radius;
use crate::scene::{Body, NodeKey, Scene};

/// Tiles that a fitting map has at most: what a sparse one needs, and quick to lay out.
const MOST_FITTING: f64 = 250_000.0;

/// Sides of a fitting tile over the middle radius: a ball lies in a handful of tiles, a tile holds a handful of balls.
const TILE_OVER_RADIUS: f64 = 3.0;

/// Tiles along an axis that the format allows.
pub(super) const MOST_ON_AXIS: f64 = 65_536.0;

/// One way to put a scene right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repair {
    /// These two.
    PushApart(NodeKey, NodeKey),
    PushAllApart,
    GrowMap,
    FitTiles,
    MakeIdsUnique,
}

impl Repair {
    /// What a button says.
    pub fn label(self) -> &'static str {
        match self {
            Self::PushApart(..) => "Push apart",
            Self::PushAllApart => "Push all apart",
            Self::GrowMap => "Grow the map",
            Self::FitTiles => "Fit tiles",
            Self::MakeIdsUnique => "Make IDs unique",
        }
    }

    /// What it does, in a sentence.
    pub fn help(self) -> &'static str {
        match self {
            Self::PushApart(..) => {
                "Moves both along the shortest way until they touch; what is static or locked stays"
            }
            Self::PushAllApart => "Moves all overlapping bodies along their shortest ways until they touch",
            Self::GrowMap => "Enlarges the map by whole tiles until all moving bodies start inside",
            Self::FitTiles => "Chooses tiles by the size of the balls; changes the speed, never the result",
            Self::MakeIdsUnique => "Gives a new UserID to everything that repeats one",
        }
    }
}

pub(super) fn may_move(body: &Body) -> bool {
    body.is_dynamic() && !body.locked
}

/// Whether two bodies can be pushed apart.
pub(super) fn may_part(a: &Body, b: &Body) -> bool {
    may_move(a) || may_move(b)
}

/// Whether a moving body's middle lies outside the map.
pub(super) fn is_outside(scene: &Scene, body: &Body) -> bool {
    body.is_dynamic() && !scene.map.contains(body.position)
}

/// The median of the radii of moving balls.
pub(super) fn middle_radius(scene: &Scene) -> Option<f64> {
    let balls = scene.bodies.iter().filter(|body| body.is_dynamic());
    let mut radii: Vec<f64> = balls.filter_map(radius).collect();
    radii.sort_by(f64::total_cmp);
    radii.get(radii.len() / 2).copied()
}

/// Tiles that suit the balls and the map.
pub(super) fn fitting_tiles(scene: &Scene) -> [u32; 3] {
    let size = scene.map.size;
    let sparse = libm::cbrt(size.element_product() / MOST_FITTING);
    let side = match middle_radius(scene) {
        Some(radius) => (TILE_OVER_RADIUS * radius).max(sparse),
        None => size.max_element() / 10.0,
    };
    (size / side).round().to_array().map(|count| count.clamp(1.0, MOST_ON_AXIS) as u32)
}
