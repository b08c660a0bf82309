//! What can be asked of a runner.

use std::collections::VecDeque;
use std::sync::Arc;

use super::file::WriteRequest;
use super::ledger::EventRow;
use super::moment::Moment;
use super::ways::PathSpan;
use crate::scene::{NodeKey, Scene};
use crate::sim::{Method, SimEdit};

/// Commands are carried out in the order sent, between events. All but `Load`, `LoadEdited`, `Reset`, `Method`, `Budget`, `Paths`, `Crossings`,
/// `Cancelled` and `Tiles` are refused (and ignored) while no simulation is loaded. What is recorded is gone through by looking it up; what is not, by
/// simulating.
#[derive(Clone, Debug)]
pub enum RunCommand {
    /// Compiles a scene and goes to its start. Forgets the recording.
    Load(Arc<Scene>),
    /// As `Load`, of the same scene edited at its start. With `keeps_run` the run until now can be brought back, until the next
    /// edit of a run; without, what could be brought back still can.
    LoadEdited {
        scene: Arc<Scene>,
        keeps_run: bool,
    },
    /// Drops the simulation: the scene has errors.
    Unload,
    /// Back to the start of the loaded scene. Forgets the recording.
    Reset,
    /// How to step from now on; another method than before goes back to the start of the loaded scene.
    Method(Method),
    /// One Δt forward (`count` of them). Δt in seconds, > 0.
    Step {
        dt: f64,
        count: u32,
    },
    /// To the next event inside the current Δt; starts a Δt of this length when none is open, and goes
    /// on through following Δt until there is an event.
    NextEvent {
        dt: f64,
        of: Of,
    },
    /// To the end of the open Δt.
    FinishStep,
    /// Δt after Δt until a goal is reached.
    RunUntil {
        dt: f64,
        goal: Goal,
    },
    /// Δt after Δt, at `speed` model seconds per wall second; slower when the machine cannot follow. Backwards
    /// where the speed is below zero, as far as is recorded.
    Play {
        dt: f64,
        speed: f64,
        /// Again and again between two times, s.
        range: Option<(f64, f64)>,
    },
    /// Ends what moves the time, and what waits to. Edits and files that wait stay.
    Pause,
    /// One Δt back, one event back.
    StepBack,
    EventBack {
        of: Of,
    },
    /// To the recorded event of this number; the Δt around it is open then.
    GoTo {
        event: u64,
    },
    /// To a moment of the recording.
    Show(Moment),
    /// To a time, s: into the recording, or beyond it by Δt of this length.
    Seek {
        dt: f64,
        time: f64,
    },
    /// Movements and edits one after the other, each where those before lead to: an edit among them waits for that. A pause ends
    /// all of it.
    Script(VecDeque<RunCommand>),
    /// Changes the scene at what is shown; several changes are one edit to go back over. What was recorded for later is
    /// kept until the next edit.
    Edit(Vec<SimEdit>),
    /// Takes the last edit in the past back, with all that came after it: what it replaced is the future again.
    BringBack,
    /// Writes the recording to a file; the next frame has what came of it.
    Write(Box<WriteRequest>),
    /// Whether frames from now on have the motion that is recorded now.
    ShareMotion(bool),
    /// Bytes that the recording may take.
    Budget(usize),
    /// How much of the bodies' ways frames have; none by default.
    Paths(Option<PathSpan>),
    /// Of which bodies frames have the tile crossings; of none by default.
    Crossings(Arc<[NodeKey]>),
    /// Whether frames at an event have the predictions that it cancelled; not by default, for that means simulating again.
    Cancelled(bool),
    /// Whether frames have the occupied tiles; not by default, for listing them costs as much as much else of a frame.
    Tiles(bool),
}

/// Which events are meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Of {
    #[default]
    All,
    Body(NodeKey),
    /// Between two bodies.
    Pair(NodeKey, NodeKey),
}

/// When running ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// Model time, s.
    Time(f64),
    /// All bodies lie still.
    Rest,
    /// So many events from now.
    Events(u64),
    /// The event of this number that a run had at this time, s. Where it does not come again, that time.
    Event { number: u64, time: f64 },
}

impl Of {
    pub fn holds(self, row: &EventRow) -> bool {
        self.holds_between(row.a_key, row.b_key)
    }

    /// Whether an event of this body, and of the other if there is one, is meant.
    pub fn holds_between(self, a: NodeKey, b: Option<NodeKey>) -> bool {
        let concerns = |key| a == key || b == Some(key);
        match self {
            Self::All => true,
            Self::Body(key) => concerns(key),
            Self::Pair(one, other) => concerns(one) && concerns(other),
        }
    }
}
