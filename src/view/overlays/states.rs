//! Marks on bodies in lasting contact: a square at rest, a ring while sliding, a diamond while stepped.

use crate::sim::ContactState;
use crate::view::stage::Stage;
use crate::view::{DrawList, Point, PointShape};

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    for posed in &stage.bodies {
        let (shape, color) = match posed.now.map(|now| now.contact) {
            Some(ContactState::Rest) => (PointShape::Square, stage.palette.rest),
            Some(ContactState::Slide) => (PointShape::Ring, stage.palette.slide),
            Some(ContactState::Stepped) => (PointShape::Diamond, stage.palette.stepped),
            Some(ContactState::Flight) | None => continue,
        };
        list.points.push(Point { position: list.local(posed.position), color, size: 11.0, shape });
    }
}
