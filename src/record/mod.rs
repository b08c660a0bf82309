//! Driving a simulation: commands in, published frames out, on this thread or on one of its own.

mod cancelled;
mod command;
mod cost;
mod crossings;
mod drift;
mod file;
mod frame;
mod grid;
mod inline;
mod keyframes;
mod lag;
mod ledger;
mod limits;
mod log;
mod moment;
mod motion;
mod moving;
mod overlaps;
mod paths;
mod publish;
mod recorder;
#[cfg(test)]
mod recorder_tests;
mod recording;
mod rows;
mod run;
mod settle;
#[cfg(test)]
mod settle_tests;
mod task;
mod thread;
mod ticks;
mod verify;
mod ways;

use std::sync::Arc;

pub use command::{Goal, Of, RunCommand};
pub use cost::Cost;
pub use file::{
    Checkpoint, EditsAt, MOST_BYTES, NamedMoment, RecordingError, RecordingFile, Steps, WriteRequest, Written,
};
pub use frame::{
    BodyFrame, Busiest, ContactFrame, Frame, Jump, Lag, LagCause, Recorded, RunState, WorstOverlap,
};
pub use inline::InlineRunner;
pub use ledger::{EventRow, Ledger, Past};
pub use limits::{Exceeded, LATEST_TIME, Limits, PREDICTIONS, Watch, advance};
pub use moment::Moment;
pub use motion::RecordedMotion;
pub use recording::BUDGET as DEFAULT_RECORDING_BYTES;
pub use rows::{COST_COLUMNS, Column, EVENT_COLUMNS, EventLine, Who, cells};
pub use thread::ThreadRunner;
pub use ticks::Division;
pub use verify::{Compared, Rerun, RerunError};
pub use ways::{BodyPath, Cancelled, CancelledImpact, Crossing, ImpactBody, PathSpan};

/// Something that runs a simulation on command. The application uses a thread, so that no scene can
/// freeze the window; tests run inline, so that nothing sleeps.
pub trait Runner {
    /// Hands over a command; gives its number, which a frame that knows of it has too. Commands are carried out in the
    /// order sent.
    fn send(&mut self, command: RunCommand) -> u64;

    /// The newest picture of the simulation.
    fn frame(&self) -> Arc<Frame>;

    /// Lets an inline runner know that `wall_s` seconds have passed while it plays. A thread keeps its own time.
    fn tick(&mut self, wall_s: f64);
}
