//! Forces: the built-in laws and the trait by which users add their own.

use std::fmt::Debug;
use std::sync::Arc;

use glam::DVec3;

use super::place::Place;
use crate::scene::{self, ForceKind, NodeKey};

/// What a force may look at: the time and the body's own state. A force between two moving bodies is
/// not possible, since each body's motion is computed alone.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Model time, s.
    pub time: f64,
    /// Centre, m.
    pub position: DVec3,
    /// What the centre has beyond the digits of `position`, m: see [`Place`].
    pub(super) low: DVec3,
    /// m/s.
    pub velocity: DVec3,
    /// kg.
    pub mass: f64,
    /// m.
    pub radius: f64,
    /// The body's `Material`, if it has one.
    pub material: Option<&'a str>,
}

impl Subject<'_> {
    /// The centre in all its digits.
    pub(super) fn place(&self) -> Place {
        Place { x: self.position, low: self.low }
    }
}

/// A force of the user's own, acting on every dynamic body.
///
/// It must be a smooth function of its subject between the times at which it is added and removed, and
/// always give the same answer for the same subject. Bodies under it are integrated with the tolerance
/// of [`crate::scene::SimParams::field_tolerance`]. Steps end where the built-in drag is not smooth, at v = 0; where
/// a force of your own is not, nobody knows, and what it does there is seen as far as a step's error shows it.
///
/// ```
/// use std::sync::Arc;
/// use glam::DVec3;
/// use polyscene::scene::{Document, NumberStyle};
/// use polyscene::sim::{Force, Simulation, Subject};
///
/// /// A spring to the origin that pulls iron only.
/// #[derive(Debug)]
/// struct Magnet {
///     stiffness: f64, // N/m
/// }
///
/// impl Force for Magnet {
///     fn force(&self, on: &Subject<'_>) -> DVec3 {
///         if on.material == Some("iron") { -self.stiffness * on.position } else { DVec3::ZERO }
///     }
///     fn potential(&self, on: &Subject<'_>) -> Option<f64> {
///         Some(if on.material == Some("iron") {
///             0.5 * self.stiffness * on.position.length_squared()
///         } else {
///             0.0
///         })
///     }
/// }
///
/// # use polyscene::scene::{Body, Motion, NodeKey, Shape};
/// let mut scene = Document::new(NumberStyle::Point).scene().cloned().unwrap();
/// let motion = Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO };
/// let ball = Body::new(1, DVec3::X, motion, Shape::Sphere { radius: 0.1 });
/// scene.bodies.push(Body { key: NodeKey(1_000_000), material: Some("iron".into()), ..ball });
/// let mut simulation = Simulation::new(&scene).unwrap();
/// simulation.add_force(Arc::new(Magnet { stiffness: 4.0 }));
/// simulation.begin(std::f64::consts::PI); // one period of ω = √(k/m) = 2 rad/s
/// simulation.finish(&mut |_, _| {}).unwrap();
/// let body = simulation.dynamic_bodies().next().unwrap();
/// let x = simulation.state(body).unwrap().position.x;
/// assert!((x - 1.0).abs() < 1e-12);
/// ```
pub trait Force: Debug + Send + Sync {
    /// Newtons.
    fn force(&self, on: &Subject<'_>) -> DVec3;

    /// Potential energy in joules, such that force = −gradient; `None` where there is none. Without it
    /// the total energy and its residual are not shown.
    fn potential(&self, on: &Subject<'_>) -> Option<f64>;
}

/// One force of a model.
#[derive(Clone, Debug)]
pub(super) struct ForceEntry {
    /// `None` for a force added by code.
    pub key: Option<NodeKey>,
    /// UserID of the file, by which forces are summed up: the order in the file makes no difference to the bit. Those added by
    /// code come last.
    pub id: i64,
    pub law: Law,
}

impl ForceEntry {
    pub fn of(force: &scene::Force) -> Self {
        Self { key: Some(force.key), id: force.id, law: Law::from_kind(&force.kind) }
    }

    pub fn custom(force: Arc<dyn Force>) -> Self {
        Self { key: None, id: i64::MAX, law: Law::Custom(force) }
    }

    /// Takes its place among the others.
    pub fn put_into(self, forces: &mut Vec<Self>) {
        let place =
            forces.partition_point(|other| (other.id, other.key.is_none()) <= (self.id, self.key.is_none()));
        forces.insert(place, self);
    }
}

#[derive(Clone, Debug)]
pub(super) enum Law {
    Uniform {
        acceleration: DVec3,
    },
    Point {
        center: DVec3,
        intensity: f64,
    },
    /// `coefficient` is ½Cρ in kg/m³.
    Drag {
        coefficient: f64,
    },
    Custom(Arc<dyn Force>),
}

/// Drag coefficient C of a sphere at the speeds the format is meant for.
const SPHERE_DRAG: f64 = 0.5;

impl Law {
    pub fn from_kind(kind: &ForceKind) -> Self {
        match *kind {
            ForceKind::GravityPlane { acceleration, .. } => Self::Uniform { acceleration },
            ForceKind::GravityPoint { position, intensity } => Self::Point { center: position, intensity },
            ForceKind::Drag { density } => Self::Drag { coefficient: 0.5 * SPHERE_DRAG * density },
        }
    }

    /// Whether the force is constant in time and space, so that flight under it is a parabola.
    pub fn is_uniform(&self) -> bool {
        match *self {
            Self::Uniform { .. } => true,
            Self::Point { intensity, .. } => intensity == 0.0,
            Self::Drag { coefficient } => coefficient == 0.0,
            Self::Custom(_) => false,
        }
    }

    /// Newtons.
    pub fn force(&self, on: &Subject<'_>) -> DVec3 {
        match self {
            Self::Uniform { acceleration } => on.mass * *acceleration,
            // F = G m r/|r|³ towards the centre.
            Self::Point { center, intensity } => {
                let r = on.place().way_to(*center);
                let distance_squared = r.length_squared();
                if *intensity == 0.0 || distance_squared == 0.0 {
                    return DVec3::ZERO;
                }
                (intensity * on.mass / (distance_squared * distance_squared.sqrt())) * r
            }
            // F = −½CρS|v|v with S = πr².
            Self::Drag { coefficient } => {
                let area = std::f64::consts::PI * on.radius * on.radius;
                (-coefficient * area * on.velocity.length()) * on.velocity
            }
            Self::Custom(force) => force.force(on),
        }
    }

    /// Joules; `None` without a potential. Drag has none but its work is integrated: see `dissipates`.
    pub fn potential(&self, on: &Subject<'_>) -> Option<f64> {
        match self {
            Self::Uniform { acceleration } => Some(-on.mass * acceleration.dot(on.position)),
            Self::Point { center, intensity } => {
                let distance = on.place().way_to(*center).length();
                Some(if *intensity == 0.0 { 0.0 } else { -intensity * on.mass / distance })
            }
            Self::Drag { .. } => Some(0.0),
            Self::Custom(force) => force.potential(on),
        }
    }

    pub fn dissipates(&self) -> bool {
        matches!(self, Self::Drag { .. }) && !self.is_uniform()
    }
}
