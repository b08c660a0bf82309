//! Ready parts to build from, each with its sizes asked in place.

mod balls;
mod boxes;
mod inputs;
mod orbit;
mod pegboard;
mod slopes;
mod table;
mod view_plate;

pub(super) use balls::{CRADLE, PYRAMID, RACK};
pub(super) use boxes::{BLOCK, CONTAINER, OPEN_BOX, ROOM};
pub(super) use orbit::ORBIT;
pub(super) use pegboard::PEGBOARD;
pub(super) use slopes::{FUNNEL, RAMP, STAIRS};
pub(super) use table::TABLE;
pub(super) use view_plate::VIEW_PLATE;
