//! The edges of the map.

use crate::view::DrawList;
use crate::view::stage::{Pen, Stage};

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    stage.add_box(list, stage.map, Pen::hidden_by_bodies(stage.palette.map_box, 1.0));
}
