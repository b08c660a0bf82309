//! Forces as marks in the scene: a diamond for an attractor, an arrow for a uniform field.

use glam::DVec3;

use super::camera::is_drawable;
use super::{Arrow, DrawList, Point, PointShape, stage::Stage};
use crate::scene::{Force, ForceKind, Scene};

/// Length of a uniform field's arrow, points.
const ARROW_POINTS: f64 = 46.0;

/// Forces that have a mark, with its place.
pub(super) fn visible(scene: &Scene) -> impl Iterator<Item = (&Force, DVec3)> {
    scene
        .forces
        .iter()
        .filter(|force| !force.hidden)
        .filter_map(|force| Some((force, force.kind.position()?)))
        .filter(|(_, place)| is_drawable(*place))
}

pub(super) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    for (force, place) in visible(stage.input.scene) {
        let selected = stage.input.selection.contains(&force.key);
        let hovered = stage.input.hovered == Some(force.key);
        let color = match (selected, hovered) {
            (true, _) => stage.palette.selected,
            (_, true) => stage.palette.hovered,
            _ => stage.palette.force,
        };
        let position = list.local(place);
        if let ForceKind::GravityPlane { acceleration, .. } = force.kind
            && let Some(direction) = acceleration.try_normalize()
        {
            let tip = place + direction * (ARROW_POINTS * stage.metres_per_point(place));
            list.arrows.push(Arrow { from: position, to: list.local(tip), color, width: 2.5 });
        }
        let shape = match force.kind {
            ForceKind::GravityPoint { .. } => PointShape::Diamond,
            _ => PointShape::Square,
        };
        let size = if selected { 14.0 } else { 11.0 };
        list.points.push(Point { position, color, size, shape });
    }
}
