//! The axes of the world.

use glam::DVec3;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    pub fn unit(self) -> DVec3 {
        [DVec3::X, DVec3::Y, DVec3::Z][self as usize]
    }

    pub fn label(self) -> &'static str {
        ["x", "y", "z"][self as usize]
    }

    /// The axis that a letter names, in either case.
    pub fn of_letter(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|axis| axis.label().starts_with(letter.to_ascii_lowercase()))
    }

    /// The world axis that a unit vector lies along, in either sense.
    pub fn of_unit(unit: DVec3) -> Option<Self> {
        Self::ALL.into_iter().find(|axis| unit[*axis as usize].abs() > 1.0 - 1e-12)
    }
}
