//! What several of these tools ask for, and when they can be used.

use glam::DVec3;

use crate::design::extent::Extent;
use crate::design::place::{clear_step, of_map};
use crate::design::plan::Given;
use crate::design::tool::{Input, Kind};
use crate::scene::{BodyChange, Edit, NodeKey};

/// Most bodies that one step adds: more would not be what was meant.
pub const MOST: usize = 100_000;

pub const AXES: Kind = Kind::Choice(&["x", "y", "z"]);
pub const ANYWHERE: Kind = Kind::Number(-1e9, 1e9);

pub const AXIS: Input = Input { label: "Axis", unit: "", help: "", kind: AXES, default: |_| 0.0 };

pub fn axis(index: usize) -> DVec3 {
    DVec3::AXES[index.min(2)]
}

pub fn with_bodies(given: &Given<'_>) -> Result<(), &'static str> {
    if given.bodies().is_empty() { Err("no body is selected") } else { Ok(()) }
}

pub fn with_several(given: &Given<'_>) -> Result<(), &'static str> {
    if given.movable().len() < 2 { Err("select two bodies or more that are not locked") } else { Ok(()) }
}

/// The box around the selected bodies, or the map.
pub fn around(given: &Given<'_>) -> Extent {
    Extent::around(given.bodies()).unwrap_or(Extent { min: DVec3::ZERO, max: given.scene.map.size })
}

/// A step that takes a copy clear of its original along an axis.
pub fn pitch(given: &Given<'_>, axis: usize) -> f64 {
    clear_step(around(given).size()[axis], of_map(given, 0.05))
}

pub fn check_count(copies: usize) -> Result<(), String> {
    if copies > MOST { Err(format!("That would add {copies} bodies, more than {MOST}")) } else { Ok(()) }
}

pub fn moved(key: NodeKey, to: DVec3) -> Edit {
    Edit::Body { key, change: BodyChange::Position(to) }
}
