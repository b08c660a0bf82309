//! Balls of a draft as points: a vertex each in place of two triangles, and the nearest first, so that what they hide is
//! not shaded. Where the processor draws thousands of small balls, that is most of the time.

use glam::Vec4;
use three_d::{Context, Program, VertexBuffer};

use super::batch::rgba;
use crate::view::{DrawList, Sphere};

/// The largest point that every driver draws, pixels.
const LARGEST: f32 = 60.0;

/// The balls as the GPU wants them.
pub(super) struct Beads {
    place_radius: VertexBuffer<[f32; 4]>,
    color: VertexBuffer<[f32; 4]>,
    ring_color: VertexBuffer<[f32; 4]>,
    count: u32,
}

/// A ball on the screen: device coordinates, and its radius in pixels.
struct Bead<'a> {
    place: [f32; 3],
    radius: f32,
    sphere: &'a Sphere,
}

impl Beads {
    pub fn new(context: &Context) -> Self {
        let [place_radius, color, ring_color] = std::array::from_fn(|_| VertexBuffer::new(context));
        Self { place_radius, color, ring_color, count: 0 }
    }

    pub fn count(&self) -> u32 {
        self.count
    }

    pub fn clear(&mut self) {
        self.count = 0;
    }

    /// Takes the balls of a picture so many pixels high that can be points, and gives back the others. `scale` is pixels per
    /// point.
    pub fn take<'a>(&mut self, list: &'a DrawList, height: u32, scale: f32) -> Vec<&'a Sphere> {
        let clip = list.projection * list.view;
        // Pixels per metre where a device coordinate is not divided by anything.
        let magnification = 0.5 * list.projection.y_axis.y * height as f32;
        let (mut beads, mut others) = (Vec::with_capacity(list.spheres.len()), Vec::new());
        for sphere in &list.spheres {
            let at = clip * sphere.center.extend(1.0);
            let bead = Bead { place: device(at), radius: sphere.radius * magnification / at.w, sphere };
            let is_seen = at.w > 0.0 && bead.place[..2].iter().all(|place| place.abs() < 1.0);
            let is_small = 2.0 * (bead.radius + sphere.outline_width * scale) <= LARGEST;
            if is_seen && is_small && !sphere.hatched && (!list.is_perspective || bead.place[2].abs() < 1.0) {
                beads.push(bead);
            } else {
                others.push(sphere);
            }
        }
        beads.sort_unstable_by(|a, b| a.place[2].total_cmp(&b.place[2]));
        self.fill(&beads, scale);
        others
    }

    fn fill(&mut self, beads: &[Bead<'_>], scale: f32) {
        self.count = beads.len() as u32;
        if beads.is_empty() {
            return;
        }
        let place = |bead: &Bead<'_>| [bead.place[0], bead.place[1], bead.place[2], bead.radius];
        let ring = |bead: &Bead<'_>| {
            let [red, green, blue, _] = rgba(bead.sphere.outline);
            [red, green, blue, bead.sphere.outline_width * scale]
        };
        self.place_radius.fill(&beads.iter().map(place).collect::<Vec<_>>());
        self.color.fill(&beads.iter().map(|bead| rgba(bead.sphere.color)).collect::<Vec<_>>());
        self.ring_color.fill(&beads.iter().map(ring).collect::<Vec<_>>());
    }

    pub fn bind(&self, program: &Program) {
        program.use_vertex_attribute("placeRadius", &self.place_radius);
        program.use_vertex_attribute("color", &self.color);
        program.use_vertex_attribute("ringColor", &self.ring_color);
    }
}

fn device(clip: Vec4) -> [f32; 3] {
    [clip.x / clip.w, clip.y / clip.w, clip.z / clip.w]
}
