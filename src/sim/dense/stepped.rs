//! What a step works on: the bodies of a component, its pairs and its contacts.

use glam::DVec3;

use crate::sim::pair::Pair;

/// The place of a body that does not move.
pub(in crate::sim) const FIXED: u32 = u32::MAX;

/// One body of a component in one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stepped {
    pub body: u32,
    /// m.
    pub x: DVec3,
    /// Velocity at the end of the step before, m/s, with the second half of its kick.
    pub v: DVec3,
    /// What that kick is beyond what the segment says, m/s.
    pub kick: DVec3,
    /// Velocity in the middle of the step before, m/s.
    pub u: DVec3,
    /// Acceleration of the applied forces, m/s².
    pub a: DVec3,
    /// Lengths of those two.
    pub speed: f64,
    pub drive: f64,
    /// 1/kg; 0 for one that is held.
    pub inverse_mass: f64,
    /// m.
    pub radius: f64,
    /// How fast the pull of attractors changes, 1/s².
    pub stiffness: f64,
    /// The longest step for that pull, s, and how many halvings make it.
    pub step: f64,
    pub halvings_by_pull: u8,
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
}

/// What touches or may come to in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Place in the list of pairs.
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
    /// The smallest of all bodies, m.
    pub radius: f64,
    /// N·s.
    pub impulse: f64,
    /// Whether it is too far off to count until it is seen to meet.
    pub is_lazy: bool,
}

/// Velocity in the middle of a step, m/s, and inverse mass, 1/kg.
pub(super) type Moving = [f64; 4];

/// m/s.
pub(super) fn velocity(moving: &Moving) -> DVec3 {
    let [x, y, z, _] = *moving;
    DVec3::new(x, y, z)
}
