//! What is compared: a method with its Δt, its tolerance or its group step.

use super::text::{seconds, short};
use crate::scene::Scene;
use crate::sim::{CompileError, Method, Simulation};

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

/// How a method looks in diagrams: an sRGB colour that anyone can tell from the others (Okabe & Ito 2008),
/// and a shape that says the same without colour.
pub fn look_of(method: Method) -> ([u8; 3], Marker) {
    match method {
        Method::Exact => ([0, 114, 178], Marker::Diamond),
        Method::Thesis => ([213, 94, 0], Marker::Triangle),
        Method::Fixed => ([0, 158, 115], Marker::Square),
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
    /// Step of stepped groups, s; `None` is the scene's own.
    pub group_step: Option<f64>,
}

impl Candidate {
    /// The simulation at t = 0.
    pub fn start(&self, scene: &Scene) -> Result<Simulation, CompileError> {
        let mut scene = scene.clone();
        if let Some(tolerance) = self.tolerance {
            scene.params.field_tolerance = tolerance;
        }
        if let Some(step) = self.group_step {
            scene.params.dense_step = step;
        }
        Simulation::with_method(&scene, self.method)
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
        if let Some(step) = self.group_step {
            label += &format!(", group step {}", seconds(step));
        }
        label
    }
}
