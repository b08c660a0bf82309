//! The motion as it is made: every piece of it that a body begins, for whoever records the run.

use glam::DVec3;

use super::event::BodyRef;
use super::place::Place;
use super::report::{BodyState, ContactState, Rotation};
use super::segment::{Path, Segment, Series};
use super::turn::{Hold, Turn};

/// How one body moves from one moment on, until its next piece begins: a polynomial in the time since its start. It gives
/// the same bits as the simulation that it was taken from.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    start: f64,
    x: DVec3,
    v: DVec3,
    a: DVec3,
    /// Of integrated motion only; apart, since most have none.
    series: Option<Box<Integrated>>,
    held: Held,
    /// Where bodies rub.
    turn: Option<Box<Turn>>,
}

/// The series of a field segment with the length of its step, s.
#[derive(Clone, Debug, PartialEq)]
struct Integrated {
    step: f64,
    series: Series,
}

/// What holds a body while it follows a piece.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Held {
    #[default]
    Nothing,
    /// A lasting contact, or the core of an attractor; with what that lets it do where bodies rub.
    Contact(Hold),
    /// It is stepped with others.
    Stepped,
    /// It lies still with others that were stepped.
    Frozen,
}

impl Held {
    /// How a body moves with this velocity and acceleration, for people: one in contact that neither moves nor is driven
    /// rests, and so does a captured one.
    pub fn state(self, velocity: DVec3, acceleration: DVec3) -> ContactState {
        let still = velocity == DVec3::ZERO && acceleration == DVec3::ZERO;
        match self {
            Self::Nothing => ContactState::Flight,
            Self::Stepped => ContactState::Stepped,
            Self::Frozen => ContactState::Rest,
            Self::Contact(Hold::Rolls) if !still => ContactState::Roll,
            Self::Contact(Hold::Slides) => ContactState::Slide,
            Self::Contact(_) if still => ContactState::Rest,
            Self::Contact(_) => ContactState::Slide,
        }
    }
}

/// A piece of a body's motion, and from when on it is seen.
#[derive(Clone, Debug)]
pub struct Begun {
    pub body: BodyRef,
    /// Number of the event from which on the body follows it; of events before, of the last one.
    pub event: u64,
    /// Whether it is seen right after that event, or the edit that began it; otherwise once all that happens at its
    /// start has happened.
    pub by_event: bool,
    pub piece: Piece,
}

/// Pieces begun since they were taken last.
#[derive(Clone, Debug, Default)]
pub(super) struct Trace {
    pub is_on: bool,
    begun: Vec<Begun>,
    /// How many of them are labelled with their event.
    sealed: usize,
}

/// Pieces for which room is kept from one portion of work to the next.
const KEPT: usize = 1024;

impl Piece {
    pub(super) fn new(path: Path<'_>) -> Self {
        let Segment { start, x, v, a, step, .. } = *path.segment;
        let series = path.series.map(|series| Box::new(Integrated { step, series: *series }));
        Self { start, x, v, a, series, held: Held::Nothing, turn: None }
    }

    /// Model time, s.
    pub fn start(&self) -> f64 {
        self.start
    }

    #[cfg(test)]
    pub(crate) fn starting_at(&self, start: f64) -> Self {
        Self { start, ..self.clone() }
    }

    /// Highest power of the time: 0 at rest, 1 straight, 2 a parabola, 9 of integrated motion.
    pub fn degree(&self) -> u32 {
        match () {
            () if self.series.is_some() => 9,
            () if self.a != DVec3::ZERO => 2,
            () if self.v != DVec3::ZERO => 1,
            () => 0,
        }
    }

    /// Centre at a time, m.
    pub fn position(&self, time: f64) -> DVec3 {
        self.with_path(|path| path.position(time))
    }

    /// State of the body at a time while it follows this piece.
    pub fn at(&self, time: f64) -> BodyState {
        let (position, velocity, acceleration) =
            self.with_path(|path| (path.position(time), path.velocity(time), path.acceleration(time)));
        let contact = self.held.state(velocity, acceleration);
        let turn = self
            .turn
            .as_ref()
            .map(|turn| Rotation { orientation: turn.orientation_at(time), spin: turn.spin_at(time) });
        BodyState { position, velocity, acceleration, contact, turn }
    }

    pub(super) fn place_and_velocity(&self, time: f64) -> (Place, DVec3) {
        self.with_path(|path| (path.place(time), path.velocity(time)))
    }

    /// Bytes that it takes, those of its series included.
    pub fn bytes(&self) -> usize {
        let series = self.series.as_ref().map_or(0, |_| size_of::<Integrated>());
        let turn = self.turn.as_ref().map_or(0, |_| size_of::<Turn>());
        size_of::<Self>() + series + turn
    }

    fn with_path<R>(&self, read: impl FnOnce(Path<'_>) -> R) -> R {
        let step = self.series.as_ref().map_or(0.0, |integrated| integrated.step);
        let segment = Segment { step, ..Segment::ballistic(self.start, self.x, self.v, self.a) };
        read(Path { segment: &segment, series: self.series.as_ref().map(|integrated| &integrated.series) })
    }
}

impl Trace {
    /// Notes what a body follows from now on.
    pub fn push(&mut self, body: u32, path: Path<'_>) {
        if self.is_on {
            self.begun.push(Begun {
                body: BodyRef::Dynamic(body),
                event: 0,
                by_event: false,
                piece: Piece::new(path),
            });
        }
    }

    /// Labels what was begun since the last call with the event that it is seen from, and with how the bodies are held
    /// and turn.
    pub fn seal(&mut self, event: u64, by_event: bool, how: impl Fn(u32) -> (Held, Option<Turn>)) {
        for begun in self.begun.iter_mut().skip(self.sealed) {
            (begun.event, begun.by_event) = (event, by_event);
            if let BodyRef::Dynamic(body) = begun.body {
                let (held, turn) = how(body);
                begun.piece.held = held;
                begun.piece.turn = turn.map(Box::new);
            }
        }
        self.sealed = self.begun.len();
    }

    pub fn has_unsealed(&self) -> bool {
        self.sealed < self.begun.len()
    }

    pub fn take(&mut self, each: impl FnMut(Begun)) {
        // Most portions of work begin nothing.
        if !self.begun.is_empty() {
            self.sealed = 0;
            self.begun.drain(..).for_each(each);
            // The first portion has a piece of every body, later ones have few.
            self.begun.shrink_to(KEPT);
        }
    }
}
