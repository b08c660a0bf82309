//! PolyScene's side: the scene as it is, with the method `exact`.

use std::time::Duration;

use cpu_time::ThreadTime;
use polyscene::scene::Scene;
use polyscene::sim::{BodyRef, CompileError, Progress, Simulation};

use crate::engines::{Ball, World};

pub struct Ours {
    simulation: Simulation,
    bodies: Vec<BodyRef>,
    started: ThreadTime,
    patience: Duration,
    /// Looks at the clock are rare: each costs as much as an impact.
    calls: u32,
}

impl Ours {
    /// Gives up after `patience` seconds of processor time.
    pub fn new(scene: &Scene, patience: f64) -> Result<Self, CompileError> {
        let simulation = Simulation::new(scene)?;
        let bodies = simulation.dynamic_bodies().collect();
        let patience = Duration::from_secs_f64(patience);
        Ok(Self { simulation, bodies, started: ThreadTime::now(), patience, calls: 0 })
    }
}

/// Predictions carried out in one call, and calls between two looks at the clock.
const PREDICTIONS: u32 = 64;
const CALLS: u32 = 64;

impl World for Ours {
    fn advance(&mut self, time: f64) -> bool {
        self.simulation.begin(time);
        loop {
            match self.simulation.work(PREDICTIONS) {
                Ok(Progress::Done) => return true,
                Ok(_) => {}
                // A fault stops it where it is.
                Err(_) => return false,
            }
            self.calls += 1;
            if self.calls.is_multiple_of(CALLS) && self.started.elapsed() >= self.patience {
                return false;
            }
        }
    }

    fn time(&self) -> f64 {
        self.simulation.time()
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
