//! Many from one, and order among many.

mod align;
mod array;
mod fill;
mod inputs;
mod mirror;
mod pack;

pub(super) use align::{ALIGN, DISTRIBUTE};
pub(super) use array::{ARRAY, CIRCLE, LINE};
pub(super) use fill::FILL;
pub(super) use mirror::MIRROR;
pub(super) use pack::PACK;
