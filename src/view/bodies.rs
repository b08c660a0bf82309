//! The bodies themselves: spheres, solid plates, and walls as glass.

use glam::DVec3;

use super::stage::{Pen, Posed, Stage};
use super::{Color, DrawList, Plate, Point, PointShape, Sphere};
use crate::scene::{Shape, rotation_matrix};

/// Spheres are never drawn smaller than this, so that they do not vanish: radius in points.
const SMALLEST_RADIUS: f64 = 1.5;

/// More plates than this are drawn without edges.
const MOST_EDGED_PLATES: usize = 4000;

/// Larger bodies are drawn with this size, so that it fits an f32, m.
const LARGEST: f64 = 1e30;

pub(super) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let plates = stage.bodies.iter().filter(|posed| matches!(posed.body.shape, Shape::Plane { .. })).count();
    list.spheres.reserve(stage.bodies.len() - plates);
    let mut glass = Vec::new();
    for posed in &stage.bodies {
        match posed.body.shape {
            Shape::Sphere { radius } => add_sphere(stage, list, posed, radius),
            Shape::Plane { half_x, half_y } => {
                let edged = plates <= MOST_EDGED_PLATES;
                let rotation = rotation_matrix(posed.body.rotation);
                let half = [half_x.min(LARGEST), half_y.min(LARGEST)];
                let along = [rotation.x_axis, rotation.y_axis];
                let face = Face { center: posed.position, along, half, edged };
                add_plate(stage, list, &mut glass, posed, &face);
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
        radius: radius.max(smallest).min(LARGEST) as f32,
        color: posed.color,
        outline,
        outline_width,
        hatched: !posed.body.is_dynamic(),
    });
}

fn add_plate(stage: &Stage<'_>, list: &mut DrawList, glass: &mut Vec<Plate>, posed: &Posed<'_>, face: &Face) {
    let see_through = stage.is_see_through(posed);
    let marked = posed.selected || posed.hovered;
    match (see_through, marked) {
        (false, _) => list.plates.push(face.plate(stage, list, posed.color)),
        // A wall in front of the scene shows only when it is meant, or it would veil everything behind it.
        (true, true) => glass.push(face.plate(stage, list, ring(stage, posed).0.with_alpha(26))),
        (true, false) => {}
    }
    let (color, width) = match (marked, see_through) {
        (true, _) => (ring(stage, posed).0, 2.5),
        (false, true) => (stage.palette.glass_edge, 1.0),
        (false, false) => (posed.color.mix(stage.palette.plate_edge, 0.6), 1.25),
    };
    if marked || face.edged {
        let corners = face.corners();
        for i in 0..4 {
            let pen = Pen { color, width, on_top: marked && see_through };
            stage.add_line(list, [corners[i], corners[(i + 1) % 4]], pen);
        }
    }
}

/// A rectangle in the world: its middle, and unit vectors with half sides along its edges.
struct Face {
    center: DVec3,
    along: [DVec3; 2],
    half: [f64; 2],
    edged: bool,
}

impl Face {
    fn corners(&self) -> [DVec3; 4] {
        let [x, y] = [self.along[0] * self.half[0], self.along[1] * self.half[1]];
        [self.center - x - y, self.center + x - y, self.center + x + y, self.center - x + y]
    }

    /// The part near the view: a plate a million times larger than the view would lose its place in f32.
    fn plate(&self, stage: &Stage<'_>, list: &DrawList, color: Color) -> Plate {
        const REACH_OVER_HEIGHT: f64 = 2000.0;
        let reach = REACH_OVER_HEIGHT * stage.camera.height;
        let span = [0, 1].map(|i| {
            let middle = (stage.camera.target - self.center).dot(self.along[i]);
            let low = (middle - reach).clamp(-self.half[i], self.half[i]);
            (low, (middle + reach).clamp(-self.half[i], self.half[i]) - low)
        });
        Plate {
            corner: list.local(self.center + self.along[0] * span[0].0 + self.along[1] * span[1].0),
            edge_x: (self.along[0] * span[0].1).as_vec3(),
            edge_y: (self.along[1] * span[1].1).as_vec3(),
            color,
        }
    }
}
