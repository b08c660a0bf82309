//! Changes to a running simulation. Each applies at the model time at which it is given.

use serde::{Deserialize, Serialize};

use crate::scene::{Body, Force, NodeKey, Roughness};

/// One change. Bodies and forces are named by their document key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum SimEdit {
    AddBody(Box<Body>),
    Remove(NodeKey),
    AddForce(Box<Force>),
    /// Replaces a force by another of the same key.
    ChangeForce(Box<Force>),
    Bounce(NodeKey, f64),
    Roughness(NodeKey, Roughness),
    /// kg; the velocity stays.
    Mass(NodeKey, f64),
    /// Moves or reshapes a static body.
    ChangeStatic(Box<Body>),
}

/// Why an edit was refused; the simulation is as it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct EditRefused(pub String);
