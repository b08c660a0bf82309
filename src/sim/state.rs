//! Everything that moves, as columns over the dynamic bodies.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use glam::{DQuat, DVec3};

use super::account::Account;
use super::body::{BodyId, Origin};
use super::contact::Contact;
use super::dense::{Dense, Role};
use super::event::Event;
use super::model::Model;
use super::open_step::OpenStep;
use super::pair::Pair;
use super::queue::{Kind, Predicted, Queue};
use super::report::{ContactState, Counters};
use super::segment::{Path, Segment, Series};
use super::tiles::{DynamicTiles, TileRange};
use super::trace::{Held, Trace};
use super::turn::{Hold, Turn};
use super::way_in::Plunge;

/// Mutable part of a simulation; a clone of it is a bit-exact snapshot.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// Model time of what can be read, s.
    pub now: f64,
    /// Time of the last prediction carried out, s; segments may begin there, after `now`.
    pub reached: f64,
    /// Time up to which events are asked for, s.
    pub until: f64,
    pub segments: Vec<Segment>,
    /// Grows with every new segment of the body, so that old predictions can be told.
    pub stamps: Vec<u32>,
    pub registered: Vec<TileRange>,
    /// When bodies came that were not there at the start, s: those after them in the columns came later.
    pub came: BTreeMap<u32, f64>,
    /// How bodies turn; empty where nothing rubs.
    pub turns: Vec<Turn>,
    /// Integrated motion; empty while all forces are uniform and no surface is round.
    pub fields: Vec<FieldColumn>,
    /// Bodies close to an attractor, on their way in or back.
    pub plunges: BTreeMap<u32, Plunge>,
    /// Bodies held at the core of an attractor: they stay where they are.
    pub captured: BTreeSet<u32>,
    /// Lasting contacts; most bodies have none.
    pub contacts: Vec<Vec<Contact>>,
    /// Dynamic bodies that lie against each body and hardly move away, without lasting contact.
    pub touching: Vec<Vec<u32>>,
    /// The impacts of each body with others that move.
    pub cascades: Vec<Cascade>,
    /// Bodies that are stepped; none where the scene can have no such groups.
    pub dense: Option<Box<Dense>>,
    pub dynamic_tiles: DynamicTiles,
    pub queue: Queue,
    /// The Δt that a method which steps by it is in.
    pub step: Option<Box<OpenStep>>,
    /// Events made but not yet handed out.
    pub outbox: VecDeque<Event>,
    pub sequence: u64,
    pub group: u64,
    pub account: Account,
    pub counters: Counters,
    /// The motion, for whoever records it.
    pub trace: Trace,
    pub scratch: Scratch,
}

/// What the field integrator keeps for a body.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FieldColumn {
    pub series: Series,
    /// Step to try next, s; 0 when unknown.
    pub next_step: f64,
}

/// What the impacts of one body with other dynamic ones have been like, lossy ones to tell an inelastic collapse.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cascade {
    /// Closing speed of the fastest of the last ones, m/s.
    pub reference: f64,
    /// How many there were since.
    pub since: u32,
    /// Whether a collapse was reported since.
    pub is_reported: bool,
    /// Whether there was any, also an elastic one, while forces were integrated.
    pub is_struck: bool,
}

/// Marks that tell which bodies were seen in the present look through the tiles.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub epoch: u32,
    pub seen_dynamic: Vec<u32>,
    pub seen_static: Vec<u32>,
    pub found_dynamic: Vec<u32>,
    pub found_static: Vec<u32>,
}

impl State {
    /// All bodies at their start, at t = 0, in no tile and with nothing predicted.
    pub fn new(origins: &[Origin]) -> Self {
        let mut state = Self {
            now: 0.0,
            reached: 0.0,
            until: 0.0,
            segments: Vec::with_capacity(origins.len()),
            stamps: Vec::with_capacity(origins.len()),
            registered: Vec::with_capacity(origins.len()),
            came: BTreeMap::new(),
            turns: Vec::new(),
            fields: Vec::new(),
            plunges: BTreeMap::new(),
            captured: BTreeSet::new(),
            contacts: Vec::with_capacity(origins.len()),
            touching: Vec::with_capacity(origins.len()),
            cascades: Vec::with_capacity(origins.len()),
            dense: None,
            dynamic_tiles: DynamicTiles::default(),
            queue: Queue::default(),
            step: None,
            outbox: VecDeque::new(),
            sequence: 0,
            group: 0,
            account: Account::default(),
            counters: Counters::default(),
            trace: Trace::default(),
            scratch: Scratch::default(),
        };
        for origin in origins {
            state.push_body(*origin);
        }
        state
    }

    /// Adds a dynamic body's row to every column, at rest in no tile; gives its index.
    pub fn push_body(&mut self, origin: Origin) -> u32 {
        let index = self.segments.len() as u32;
        self.segments.push(Segment::ballistic(self.now, origin.position, origin.velocity, DVec3::ZERO));
        self.stamps.push(0);
        self.registered.push(TileRange::default());
        self.contacts.push(Vec::new());
        self.touching.push(Vec::new());
        self.cascades.push(Cascade::default());
        if let Some(dense) = &mut self.dense {
            dense.push_body();
        }
        index
    }

    #[inline]
    pub fn path(&self, body: u32) -> Path<'_> {
        let segment = &self.segments[body as usize];
        let series = (segment.step > 0.0).then(|| &self.fields[body as usize].series);
        Path { segment, series }
    }

    /// Angular velocity of a body, rad/s: that which an impact has just given it, or that of its motion.
    pub fn spin(&self, body: u32, time: f64) -> DVec3 {
        let turn = self.turns.get(body as usize);
        turn.map_or(DVec3::ZERO, |turn| turn.given.unwrap_or_else(|| turn.spin_at(time)))
    }

    /// World from body; none is kept where nothing rubs.
    pub fn orientation(&self, body: u32, time: f64) -> DQuat {
        self.turns.get(body as usize).map_or(DQuat::IDENTITY, |turn| turn.orientation_at(time))
    }

    /// Gives a body the spin with which its next motion begins.
    pub fn give_spin(&mut self, body: u32, spin: DVec3) {
        if let Some(turn) = self.turns.get_mut(body as usize) {
            turn.given = Some(spin);
        }
    }

    /// Lets a body go on turning from a time on as nothing changes it.
    pub fn turn_freely(&mut self, body: u32, time: f64) {
        if let Some(turn) = self.turns.get_mut(body as usize) {
            *turn = turn.steady_from(time);
        }
    }

    /// What the contacts of a body let it do.
    pub fn hold(&self, body: u32) -> Hold {
        self.turns.get(body as usize).map_or(Hold::Free, |turn| turn.hold)
    }

    /// Notes whether a lasting contact does not slip at the end of its bodies' segments.
    pub fn mark_sticking(&mut self, pair: Pair, sticks: bool) {
        for (body, other) in pair.ends() {
            let contacts = &mut self.contacts[body as usize];
            contacts
                .iter_mut()
                .filter(|contact| contact.other == other)
                .for_each(|contact| contact.sticks = sticks);
        }
    }

    /// Room for turns where the scene needs them. Bodies that had none kept their spin from when they came.
    pub fn make_turns(&mut self, model: &Model) {
        if !model.plan.spin {
            return;
        }
        for body in self.turns.len()..self.segments.len() {
            let (orientation, spin) = model.dynamic(body as u32).turn_at_start();
            let came = self.came.get(&(body as u32)).copied().unwrap_or(0.0);
            self.turns.push(Turn::steady(came, orientation, spin).steady_from(self.now));
        }
    }

    /// The motion of any body.
    #[inline]
    pub fn path_of<'a>(&'a self, model: &'a Model, id: BodyId) -> Path<'a> {
        match id.dynamic() {
            Some(body) => self.path(body),
            None => Path { segment: model.bodies.static_segment(id.index()), series: None },
        }
    }

    pub fn motion_bytes(&self) -> usize {
        size_of_val(self.segments.as_slice()) + size_of_val(self.fields.as_slice())
    }

    #[inline]
    pub fn position(&self, body: u32, time: f64) -> DVec3 {
        self.path(body).position(time)
    }

    #[inline]
    pub fn velocity(&self, body: u32, time: f64) -> DVec3 {
        self.path(body).velocity(time)
    }

    /// A prediction for one body and what is no dynamic body.
    pub fn predict_alone(&mut self, time: f64, kind: Kind, body: u32, b: BodyId) {
        let stamp_a = self.stamps[body as usize];
        self.queue.push(Predicted { time, kind, a: body, b, stamp_a, stamp_b: 0 });
    }

    /// A prediction for two bodies.
    pub fn predict(&mut self, time: f64, kind: Kind, pair: Pair) {
        let stamp_a = self.stamps[pair.first() as usize];
        let stamp_b = pair.second().map_or(0, |b| self.stamps[b as usize]);
        self.queue.push(Predicted { time, kind, a: pair.first(), b: pair.b, stamp_a, stamp_b });
    }

    /// Whether a body moves for nobody: it is static, or captured.
    #[inline]
    pub fn is_fixed(&self, id: BodyId) -> bool {
        id.dynamic().is_none_or(|body| self.captured.contains(&body))
    }

    /// 1/kg; 0 for a captured body.
    pub fn inverse_mass(&self, model: &Model, body: u32) -> f64 {
        if self.captured.contains(&body) { 0.0 } else { model.dynamic(body).inverse_mass() }
    }

    /// How a body moves at a time, for people: a body in contact that neither moves nor is driven rests, and so does
    /// a captured one.
    pub fn contact_state(&self, body: u32, time: f64) -> ContactState {
        let path = self.path(body);
        self.held(body).state(path.velocity(time), path.acceleration(time))
    }

    /// Notes the segment that a body has just begun, if the motion is recorded.
    pub fn note_begun(&mut self, body: u32) {
        if self.trace.is_on {
            let mut trace = std::mem::take(&mut self.trace);
            trace.push(body, self.path(body));
            self.trace = trace;
        }
    }

    /// Labels the segments begun since the last call with the event from which on they are seen.
    pub fn seal_trace(&mut self, event: u64, by_event: bool) {
        if self.trace.has_unsealed() {
            let mut trace = std::mem::take(&mut self.trace);
            trace.seal(event, by_event, |body| (self.held(body), self.turns.get(body as usize).copied()));
            self.trace = trace;
        }
    }

    fn held(&self, body: u32) -> Held {
        match self.role(body) {
            Role::Member(_) => Held::Stepped,
            Role::Frozen(_) => Held::Frozen,
            Role::Outside if !self.contacts[body as usize].is_empty() => Held::Contact(self.hold(body)),
            Role::Outside if self.captured.contains(&body) => Held::Contact(self.hold(body)),
            Role::Outside => Held::Nothing,
        }
    }

    /// What a dynamic body is to stepped groups.
    pub fn role(&self, body: u32) -> Role {
        self.dense.as_ref().map_or(Role::Outside, |dense| dense.role(body))
    }

    /// The lasting contact of a pair.
    pub fn contact(&self, pair: Pair) -> Option<&Contact> {
        self.contacts[pair.first() as usize].iter().find(|contact| contact.other == pair.b)
    }

    /// Whether the dynamic bodies that a body is in contact with list the same contact.
    pub fn has_symmetric_contacts(&self, body: u32) -> bool {
        let listed = |back: &Contact, contact: &Contact| {
            back.other.dynamic() == Some(body) && back.settles_at == contact.settles_at
        };
        self.contacts[body as usize].iter().all(|contact| {
            let other = contact.other.dynamic();
            other.is_none_or(|other| self.contacts[other as usize].iter().any(|back| listed(back, contact)))
        })
    }

    /// Notes that two dynamic bodies lie against each other.
    pub fn note_touching(&mut self, a: u32, b: u32) {
        for (body, other) in [(a, b), (b, a)] {
            if !self.touching[body as usize].contains(&other) {
                self.touching[body as usize].push(other);
            }
        }
    }

    /// Forgets what a body lies against: it begins another motion.
    pub fn forget_touching(&mut self, body: u32) {
        for other in std::mem::take(&mut self.touching[body as usize]) {
            self.touching[other as usize].retain(|back| *back != body);
        }
    }
}
