//! A naive simulator to check the core against: all pairs, extrapolated midpoint steps (Gragg, Bulirsch,
//! Stoer), bisection of the distance between surfaces. It shares nothing with the core but the scene,
//! handles one impact at a time and knows no groups; of lasting contact only that of one ball that rubs on one face.
//! Slow, and right up to where it ends.

mod extrapolation;
mod face;
mod flight;
pub mod geometry;
mod rubbing;
mod settings;
mod simulator;

pub use face::{Hold, OnFace};
pub use flight::{Ball, Sum};
pub use settings::{End, ReferenceSettings, Unsupported};
pub use simulator::{Change, Impact, Reference, Step};
