//! Where the moving bodies have been recently, fading with age.

use crate::view::DrawList;
use crate::view::stage::{Pen, Stage};

/// More pieces than this are thinned to the newest of each body.
const MOST_PIECES: usize = 60_000;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(trails) = stage.input.trails else { return };
    let drawn = stage.bodies.iter().filter_map(|posed| Some((posed, trails.get(posed.body.key)?)));
    let most_each = MOST_PIECES / drawn.clone().count().max(1);
    for (posed, trail) in drawn {
        let pieces = trail.points.len().saturating_sub(1).min(most_each);
        let first = trail.points.len().saturating_sub(pieces + 1);
        for (i, (from, to)) in trail.points.iter().zip(trail.points.iter().skip(1)).skip(first).enumerate() {
            let alpha = 30 + (190 * (i + 1) / pieces) as u8;
            let pen = Pen::hidden_by_bodies(posed.color.with_alpha(alpha), 1.75);
            stage.add_line(list, [*from, *to], pen);
        }
    }
}
