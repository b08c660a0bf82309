//! PolyScene's side: the scene as it is, with the method `exact`.

use polyscene::scene::Scene;
use polyscene::sim::{BodyRef, CompileError, Simulation};

use crate::engines::{Ball, World};

pub struct Ours {
    simulation: Simulation,
    bodies: Vec<BodyRef>,
}

impl Ours {
    pub fn new(scene: &Scene) -> Result<Self, CompileError> {
        let simulation = Simulation::new(scene)?;
        let bodies = simulation.dynamic_bodies().collect();
        Ok(Self { simulation, bodies })
    }
}

impl World for Ours {
    fn advance(&mut self, time: f64) {
        self.simulation.begin(time);
        // A fault stops it where it is, which shows as an error of position.
        let _ = self.simulation.finish(&mut |_, _| {});
    }

    fn read(&self, into: &mut Vec<Ball>) {
        into.clear();
        let states = self.bodies.iter().filter_map(|body| self.simulation.state(*body));
        into.extend(states.map(|state| Ball { position: state.position, velocity: state.velocity }));
    }

    fn impacts(&self) -> Option<u64> {
        Some(self.simulation.counters().total_events())
    }
}
