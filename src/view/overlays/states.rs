//! Marks on bodies in lasting contact: a square at rest, a ring while sliding, a disc while rolling, a diamond
//! while stepped.

use crate::scene::Shape;
use crate::sim::ContactState;
use crate::view::stage::{Posed, Stage};
use crate::view::{DrawList, Point, PointShape};

/// Sizes of a mark, points: on a large body, and on the smallest.
const SIZES: (f64, f64) = (11.0, 4.0);
/// Share of a body's width that a mark may hide in between, so that a heap is seen.
const SHARE: f64 = 0.4;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    for posed in &stage.bodies {
        let (shape, color) = match posed.now.map(|now| now.contact) {
            Some(ContactState::Rest) => (PointShape::Square, stage.palette.rest),
            Some(ContactState::Slide) => (PointShape::Ring, stage.palette.slide),
            Some(ContactState::Roll) => (PointShape::Disc, stage.palette.roll),
            Some(ContactState::Stepped) => (PointShape::Diamond, stage.palette.stepped),
            Some(ContactState::Flight) | None => continue,
        };
        list.points.push(Point {
            position: list.local(posed.position),
            color,
            size: size(stage, posed),
            shape,
        });
    }
}

fn size(stage: &Stage<'_>, posed: &Posed<'_>) -> f32 {
    let Shape::Sphere { radius } = posed.body.shape else { return SIZES.0 as f32 };
    let width = 2.0 * radius / stage.metres_per_point(posed.position);
    (SHARE * width).max(SIZES.1).min(SIZES.0) as f32
}
