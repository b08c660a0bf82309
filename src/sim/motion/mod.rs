//! How bodies move between events: closed forms where the forces are constant, a series where not.

mod close_pass;
mod collocation;
mod control;
mod coupled;
mod held;
mod law;
mod plunge;
mod quadrature;
mod radau;
mod smoothness;
mod tolerance;

pub(super) use close_pass::{pass_core, predict_core_passes};
pub(super) use coupled::{CoupledStart, Step, coupled_step};
pub(super) use held::{Held, driven, free_if_struck, free_unheld};
pub(super) use law::{applied_force, begin_segment, check, place, step_hint, subject_at};
pub(super) use plunge::Plunges;
pub(super) use quadrature::integrate;

/// Why a body has no motion from here on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SegmentError {
    NotFinite,
    /// The step fell below the resolution of time: the field is singular or not smooth here.
    Stalled,
    /// The centre lies within the core of a point attractor, where its force has no meaning.
    InCore,
}
