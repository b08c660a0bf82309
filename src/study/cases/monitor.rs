//! Watches the overlaps of a running simulation and adds up its energy, without asking the core for either.

use glam::DVec3;

use super::trial::{Stop, states};
use crate::scene::{Force, ForceKind, Motion, Scene};
use crate::sim::{BodyRef, BodyState, Event, Simulation};
use crate::study::OverlapMonitor;

/// Watches a scene that is not edited while it runs.
pub(super) struct Monitor {
    overlaps: OverlapMonitor,
    /// Mass of each dynamic body, kg, in UserID order, as the simulation lists them.
    masses: Vec<f64>,
    forces: Vec<Force>,
    start_energy: f64,
    /// |E₀|, or the kinetic energy at the start if that is larger.
    scale: f64,
    /// The deepest overlap of any pair seen, m.
    pub worst_overlap: f64,
    /// The largest change of the mechanical energy seen, over |E₀| or the kinetic energy at the start.
    pub energy_drift: f64,
    /// The largest gain of mechanical energy seen, as above.
    pub energy_gain: f64,
}

/// Above this many bodies an event has only its own bodies looked at, against all others.
const SMALL: usize = 64;
/// Above this many not even every event has: all against all would cost more than the run itself.
const LARGE: usize = 2000;
/// Of the events of such a scene one in so many is looked at.
const STRIDE: u64 = 64;

impl Monitor {
    pub(super) fn new(scene: &Scene, sim: &Simulation) -> Result<Self, Stop> {
        let mut bodies: Vec<_> = scene.bodies.iter().collect();
        bodies.sort_by_key(|body| body.id);
        let masses = bodies.iter().filter_map(|body| match body.motion {
            Motion::Dynamic { mass, .. } => Some(mass),
            Motion::Static => None,
        });
        let mut monitor = Self {
            overlaps: OverlapMonitor::in_id_order(scene),
            masses: masses.collect(),
            forces: scene.forces.clone(),
            start_energy: 0.0,
            scale: 0.0,
            worst_overlap: 0.0,
            energy_drift: 0.0,
            energy_gain: 0.0,
        };
        let states = states(sim);
        if states.len() != monitor.masses.len() {
            return Err(Stop::Unexpected("a body got lost".into()));
        }
        let (kinetic, potential) = monitor.energy(&states);
        monitor.start_energy = kinetic + potential;
        monitor.scale = monitor.start_energy.abs().max(kinetic);
        Ok(monitor)
    }

    /// Looks at the simulation now.
    pub(super) fn look(&mut self, sim: &Simulation, event: Option<&Event>) {
        match event {
            Some(event) if self.masses.len() > LARGE && event.seq % STRIDE != 0 => {}
            Some(event) if self.masses.len() > SMALL => {
                let positions = positions(&states(sim));
                for body in [Some(event.a), event.b].into_iter().flatten() {
                    if let BodyRef::Dynamic(index) = body {
                        self.note(self.overlaps.worst_of(index as usize, &positions));
                    }
                }
            }
            _ => {
                let states = states(sim);
                self.note(self.overlaps.worst(&positions(&states)));
                self.weigh(&states);
            }
        }
    }

    fn note(&mut self, overlap: f64) {
        self.worst_overlap = self.worst_overlap.max(overlap);
    }

    fn weigh(&mut self, states: &[BodyState]) {
        let (kinetic, potential) = self.energy(states);
        let scale = if self.scale > 0.0 { self.scale } else { kinetic };
        if scale > 0.0 {
            let change = (kinetic + potential - self.start_energy) / scale;
            self.energy_drift = self.energy_drift.max(change.abs());
            self.energy_gain = self.energy_gain.max(change);
        }
    }

    /// Kinetic and potential energy, J. Drag has no potential: it only takes.
    fn energy(&self, states: &[BodyState]) -> (f64, f64) {
        let mut energy = (0.0, 0.0);
        for (state, mass) in states.iter().zip(&self.masses) {
            energy.0 += 0.5 * mass * state.velocity.length_squared();
            energy.1 += mass * self.forces.iter().map(|force| potential(force, state.position)).sum::<f64>();
        }
        energy
    }
}

fn positions(states: &[BodyState]) -> Vec<DVec3> {
    states.iter().map(|state| state.position).collect()
}

/// Potential energy of a unit mass, J/kg.
fn potential(force: &Force, at: DVec3) -> f64 {
    match force.kind {
        ForceKind::GravityPlane { acceleration, .. } => -acceleration.dot(at),
        ForceKind::GravityPoint { position, intensity } => -intensity / (at - position).length(),
        ForceKind::Drag { .. } => 0.0,
    }
}
