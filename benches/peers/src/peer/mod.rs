//! rapier3d's side: its settings, and its worlds in single and double precision.

mod double;
mod single;

use polyscene::scene::Scene;

use crate::engines::World;

/// One way to set the solver. All of them are measured and each counts with its best figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    pub name: &'static str,
    pub solver_iterations: usize,
    pub ccd_substeps: usize,
}

/// Rapier's solver iterations are substeps with the force held: more of them cost more and are better for
/// contacts and uniform gravity, but one is best for a force that changes along the way.
pub const SETTINGS: [Settings; 3] = [
    Settings { name: "1 iteration", solver_iterations: 1, ccd_substeps: 0 },
    Settings { name: "default", solver_iterations: 4, ccd_substeps: 1 },
    Settings { name: "8 iterations", solver_iterations: 8, ccd_substeps: 4 },
];

/// Steps per second.
pub const RATES: [f64; 4] = [60.0, 240.0, 1000.0, 4000.0];

/// What a plate becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Walls {
    /// A thick box behind the plate's face: it is near few balls, so it makes few pairs.
    Boxes,
    /// A half-space: no ball passes it, but it makes a pair with every one.
    HalfSpaces,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Precision {
    /// The crate rapier3d, its default.
    Single,
    /// The crate rapier3d-f64.
    Double,
}

/// A world of rapier's. `watch_first` counts the impacts of the first ball, at the price of looking at it after
/// each step.
pub fn world(
    scene: &Scene,
    dt: f64,
    settings: &Settings,
    walls: Walls,
    precision: Precision,
    watch_first: bool,
) -> Box<dyn World> {
    match precision {
        Precision::Single => Box::new(single::world::Peer::new(scene, dt, settings, walls, watch_first)),
        Precision::Double => Box::new(double::world::Peer::new(scene, dt, settings, walls, watch_first)),
    }
}
