//! The uniform grid that tells which bodies are near each other.

mod bricks;
mod grid;
mod moving;
mod statics;

pub(super) use bricks::for_each_brick;
pub(super) use grid::{Grid, TileRange};
pub(super) use moving::MovingTiles;
pub(super) use statics::StaticTiles;
