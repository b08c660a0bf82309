//! Driving a simulation: commands in, published frames out, on this thread or on one of its own.

mod as_start;
mod command;
mod drift;
mod frame;
mod grid;
mod history;
mod inline;
mod lag;
mod limits;
mod publish;
mod recorder;
mod replay;
mod run;
mod thread;

use std::sync::Arc;

pub use as_start::as_start;
pub use command::RunCommand;
pub use frame::{BodyFrame, Busiest, ContactFrame, EventRow, Frame, Jump, Lag, LagCause, RunState};
pub use inline::InlineRunner;
pub use limits::{Exceeded, Limits, Watch, advance};
pub use thread::{ThreadRunner, Unanswered};

/// Something that runs a simulation on command. The application uses a thread, so that no scene can
/// freeze the window; tests run inline, so that nothing sleeps.
pub trait Runner {
    /// Hands over a command. Commands are carried out in the order sent.
    fn send(&mut self, command: RunCommand);

    /// The newest picture of the simulation.
    fn frame(&self) -> Arc<Frame>;

    /// Lets an inline runner know that `wall_s` seconds have passed while it plays. A thread keeps its own time.
    fn tick(&mut self, wall_s: f64);
}
