//! Motion between impacts: Gragg's modified midpoint rule, extrapolated until the digits stop changing.

use crate::scene::{Force, ForceKind};
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

    fn plus(self, change: DVec3) -> Self {
        let small = change + self.rest;
        let value = self.value + small;
        // Knuth's exact error of a sum.
        let back = value - self.value;
        let rest = (self.value - (value - back)) + (small - back);
        Self { value, rest }
    }
}

/// Rows of the extrapolation table before a step is halved.
const ROWS: usize = 9;
/// Halvings before the result is taken as it is.
const DEPTH: u32 = 40;

impl Ball {
    /// The ball `duration` later, if it meets nothing; `tolerance` as in the settings.
    pub(super) fn flown(&self, forces: &[Force], duration: f64, tolerance: f64) -> Self {
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

    /// Changes of position and velocity in one step, extrapolated to substeps of no length.
    fn extrapolated(
        &self,
        forces: &[Force],
        duration: f64,
        tolerance: f64,
        at_any_rate: bool,
    ) -> Option<[DVec3; 2]> {
        let mut row = [[DVec3::ZERO; 2]; ROWS];
        for j in 0..ROWS {
            let substeps = 2 * (j + 1);
            let mut next = [[DVec3::ZERO; 2]; ROWS];
            next[0] = self.midpoint(forces, duration, substeps);
            for k in 1..=j {
                // T(j,k) = T(j,k-1) + (T(j,k-1) − T(j−1,k-1)) / ((n_j/n_(j−k))² − 1)
                let ratio = substeps as f64 / (2 * (j - k + 1)) as f64;
                let (new, old) = (next[k - 1], row[k - 1]);
                next[k] = [0, 1].map(|i| new[i] + (new[i] - old[i]) / (ratio * ratio - 1.0));
            }
            if j > 0 && self.converged(next[j], next[j - 1], duration, tolerance) {
                return Some(next[j]);
            }
            row = next;
        }
        // A number that is no longer finite converges nowhere.
        (at_any_rate || !row[ROWS - 1][1].is_finite()).then_some(row[ROWS - 1])
    }

    fn converged(&self, new: [DVec3; 2], old: [DVec3; 2], duration: f64, tolerance: f64) -> bool {
        let speed = self.velocity.value.length() + new[1].length();
        let small = [speed * duration, 1e-3 * self.velocity.value.length() + new[1].length()];
        (0..2).all(|i| (new[i] - old[i]).length() <= tolerance * small[i])
    }

    fn midpoint(&self, forces: &[Force], duration: f64, substeps: usize) -> [DVec3; 2] {
        let h = duration / substeps as f64;
        let rate = |[dx, dv]: [DVec3; 2]| {
            [self.velocity.value + (self.velocity.rest + dv), self.acceleration(forces, dx, dv)]
        };
        let step =
            |from: [DVec3; 2], rate: [DVec3; 2], h: f64| [from[0] + rate[0] * h, from[1] + rate[1] * h];
        let mut before = [DVec3::ZERO; 2];
        let mut now = step(before, rate(before), h);
        for _ in 1..substeps {
            (before, now) = (now, step(before, rate(now), 2.0 * h));
        }
        let last = step(before, rate(now), h);
        [0, 1].map(|i| (now[i] + last[i]) / 2.0)
    }

    /// Acceleration at an offset from the ball's present position and velocity.
    fn acceleration(&self, forces: &[Force], dx: DVec3, dv: DVec3) -> DVec3 {
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

    /// Kinetic and potential energy, J; the potential of a uniform field is 0 at the origin.
    pub fn energy(&self, forces: &[Force]) -> f64 {
        let (x, v) = (self.position.value, self.velocity.value);
        let potential = |force: &Force| match force.kind {
            ForceKind::GravityPlane { acceleration, .. } => -acceleration.dot(x),
            ForceKind::GravityPoint { position, intensity } => -intensity / (position - x).length(),
            ForceKind::Drag { .. } => 0.0,
        };
        self.mass * (v.length_squared() / 2.0 + forces.iter().map(potential).sum::<f64>())
    }
}
