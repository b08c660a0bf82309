//! Marks on bodies in lasting contact: a square at rest, a ring while sliding, a disc while rolling, a diamond
//! while stepped.

use crate::scene::Shape;
use crate::sim::ContactState;
use crate::view::stage::{Posed, Stage};
use crate::view::{Color, DrawList, Point, PointShape};

/// Sizes of a mark, points: on a large body, and on the smallest.
const SIZES: (f64, f64) = (11.0, 4.0);
/// Share of a body's width that a mark may hide in between, so that a heap is seen.
const SHARE: f64 = 0.4;
/// The same in a crowd, where marks are beside each other and have edges of their own.
const SHARE_IN_CROWD: f64 = 0.2;
/// All marks together hide no more than a square of this side, points: they are over all bodies, also of those inside a heap.
const ALL: f64 = 60.0;
/// What is smaller cannot be seen, points.
const LEAST: f64 = 1.0;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let marked = stage.bodies.iter().filter_map(|posed| Some((posed, mark(stage, posed)?)));
    let marked: Vec<_> = marked.filter(|(posed, _)| stage.shows_marks_of(posed)).collect();
    let most = (ALL / libm::sqrt(marked.len() as f64)).max(LEAST);
    for (posed, (shape, color)) in marked {
        let size = size(stage, posed).min(most) as f32;
        list.points.push(Point { position: list.local(posed.position), color, size, shape });
    }
}

/// What is drawn on a body, if anything.
fn mark(stage: &Stage<'_>, posed: &Posed<'_>) -> Option<(PointShape, Color)> {
    match posed.now?.contact {
        ContactState::Rest => Some((PointShape::Square, stage.palette.rest)),
        ContactState::Slide => Some((PointShape::Ring, stage.palette.slide)),
        ContactState::Roll => Some((PointShape::Disc, stage.palette.roll)),
        ContactState::Stepped => Some((PointShape::Diamond, stage.palette.stepped)),
        ContactState::Flight => None,
    }
}

fn size(stage: &Stage<'_>, posed: &Posed<'_>) -> f64 {
    let Shape::Sphere { radius } = posed.body.shape else { return SIZES.0 };
    let width = 2.0 * radius / stage.metres_per_point(posed.position);
    if stage.is_crowd() {
        return (SHARE_IN_CROWD * width).clamp(LEAST, SIZES.0);
    }
    (SHARE * width).max(SIZES.1).min(SIZES.0)
}
