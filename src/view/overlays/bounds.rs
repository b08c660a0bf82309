//! Axis-aligned boxes around the bodies.

use crate::view::DrawList;
use crate::view::bounds::body_bounds;
use crate::view::stage::{Pen, Stage};

const MOST: usize = 2000;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let pen = Pen::hidden_by_bodies(stage.palette.bounds, 1.0);
    for posed in stage.bodies.iter().take(MOST) {
        stage.add_box(list, body_bounds(posed.body, posed.position), pen);
    }
    if stage.bodies.len() > MOST {
        list.notes.push(format!("Bounding boxes: the first {MOST} of {} bodies.", stage.bodies.len()));
    }
}
