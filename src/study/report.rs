//! What a study answers, as plain data.

use serde::{Serialize, Serializer};

use super::StudySettings;
use crate::scene::escaped;
use crate::sim::Method;

/// The answer of a study.
#[derive(Clone, Debug, Serialize)]
pub struct StudyReport {
    /// What to call the scene; empty when it has no name.
    pub scene: String,
    /// Model time asked for, s.
    pub until: f64,
    pub dynamic_bodies: usize,
    pub static_bodies: usize,
    /// `ballistic` or `field`.
    pub motion: String,
    pub horizon: Horizon,
    /// In the order methods, Δt from coarse to fine, tolerance and group step from coarse to fine.
    pub points: Vec<RunFigures>,
    /// Ended before everything was done: what is there stands.
    pub cancelled: bool,
    /// It was its own time limit that ended it, and nobody who cancelled it.
    pub out_of_time: bool,
    /// The knobs that the figures depend on.
    pub trusted_error: f64,
    pub agreement: f64,
    pub event_window: f64,
    pub samples: u32,
    pub repeat: u32,
}

/// How far runs are compared with the reference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Horizon {
    /// Model time up to which positions and events are compared, s; beyond it, only invariants are.
    pub time: f64,
    pub cause: HorizonCause,
    /// The reference's own estimate of its position error at that time, m.
    pub error: f64,
    /// Impacts of the reference up to there.
    pub impacts: usize,
}

/// Why runs are compared no further.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum HorizonCause {
    /// The whole run is compared.
    WholeRun,
    /// The reference's own error estimate reached its bound, as in every chaotic scene.
    ReferenceError,
    /// The reference's wall time was over.
    ReferenceLimit,
    /// The reference does not know this scene or what comes next in it; the text says what.
    Unknown(String),
    /// Whoever started the study ended it, or its time limit did.
    Cancelled,
}

/// One run: what it costs and how wrong it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunFigures {
    #[serde(serialize_with = "name_of")]
    pub method: Method,
    /// s; `None` where the result does not depend on it.
    pub dt: Option<f64>,
    /// Field tolerance; `None` is the scene's own.
    pub tolerance: Option<f64>,
    /// Step of stepped groups, s; `None` is the scene's own.
    pub group_step: Option<f64>,
    /// Model time reached, s.
    pub reached: f64,
    /// Why it stopped before the end asked for.
    pub stopped: Option<Stop>,
    /// Wall time per second of model time: the median of the timings. `None` before any.
    pub wall_per_s: Option<f64>,
    /// The quickest and the slowest timing.
    pub wall_range: Option<[f64; 2]>,
    /// Largest distance of any body from the reference at a sample up to the horizon, m.
    pub position_error: Option<f64>,
    /// Largest difference of velocity, likewise, m/s.
    pub velocity_error: Option<f64>,
    /// Largest size of the energy residual at a sample of the whole run; `None` without potential.
    pub energy_residual: Option<f64>,
    /// Largest momentum residual at a sample of the whole run.
    pub momentum_residual: f64,
    /// Deepest overlap of any two bodies at a sample, an event or the end of a Δt, m.
    pub worst_overlap: f64,
    /// Impacts of the whole run.
    pub impacts: u64,
    /// Impacts of the reference up to the horizon that the run does not have; `None` without reference.
    pub missed: Option<u64>,
    /// Impacts of the run up to the horizon that the reference does not have.
    pub wrong: Option<u64>,
    /// Time of the first impact missed or wrong, s.
    pub first_difference: Option<f64>,
    /// Last sample up to which every position error is below the agreement, s.
    pub follows_until: Option<f64>,
}

/// Why a run ended early.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// Its wall time was over.
    RunLimit,
    /// It had as many events as are allowed.
    EventLimit,
    /// A number went wrong.
    Fault(String),
}

fn name_of<S: Serializer>(method: &Method, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(method.name())
}

impl StudyReport {
    /// The name becomes part of pictures and tables: characters that would break them are escaped.
    pub(super) fn new(scene: &str, settings: &StudySettings) -> Self {
        Self {
            scene: escaped(scene),
            until: settings.until,
            dynamic_bodies: 0,
            static_bodies: 0,
            motion: String::new(),
            horizon: Horizon { time: 0.0, cause: HorizonCause::Cancelled, error: 0.0, impacts: 0 },
            points: Vec::new(),
            cancelled: false,
            out_of_time: false,
            trusted_error: settings.trusted_error,
            agreement: settings.agreement,
            event_window: settings.event_window,
            samples: settings.samples,
            repeat: settings.repeat,
        }
    }

    /// What stands above a diagram: the scene and how long it ran.
    pub fn title(&self) -> String {
        let name = if self.scene.is_empty() { "Scene" } else { &self.scene };
        format!("{name}: speed against error over {} s", super::short(self.until))
    }

    /// How a study that is not complete ended, to begin a sentence.
    pub(super) fn ended(&self) -> &'static str {
        if self.out_of_time { "Out of time" } else { "Cancelled" }
    }

    /// How far the reference is trusted, and why no further, as a sentence.
    pub fn horizon_statement(&self) -> String {
        let Horizon { time, cause, error, impacts } = &self.horizon;
        let (until, bound) = (format!("{time:.3} s"), super::short(self.trusted_error));
        let plural = if *impacts == 1 { "" } else { "s" };
        let checked =
            format!("{impacts} impact{plural}, own error estimate {} m there", super::short(*error));
        match cause {
            HorizonCause::Unknown(what) if *time == 0.0 => {
                format!("Not compared with the independent reference: {what}. Only invariants count.")
            }
            HorizonCause::WholeRun => {
                format!("Compared with the independent reference over the whole {until} ({checked}).")
            }
            HorizonCause::ReferenceError => format!(
                "Compared with the independent reference up to the horizon at {until} ({checked}): beyond it \
                 the reference's own error estimate exceeds {bound} m, so only invariants count."
            ),
            HorizonCause::ReferenceLimit => format!(
                "Compared with the independent reference up to {until} ({checked}), as far as it got in its \
                 time limit; beyond that only invariants count."
            ),
            HorizonCause::Unknown(what) => format!(
                "Compared with the independent reference up to {until} ({checked}): {what}. Beyond that only \
                 invariants count."
            ),
            HorizonCause::Cancelled => {
                let ended = self.ended();
                format!("{ended} while the reference was at {until}; positions were not compared further.")
            }
        }
    }
}
