//! PolyScene's side: the scene as it is, with the method `exact`.

use std::time::{Duration, Instant};

use cpu_time::ThreadTime;
use polyscene::scene::Scene;
use polyscene::sim::{BodyRef, CompileError, Progress, Simulation};

use crate::engines::{Ball, World};

pub struct Ours {
    simulation: Simulation,
    bodies: Vec<BodyRef>,
    started: (Instant, ThreadTime),
    patience: Duration,
}

impl Ours {
    /// Gives up after `patience` seconds of processor time.
    pub fn new(scene: &Scene, patience: f64) -> Result<Self, CompileError> {
        let simulation = Simulation::new(scene)?;
        let bodies = simulation.dynamic_bodies().collect();
        let patience = Duration::from_secs_f64(patience);
        Ok(Self { simulation, bodies, started: (Instant::now(), ThreadTime::now()), patience })
    }

    /// A look at processor time costs as much as an impact, and none is needed while the wall clock has not got there.
    fn is_over(&self) -> bool {
        self.started.0.elapsed() >= self.patience && self.started.1.elapsed() >= self.patience
    }
}

/// Predictions carried out between two looks at the clock: in a pile one may take a tenth of a second.
const PREDICTIONS: u32 = 16;

impl World for Ours {
    fn advance(&mut self, time: f64) -> bool {
        self.simulation.begin(time);
        loop {
            match self.simulation.work(PREDICTIONS) {
                Ok(Progress::Done) => return true,
                Ok(_) if self.is_over() => return false,
                Ok(_) => {}
                // A fault stops it where it is.
                Err(_) => return false,
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
