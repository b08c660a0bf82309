//! What a runner publishes: one consistent picture of the simulation, cheap to share.

use std::sync::Arc;

use glam::DVec3;

use super::file::Written;
use super::ledger::{EventRow, Ledger};
use super::motion::RecordedMotion;
use super::ticks::Division;
use super::ways::{BodyPath, Cancelled, Crossing, ImpactBody};
use crate::scene::{Diagnostic, NodeKey};
use crate::sim::{ContactState, Counters, Energy, Method, Momentum, Plan, Rotation, SteppedBodies, Tiling};

/// What a runner is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum RunState {
    /// No simulation: nothing loaded, or the scene cannot be simulated.
    #[default]
    Empty,
    Paused,
    /// Working on a command that is not done yet.
    Busy,
    Playing,
    /// Stopped by a numerical fault.
    Faulted,
}

/// One dynamic body now.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyFrame {
    pub key: NodeKey,
    /// m, m/s, m/s², N.
    pub position: DVec3,
    pub velocity: DVec3,
    pub acceleration: DVec3,
    pub force: DVec3,
    /// J.
    pub kinetic: f64,
    pub contact: ContactState,
    /// `None` where nothing rubs.
    pub turn: Option<Rotation>,
}

/// A contact through which bodies of a heap press on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactFrame {
    pub keys: [NodeKey; 2],
    /// The centre of the first body, and that of the second or, of a static one, the point on its surface, m.
    pub ends: [DVec3; 2],
    /// N.
    pub force: f64,
}

/// What is kept of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
    /// From when to when, s. What was before the first was dropped to stay within the budget.
    pub from: f64,
    pub to: f64,
    /// Bytes that it takes, and may take.
    pub bytes: usize,
    pub budget: usize,
    /// Times of the edits, s.
    pub edits: Vec<f64>,
    /// How it is divided into Δt, in order.
    pub divisions: Vec<Division>,
    /// Whether an edit in the past has replaced something that can be brought back.
    pub can_bring_back: bool,
}

/// A change of the energy residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Number of the event; the flights since the one looked at before are part of the change.
    pub event: u64,
    /// s.
    pub time: f64,
    /// Size of the change of the energy residual (of the momentum residual where a force has no potential).
    pub size: f64,
}

/// The deepest overlap of two bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstOverlap {
    /// m.
    pub depth: f64,
    /// Whether bodies had been stepped by then, which may overlap a little.
    pub is_of_stepped: bool,
}

/// Playing that reaches less than the speed asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lag {
    /// Share of the speed asked for that is reached, 0 to 1.
    pub share: f64,
    pub cause: LagCause,
}

/// What most of the time goes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LagCause {
    /// So many bodies that are stepped together.
    Stepped { bodies: usize },
    /// Events: how many per second of model time, and of which bodies most are in the Δt being looked at.
    Events { per_model_s: f64, busiest: Option<Busiest> },
    /// The integration of bodies in fields, of the one with the largest acceleration most.
    Field { body: Option<NodeKey> },
}

/// The bodies that most events are of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Busiest {
    pub a: NodeKey,
    pub b: Option<NodeKey>,
    /// Of all events listed, 0 to 1.
    pub share: f64,
}

impl Frame {
    /// The recorded event of this number.
    pub fn event(&self, seq: u64) -> Option<&Arc<EventRow>> {
        self.ledger.get(seq)
    }

    /// Whatever has gone wrong, the worst first.
    pub fn complaint(&self) -> Option<&str> {
        self.fault.as_deref().or(self.refused.as_deref()).or(self.message.as_deref())
    }

    /// Whether it stands at the start of the scene.
    pub fn is_at_start(&self) -> bool {
        self.dt_index == 0 && self.open_step.is_none() && self.event_count == 0
    }
}

/// A consistent picture, never changed after it is published.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// Grows with every frame published.
    pub revision: u64,
    /// Number of the last command that it knows of; 0 before the first.
    pub command: u64,
    /// The recording that was written last; another one for each.
    pub written: Option<Arc<Written>>,
    /// The motion that was recorded when it was asked for.
    pub motion: Option<Arc<RecordedMotion>>,
    /// Whether the simulation stands at what is shown. Before, what was looked up is there: bodies and events; energy,
    /// momentum and contacts follow.
    pub is_settled: bool,
    pub state: RunState,
    /// How it steps.
    pub method: Method,
    /// Model time, s.
    pub time: f64,
    /// Number of the Δt being looked at: 0 at the start, k after the k-th.
    pub dt_index: u64,
    /// Start and end of the Δt being looked at; `None` at the start.
    pub step: Option<(f64, f64)>,
    /// When inside a Δt: its start and end.
    pub open_step: Option<(f64, f64)>,
    /// In UserID order.
    pub bodies: Vec<BodyFrame>,
    /// How many bodies are stepped now.
    pub stepped: Option<SteppedBodies>,
    /// What presses on what among bodies that are stepped or came to rest so, and whether weaker contacts were left out.
    pub contacts: Vec<ContactFrame>,
    pub contacts_truncated: bool,
    /// Events of the last (or open) Δt up to the time shown, oldest first, and whether older ones were left out.
    pub events: Vec<Arc<EventRow>>,
    pub events_truncated: bool,
    /// All events that are recorded, also those after the time shown.
    pub ledger: Ledger,
    pub recorded: Arc<Recorded>,
    /// The bodies of the event that is right now, if one is.
    pub at_impact: Arc<Vec<ImpactBody>>,
    /// What the event that is right now cancelled, if that is asked for, as soon as it is known.
    pub cancelled: Option<Arc<Cancelled>>,
    /// Whether that is still looked for.
    pub seeks_cancelled: bool,
    /// Ways of the bodies, if they are asked for.
    pub paths: Arc<Vec<BodyPath>>,
    /// Tile crossings in the Δt being looked at, of the bodies for which they are asked.
    pub crossings: Arc<Vec<Crossing>>,
    /// Events since the start.
    pub event_count: u64,
    /// How many of the recorded edits were made before what is shown.
    pub edits_before: usize,
    pub energy: Option<Energy>,
    pub momentum: Option<Momentum>,
    /// Where the energy residual changed most since the start.
    pub largest_jump: Option<Jump>,
    /// In any frame up to the time shown.
    pub worst_overlap: WorstOverlap,
    pub counters: Counters,
    pub plan: Arc<Plan>,
    /// The occupied tiles, if they are asked for.
    pub tiling: Arc<Tiling>,
    /// Wall-clock seconds the last Δt took.
    pub step_wall_s: f64,
    /// Events per wall-clock second, smoothed.
    pub events_per_s: f64,
    /// Model seconds per wall second really reached while playing.
    pub real_speed: f64,
    /// How far and why playing falls behind the speed asked for; `None` while it does not.
    pub lag: Option<Lag>,
    /// Whether there is something to step back to.
    pub can_step_back: bool,
    /// Why the scene cannot be simulated, or geometric warnings of the start.
    pub problems: Arc<Vec<Diagnostic>>,
    /// The numerical fault, while it stands where that stopped it. Of this and the two after it a new one has another pointer,
    /// whatever its words.
    pub fault: Option<Arc<str>>,
    /// Why an edit since the start was refused, the last that was.
    pub refused: Option<Arc<str>>,
    /// What there is to say of the last command otherwise: why it did nothing, or what came with it.
    pub message: Option<Arc<str>>,
}
