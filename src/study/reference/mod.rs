//! A naive simulator to check the core against: all pairs, extrapolated midpoint steps (Gragg, Bulirsch,
//! Stoer), bisection of the distance between surfaces. It shares nothing with the core but the scene,
//! handles one impact at a time and knows neither rest nor groups. Slow, and right up to where it ends.

mod flight;
pub mod geometry;
mod settings;
mod simulator;

pub use flight::{Ball, Sum};
pub use settings::{End, ReferenceSettings, Unsupported};
pub use simulator::{Impact, Reference, Step};
