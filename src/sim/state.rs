//! Everything that moves, as columns over the dynamic bodies.

use std::collections::VecDeque;

use glam::DVec3;

use super::account::Account;
use super::compile::Start;
use super::contact::{Contact, Pair, Partner};
use super::model::Model;
use super::motion::{Held, Plunges};
use super::predict::Mover;
use super::queue::{Kind, Predicted, Queue};
use super::segment::{Path, Segment, Series};
use super::stepping::OpenStep;
use super::tiles::{MovingTiles, TileRange};
use super::{Counters, Event};

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
    /// Integrated motion; empty while all forces are uniform and no surface is round.
    pub fields: Vec<FieldColumn>,
    /// Bodies close to an attractor.
    pub plunges: Plunges,
    /// Bodies captured by an attractor.
    pub held: Held,
    /// Lasting contacts; most bodies have none.
    pub contacts: Vec<Vec<Contact>>,
    /// Dynamic bodies that lie against each body and hardly move away, without lasting contact.
    pub touching: Vec<Vec<u32>>,
    /// The impacts of each body that follow each other closely.
    pub cascades: Vec<Cascade>,
    pub moving: MovingTiles,
    pub queue: Queue,
    /// The Δt that a method which steps by it is in.
    pub step: Option<Box<OpenStep>>,
    /// Events made but not yet handed out.
    pub outbox: VecDeque<Event>,
    pub sequence: u64,
    pub group: u64,
    pub account: Account,
    pub counters: Counters,
    pub scratch: Scratch,
}

/// What the field integrator keeps for a body.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FieldColumn {
    pub series: Series,
    /// Step to try next, s; 0 when unknown.
    pub next_step: f64,
}

/// A run of impacts of one body, each within `contact_duration` of the one before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cascade {
    pub last_impact: f64,
    pub length: u32,
}

/// Marks that tell which bodies were seen in the present look through the tiles.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    pub epoch: u32,
    pub seen_moving: Vec<u32>,
    pub seen_fixed: Vec<u32>,
    pub found_moving: Vec<u32>,
    pub found_fixed: Vec<u32>,
}

impl State {
    /// All bodies at their start, at t = 0, in no tile and with nothing predicted.
    pub fn new(starts: &[Start]) -> Self {
        let mut state = Self {
            now: 0.0,
            reached: 0.0,
            until: 0.0,
            segments: Vec::with_capacity(starts.len()),
            stamps: Vec::with_capacity(starts.len()),
            registered: Vec::with_capacity(starts.len()),
            fields: Vec::new(),
            plunges: Plunges::default(),
            held: Held::default(),
            contacts: Vec::with_capacity(starts.len()),
            touching: Vec::with_capacity(starts.len()),
            cascades: Vec::with_capacity(starts.len()),
            moving: MovingTiles::default(),
            queue: Queue::default(),
            step: None,
            outbox: VecDeque::new(),
            sequence: 0,
            group: 0,
            account: Account::default(),
            counters: Counters::default(),
            scratch: Scratch::default(),
        };
        for start in starts {
            state.push_body(*start);
        }
        state
    }

    /// Adds a dynamic body's row to every column, at rest in no tile; gives its index.
    pub fn push_body(&mut self, start: Start) -> u32 {
        let index = self.segments.len() as u32;
        self.segments.push(Segment::ballistic(self.now, start.position, start.velocity, DVec3::ZERO));
        self.stamps.push(0);
        self.registered.push(TileRange::default());
        self.contacts.push(Vec::new());
        self.touching.push(Vec::new());
        self.cascades.push(Cascade { last_impact: f64::NEG_INFINITY, length: 0 });
        index
    }

    pub fn path(&self, body: u32) -> Path<'_> {
        let segment = &self.segments[body as usize];
        let series = (segment.step > 0.0).then(|| &self.fields[body as usize].series);
        Path { segment, series }
    }

    pub fn mover<'a>(&'a self, model: &Model, body: u32) -> Mover<'a> {
        Mover { path: self.path(body), radius: model.radii[body as usize] }
    }

    pub fn motion_bytes(&self) -> usize {
        size_of_val(self.segments.as_slice()) + size_of_val(self.fields.as_slice())
    }

    pub fn position(&self, body: u32, time: f64) -> DVec3 {
        self.path(body).position(time)
    }

    pub fn velocity(&self, body: u32, time: f64) -> DVec3 {
        self.path(body).velocity(time)
    }

    /// Whether a prediction was made for the segments that its bodies still follow.
    pub fn holds(&self, predicted: &Predicted) -> bool {
        self.stamps[predicted.a as usize] == predicted.stamp_a
            && (!predicted.kind.is_of_pair() || self.stamps[predicted.b as usize] == predicted.stamp_b)
    }

    /// A prediction for one body (and perhaps something that does not move).
    pub fn predict_one(&mut self, time: f64, kind: Kind, a: u32, b: u32) {
        let stamp_a = self.stamps[a as usize];
        self.queue.push(Predicted { time, kind, a, b, stamp_a, stamp_b: 0 });
    }

    /// A prediction for two dynamic bodies.
    pub fn predict_pair(&mut self, time: f64, kind: Kind, a: u32, b: u32) {
        let (a, b) = (a.min(b), a.max(b));
        let (stamp_a, stamp_b) = (self.stamps[a as usize], self.stamps[b as usize]);
        self.queue.push(Predicted { time, kind, a, b, stamp_a, stamp_b });
    }

    /// A prediction for the bodies of a pair: `kinds` are for a dynamic and a static partner.
    pub fn predict_of(&mut self, time: f64, kinds: [Kind; 2], pair: Pair) {
        match pair.partner {
            Partner::Dynamic(other) => self.predict_pair(time, kinds[0], pair.a, other),
            Partner::Static(fixture) => self.predict_one(time, kinds[1], pair.a, fixture),
        }
    }

    /// 1/kg; 0 for a body that is held and moves for nobody.
    pub fn inverse_mass(&self, model: &Model, body: u32) -> f64 {
        if self.held.contains(body) { 0.0 } else { 1.0 / model.movers[body as usize].mass }
    }

    /// Whether a body is in lasting contact with a partner.
    pub fn is_in_contact(&self, body: u32, partner: Partner) -> bool {
        self.contacts[body as usize].iter().any(|contact| contact.partner == partner)
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
