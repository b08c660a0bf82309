//! How bodies move between events: closed forms where the forces are constant, a series where not.

mod law;
mod plunge;
mod quadrature;
mod radau;

pub(super) use law::{SegmentError, applied_force, begin_segment};
pub(super) use plunge::{Plunge, turn_back};
pub(super) use quadrature::integrate;
