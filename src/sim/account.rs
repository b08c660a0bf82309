//! Running totals of what was lost, given and taken, without loss to rounding.

use glam::DVec3;

/// A sum that keeps its rounding (Neumaier 1974).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    pub fn add(&mut self, value: f64) {
        let total = self.total + value;
        self.lost += if self.total.abs() >= value.abs() {
            (self.total - total) + value
        } else {
            (value - total) + self.total
        };
        self.total = total;
    }

    pub fn value(&self) -> f64 {
        self.total + self.lost
    }
}

/// The same for vectors.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct VectorSum([Sum; 3]);

impl VectorSum {
    pub fn add(&mut self, value: DVec3) {
        for (sum, part) in self.0.iter_mut().zip(value.to_array()) {
            sum.add(part);
        }
    }

    pub fn value(&self) -> DVec3 {
        DVec3::from_array(self.0.map(|sum| sum.value()))
    }
}

/// Running totals of angular momentum about the origin, where bodies spin.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AngularAccount {
    pub at_start: DVec3,
    /// Σ m|x||v| + I|ω| at the start, kg·m²/s.
    pub scale: f64,
    /// Given by static bodies in impacts, and by edits.
    pub impulses: VectorSum,
    /// ∫x×F dt over segments that have ended, with the torques of contact.
    pub torque_impulse: VectorSum,
}

/// The angular momentum that an impulse at a point brings.
pub(super) fn angular(at: DVec3, impulse: DVec3) -> DVec3 {
    at.cross(impulse)
}

/// Running totals since the start.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Account {
    pub energy_at_start: f64,
    pub kinetic_at_start: f64,
    pub momentum_at_start: DVec3,
    /// Σ m|v| at the start, kg·m/s.
    pub momentum_scale: f64,
    /// Energy taken by impacts, J.
    pub impact_losses: Sum,
    /// Energy taken by drag over segments that have ended, J.
    pub dissipated: Sum,
    /// Energy put in by edits, J.
    pub edit_work: Sum,
    /// Whether a force without a potential has done work, which nobody knows.
    pub unknown_work: bool,
    /// Momentum given by static bodies in impacts, and by edits.
    pub impulses: VectorSum,
    /// ∫F dt over segments that have ended, contact forces included.
    pub force_impulse: VectorSum,
    pub angular: AngularAccount,
}
