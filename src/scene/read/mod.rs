//! From the tree to what it means: the typed scene, every problem, and the uses of format 1.1.
//! One file per family of elements; `item.rs` and `scene.rs` put their results together.

mod body;
mod cosmetic;
mod feature;
mod force;
mod item;
mod log;
mod map;
mod problem;
mod scene;
mod shape;
mod simulation;

pub(super) use body::{BODY_ORDER, SHAPES};
pub(super) use cosmetic::is_cosmetic;
#[cfg(test)]
pub(super) use feature::NAMES as NEW;
#[cfg(test)]
pub(super) use force::FORCES;
pub(super) use item::{Item, ItemReading};
pub(super) use scene::{Meaning, read};
