//! What many tests share: scenes built in code or loaded from `scenes/`, seeded random numbers, ways of
//! driving a simulation, the naive reference, and the all-pairs monitor.

pub mod build;
pub mod drive;
pub mod load;
pub mod monitor;
pub mod random;
pub mod reference;
