//! What both engines are asked for: go to a time, say where the spheres are.

use glam::DVec3;

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
    /// Goes on to model time `time`, s.
    fn advance(&mut self, time: f64);

    fn read(&self, into: &mut Vec<Ball>);

    /// Impacts so far, of both kinds, or `None` where the engine does not tell.
    fn impacts(&self) -> Option<u64>;
}

/// An engine with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Engine {
    Polyscene,
    Rapier { dt: f64, settings: &'static crate::peer::Settings },
}

impl Engine {
    pub fn name(self) -> &'static str {
        match self {
            Self::Polyscene => "polyscene",
            Self::Rapier { .. } => "rapier3d",
        }
    }

    pub fn settings(self) -> &'static str {
        match self {
            Self::Polyscene => "exact",
            Self::Rapier { settings, .. } => settings.name,
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
