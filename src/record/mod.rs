//! Driving a simulation: commands in, published frames out, on this thread or on one of its own.

mod command;
mod frame;

pub use command::RunCommand;
pub use frame::{BodyFrame, EventRow, Frame, RunState};
