//! rapier3d in its default precision.

use rapier3d as engine;

type Real = f32;

#[path = "world.rs"]
pub mod world;
