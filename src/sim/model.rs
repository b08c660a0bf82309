//! The compiled scene: everything about bodies, forces and settings that does not move.

use std::sync::Arc;

use glam::DVec3;

use super::force::ForceEntry;
use super::tiles::{Grid, StaticTiles};
use super::{Method, Plan};
use crate::scene::{Diagnostic, NodeKey, SimParams};

/// Immutable while it runs; an edit makes a changed copy.
#[derive(Clone, Debug)]
pub(super) struct Model {
    pub params: SimParams,
    pub method: Method,
    pub movers: Vec<MoverInfo>,
    /// Radii of the movers, m: close together, for predictions read many.
    pub radii: Vec<f64>,
    pub fixtures: Vec<Fixture>,
    pub forces: Vec<ForceEntry>,
    pub grid: Grid,
    pub static_tiles: StaticTiles,
    pub plan: Plan,
    pub start_warnings: Vec<Diagnostic>,
}

/// Who a body is.
#[derive(Clone, Debug)]
pub(super) struct Identity {
    pub key: NodeKey,
    pub id: i64,
    pub label: Arc<str>,
    /// What a person calls it: its name, else its label.
    pub name: Arc<str>,
    /// Order among bodies of the same id.
    pub order: u32,
}

/// What does not change about a dynamic body.
#[derive(Clone, Debug)]
pub(super) struct MoverInfo {
    /// Apart, since predictions never look at it.
    pub identity: Box<Identity>,
    /// kg.
    pub mass: f64,
    /// m.
    pub radius: f64,
    pub bounce: f64,
    pub material: Option<Arc<str>>,
    /// False once it is removed: indices of the others stay.
    pub present: bool,
}

/// A static body.
#[derive(Clone, Debug)]
pub(super) struct Fixture {
    pub identity: Box<Identity>,
    pub bounce: f64,
    /// m.
    pub position: DVec3,
    pub shape: FixtureShape,
    pub present: bool,
}

#[derive(Clone, Debug)]
pub(super) enum FixtureShape {
    Sphere {
        radius: f64,
    },
    /// Apart, so that a static body fills one cache line.
    Plate(Box<Plate>),
}

/// A bounded plane in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plate {
    pub center: DVec3,
    /// Unit vectors of its own frame.
    pub axis_x: DVec3,
    pub axis_y: DVec3,
    pub normal: DVec3,
    /// m.
    pub half_x: f64,
    pub half_y: f64,
}

impl Plate {
    /// A point in the plate's own frame: Q' = R⁻¹(Q − P).
    pub fn local_of(&self, at: DVec3) -> DVec3 {
        let d = at - self.center;
        DVec3::new(self.axis_x.dot(d), self.axis_y.dot(d), self.normal.dot(d))
    }

    /// Whether the foot of a point given in the plate's frame lies on the plate.
    pub fn covers(&self, local: DVec3) -> bool {
        local.x.abs() <= self.half_x && local.y.abs() <= self.half_y
    }

    pub fn corners(&self) -> [DVec3; 4] {
        let (x, y) = (self.half_x * self.axis_x, self.half_y * self.axis_y);
        [self.center - x - y, self.center + x - y, self.center - x + y, self.center + x + y]
    }
}

impl Fixture {
    /// Axis-aligned bounds, m.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        match &self.shape {
            FixtureShape::Sphere { radius } => (self.position - *radius, self.position + *radius),
            FixtureShape::Plate(plate) => {
                let [first, rest @ ..] = plate.corners();
                rest.iter().fold((first, first), |(low, high), corner| (low.min(*corner), high.max(*corner)))
            }
        }
    }
}

impl Model {
    /// Whether flight is a parabola: all forces are uniform.
    pub fn is_ballistic(&self) -> bool {
        self.forces.iter().all(|force| force.law.is_uniform())
    }
}
