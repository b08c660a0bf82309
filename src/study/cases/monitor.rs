//! Looks at all pairs of a running simulation with the reference's geometry, and adds up its energy, without
//! asking the core for either.

use glam::DVec3;

use super::trial::{Stop, states};
use crate::scene::{Force, ForceKind, Motion, Scene};
use crate::sim::{BodyRef, BodyState, Event, Simulation};
use crate::study::reference::geometry::{Surface, dynamic_radius, sphere_gap};

/// Watches a scene that is not edited while it runs.
pub(super) struct Monitor {
    /// Radius and mass of each dynamic body, in UserID order, as the simulation lists them.
    balls: Vec<(f64, f64)>,
    statics: Vec<Surface>,
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
        let mut balls = Vec::new();
        let mut statics = Vec::new();
        for body in bodies {
            match (body.motion, dynamic_radius(body)) {
                (Motion::Dynamic { mass, .. }, Some(radius)) => balls.push((radius, mass)),
                _ => statics.extend(Surface::of(body)),
            }
        }
        let mut monitor = Self {
            balls,
            statics,
            forces: scene.forces.clone(),
            start_energy: 0.0,
            scale: 0.0,
            worst_overlap: 0.0,
            energy_drift: 0.0,
            energy_gain: 0.0,
        };
        let states = states(sim);
        if states.len() != monitor.balls.len() {
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
            Some(event) if self.balls.len() > LARGE && event.seq % STRIDE != 0 => {}
            Some(event) if self.balls.len() > SMALL => {
                for body in [Some(event.a), event.b].into_iter().flatten() {
                    self.look_around(sim, body);
                }
            }
            _ => {
                let states = states(sim);
                self.look_at_all(&states);
                self.weigh(&states);
            }
        }
    }

    /// A body against all others.
    fn look_around(&mut self, sim: &Simulation, body: BodyRef) {
        let (BodyRef::Dynamic(index), Some(own)) = (body, sim.state(body)) else { return };
        let radius = self.balls.get(index as usize).map_or(0.0, |ball| ball.0);
        let others = sim.dynamic_bodies().zip(&self.balls).filter(|(other, _)| *other != body);
        let gaps = others.filter_map(|(other, ball)| {
            sim.state(other).map(|state| sphere_gap(own.position, radius, state.position, ball.0).distance)
        });
        let nearest = gaps.fold(f64::INFINITY, f64::min);
        self.note(nearest);
        self.look_at_statics(own.position, radius);
    }

    fn look_at_all(&mut self, states: &[BodyState]) {
        // Sorted along x, a pair farther apart in x than the two largest balls can be skipped with all after it.
        let mut sorted: Vec<(DVec3, f64)> =
            states.iter().zip(&self.balls).map(|(state, ball)| (state.position, ball.0)).collect();
        sorted.sort_by(|left, right| left.0.x.total_cmp(&right.0.x));
        let widest = self.balls.iter().map(|ball| ball.0).fold(0.0, f64::max);
        for (index, &(a, radius)) in sorted.iter().enumerate() {
            for &(b, other) in sorted[index + 1..].iter().take_while(|(b, _)| b.x - a.x <= radius + widest) {
                self.note(sphere_gap(a, radius, b, other).distance);
            }
            self.look_at_statics(a, radius);
        }
    }

    fn look_at_statics(&mut self, position: DVec3, radius: f64) {
        let nearest = self.statics.iter().map(|surface| surface.gap(position, radius).distance);
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        self.note(nearest);
    }

    fn note(&mut self, distance: f64) {
        self.worst_overlap = self.worst_overlap.max(-distance);
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
        for (state, &(_, mass)) in states.iter().zip(&self.balls) {
            energy.0 += 0.5 * mass * state.velocity.length_squared();
            energy.1 += mass * self.forces.iter().map(|force| potential(force, state.position)).sum::<f64>();
        }
        energy
    }
}

/// Potential energy of a unit mass, J/kg.
fn potential(force: &Force, at: DVec3) -> f64 {
    match force.kind {
        ForceKind::GravityPlane { acceleration, .. } => -acceleration.dot(at),
        ForceKind::GravityPoint { position, intensity } => -intensity / (at - position).length(),
        ForceKind::Drag { .. } => 0.0,
    }
}
