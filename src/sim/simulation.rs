//! The simulation as its users see it: compile, begin, next event, finish, read.

use glam::DVec3;

use super::{BodyRef, BodyState, Counters, EditRefused, Energy, Event, Momentum, Plan, SimEdit, Tiling};
use crate::scene::{Diagnostic, NodeKey, Scene};

/// Why a scene can't be simulated.
#[derive(Clone, Debug, thiserror::Error)]
#[error("the scene can't be simulated: {}", .problems.first().map_or("", |p| &p.message))]
pub struct CompileError {
    pub problems: Vec<Diagnostic>,
}

/// A number went wrong while running. The simulation stays at the last good event.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("at t = {time} s: {message}")]
pub struct Fault {
    pub time: f64,
    pub message: String,
}

/// A bit-exact copy of everything that moves.
#[derive(Clone, Debug)]
pub struct Snapshot {}

/// A running scene.
#[derive(Clone, Debug)]
pub struct Simulation {}

impl Simulation {
    pub fn new(_scene: &Scene) -> Result<Self, CompileError> {
        todo!()
    }

    /// Geometric warnings about the start: overlaps, bodies outside the map.
    pub fn start_warnings(&self) -> &[Diagnostic] {
        todo!()
    }

    /// Model time of what can be read now, s.
    pub fn time(&self) -> f64 {
        todo!()
    }

    /// Sets the time up to which [`Self::next_event`] goes. Times before now count as now.
    pub fn begin(&mut self, _until: f64) {
        todo!()
    }

    /// Goes to the next event not after the time given to [`Self::begin`] and reports it; `None` when
    /// there is none left: then now is still the last event's time, until [`Self::finish`].
    pub fn next_event(&mut self) -> Result<Option<Event>, Fault> {
        todo!()
    }

    /// Goes through the events that are left to the time given to [`Self::begin`], which becomes now.
    pub fn finish(&mut self, _on_event: &mut dyn FnMut(&Simulation, &Event)) -> Result<(), Fault> {
        todo!()
    }

    pub fn dynamic_count(&self) -> usize {
        todo!()
    }

    pub fn static_count(&self) -> usize {
        todo!()
    }

    /// All dynamic bodies that are there now, in UserID order.
    pub fn dynamic_bodies(&self) -> impl Iterator<Item = BodyRef> + '_ {
        std::iter::empty()
    }

    /// State of a dynamic body now; `None` for a static or removed one.
    pub fn state(&self, _body: BodyRef) -> Option<BodyState> {
        todo!()
    }

    /// Sum of the applied forces (without contact forces) on a dynamic body now, N.
    pub fn total_force(&self, _body: BodyRef) -> DVec3 {
        todo!()
    }

    pub fn key(&self, _body: BodyRef) -> NodeKey {
        todo!()
    }

    /// The unique label: UserID, or UserID#k.
    pub fn label(&self, _body: BodyRef) -> &str {
        todo!()
    }

    pub fn find(&self, _key: NodeKey) -> Option<BodyRef> {
        todo!()
    }

    pub fn energy(&self) -> Energy {
        todo!()
    }

    pub fn momentum(&self) -> Momentum {
        todo!()
    }

    /// Deepest overlap of any two bodies now, m, ≥ 0. Costs a look through the tiles.
    pub fn worst_overlap(&self) -> f64 {
        todo!()
    }

    pub fn counters(&self) -> Counters {
        todo!()
    }

    pub fn plan(&self) -> &Plan {
        todo!()
    }

    /// The occupied tiles now, at most `limit` of them.
    pub fn tiling(&self, _limit: usize) -> Tiling {
        todo!()
    }

    /// Applies a change now.
    pub fn apply(&mut self, _edit: &SimEdit) -> Result<(), EditRefused> {
        todo!()
    }

    pub fn snapshot(&self) -> Snapshot {
        todo!()
    }

    pub fn restore(&mut self, _snapshot: &Snapshot) {
        todo!()
    }

    /// FNV-1a over the bits of time, positions, velocities and contact states.
    pub fn hash(&self) -> u64 {
        todo!()
    }
}
