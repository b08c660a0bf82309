//! What the readers find, before it becomes a scene: in the coordinates of robotics, z up.

use glam::{DMat3, DVec3};

#[derive(Clone, Debug)]
pub(super) struct World {
    /// m/s².
    pub gravity: DVec3,
    /// Density of the air by this program's law of drag, kg/m³.
    pub density: f64,
    pub time_speed: f64,
    /// Size of the map, y up, where the file says it.
    pub map: Option<DVec3>,
    pub pieces: Vec<Piece>,
}

impl World {
    pub fn with_gravity(gravity: DVec3) -> Self {
        Self { gravity, density: 0.0, time_speed: 1.0, map: None, pieces: Vec::new() }
    }
}

/// A shape at a place.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub name: Option<String>,
    pub id: Option<i64>,
    pub pose: Pose,
    pub shape: PieceShape,
    /// Mass in kg and velocity in m/s of what moves.
    pub motion: Option<(f64, DVec3)>,
    /// Angular velocity of what moves, rad/s.
    pub spin: DVec3,
    pub bounce: f64,
    /// Coefficient μ of Coulomb's friction.
    pub friction: f64,
    /// Share of the load that slows a rolling ball.
    pub rolling: f64,
    pub color: Option<[u8; 3]>,
    pub hidden: bool,
    /// Line and column of the element that it is.
    pub origin: Option<(u32, u32)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PieceShape {
    /// Radius, m.
    Sphere(f64),
    /// Without end, local xy; half sides as drawn, 0 for unknown, m.
    Plane([f64; 2]),
    /// Half sides, m.
    Box(DVec3),
}

/// Parent from local: x ↦ turn·x + place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub place: DVec3,
    pub turn: DMat3,
}

impl Piece {
    /// Of a sphere that moves, m.
    pub fn rolling_radius(&self) -> Option<f64> {
        match self.shape {
            PieceShape::Sphere(radius) if self.motion.is_some() => Some(radius),
            PieceShape::Sphere(_) | PieceShape::Plane(_) | PieceShape::Box(_) => None,
        }
    }
}

impl Pose {
    pub const IDENTITY: Self = Self { place: DVec3::ZERO, turn: DMat3::IDENTITY };

    /// This one's parent from the other's local.
    pub fn then(self, inner: Self) -> Self {
        Self { place: self.place + self.turn * inner.place, turn: self.turn * inner.turn }
    }
}

/// Turns about axes that turn along (small letters) or stay (capitals), in order.
pub(super) fn euler(order: &str, angles: [f64; 3]) -> DMat3 {
    let mut turn = DMat3::IDENTITY;
    for (axis, angle) in order.chars().zip(angles) {
        let step = match axis.to_ascii_lowercase() {
            'x' => DMat3::from_rotation_x(angle),
            'y' => DMat3::from_rotation_y(angle),
            _ => DMat3::from_rotation_z(angle),
        };
        turn = if axis.is_ascii_lowercase() { turn * step } else { step * turn };
    }
    turn
}
