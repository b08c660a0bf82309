//! How bodies move between events: closed forms where the forces are constant, a series where not.

mod law;
mod quadrature;
mod radau;

pub(super) use law::{SegmentError, applied_force, begin_segment};
pub(super) use quadrature::integrate;
