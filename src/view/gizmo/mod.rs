//! Handles to drag bodies by, as geometry alone: where they are seen, which lies under the pointer, and what
//! dragging one means. Drawing them and editing the scene is left to others.

mod axis;
mod contact;
mod freedom;
mod handles;
mod pull;
mod snap;

pub use axis::Axis;
pub use contact::{Guide, Neighbour, aligned, features, touching};
pub use freedom::Freedom;
pub use handles::{Handle, Knob, Pivot, Sides, Subject, Tool, Vector, VectorKind, handle_at, knobs};
pub use pull::{Grip, Pull, pull};
pub use snap::{fine_step, snap, snap_angle, snap_step, snap_value};
