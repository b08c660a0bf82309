//! Methods that step by Δt: a trial step of every body, overlaps at its end, bisection, response, the rest.
//!
//! Between two collisions a body follows the parabola of its acceleration at the start, as a ballistic
//! segment, so everything that reads a simulation reads these methods too. A Δt is what [`plan`] is told
//! while none is open; looking at it from inside changes nothing.

mod fixed;
mod limits;
mod overlap;
mod register;
mod response;
mod step;
mod thesis;
mod trial;

pub use limits::StepLimits;
pub(super) use step::{advance, begin_all, plan};
