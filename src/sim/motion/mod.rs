//! How bodies move between events: closed forms where the forces are constant, a series where not.

mod coupled;
mod law;
mod plunge;
mod quadrature;
mod radau;

pub(super) use coupled::{Step, coupled_step};
pub(super) use law::{SegmentError, applied_force, begin_segment, check, place, step_hint, subject_at};
pub(super) use plunge::{Plunge, turn_back};
pub(super) use quadrature::integrate;
