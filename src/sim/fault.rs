//! Faults: what stops a run, and the messages.

use super::body::BodyId;
use super::model::Model;
use super::motion::SegmentError;
use crate::scene::{Diagnostic, NodeKey, Severity};

/// A number went wrong while running. The simulation stops there; only an edit or a reset helps.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("at t = {time} s: {message}")]
pub struct Fault {
    pub time: f64,
    pub message: String,
    /// The body that cannot go on, where it is one.
    pub key: Option<NodeKey>,
}

impl Fault {
    /// What the program itself has got wrong.
    pub(super) fn internal(time: f64, what: &str) -> Self {
        Self { time, message: format!("internal error: {what}; please report the scene"), key: None }
    }

    /// What is wrong with a scene that has this fault at its start. The message ends with the way out, after a semicolon.
    pub(super) fn of_start(self) -> Diagnostic {
        let (message, hint) = self.message.split_once("; ").unwrap_or((&self.message, ""));
        Diagnostic {
            severity: Severity::Error,
            position: None,
            path: String::new(),
            message: message.into(),
            hint: hint.into(),
            key: self.key,
        }
    }
}

/// What to report of a body that has no motion from here on.
pub(super) fn fault(model: &Model, body: u32, time: f64, error: SegmentError) -> Fault {
    let identity = model.identity(BodyId::of_dynamic(body));
    let name = identity.name();
    let message = match error {
        SegmentError::NotFinite => {
            format!(
                "body {name}: position, velocity or force is not a number, or too large to go on with; look at its forces and start"
            )
        }
        SegmentError::InCore => {
            format!(
                "body {name}: its centre lies on a point attractor, where the force has no value; move one of them by more than the core radius"
            )
        }
        SegmentError::TooFast => {
            format!(
                "body {name}: it is so fast that it passes a tile in less time than can be told from none; look for bounces above 1 and at its forces and start"
            )
        }
        SegmentError::Stalled => {
            format!(
                "body {name}: the integrator's step has shrunk to nothing; a force is singular or not smooth there: keep the body away from it, or run with --method fixed"
            )
        }
    };
    Fault { time, message, key: Some(identity.key) }
}
