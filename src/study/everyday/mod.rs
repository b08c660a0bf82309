//! Everyday scenes: what a person drops, pours, stacks and rolls, in natural sizes (radii of 2 to 10 cm on Earth), in
//! families over the number of balls and the restitution; and the demands every one of them has to meet.

// The scenes.
mod builder;
mod family;
mod heaps;
mod recipe;
mod rooms;

// What is demanded of them.
mod clock;
mod demands;
mod judge;
mod table;

pub use demands::{Miss, misses};
pub use family::{FAMILIES, Family, RESTITUTIONS, SIZES, Setup};
pub use judge::{Effort, Ending, Outcome, judge};
pub use table::{Row, markdown, rows, short, text};
