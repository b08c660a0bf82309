//! Where the moving bodies have been and, as far as it is recorded, where they go: fading with the distance in time.

use glam::DVec3;

use crate::view::stage::{Pen, Posed, Stage};
use crate::view::{Color, DrawList};

/// How opaque the ways are at the body.
const PAST: f64 = 220.0;
const FUTURE: f64 = 110.0;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(frame) = stage.input.frame else { return };
    for path in frame.paths.iter() {
        let Some(posed) = stage.bodies.iter().find(|posed| posed.body.key == path.key) else { continue };
        add_way(stage, list, posed, path.past.iter().rev(), PAST);
        add_way(stage, list, posed, path.future.iter(), FUTURE);
    }
    if frame.bodies.len() > frame.paths.len() && !frame.paths.is_empty() {
        list.notes.push(format!("Paths: of the first {} bodies.", frame.paths.len()));
    }
}

/// From the body on.
fn add_way<'a>(
    stage: &Stage<'_>,
    list: &mut DrawList,
    posed: &Posed<'_>,
    way: impl ExactSizeIterator<Item = &'a DVec3> + Clone,
    opacity: f64,
) {
    let count = way.len() as f64;
    for (nth, (from, to)) in way.clone().zip(way.skip(1)).enumerate() {
        let alpha = 25.0 + (opacity - 25.0) * (1.0 - nth as f64 / count);
        let color: Color = posed.color.with_alpha(alpha as u8);
        stage.add_line(list, [*from, *to], Pen::hidden_by_bodies(color, 1.75));
    }
}
