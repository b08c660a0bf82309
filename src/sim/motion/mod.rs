//! How bodies move between events: closed forms where the forces are constant, a series where not.

mod collocation;
mod control;
mod coupled;
mod face;
mod law;
mod plunge;
mod quadrature;
mod radau;
mod smoothness;
mod straight;
mod tolerance;

pub(super) use coupled::{CoupledStart, Step, coupled_step};
pub(super) use face::{Going, OnFace, go_on_face};
pub(super) use law::{begin_segment, begin_stay, check, place, step_hint};
pub(super) use plunge::turn_back;
pub(super) use quadrature::integrate;

/// Why a body has no motion from here on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SegmentError {
    NotFinite,
    /// The step fell below the resolution of time: the field is singular or not smooth here.
    Stalled,
    /// The centre lies within the core of a point attractor, where its force has no meaning.
    InCore,
    /// It passes a tile in less than the resolution of time.
    TooFast,
}
