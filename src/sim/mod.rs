//! The simulation core: a scene is compiled into a model and a state, and advanced event by event.
//! Knows nothing of files, clocks or pixels.

// What users see.
mod edit;
mod event;
mod fault;
mod force;
mod method;
mod report;
mod simulation;

// From scene to model.
mod body;
mod compile;
mod model;
mod plan;
mod shape;

// The step, from the top down.
mod capture;
mod change;
mod close_pass;
mod constraint;
mod contact_ends;
mod contact_forces;
mod dense;
mod drive;
mod engine;
mod exchange;
mod geometry;
mod grip;
mod gripping;
mod group;
mod group_friction;
mod impact;
mod island;
mod ledger;
mod link;
mod loads;
mod motion;
mod nearest;
mod neighbours;
mod predict;
mod restart;
mod restitution;
mod rolling;
mod roots;
mod rub;
mod search;
mod settle;
mod stepping;
mod tiles;
mod tolerance;

// What moves.
mod account;
mod contact;
mod open_step;
mod pair;
mod place;
mod queue;
mod segment;
mod state;
mod trace;
mod turn;
mod way_in;

// What looks on.
mod as_start;
mod books;
mod candidates;
mod hash;
mod monitor;

pub use as_start::as_start;
pub use candidates::CandidateSet;
pub use edit::{EditRefused, SimEdit};
pub use event::{BodyRef, Event, EventKind};
pub use fault::Fault;
pub use force::{Force, Subject};
pub use method::Method;
pub use report::{
    AngularMomentum, BodyState, ContactForce, ContactState, Counters, Energy, Momentum, Plan,
    PredictedImpact, Rotation, SteppedBodies, Tiling,
};
pub use simulation::{CompileError, Progress, Simulation, Snapshot};
pub use stepping::StepLimits;
pub use trace::{Begun, Piece};
