//! The simulation core: a scene is compiled into a model and a state, and advanced event by event.
//! Knows nothing of files, clocks or pixels.

mod edit;
mod ledger;
mod report;
mod simulation;

pub use edit::{EditRefused, SimEdit};
pub use ledger::{BodyRef, Event, EventKind};
pub use report::{BodyState, ContactState, Counters, Energy, Momentum, Plan, Tiling};
pub use simulation::{CompileError, Fault, Simulation, Snapshot};
