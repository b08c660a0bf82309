//! Faults: what stops a run, and the messages.

use super::model::Model;
use super::motion::SegmentError;

/// A number went wrong while running. The simulation stops there; only an edit or a reset helps.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("at t = {time} s: {message}")]
pub struct Fault {
    pub time: f64,
    pub message: String,
}

impl Fault {
    /// What the program itself has got wrong.
    pub(super) fn internal(time: f64, what: &str) -> Self {
        Self { time, message: format!("internal error: {what}; please report the scene") }
    }
}

/// What to report of a body that has no motion from here on.
pub(super) fn fault(model: &Model, body: u32, time: f64, error: SegmentError) -> Fault {
    let name = &model.dynamic(body).identity.name;
    let message = match error {
        SegmentError::NotFinite => {
            format!(
                "body {name}: position, velocity or force is no number, or too large to go on with; look at its forces and start"
            )
        }
        SegmentError::InCore => {
            format!(
                "body {name}: its centre lies on a point attractor, where the force has no value; move one of them"
            )
        }
        SegmentError::Stalled => {
            format!(
                "body {name}: the integrator's step has shrunk to nothing; a force is singular or not smooth there"
            )
        }
    };
    Fault { time, message }
}
