//! How a sphere turns between two events. What it does never acts back on where its centre goes: that is known before.

use glam::{DQuat, DVec3};

use super::segment::Series;

/// Moment of inertia of a solid sphere over m R²: I = ⅖ m R².
pub(super) const INERTIA: f64 = 0.4;

/// Change of the angle in one panel of an orientation under an angular acceleration, rad. Smaller costs time, larger turns
/// the pattern on a ball by more than a pixel: nothing else depends on it.
const PANEL: f64 = 0.05;

/// Panels of one orientation at most.
const MOST_PANELS: f64 = 4096.0;

/// What the contacts of a body let it do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Hold {
    /// It touches nothing that rubs.
    #[default]
    Free,
    Slides,
    /// No point of it slips.
    Rolls,
    Rests,
}

/// What is exactly zero at the end of a segment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Due {
    #[default]
    Nothing,
    /// The slip of its contact.
    NoSlip,
    /// Its velocity.
    Stop,
}

/// What friction takes from a body that lies on a face: `slide` times its slip, `roll` times its speed, W.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rubbing {
    /// N.
    pub slide: f64,
    pub roll: f64,
    /// From the face to the centre: the normal times the radius, m.
    pub arm: DVec3,
}

/// Rotation of one sphere from `start` on: ω(τ) = spin + ramp τ (+ a series as that of a segment).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    /// s.
    pub start: f64,
    /// World from body.
    pub orientation: DQuat,
    /// rad/s.
    pub spin: DVec3,
    /// rad/s².
    pub ramp: DVec3,
    /// Continues the ramp where `step`, s, is above 0.
    pub series: Series,
    pub step: f64,
    pub hold: Hold,
    pub due: Due,
    pub rubbing: Rubbing,
    /// What friction takes of all the bodies that this one is the first of, W: at the start, and how that goes on, along x.
    pub work: f64,
    pub work_series: Series,
    /// Spin with which the next segment begins, where an impact gave one.
    pub given: Option<DVec3>,
}

impl Turn {
    /// A rotation that nothing changes.
    pub fn steady(start: f64, orientation: DQuat, spin: DVec3) -> Self {
        Self {
            start,
            orientation,
            spin,
            ramp: DVec3::ZERO,
            series: Series::default(),
            step: 0.0,
            hold: Hold::Free,
            due: Due::Nothing,
            rubbing: Rubbing::default(),
            work: 0.0,
            work_series: Series::default(),
            given: None,
        }
    }

    /// The same rotation from a time on, with the spin that an impact gave, and nothing that changes it.
    pub fn steady_from(&self, time: f64) -> Self {
        let spin = self.given.unwrap_or_else(|| self.spin_at(time));
        Self::steady(time, self.orientation_at(time), spin)
    }

    /// rad/s.
    pub fn spin_at(&self, time: f64) -> DVec3 {
        let tau = time - self.start;
        let spin = self.spin + tau * self.ramp;
        if self.step > 0.0 { spin + tau * self.series.velocity_term(tau / self.step) } else { spin }
    }

    /// What friction has taken up to a time, J, beside its rubbing on a face.
    pub fn work_until(&self, time: f64) -> f64 {
        let tau = time - self.start;
        let more = if self.step > 0.0 { self.work_series.velocity_term(tau / self.step).x } else { 0.0 };
        tau * (self.work + more)
    }

    /// World from body. Of a spin that changes its direction a product of exponentials, one for each panel (Magnus 1954, to
    /// fourth order at two Gauss nodes: Ω = ½h(ω₁ + ω₂) + (√3/12)h² ω₂×ω₁).
    pub fn orientation_at(&self, time: f64) -> DQuat {
        let tau = time - self.start;
        let bend = self.ramp.length() + if self.step > 0.0 { self.series.bound() } else { 0.0 };
        if bend == 0.0 {
            return (exp(tau * self.spin) * self.orientation).normalize();
        }
        let panels = (bend * tau * tau / PANEL + 1.0).ceil().min(MOST_PANELS);
        let h = tau / panels;
        let node = 0.5 / 3.0_f64.sqrt();
        let mut q = self.orientation;
        for panel in 0..panels as u32 {
            let middle = self.start + (f64::from(panel) + 0.5) * h;
            let [first, second] = [middle - node * h, middle + node * h].map(|at| self.spin_at(at));
            let turn = 0.5 * h * (first + second) + (3.0_f64.sqrt() / 12.0) * h * h * second.cross(first);
            q = (exp(turn) * q).normalize();
        }
        q
    }
}

/// The rotation by |w| about w.
fn exp(w: DVec3) -> DQuat {
    let angle = w.length();
    let (sin, cos) = libm::sincos(0.5 * angle);
    let axis = if angle > 0.0 { sin / angle * w } else { 0.5 * w };
    DQuat::from_xyzw(axis.x, axis.y, axis.z, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spin that turns about a fixed axis while that axis is tilted: against many short steps.
    #[test]
    fn orientations_follow_a_spin_that_changes_its_direction() {
        let spin = DVec3::new(3.0, -1.0, 0.5);
        let turn = Turn { ramp: DVec3::new(-1.0, 4.0, 2.0), ..Turn::steady(1.0, DQuat::IDENTITY, spin) };
        let (mut q, steps) = (DQuat::IDENTITY, 200_000);
        let h = 2.0 / f64::from(steps);
        for step in 0..steps {
            let middle = turn.spin_at(1.0 + (f64::from(step) + 0.5) * h);
            q = exp(h * middle) * q;
        }
        let found = turn.orientation_at(3.0);
        assert!((found - q).length() <= 2e-6, "{found} {q}");
        assert!((found.length() - 1.0).abs() <= 1e-15);
    }

    #[test]
    fn a_steady_spin_comes_round() {
        let turn = Turn::steady(0.0, DQuat::IDENTITY, DVec3::Y * std::f64::consts::TAU);
        let half = turn.orientation_at(0.5) * DVec3::X;
        assert!((half + DVec3::X).length() <= 1e-15, "{half}");
        assert!((turn.orientation_at(7.0) * DVec3::X - DVec3::X).length() <= 1e-14);
    }
}
