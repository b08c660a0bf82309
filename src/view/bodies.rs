//! The bodies themselves: spheres, solid plates, and walls as glass.

use super::stage::{Posed, Stage};
use super::{Color, DrawList, Line, Plate, Point, PointShape, Sphere};
use crate::scene::{Shape, rotation_matrix};

/// Spheres are never drawn smaller than this, so that they don't vanish: radius in points.
const SMALLEST_RADIUS: f64 = 1.5;

/// More plates than this are drawn without edges.
const MOST_EDGED_PLATES: usize = 4000;

pub(super) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let plates = stage.bodies.iter().filter(|posed| matches!(posed.body.shape, Shape::Plane { .. })).count();
    let mut glass = Vec::new();
    for posed in &stage.bodies {
        match posed.body.shape {
            Shape::Sphere { radius } => add_sphere(stage, list, posed, radius),
            Shape::Plane { half_x, half_y } => {
                let edged = plates <= MOST_EDGED_PLATES || posed.selected || posed.hovered;
                add_plate(stage, list, &mut glass, posed, [half_x, half_y], edged);
            }
            Shape::Unbuilt { .. } => {
                let (position, color) = (list.local(posed.position), ring(stage, posed).0);
                list.points.push(Point { position, color, size: 13.0, shape: PointShape::Cross });
            }
        }
    }
    list.plates.append(&mut glass);
    if plates > MOST_EDGED_PLATES {
        list.notes.push(format!("{plates} plates are drawn without their edges."));
    }
}

/// Colour and width of the ring around a body: selected, hovered, or none.
fn ring(stage: &Stage<'_>, posed: &Posed<'_>) -> (Color, f32) {
    match (posed.selected, posed.hovered) {
        (true, _) => (stage.palette.selected, 3.0),
        (_, true) => (stage.palette.hovered, 2.0),
        _ => (posed.color, 0.0),
    }
}

fn add_sphere(stage: &Stage<'_>, list: &mut DrawList, posed: &Posed<'_>, radius: f64) {
    let smallest = SMALLEST_RADIUS * stage.metres_per_point(posed.position);
    let (outline, outline_width) = ring(stage, posed);
    list.spheres.push(Sphere {
        center: list.local(posed.position),
        radius: radius.max(smallest) as f32,
        color: posed.color,
        outline,
        outline_width,
        hatched: !posed.body.is_dynamic(),
    });
}

fn add_plate(
    stage: &Stage<'_>,
    list: &mut DrawList,
    glass: &mut Vec<Plate>,
    posed: &Posed<'_>,
    half: [f64; 2],
    edged: bool,
) {
    let rotation = rotation_matrix(posed.body.rotation);
    let (half_x, half_y) = (rotation.x_axis * half[0], rotation.y_axis * half[1]);
    let see_through = stage.is_see_through(posed);
    let plate = |color| Plate {
        center: list.local(posed.position),
        half_x: half_x.as_vec3(),
        half_y: half_y.as_vec3(),
        color,
    };
    match (see_through, posed.selected || posed.hovered) {
        (false, _) => list.plates.push(plate(posed.color)),
        // A wall in front of the scene shows only when it is meant, or it would veil everything behind it.
        (true, true) => glass.push(plate(ring(stage, posed).0.with_alpha(26))),
        (true, false) => {}
    }
    if !edged {
        return;
    }
    let (color, width) = match (posed.selected || posed.hovered, see_through) {
        (true, _) => (ring(stage, posed).0, 2.5),
        (false, true) => (stage.palette.glass_edge, 1.0),
        (false, false) => (posed.color.mix(stage.palette.plate_edge, 0.6), 1.25),
    };
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| list.local(posed.position + half_x * x + half_y * y));
    for i in 0..4 {
        let (from, to) = (corners[i], corners[(i + 1) % 4]);
        list.lines.push(Line { from, to, color, width, on_top: false });
    }
}
