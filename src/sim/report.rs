//! What can be read off a simulation: states, energies, counters, the plan, the tiles.

use glam::{DQuat, DVec3};

use super::event::BodyRef;

/// How a dynamic body is moving.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ContactState {
    Flight,
    /// In lasting contact and still.
    Rest,
    /// In lasting contact and moving along it.
    Slide,
    /// Stepped with others that it touches too often for events.
    Stepped,
    /// In lasting contact and moving along it without slip.
    Roll,
}

impl ContactState {
    /// `flight`, `rest`, `slide`, `roll` or `stepped`, as files and the window write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flight => "flight",
            Self::Rest => "rest",
            Self::Slide => "slide",
            Self::Stepped => "stepped",
            Self::Roll => "roll",
        }
    }

    /// What that is, for a tooltip.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Flight => "moves freely",
            Self::Rest => "lies still on what it touches",
            Self::Slide => "moves along what it touches",
            Self::Roll => "rolls on what it touches without slipping",
            Self::Stepped => "touches others too often for single events, and is stepped together with them",
        }
    }
}

/// An impact that is to come, unless one of the bodies meets another before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedImpact {
    /// Model time, s.
    pub time: f64,
    /// The body with the smaller UserID.
    pub a: BodyRef,
    pub b: BodyRef,
}

/// Bodies that are stepped because they touch too often for events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteppedBodies {
    pub count: usize,
    /// Since when some are without a break, s.
    pub since: f64,
    /// Length of a step, which is halved where it must be, s.
    pub step: f64,
}

/// What two bodies that are stepped, or came to rest so, press on each other with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce {
    /// The first is dynamic.
    pub a: BodyRef,
    pub b: BodyRef,
    /// On the surface of the first, m.
    pub point: DVec3,
    /// Unit vector from the first to the second.
    pub normal: DVec3,
    /// In the last step, N.
    pub force: f64,
}

/// State of one dynamic body at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyState {
    /// Centre, m.
    pub position: DVec3,
    /// m/s.
    pub velocity: DVec3,
    /// m/s², of the motion, so contact forces are included.
    pub acceleration: DVec3,
    pub contact: ContactState,
    /// `None` where nothing rubs, so that spins stay what they are.
    pub turn: Option<Rotation>,
}

/// How a sphere is turned, and turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Unit quaternion, world from body.
    pub orientation: DQuat,
    /// rad/s, in the axes of the map.
    pub spin: DVec3,
}

/// Energies in joules.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy {
    pub kinetic: f64,
    /// `None` when a force has no potential.
    pub potential: Option<f64>,
    /// `None` when a force has no potential.
    pub total: Option<f64>,
    /// (E − E₀ + impact losses + dissipated work − work of edits) over the largest of |E₀|, the kinetic
    /// energy at the start and now, the energy lost, and that put in by edits. `None` also after a force
    /// without a potential was removed, for what it did is not known.
    pub residual: Option<f64>,
}

/// Linear momentum in kg·m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momentum {
    pub value: DVec3,
    /// |p − p₀ − ∫F dt − impulses of statics| over the largest of Σ m|v| at the start and now, and the
    /// impulses given.
    pub residual: f64,
}

/// Angular momentum about the map's origin, of centres and of spins, in kg·m²/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularMomentum {
    pub value: DVec3,
    /// |L − L₀ − ∫x×F dt − impulses of statics at their contact points| over the largest of Σ m|x||v| + I|ω| at the
    /// start and now, and what was given.
    pub residual: f64,
}

/// What the core has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Ledger rows by kind, in the order of [`super::EventKind::ALL`].
    pub events: [u64; 11],
    /// Pairs whose time of impact was looked for: of most of them a bound told that they miss each other.
    pub pair_tests: u64,
    /// Times a body moved to other tiles.
    pub tile_crossings: u64,
    /// Segments begun.
    pub segments: u64,
    /// Force evaluations of the field integrator.
    pub force_evaluations: u64,
    /// Times a body (`fixed`) or a local set (`thesis`) ran into the limit of collisions of a Δt, which left the rest as overlap; in `exact`, times the search for motions that
    /// all contacts allow ran into its limit of rounds, and the best found was taken.
    pub given_up: u64,
    /// Predicted events dropped because a body had changed since.
    pub stale_events: u64,
    /// Steps of stepped groups, one for each component; and how often one was halved.
    pub steps: u64,
    pub halvings: u64,
    /// Contacts in those steps, and sweeps over them.
    pub contacts: u64,
    pub sweeps: u64,
}

impl Counters {
    pub fn total_events(&self) -> u64 {
        self.events.iter().sum()
    }
}

/// What the scene needs, decided when it is compiled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    pub dynamic_bodies: usize,
    pub static_bodies: usize,
    /// How bodies move between events: `ballistic` (closed form) or `field` (integrated).
    pub motion: &'static str,
    /// Shape pairs that can meet.
    pub pairs: Vec<&'static str>,
    /// Whether a body can come to rest.
    pub lasting_contact: bool,
    /// Whether bodies rub, so that they turn.
    pub spin: bool,
    /// Whether bodies that touch too often for events may be stepped.
    pub stepped_groups: bool,
    /// Length of their steps, s; 0 where there are none, and while nothing moves or drives the bodies.
    pub group_step: f64,
    /// What was not stored and not computed because nothing in the scene needs it.
    pub left_out: Vec<&'static str>,
}

/// The tile grid at one time, for overlays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tiling {
    /// Metres per tile.
    pub tile_size: DVec3,
    pub tiles: [u32; 3],
    /// Occupied tiles: indices, statics in it, dynamic bodies in it. Sorted.
    pub occupied: Vec<([u32; 3], u32, u32)>,
    /// Set when more tiles were occupied than are listed.
    pub truncated: bool,
}
