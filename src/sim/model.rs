//! The compiled scene: everything about bodies, forces and settings that does not move.

use glam::DVec3;

use super::body::{Bodies, Body, BodyId, Identity};
use super::force::{ForceEntry, Law, Subject};
use super::method::Method;
use super::place::Place;
use super::report::Plan;
use super::tiles::{Grid, StaticTiles};
use crate::scene::{Diagnostic, SimParams};

/// What the step of groups was found from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum StepSource {
    /// Nothing drives the bodies and none moves.
    #[default]
    Nothing,
    /// Forces of the user's own alone, on bodies of which none moves yet.
    ForcesAtRest,
    Motion,
    /// Forces, or what the scene asks for.
    Forces,
}

/// Immutable while it runs; an edit makes a changed copy.
#[derive(Clone, Debug)]
pub(super) struct Model {
    pub params: SimParams,
    pub method: Method,
    pub bodies: Bodies,
    pub forces: Vec<ForceEntry>,
    pub grid: Grid,
    pub static_tiles: StaticTiles,
    /// Step of stepped groups, s; 0 where the scene can have none, and while nothing tells how long it may be.
    pub dense_step: f64,
    pub step_source: StepSource,
    pub plan: Plan,
    pub start_warnings: Vec<Diagnostic>,
}

impl Model {
    pub fn body(&self, id: BodyId) -> &Body {
        self.bodies.get(id)
    }

    /// Who a body is.
    pub fn identity(&self, id: BodyId) -> &Identity {
        self.bodies.identity(id)
    }

    /// A dynamic body.
    pub fn dynamic(&self, body: u32) -> &Body {
        &self.bodies.dynamic()[body as usize]
    }

    /// kg, of a dynamic body.
    pub fn mass(&self, body: u32) -> f64 {
        self.dynamic(body).mass()
    }

    /// m, of a dynamic body.
    pub fn radius(&self, body: u32) -> f64 {
        self.bodies.radius(body)
    }

    /// All dynamic bodies that are there now.
    pub fn present(&self) -> impl Iterator<Item = u32> + '_ {
        self.bodies.present_dynamic()
    }

    /// What forces see of a dynamic body.
    pub fn subject(&self, body: u32, time: f64, place: Place, velocity: DVec3) -> Subject<'_> {
        let dynamic = self.dynamic(body);
        Subject {
            time,
            position: place.x,
            low: place.low,
            velocity,
            mass: dynamic.mass(),
            radius: self.radius(body),
            material: dynamic.material(),
        }
    }

    /// Sum of the applied forces, N.
    pub fn applied_force(&self, subject: &Subject<'_>) -> DVec3 {
        self.forces.iter().map(|force| force.law.force(subject)).sum()
    }

    /// What the applied forces give a body, m/s².
    pub fn applied_acceleration(&self, subject: &Subject<'_>) -> DVec3 {
        self.applied_force(subject) / subject.mass
    }

    /// Whether a force may depend on the time, as one of the user's own may: what rests under it may move later.
    pub fn may_depend_on_time(&self) -> bool {
        self.forces.iter().any(|force| matches!(force.law, Law::Custom(_)))
    }

    /// Whether flight is a parabola: all forces are uniform.
    pub fn is_ballistic(&self) -> bool {
        self.forces.iter().all(|force| force.law.is_uniform())
    }
}
