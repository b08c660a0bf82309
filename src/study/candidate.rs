//! What is put on trial: a method with its Δt or its tolerance.

use serde::Serialize;

use super::text::{seconds, short};
use crate::scene::Scene;
use crate::sim::{CompileError, Simulation};

/// How a simulation is stepped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Event by event; Δt only samples.
    Exact,
}

impl Method {
    pub const ALL: [Self; 1] = [Self::Exact];

    /// The name used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
        }
    }

    /// sRGB, told apart by anyone (Okabe & Ito 2008); the marker says the same without colour.
    pub fn color(self) -> [u8; 3] {
        match self {
            Self::Exact => [0, 114, 178],
        }
    }

    /// The shape in diagrams.
    pub fn marker(self) -> Marker {
        match self {
            Self::Exact => Marker::Diamond,
        }
    }

    /// Whether the result depends on Δt, so that it is a curve.
    pub fn depends_on_dt(self) -> bool {
        match self {
            Self::Exact => false,
        }
    }
}

/// The shape that marks a method in diagrams.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    Diamond,
    Triangle,
    Square,
}

impl Marker {
    /// Corners of the filled shape around the origin, y up, about 1 from it.
    pub fn corners(self) -> &'static [[f64; 2]] {
        match self {
            Self::Diamond => &[[0.0, 1.15], [1.15, 0.0], [0.0, -1.15], [-1.15, 0.0]],
            Self::Triangle => &[[0.0, 1.0], [1.0, -0.8], [-1.0, -0.8]],
            Self::Square => &[[-0.8, 0.8], [0.8, 0.8], [0.8, -0.8], [-0.8, -0.8]],
        }
    }
}

/// One run of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    pub method: Method,
    /// s; `None` where the result does not depend on it.
    pub dt: Option<f64>,
    /// Field tolerance; `None` is the scene's own.
    pub tolerance: Option<f64>,
}

impl Candidate {
    /// The simulation at t = 0.
    pub fn start(&self, scene: &Scene) -> Result<Simulation, CompileError> {
        let mut scene = scene.clone();
        if let Some(tolerance) = self.tolerance {
            scene.params.field_tolerance = tolerance;
        }
        Simulation::new(&scene)
    }

    /// The Δt of each step and how many of them lie between two samples about `sample_dt` apart.
    pub(super) fn stride(&self, sample_dt: f64) -> (f64, u64) {
        match self.dt {
            Some(dt) => (dt, (sample_dt / dt).round().max(1.0) as u64),
            None => (sample_dt, 1),
        }
    }

    /// `thesis, Δt 1/60 s`, for a person.
    pub fn label(&self) -> String {
        let mut label = self.method.name().to_owned();
        if let Some(dt) = self.dt {
            label += &format!(", Δt {}", seconds(dt));
        }
        if let Some(tolerance) = self.tolerance {
            label += &format!(", tolerance {}", short(tolerance));
        }
        label
    }
}
