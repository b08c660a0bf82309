//! What both engines are asked for: go to a time, say where the spheres are.

use glam::DVec3;

use crate::peer::{Precision, Settings, Walls};

/// One moving sphere. Bodies come in the order of their UserIDs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// m.
    pub position: DVec3,
    /// m/s.
    pub velocity: DVec3,
}

/// A scene that runs in one engine.
pub trait World {
    /// Goes on to model time `time`, s; false when it has given up before.
    fn advance(&mut self, time: f64) -> bool;

    /// Model time, s.
    fn time(&self) -> f64;

    fn read(&self, into: &mut Vec<Ball>);

    /// Impacts so far, of both kinds, or `None` where the engine does not tell.
    fn impacts(&self) -> Option<u64>;
}

/// An engine with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Engine {
    Polyscene,
    Rapier { dt: f64, settings: &'static Settings, walls: Walls, precision: Precision },
}

impl Engine {
    pub fn name(self) -> &'static str {
        match self {
            Self::Polyscene => "polyscene",
            Self::Rapier { precision: Precision::Single, .. } => "rapier3d",
            Self::Rapier { precision: Precision::Double, .. } => "rapier3d-f64",
        }
    }

    pub fn settings(self) -> String {
        match self {
            Self::Polyscene => "exact".into(),
            Self::Rapier { settings, walls: Walls::Boxes, .. } => settings.name.into(),
            Self::Rapier { settings, walls: Walls::HalfSpaces, .. } => {
                format!("{}, half-spaces", settings.name)
            }
        }
    }

    /// Steps per second; `None` for an engine whose results do not depend on any.
    pub fn rate(self) -> Option<f64> {
        match self {
            Self::Polyscene => None,
            Self::Rapier { dt, .. } => Some(1.0 / dt),
        }
    }
}
