//! Motion between impacts, in free flight.

use super::extrapolation::extrapolated;
use super::face::OnFace;
use crate::scene::{Force, ForceKind, Roughness};
use glam::DVec3;

/// One moving sphere. Position and velocity carry the rounding of their own sums along.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// UserID.
    pub id: i64,
    /// Index in the scene's bodies.
    pub body: usize,
    /// Centre, m.
    pub position: Sum,
    /// m/s.
    pub velocity: Sum,
    /// m.
    pub radius: f64,
    /// kg.
    pub mass: f64,
    pub bounce: f64,
    pub roughness: Roughness,
    /// rad/s.
    pub spin: DVec3,
    /// The face that it lies on and rubs on.
    pub on: Option<OnFace>,
}

/// A compensated sum: `value` plus a `rest` too small for it.
#[derive(Clone, Copy, Debug)]
pub struct Sum {
    pub value: DVec3,
    rest: DVec3,
}

impl Sum {
    /// A sum of one term.
    pub fn new(value: DVec3) -> Self {
        Self { value, rest: DVec3::ZERO }
    }

    /// `self − other`, with the rests.
    pub(super) fn minus(self, other: Self) -> DVec3 {
        (self.value - other.value) + (self.rest - other.rest)
    }

    pub(super) fn plus(self, change: DVec3) -> Self {
        let small = change + self.rest;
        let value = self.value + small;
        // Knuth's exact error of a sum.
        let back = value - self.value;
        let rest = (self.value - (value - back)) + (small - back);
        Self { value, rest }
    }
}

/// Moment of inertia of a solid sphere over m R².
pub(super) const INERTIA: f64 = 0.4;
/// Halvings before the result is taken as it is.
const DEPTH: u32 = 40;

impl Ball {
    /// The ball `duration` later, if it meets nothing; `tolerance` as in the settings.
    pub(super) fn flown(&self, forces: &[Force], duration: f64, tolerance: f64) -> Self {
        if let Some(on) = self.on {
            return self.gone_on(on, forces, duration, tolerance);
        }
        self.flown_at_depth(forces, duration, tolerance, 0)
    }

    fn flown_at_depth(&self, forces: &[Force], duration: f64, tolerance: f64, depth: u32) -> Self {
        if let Some([dx, dv]) = self.extrapolated(forces, duration, tolerance, depth == DEPTH) {
            let (position, velocity) = (self.position.plus(dx), self.velocity.plus(dv));
            return Self { position, velocity, ..*self };
        }
        let half = self.flown_at_depth(forces, duration / 2.0, tolerance, depth + 1);
        half.flown_at_depth(forces, duration / 2.0, tolerance, depth + 1)
    }

    /// Changes of position and velocity in one step.
    fn extrapolated(
        &self,
        forces: &[Force],
        duration: f64,
        tolerance: f64,
        at_any_rate: bool,
    ) -> Option<[DVec3; 2]> {
        let rate = |[dx, dv]: [DVec3; 2]| {
            [self.velocity.value + (self.velocity.rest + dv), self.acceleration(forces, dx, dv)]
        };
        let converged = |new, old| self.converged(new, old, duration, tolerance);
        extrapolated(duration, at_any_rate, rate, converged)
    }

    fn converged(&self, new: [DVec3; 2], old: [DVec3; 2], duration: f64, tolerance: f64) -> bool {
        let speed = self.velocity.value.length() + new[1].length();
        let small = [speed * duration, 1e-3 * self.velocity.value.length() + new[1].length()];
        (0..2).all(|i| (new[i] - old[i]).length() <= tolerance * small[i])
    }

    /// Acceleration at an offset from the ball's present position and velocity.
    pub(super) fn acceleration(&self, forces: &[Force], dx: DVec3, dv: DVec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for force in forces {
            sum += match force.kind {
                ForceKind::GravityPlane { acceleration, .. } => acceleration,
                ForceKind::GravityPoint { position, intensity } => {
                    let r = (position - self.position.value) - (self.position.rest + dx);
                    r * (intensity / (r.length_squared() * r.length()))
                }
                ForceKind::Drag { density } => {
                    let v = self.velocity.value + (self.velocity.rest + dv);
                    let area = std::f64::consts::PI * self.radius * self.radius;
                    v * (-0.5 * 0.5 * density * area * v.length() / self.mass)
                }
            };
        }
        sum
    }

    /// Acceleration by the forces at the present place, m/s².
    pub(super) fn acceleration_now(&self, forces: &[Force]) -> DVec3 {
        self.acceleration(forces, DVec3::ZERO, DVec3::ZERO)
    }

    /// Takes an impulse, N·s.
    pub(super) fn push(&mut self, impulse: DVec3) {
        self.velocity = self.velocity.plus(impulse / self.mass);
    }

    /// Takes an impulse across a normal, N·s, at the point of its surface in this direction.
    pub(super) fn rub(&mut self, to: DVec3, impulse: DVec3) {
        if impulse != DVec3::ZERO {
            self.push(impulse);
            self.spin += to.cross(impulse) / (INERTIA * self.mass * self.radius);
        }
    }

    /// Kinetic and potential energy, J; the potential of a uniform field is 0 at the origin.
    pub fn energy(&self, forces: &[Force]) -> f64 {
        let (x, v) = (self.position.value, self.velocity.value);
        let potential = |force: &Force| match force.kind {
            ForceKind::GravityPlane { acceleration, .. } => -acceleration.dot(x),
            ForceKind::GravityPoint { position, intensity } => -intensity / (position - x).length(),
            ForceKind::Drag { .. } => 0.0,
        };
        let turning = INERTIA * self.radius * self.radius * self.spin.length_squared();
        self.mass * ((v.length_squared() + turning) / 2.0 + forces.iter().map(potential).sum::<f64>())
    }
}
