//! The simulation core: a scene is compiled into a model and a state, and advanced event by event.
//! Knows nothing of files, clocks or pixels.

// What users see.
mod edit;
mod force;
mod ledger;
mod method;
mod report;
mod simulation;

// From scene to model.
mod compile;
mod model;
mod plan;

// The step, from the top down.
mod change;
mod constraint;
mod contact;
mod engine;
mod group;
mod impact;
mod island;
mod lasting;
mod motion;
mod neighbours;
mod place;
mod predict;
mod queue;
mod restitution;
mod roots;
mod segment;
mod state;
mod stepping;
mod tiles;

// What looks on.
mod account;
mod candidates;
mod hash;
mod monitor;

pub use candidates::CandidateSet;
pub use edit::{EditRefused, SimEdit};
pub use force::{Force, Subject};
pub use ledger::{BodyRef, Event, EventKind};
pub use method::Method;
pub use report::{BodyState, ContactState, Counters, Energy, Momentum, Plan, Tiling};
pub use simulation::{CompileError, Fault, Progress, Simulation, Snapshot};
pub use stepping::StepLimits;
