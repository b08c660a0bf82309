//! What a step works on: the bodies of a component, its pairs and its contacts.

use glam::DVec3;

use crate::sim::pair::Pair;

/// The place of a body that does not move.
pub(in crate::sim) const FIXED: u32 = u32::MAX;

/// A step of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Its length, s.
    pub h: f64,
    /// The smallest radius of all bodies, m: steps are as long as that allows, and so is what they leave.
    pub radius: f64,
}

/// One body of a component in one step. What is read of each pair comes first, and each line of memory is read whole.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Stepped {
    /// m.
    pub x: DVec3,
    /// m.
    pub radius: f64,
    /// Length of `u`, m/s, and of `a`, m/s².
    pub speed: f64,
    pub drive: f64,
    /// 1/kg; 0 for one that is held.
    pub inverse_mass: f64,
    pub body: u32,
    pub halvings_by_pull: u8,
    /// Velocity in the middle of the step before, m/s.
    pub u: DVec3,
    /// Acceleration of the applied forces, m/s².
    pub a: DVec3,
    /// How fast the pull of attractors changes, 1/s².
    pub stiffness: f64,
    /// The longest step for that pull, s; `halvings_by_pull` make it.
    pub step: f64,
    /// Velocity at the end of the step before, m/s, with the second half of its kick.
    pub v: DVec3,
    /// What that kick is beyond what the segment says, m/s.
    pub kick: DVec3,
}

impl Stepped {
    /// What never moves.
    pub const FIXED: Self = Self {
        body: u32::MAX,
        x: DVec3::ZERO,
        v: DVec3::ZERO,
        kick: DVec3::ZERO,
        u: DVec3::ZERO,
        a: DVec3::ZERO,
        speed: 0.0,
        drive: 0.0,
        inverse_mass: 0.0,
        radius: 0.0,
        stiffness: 0.0,
        step: f64::INFINITY,
        halvings_by_pull: 0,
    };

    /// Turns to a step of another length h, s.
    pub fn take_step(&mut self, h: f64) {
        self.u = self.v - 0.5 * h * self.a;
        self.speed = self.u.length();
    }
}

/// A listed pair within its component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub pair: Pair,
    /// Place in the list of pairs.
    pub listed: u32,
    /// Places in the component; `b` is [`FIXED`] for one that does not move.
    pub a: u32,
    pub b: u32,
    /// Force between them in the last step, N.
    pub force: f64,
}

/// What touches or may come to in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Place among the pairs of its component, and in the list of pairs.
    pub near: u32,
    pub listed: u32,
    /// Places in the component; `b` is [`FIXED`] for one that does not move.
    pub a: u32,
    pub b: u32,
    /// Unit vector from a to b.
    pub normal: DVec3,
    /// m.
    pub gap: f64,
    /// n·(u_b − u_a), m/s: negative when closing.
    pub rate: f64,
    /// m/s.
    pub bound: f64,
    /// 1/m_a + 1/m_b.
    pub inverse_mass: f64,
    /// N·s.
    pub impulse: f64,
}

/// Velocity in the middle of a step, m/s, and inverse mass, 1/kg.
pub(super) type Moving = [f64; 4];

/// m/s.
pub(super) fn velocity(moving: &Moving) -> DVec3 {
    let [x, y, z, _] = *moving;
    DVec3::new(x, y, z)
}
