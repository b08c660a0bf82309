//! What can be asked of a runner.

use std::sync::Arc;

use crate::scene::Scene;
use crate::sim::{Method, SimEdit};

/// Commands are carried out in the order sent, between events. All but `Load`, `Reset` and `Method` are
/// refused (and ignored) while no simulation is loaded.
#[derive(Clone, Debug)]
pub enum RunCommand {
    /// Compiles a scene and goes to its start. Forgets recorded edits.
    Load(Arc<Scene>),
    /// Drops the simulation: the scene has errors.
    Unload,
    /// Back to the start of the loaded scene.
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
    },
    /// To the end of the Δt that `NextEvent` opened.
    FinishStep,
    /// Δt after Δt, at `speed` model seconds per wall second; slower when the machine cannot follow.
    Play {
        dt: f64,
        speed: f64,
    },
    Pause,
    /// One Δt back, one event back.
    StepBack,
    EventBack,
    /// Back to the event of this number; the Δt around it is open then.
    GoTo {
        event: u64,
    },
    /// Changes the running scene now; several changes are one edit to go back over.
    Edit(Vec<SimEdit>),
}
