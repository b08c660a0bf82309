//! The events a simulation reports: what happened, when, where, to whom, how hard.

use glam::DVec3;

/// A body of a running simulation. Dynamic and static bodies are numbered apart, both in UserID order; those added later
/// come after them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BodyRef {
    Dynamic(u32),
    Static(u32),
}

impl BodyRef {
    /// No body: what an edit of a force is recorded with.
    pub const NONE: Self = Self::Dynamic(u32::MAX);
}

/// What kind of event a ledger row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum EventKind {
    /// Two surfaces meet and part again.
    Impact,
    /// A body's bounces have ended: it lies still, or goes on as a slide.
    Rest,
    /// A body in contact starts to move along the surface.
    Slide,
    /// A body in contact leaves the surface: it was lifted, or the face ended.
    LiftOff,
    /// A body passed a point attractor within the core radius.
    SingularPass,
    /// A body bound to the core of a point attractor stays there from now on, until an impact throws it out or an
    /// edit takes the attractor away.
    Captured,
    /// An impact in an inelastic collapse: one of more than anyone could list, at one instant or closely after
    /// each other. What is left of them is taken plastically, and the bodies do not bounce off each other until
    /// it has been quiet for a while.
    Collapse,
    /// The scene was edited while it ran.
    Edit,
    /// Bodies that touch too often for events are stepped from now on: `bodies` of them, for which the one of the
    /// smallest UserID stands.
    Dense,
    /// Stepped bodies came to rest together.
    GroupRest,
    /// A body in contact goes on without slip.
    Roll,
}

impl EventKind {
    pub const ALL: [Self; 11] = [
        Self::Impact,
        Self::Rest,
        Self::Slide,
        Self::LiftOff,
        Self::SingularPass,
        Self::Captured,
        Self::Collapse,
        Self::Edit,
        Self::Dense,
        Self::GroupRest,
        Self::Roll,
    ];

    /// The name used in files: `impact`, `rest`, `slide`, `lift_off`, `singular_pass`, `captured`,
    /// `collapse`, `edit`, `dense`, `group_rest`, `roll`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Rest => "rest",
            Self::Slide => "slide",
            Self::LiftOff => "lift_off",
            Self::SingularPass => "singular_pass",
            Self::Captured => "captured",
            Self::Collapse => "collapse",
            Self::Edit => "edit",
            Self::Dense => "dense",
            Self::GroupRest => "group_rest",
            Self::Roll => "roll",
        }
    }

    /// One line for the help.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Impact => "two surfaces met and parted again",
            Self::Rest => "the bounces of a body ended; it lies or slides",
            Self::Slide => "a body in contact began to move along the surface",
            Self::LiftOff => "a body in contact left the surface",
            Self::SingularPass => "a body passed a point attractor within the core radius",
            Self::Captured => "a body bound to the core of a point attractor stays there from now on",
            Self::Collapse => "inelastic collapse: impacts without end, taken plastically until it is quiet",
            Self::Edit => "the scene was edited while it ran",
            Self::Dense => "bodies that touch too often for events are stepped together from now on",
            Self::GroupRest => "bodies that were stepped together came to rest",
            Self::Roll => "a body in contact went on without slip",
        }
    }
}

/// One row of the ledger. Bit-identical for every way of sampling the same scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// 1 for the first event of a run.
    pub seq: u64,
    /// Model time, s.
    pub time: f64,
    pub kind: EventKind,
    /// The body with the smaller UserID (for one body alone: that body).
    pub a: BodyRef,
    /// `None` for events of one body alone.
    pub b: Option<BodyRef>,
    /// A point on the surface where they touch, m.
    pub point: DVec3,
    /// Unit vector from `a` to `b` at the contact; zero for events of one body alone.
    pub normal: DVec3,
    /// N·s, ≥ 0.
    pub impulse: f64,
    /// Normal component of the velocity of `b` relative to `a` along `normal`: negative when closing, m/s.
    pub vn_before: f64,
    pub vn_after: f64,
    /// Number of the impact group, from 1: the contacts of bodies that touch are resolved together and share
    /// it, one row each; stepped bodies have the number that they entered with, and none if an edit woke them. 0 for other
    /// events.
    pub group: u64,
    /// Which row of its group this is, from 1, and how many there are; both 0 without a group.
    pub row_in_group: [u32; 2],
    /// How many bodies it is about.
    pub bodies: u32,
    /// Distance of the surfaces where the search for the time of contact ended, m: what its root left over. 0 where
    /// nothing was searched for.
    pub gap: f64,
    /// In how many rounds the contacts of the impact group were resolved; 0 for two bodies alone, by Newton's law.
    pub rounds: u32,
}

impl Event {
    /// An event of one body that exchanges no impulse, not yet numbered.
    pub(super) fn of_one(time: f64, kind: EventKind, body: BodyRef, point: DVec3) -> Self {
        Self {
            seq: 0,
            time,
            kind,
            a: body,
            b: None,
            point,
            normal: DVec3::ZERO,
            impulse: 0.0,
            vn_before: 0.0,
            vn_after: 0.0,
            group: 0,
            row_in_group: [0; 2],
            bodies: 1,
            gap: 0.0,
            rounds: 0,
        }
    }

    /// An impact for tests of lists of events.
    #[cfg(test)]
    pub(crate) fn impact_of_one(seq: u64, time: f64, body: BodyRef, impulse: f64) -> Self {
        let event = Self::of_one(time, EventKind::Impact, body, DVec3::ZERO);
        Self { seq, normal: DVec3::X, impulse, vn_before: -3.0, vn_after: 1.0, ..event }
    }
}
