//! The uniform grid that tells which bodies are near each other.

mod bricks;
mod dynamic;
mod grid;
mod statics;

pub(super) use bricks::for_each_brick;
pub(super) use dynamic::DynamicTiles;
pub(super) use grid::{Grid, TileRange};
pub(super) use statics::{StaticTiles, coarse_enough};
