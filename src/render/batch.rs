//! Instances of one kind, as the GPU wants them: one buffer for each attribute.

use three_d::{Context, InstanceBuffer, Program};

use crate::view::{Arrow, Color, DrawList, Line, Plate, Point, PointShape, Sphere, Stroke};

/// From one line of the hatching of static spheres to the next, points across and down.
const HATCH_POINTS: f32 = 9.0;

/// A group of instances drawn with one program by one call.
pub(super) struct Batch {
    four: Vec<(&'static str, InstanceBuffer<[f32; 4]>)>,
    three: Vec<(&'static str, InstanceBuffer<[f32; 3]>)>,
    two: Vec<(&'static str, InstanceBuffer<[f32; 2]>)>,
    count: u32,
}

impl Batch {
    pub fn new(
        context: &Context,
        four: &[&'static str],
        three: &[&'static str],
        two: &[&'static str],
    ) -> Self {
        Self {
            four: four.iter().map(|name| (*name, InstanceBuffer::new(context))).collect(),
            three: three.iter().map(|name| (*name, InstanceBuffer::new(context))).collect(),
            two: two.iter().map(|name| (*name, InstanceBuffer::new(context))).collect(),
            count: 0,
        }
    }

    pub fn count(&self) -> u32 {
        self.count
    }

    pub fn bind(&self, program: &Program) {
        self.four.iter().for_each(|(name, buffer)| program.use_instance_attribute(name, buffer));
        self.three.iter().for_each(|(name, buffer)| program.use_instance_attribute(name, buffer));
        self.two.iter().for_each(|(name, buffer)| program.use_instance_attribute(name, buffer));
    }

    fn fill(&mut self, count: usize, four: &[Vec<[f32; 4]>], three: &[Vec<[f32; 3]>], two: &[Vec<[f32; 2]>]) {
        self.count = count as u32;
        if count == 0 {
            return;
        }
        self.four.iter_mut().zip(four).for_each(|((_, buffer), data)| buffer.fill(data));
        self.three.iter_mut().zip(three).for_each(|((_, buffer), data)| buffer.fill(data));
        self.two.iter_mut().zip(two).for_each(|((_, buffer), data)| buffer.fill(data));
    }

    /// One instance: OpenGL draws nothing without an attribute.
    pub fn background(context: &Context) -> Self {
        Self::new(context, &["topColor", "bottomColor"], &[], &[])
    }

    pub fn fill_background(&mut self, [top, bottom]: [Color; 2]) {
        self.fill(1, &[vec![rgba(top)], vec![rgba(bottom)]], &[], &[]);
    }

    pub fn spheres(context: &Context) -> Self {
        Self::new(context, &["centerRadius", "color", "ringColor"], &[], &["ringHatch"])
    }

    pub fn fill_spheres(&mut self, spheres: &[&Sphere], scale: f32) {
        let center = spheres.iter().map(|s| s.center.extend(s.radius).to_array()).collect();
        let color = spheres.iter().map(|s| rgba(s.color)).collect();
        let ring = spheres.iter().map(|s| rgba(s.outline)).collect();
        let hatch = |s: &&Sphere| if s.hatched { HATCH_POINTS * scale } else { 0.0 };
        let hatch = spheres.iter().map(|s| [s.outline_width * scale, hatch(s)]).collect();
        self.fill(spheres.len(), &[center, color, ring], &[], &[hatch]);
    }

    pub fn plates(context: &Context) -> Self {
        Self::new(context, &["color"], &["corner", "edgeX", "edgeY"], &[])
    }

    pub fn fill_plates(&mut self, plates: &[&Plate]) {
        let color = plates.iter().map(|p| rgba(p.color)).collect();
        let corner = plates.iter().map(|p| p.corner.to_array()).collect();
        let edge_x = plates.iter().map(|p| p.edge_x.to_array()).collect();
        let edge_y = plates.iter().map(|p| p.edge_y.to_array()).collect();
        self.fill(plates.len(), &[color], &[corner, edge_x, edge_y], &[]);
    }

    pub fn strokes(context: &Context) -> Self {
        Self::new(context, &["fromWidth", "toHead", "color"], &[], &[])
    }

    fn fill_segments(&mut self, segments: impl Iterator<Item = ([f32; 4], [f32; 4], Color)>) {
        let (mut from, mut to, mut color) = (Vec::new(), Vec::new(), Vec::new());
        for (a, b, tint) in segments {
            from.push(a);
            to.push(b);
            color.push(rgba(tint));
        }
        self.fill(from.len(), &[from, to, color], &[], &[]);
    }

    pub fn fill_lines<'a>(&mut self, lines: impl Iterator<Item = &'a Line>, scale: f32) {
        self.fill_segments(
            lines.map(|l| (l.from.extend(l.width * scale).to_array(), l.to.extend(0.0).to_array(), l.color)),
        );
    }

    pub fn fill_arrows(&mut self, arrows: &[Arrow], scale: f32) {
        /// Length of an arrow's head over its width.
        const HEAD: f32 = 5.0;
        self.fill_segments(arrows.iter().map(|a| {
            let width = a.width * scale;
            (a.from.extend(width).to_array(), a.to.extend(HEAD * width).to_array(), a.color)
        }));
    }

    /// Strokes are flat on the view: their device coordinates take the place of positions.
    pub fn fill_strokes(&mut self, list: &DrawList, scale: f32) {
        let device = |p: glam::Vec2, last: f32| {
            let ndc = list.viewport.ndc(p.as_dvec2()).as_vec2();
            [ndc.x, ndc.y, 0.0, last]
        };
        let segment = |s: &Stroke| (device(s.from, s.width * scale), device(s.to, 0.0), s.color);
        self.fill_segments(list.strokes.iter().map(segment));
    }

    pub fn points(context: &Context) -> Self {
        Self::new(context, &["positionSize", "color"], &[], &["shape"])
    }

    pub fn fill_points(&mut self, points: &[Point], scale: f32) {
        let position = points.iter().map(|p| p.position.extend(p.size * scale).to_array()).collect();
        let color = points.iter().map(|p| rgba(p.color)).collect();
        let shape = points.iter().map(|p| [shape_number(p.shape), 0.0]).collect();
        self.fill(points.len(), &[position, color], &[], &[shape]);
    }
}

/// As point.frag numbers them.
fn shape_number(shape: PointShape) -> f32 {
    match shape {
        PointShape::Disc => 0.0,
        PointShape::Ring => 1.0,
        PointShape::Diamond => 2.0,
        PointShape::Square => 3.0,
        PointShape::Cross => 4.0,
    }
}

pub(super) fn rgba(color: Color) -> [f32; 4] {
    color.0.map(|channel| f32::from(channel) / 255.0)
}
