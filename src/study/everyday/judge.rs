//! Runs an everyday scene and measures what is demanded of it, without asking the core for overlap or energy.

use std::time::Duration;

use glam::DVec3;

use super::clock::Clock;
use super::family::Setup;
use crate::scene::{Force, ForceKind, Motion, Scene, Shape};
use crate::sim::{Fault, Progress, Simulation};
use crate::study::{OverlapMonitor, Random};

/// How far a scene is run, and what that may cost.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Model time, s.
    pub until: f64,
    /// Processor time of the core, s.
    pub most: f64,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    Finished,
    /// It took longer than allowed.
    Stalled,
    Faulted(Fault),
    /// The scene could not be simulated at all.
    Refused(String),
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub ending: Ending,
    /// Model time, s.
    pub reached: f64,
    /// Processor time of the core, without the looking on, s.
    pub cost: f64,
    /// The deepest overlap of any pair, over the smallest radius.
    pub overlap: f64,
    /// The highest rise of the total energy over its lowest value before, in the mean body's `m g r`.
    pub gain: f64,
    /// How far any ball reached through a wall, over the smallest radius; at most 0 while all are inside.
    pub escape: f64,
    /// The books' residual of energy, the largest seen; infinite where they have none.
    pub energy_residual: f64,
    /// The same of momentum.
    pub momentum_residual: f64,
    /// Whether forces change from place to place or with the speed.
    pub is_in_field: bool,
    /// Whether bodies were stepped as a group.
    pub was_stepped: bool,
    pub events: u64,
}

/// Looks per second of model time, a power of two: at steps of 2^-p s as well, where a core has any. One more look
/// comes at a random time after each.
const LOOKS: f64 = 64.0;

/// Runs a scene and measures it.
pub fn judge(setup: &Setup, effort: Effort) -> Outcome {
    let scene = setup.scene();
    match Simulation::new(&scene) {
        Ok(simulation) => Judge::new(&scene, simulation).run(effort),
        Err(error) => Outcome { ending: Ending::Refused(error.to_string()), ..Outcome::nothing() },
    }
}

impl Outcome {
    fn nothing() -> Self {
        Self {
            ending: Ending::Finished,
            reached: 0.0,
            cost: 0.0,
            overlap: 0.0,
            gain: 0.0,
            escape: f64::NEG_INFINITY,
            energy_residual: 0.0,
            momentum_residual: 0.0,
            is_in_field: false,
            was_stepped: false,
            events: 0,
        }
    }
}

struct Judge {
    simulation: Simulation,
    overlaps: OverlapMonitor,
    walls: Vec<i64>,
    forces: Vec<Force>,
    /// kg, in the simulation's order.
    masses: Vec<f64>,
    /// m.
    smallest: f64,
    /// J.
    unit: f64,
    /// The lowest total energy so far, J.
    lowest: f64,
    outcome: Outcome,
}

impl Judge {
    fn new(scene: &Scene, simulation: Simulation) -> Self {
        let masses = simulation.dynamic_bodies().filter_map(|body| simulation.mass(body)).collect();
        let mut judge = Self {
            overlaps: OverlapMonitor::in_id_order(scene),
            walls: Setup::walls(scene),
            forces: scene.forces.clone(),
            masses,
            smallest: scene.smallest_radius().unwrap_or(f64::INFINITY),
            unit: energy_unit(scene),
            lowest: f64::INFINITY,
            outcome: Outcome::nothing(),
            simulation,
        };
        judge.look();
        judge
    }

    fn run(mut self, effort: Effort) -> Outcome {
        let mut random = Random::new(1);
        let steps = (effort.until * LOOKS).ceil() as u64;
        for step in 1..=steps {
            let grid = (step as f64 / LOOKS).min(effort.until);
            let between = (step as f64 - random.unit()) / LOOKS;
            for time in [between.min(grid), grid] {
                if !self.go_on(time, effort.most) {
                    self.look();
                    return self.outcome;
                }
                self.look();
            }
        }
        self.outcome
    }

    /// Goes on to `time`; false where the run ends before.
    fn go_on(&mut self, time: f64, most: f64) -> bool {
        let clock = Clock::start();
        let left = Duration::from_secs_f64((most - self.outcome.cost).clamp(0.0, 1e9));
        self.simulation.begin(time);
        let ending = loop {
            match self.simulation.work(1) {
                Ok(Progress::Done) => break Ending::Finished,
                Ok(_) if clock.is_over(left) => break Ending::Stalled,
                Ok(_) => {}
                Err(fault) => break Ending::Faulted(fault),
            }
        };
        self.outcome.cost += clock.elapsed().as_secs_f64();
        self.outcome.reached = self.simulation.time();
        self.outcome.events = self.simulation.counters().total_events();
        self.outcome.ending = ending;
        self.outcome.ending == Ending::Finished
    }

    fn look(&mut self) {
        let outcome = &mut self.outcome;
        let sim = &self.simulation;
        outcome.overlap = outcome.overlap.max(self.overlaps.worst_now(sim) / self.smallest);
        outcome.escape = outcome.escape.max(self.overlaps.worst_escape(sim, &self.walls) / self.smallest);
        let residual = sim.energy().residual.map_or(f64::INFINITY, f64::abs);
        outcome.energy_residual = outcome.energy_residual.max(residual);
        outcome.momentum_residual = outcome.momentum_residual.max(sim.momentum().residual);
        outcome.is_in_field = sim.plan().motion != "ballistic";
        outcome.was_stepped = sim.counters().steps > 0;
        let total = self.total_energy();
        self.lowest = self.lowest.min(total);
        self.outcome.gain = self.outcome.gain.max((total - self.lowest) / self.unit);
    }

    /// Kinetic and potential energy, J. Air has no potential: it only takes.
    fn total_energy(&self) -> f64 {
        let states = self.simulation.dynamic_bodies().filter_map(|body| self.simulation.state(body));
        let energies = states.zip(&self.masses).map(|(state, mass)| {
            mass * (state.velocity.length_squared() / 2.0 + potential(&self.forces, state.position))
        });
        energies.sum()
    }
}

/// Potential energy of a unit mass, J/kg.
fn potential(forces: &[Force], at: DVec3) -> f64 {
    let of_each = forces.iter().map(|force| match force.kind {
        ForceKind::GravityPlane { acceleration, .. } => -acceleration.dot(at),
        ForceKind::GravityPoint { position, intensity } => -intensity / (at - position).length(),
        ForceKind::Drag { .. } => 0.0,
    });
    of_each.sum()
}

/// Acceleration by all forces with a potential, m/s².
fn pull(forces: &[Force], at: DVec3) -> DVec3 {
    let of_each = forces.iter().map(|force| match force.kind {
        ForceKind::GravityPlane { acceleration, .. } => acceleration,
        ForceKind::GravityPoint { position, intensity } => {
            let away = position - at;
            away * (intensity / (away.length_squared() * away.length()))
        }
        ForceKind::Drag { .. } => DVec3::ZERO,
    });
    of_each.sum()
}

/// Mean over the balls of m g r at the start, or of their kinetic energies where nothing pulls, J.
fn energy_unit(scene: &Scene) -> f64 {
    let (mut weights, mut kinetic, mut count) = (0.0, 0.0, 0.0_f64);
    for body in &scene.bodies {
        if let (Motion::Dynamic { mass, velocity }, &Shape::Sphere { radius }) = (body.motion, &body.shape) {
            weights += mass * pull(&scene.forces, body.position).length() * radius;
            kinetic += 0.5 * mass * velocity.length_squared();
            count += 1.0;
        }
    }
    (if weights > 0.0 { weights } else { kinetic }) / count.max(1.0)
}
