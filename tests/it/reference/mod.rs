//! A naive simulator to check the core against: all pairs, extrapolated midpoint steps (Gragg, Bulirsch,
//! Stoer), bisection of the distance between surfaces. It shares nothing with the core but the scene,
//! handles one impact at a time and knows neither rest nor groups. Slow, and right.

mod check;
pub mod flight;
pub mod geometry;
pub mod simulator;

pub use simulator::Reference;
