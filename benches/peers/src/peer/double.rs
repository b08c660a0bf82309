//! rapier3d-f64: the same source, which differs in the type of a number only.

use rapier3d_f64 as engine;

type Real = f64;

#[path = "world.rs"]
pub mod world;
