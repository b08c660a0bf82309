//! The simulation as its users see it: compile, begin, next event, finish, read.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;

use super::body::{BodyId, Identity, Origin};
use super::books::{self, subject};
use super::candidates::{CandidateSet, candidate_sets};
use super::compile::compile;
use super::edit::{EditRefused, SimEdit};
use super::event::{BodyRef, Event};
use super::fault::Fault;
use super::force::Force;
use super::method::Method;
use super::model::Model;
use super::neighbours::enter;
use super::report::{
    AngularMomentum, BodyState, ContactForce, Counters, Energy, Momentum, Plan, PredictedImpact, Rotation,
    SteppedBodies, Tiling,
};
use super::state::State;
use super::trace::{Begun, Piece};
use super::{change, dense, drive, engine, hash, monitor};
use crate::scene::{Diagnostic, NodeKey, Scene};

/// Why a scene cannot be simulated.
#[derive(Clone, Debug, thiserror::Error)]
#[error("the scene cannot be simulated: {}", .problems.first().map_or("", |p| &p.message))]
pub struct CompileError {
    pub problems: Vec<Diagnostic>,
}

/// How far [`Simulation::work`] has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress {
    /// An event was reached.
    Event(Event),
    /// There is more to do before the next event or the end.
    Working,
    /// The time asked for is reached.
    Done,
}

/// A bit-exact copy of a simulation at one time.
#[derive(Clone, Debug)]
pub struct Snapshot(Box<Simulation>);

impl Snapshot {
    /// The simulation as it was.
    pub fn simulation(&self) -> &Simulation {
        &self.0
    }
}

/// A running scene.
///
/// Time goes on by [`Self::begin`], [`Self::next_event`] until there is none, [`Self::finish`]. In between,
/// everything can be read at [`Self::time`]. In [`Method::Exact`] the events and states do not depend on how
/// time is divided; in the others [`Self::begin`] says how long a Δt is.
#[derive(Clone, Debug)]
pub struct Simulation {
    model: Arc<Model>,
    state: State,
    fault: Option<Fault>,
}

impl Simulation {
    /// Compiles a scene and goes to its start, t = 0. Steps by [`Method::Exact`]. A scene in which a body cannot take
    /// its first step is refused.
    pub fn new(scene: &Scene) -> Result<Self, CompileError> {
        Self::with_method(scene, Method::Exact)
    }

    /// As [`Self::new`], stepping by another method.
    pub fn with_method(scene: &Scene, method: Method) -> Result<Self, CompileError> {
        Self::begun(compile(scene, method))
    }

    /// As [`Self::with_method`], of a scene that nobody else needs: its memory is given back before the simulation begins.
    pub fn of_owned(scene: Arc<Scene>, method: Method) -> Result<Self, CompileError> {
        let compiled = compile(&scene, method);
        drop(scene);
        Self::begun(compiled)
    }

    /// Goes to the start.
    fn begun(compiled: Result<(Model, Vec<Origin>), Vec<Diagnostic>>) -> Result<Self, CompileError> {
        let (mut model, starts) = compiled.map_err(|problems| CompileError { problems })?;
        let mut state = State::new(&starts);
        drop(starts);
        state.make_turns(&model);
        for body in 0..model.bodies.dynamic().len() as u32 {
            enter(&model, &mut state, body, 0.0);
        }
        // Before anything is predicted: what is refused here would take minutes.
        model.start_warnings = monitor::start_warnings(&model, &state)
            .map_err(|problem| CompileError { problems: vec![problem] })?;
        start(&model, &mut state).map_err(|fault| CompileError { problems: vec![fault.of_start()] })?;
        Ok(Self { model: Arc::new(model), state, fault: None })
    }

    /// Geometric warnings about the start: overlaps, bodies outside the map.
    pub fn start_warnings(&self) -> &[Diagnostic] {
        &self.model.start_warnings
    }

    /// Model time of what can be read now, s.
    pub fn time(&self) -> f64 {
        self.state.now
    }

    /// Sets the time up to which [`Self::next_event`] goes. A time before now, or none at all, counts as now; ∞ goes on for
    /// as long as anything is predicted, and now is then the last of what was.
    ///
    /// For a method that steps by Δt this is the end of the next one, and ∞ counts as now. A Δt that is open keeps its end:
    /// one can stop inside it and go on. An edit ends it.
    pub fn begin(&mut self, until: f64) {
        let is_ahead = until > self.state.now && (until.is_finite() || self.model.method == Method::Exact);
        self.state.until = if is_ahead { until } else { self.state.now };
        drive::plan(&self.model, &mut self.state);
    }

    /// Goes to the next event not after the time given to [`Self::begin`] and reports it; `None` when
    /// there is none left: then that time is reached and is now.
    ///
    /// After a fault it goes no further and gives the same fault again.
    pub fn next_event(&mut self) -> Result<Option<Event>, Fault> {
        loop {
            match self.work(u32::MAX)? {
                Progress::Event(event) => return Ok(Some(event)),
                Progress::Done => return Ok(None),
                Progress::Working => {}
            }
        }
    }

    /// As [`Self::next_event`], but carries out at most `limit` predictions. Most of them (segments that
    /// end, tiles that are left) are no events, so a caller that has to answer someone needs this.
    pub fn work(&mut self, limit: u32) -> Result<Progress, Fault> {
        for _ in 0..limit {
            if let Some(event) = self.state.outbox.pop_front() {
                self.state.now = self.state.now.max(event.time);
                return Ok(Progress::Event(event));
            }
            if let Some(fault) = &self.fault {
                return Err(fault.clone());
            }
            let advanced = drive::advance(&self.model, &mut self.state);
            // What an event changed is seen from that event on, from the first where one impact has several rows.
            let event = self.state.outbox.front().map(|event| event.seq);
            if event.is_some() {
                drive::look(&mut self.model, &mut self.state);
            }
            self.state.seal_trace(event.unwrap_or(self.state.sequence), event.is_some());
            match advanced {
                Ok(true) => {}
                Ok(false) => {
                    let State { now, until, reached, .. } = &mut self.state;
                    *now = if until.is_finite() { *until } else { now.max(*reached) };
                    return Ok(Progress::Done);
                }
                Err(fault) => {
                    self.state.now = self.state.now.max(self.state.reached);
                    self.fault = Some(fault);
                }
            }
        }
        // The bodies of an event follow their new motion already: it is handed out before anyone looks.
        if let Some(event) = self.state.outbox.pop_front() {
            self.state.now = self.state.now.max(event.time);
            return Ok(Progress::Event(event));
        }
        if let Some(fault) = &self.fault {
            return Err(fault.clone());
        }
        self.state.now = self.state.now.max(self.state.reached);
        Ok(Progress::Working)
    }

    /// Whether it is known that no event will follow, now or ever, unless something is edited: bodies that left the map fly on
    /// along straight lines or parabolas.
    pub fn is_over(&mut self) -> bool {
        self.fault.is_none() && drive::is_over(&self.model, &mut self.state)
    }

    /// Goes through the events that are left to the time given to [`Self::begin`], which becomes now.
    pub fn finish(&mut self, on_event: &mut dyn FnMut(&Simulation, &Event)) -> Result<(), Fault> {
        while let Some(event) = self.next_event()? {
            on_event(self, &event);
        }
        Ok(())
    }

    /// Dynamic bodies that are there now.
    pub fn dynamic_count(&self) -> usize {
        self.model.present().count()
    }

    /// Static bodies that are there now.
    pub fn static_count(&self) -> usize {
        self.model.bodies.present_statics().count()
    }

    /// All dynamic bodies that are there now, in UserID order; those added while running come last.
    pub fn dynamic_bodies(&self) -> impl Iterator<Item = BodyRef> + '_ {
        self.model.present().map(BodyRef::Dynamic)
    }

    /// The numbers of all dynamic and of all static bodies that ever were there, by which a [`BodyRef`] names them.
    pub fn body_numbers(&self) -> (Range<u32>, Range<u32>) {
        let bodies = &self.model.bodies;
        (0..bodies.dynamic().len() as u32, 0..bodies.static_len() as u32)
    }

    /// State of a dynamic body now; `None` for a static or removed one.
    pub fn state(&self, body: BodyRef) -> Option<BodyState> {
        let index = self.dynamic_index(body)?;
        let (path, now) = (self.state.path(index), self.state.now);
        Some(BodyState {
            position: path.position(now),
            velocity: path.velocity(now),
            acceleration: path.acceleration(now),
            contact: self.state.contact_state(index, now),
            turn: self
                .state
                .turns
                .get(index as usize)
                .map(|turn| Rotation { orientation: turn.orientation_at(now), spin: turn.spin_at(now) }),
        })
    }

    /// Sum of the applied forces (without contact forces) on a dynamic body now, N; zero for others.
    pub fn total_force(&self, body: BodyRef) -> DVec3 {
        self.dynamic_index(body).map_or(DVec3::ZERO, |index| {
            self.model.applied_force(&subject(&self.model, &self.state, index, self.state.now))
        })
    }

    /// The impacts that are predicted now, by time: of two bodies the next, if they are near enough to be searched for it, and
    /// none of bodies that are stepped or by a method that steps by Δt.
    pub fn predicted_impacts(&self) -> Vec<PredictedImpact> {
        engine::predicted_impacts(&self.model, &self.state)
    }

    /// How many bodies are stepped now; `None` for none.
    pub fn stepped(&self) -> Option<SteppedBodies> {
        dense::stepped_bodies(&self.model, &self.state)
    }

    /// What bodies that are stepped, or came to rest so, press on each other with; if there are more contacts than
    /// `most`, the strongest.
    pub fn contact_forces(&self, most: usize) -> Vec<ContactForce> {
        dense::contact_forces(&self.model, &self.state, most)
    }

    /// The document's key of a body; the default key for [`BodyRef::NONE`].
    pub fn key(&self, body: BodyRef) -> NodeKey {
        self.identity(body).map_or(NodeKey::default(), |identity| identity.key)
    }

    /// The unique label: UserID, or UserID#k. Empty for [`BodyRef::NONE`].
    pub fn label(&self, body: BodyRef) -> &str {
        self.identity(body).map_or("", |identity| &identity.label)
    }

    /// Mass in kg of a dynamic body; `None` for others.
    pub fn mass(&self, body: BodyRef) -> Option<f64> {
        self.dynamic_index(body).map(|index| self.model.mass(index))
    }

    /// Kinetic energy of a dynamic body in a state, J, with that of its spin where bodies rub; `None` for others.
    pub fn kinetic(&self, body: BodyRef, state: &BodyState) -> Option<f64> {
        let index = self.dynamic_index(body)?;
        Some(books::kinetic_in(&self.model, index, state))
    }

    /// The body of a document key, if it is there now.
    pub fn find(&self, key: NodeKey) -> Option<BodyRef> {
        change::find(&self.model, key).map(BodyId::to_ref)
    }

    pub fn energy(&self) -> Energy {
        books::energy(&self.model, &self.state)
    }

    pub fn momentum(&self) -> Momentum {
        books::momentum(&self.model, &self.state)
    }

    /// Angular momentum about the map's origin; `None` where nothing rubs.
    pub fn angular_momentum(&self) -> Option<AngularMomentum> {
        self.model.plan.spin.then(|| books::angular_momentum(&self.model, &self.state))
    }

    /// Deepest overlap of any two bodies now, m, ≥ 0. Costs a look through the tiles.
    pub fn worst_overlap(&self) -> f64 {
        monitor::worst_overlap(&self.model, &self.state, self.state.now)
    }

    pub fn counters(&self) -> Counters {
        self.state.counters
    }

    pub fn method(&self) -> Method {
        self.model.method
    }

    pub fn plan(&self) -> &Plan {
        &self.model.plan
    }

    /// Records from now on how bodies move; what they follow now comes first.
    pub fn trace_motion(&mut self) {
        self.state.trace.is_on = true;
        for body in self.model.present() {
            self.state.note_begun(body);
        }
        self.state.seal_trace(self.state.sequence - self.state.outbox.len() as u64, true);
    }

    /// Hands out the pieces of motion begun since the last call, in the order begun; see [`Self::trace_motion`].
    pub fn take_motion(&mut self, each: impl FnMut(Begun)) {
        self.state.trace.take(each);
    }

    /// Sum of the applied forces on a dynamic body that follows a piece of motion, at a time, N; zero for others.
    pub fn force_on(&self, body: BodyRef, piece: &Piece, time: f64) -> DVec3 {
        self.dynamic_index(body).map_or(DVec3::ZERO, |index| {
            let (place, velocity) = piece.place_and_velocity(time);
            self.model.applied_force(&self.model.subject(index, time, place, velocity))
        })
    }

    /// Bytes in which the motion of the dynamic bodies is stored: more where it is integrated.
    pub fn motion_bytes(&self) -> usize {
        self.state.motion_bytes()
    }

    /// The occupied tiles, at most `limit` of them.
    pub fn tiling(&self, limit: usize) -> Tiling {
        monitor::tiling(&self.model, &self.state, limit)
    }

    /// The dynamic bodies now, in sets of those that share tiles directly or through others, each with the
    /// static bodies in its tiles.
    pub fn candidate_sets(&self) -> Vec<CandidateSet> {
        candidate_sets(&self.model, &self.state)
    }

    /// Applies a change now. Refused, everything is as it was.
    pub fn apply(&mut self, edit: &SimEdit) -> Result<(), EditRefused> {
        self.apply_all(std::slice::from_ref(edit)).pop().unwrap_or(Ok(()))
    }

    /// Applies changes now, one after the other, and lets the bodies go on anew once, after all of them. What became of each:
    /// one that is refused changes nothing, the others are made. Where nothing can go on after them, all are refused.
    pub fn apply_all(&mut self, edits: &[SimEdit]) -> Vec<Result<(), EditRefused>> {
        let mut outcomes = Vec::with_capacity(edits.len());
        if edits.is_empty() {
            return outcomes;
        }
        if let Err(refused) = self.change(|model, state| change::apply(model, state, edits, &mut outcomes)) {
            outcomes.iter_mut().filter(|outcome| outcome.is_ok()).for_each(|outcome| {
                *outcome = Err(refused.clone());
            });
        }
        outcomes
    }

    /// Adds a force of the user's own now.
    pub fn add_force(&mut self, force: Arc<dyn Force>) -> Result<(), EditRefused> {
        self.change(|model, state| change::add_custom(model, state, force))
    }

    /// Removes a force added by [`Self::add_force`] now; whether it was there.
    pub fn remove_force(&mut self, force: &Arc<dyn Force>) -> Result<bool, EditRefused> {
        if !change::has_custom(&self.model, force) {
            return Ok(false);
        }
        self.change(|model, state| change::remove_custom(model, state, force)).map(|()| true)
    }

    pub fn snapshot(&self) -> Snapshot {
        Snapshot(Box::new(self.clone()))
    }

    pub fn restore(&mut self, snapshot: &Snapshot) {
        self.clone_from(&snapshot.0);
    }

    /// FNV-1a over the bits of time, positions, velocities and contact states.
    pub fn hash(&self) -> u64 {
        hash::of(&self.model, &self.state)
    }

    fn change<T>(
        &mut self,
        change: impl FnOnce(&mut Model, &mut State) -> Result<T, EditRefused>,
    ) -> Result<T, EditRefused> {
        let (mut model, mut state) = (Model::clone(&self.model), self.state.clone());
        let outcome = change(&mut model, &mut state)?;
        // An edit is seen at once, before its event is handed out.
        state.seal_trace(self.state.sequence - self.state.outbox.len() as u64, true);
        (self.model, self.state, self.fault) = (Arc::new(model), state, None);
        Ok(outcome)
    }

    fn dynamic_index(&self, body: BodyRef) -> Option<u32> {
        let id = BodyId::from_ref(body);
        id.dynamic().filter(|_| self.model.bodies.find(id).is_some_and(|body| body.present))
    }

    fn identity(&self, body: BodyRef) -> Option<&Identity> {
        self.model.bodies.find_identity(BodyId::from_ref(body))
    }
}

/// First segments and predictions of all bodies. The books are opened before anything can touch them.
fn start(model: &Model, state: &mut State) -> Result<(), Fault> {
    books::open(model, state);
    drive::begin_all(model, state)
}
