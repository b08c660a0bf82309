//! How accurate a simulation is and what that costs: references, residuals, work-precision runs.

pub mod cases;
pub mod reference;
