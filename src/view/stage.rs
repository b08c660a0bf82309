//! The scene as it stands at the moment of the picture: bodies in their places, and what every builder needs.

use std::cell::OnceCell;

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

use super::camera::is_drawable;
use super::front::Front;
use super::{
    Bounds, Camera, Color, DrawList, Line, Palette, ViewInput, bounds, color,
    see_through::{Walls, is_between},
};
use crate::record::BodyFrame;
use crate::scene::{Body, NodeKey, Shape};

/// A body where it is now.
pub(super) struct Posed<'a> {
    pub body: &'a Body,
    pub position: DVec3,
    /// What the simulation says of it; `None` for statics and without a simulation.
    pub now: Option<&'a BodyFrame>,
    pub color: Color,
    /// Unit normal towards the scene, for a plate that is a wall.
    pub inward: Option<DVec3>,
    pub selected: bool,
    pub hovered: bool,
}

/// How a line is drawn.
#[derive(Clone, Copy)]
pub(super) struct Pen {
    pub color: Color,
    /// Points.
    pub width: f32,
    pub on_top: bool,
}

impl Pen {
    pub fn hidden_by_bodies(color: Color, width: f32) -> Self {
        Self { color, width, on_top: false }
    }

    pub fn over_bodies(color: Color, width: f32) -> Self {
        Self { color, width, on_top: true }
    }
}

/// Read-only context of one picture.
pub(super) struct Stage<'a> {
    pub input: &'a ViewInput<'a>,
    pub camera: Camera,
    pub palette: &'static Palette,
    /// Visible bodies in file order.
    pub bodies: Vec<Posed<'a>>,
    /// Around the map.
    pub map: Bounds,
    /// Of a crowd; made where it is asked for.
    front: OnceCell<Option<Front>>,
}

/// Moving bodies from which on marks of those behind others are left out: they would cover the front ones.
const CROWD: usize = 300;

impl<'a> Stage<'a> {
    pub fn new(input: &'a ViewInput<'a>) -> Self {
        let palette = input.theme.palette();
        let now: FxHashMap<NodeKey, &BodyFrame> =
            input.frame.iter().flat_map(|frame| &frame.bodies).map(|body| (body.key, body)).collect();
        let selection: FxHashSet<NodeKey> = input.selection.iter().copied().collect();
        let mut nth_dynamic = 0;
        let mut bodies = Vec::with_capacity(input.scene.bodies.len());
        for body in &input.scene.bodies {
            let color = color::body_color(body, nth_dynamic, palette);
            nth_dynamic += usize::from(body.is_dynamic());
            let now = now.get(&body.key).copied();
            let position = now.map_or(body.position, |now| now.position);
            if body.hidden || input.inside == Some(body.key) || !is_drawable(position) {
                continue;
            }
            let selected = selection.contains(&body.key);
            let hovered = input.hovered == Some(body.key);
            bodies.push(Posed { body, position, now, color, inward: None, selected, hovered });
        }
        let map = bounds::map_bounds(input.scene);
        let walls = Walls::new(map, &bodies);
        for posed in &mut bodies {
            posed.inward = walls.inward(posed.body, posed.position);
            if posed.inward.is_some() && posed.body.color.is_none() {
                posed.color = palette.wall;
            }
        }
        Self { input, camera: input.camera.usable(), palette, bodies, map, front: OnceCell::new() }
    }

    /// Of a crowd.
    fn front(&self) -> Option<&Front> {
        let ball = |posed: &Posed<'_>| match posed.body.shape {
            Shape::Sphere { radius } => Some((posed.position, radius)),
            Shape::Plane { .. } | Shape::Unbuilt { .. } => None,
        };
        let of_crowd = || {
            let balls = self.bodies.iter().filter_map(ball);
            let is_crowd = self.bodies.iter().filter(|posed| posed.body.is_dynamic()).nth(CROWD).is_some();
            is_crowd.then(|| Front::of(self.camera, self.input.viewport, balls))
        };
        self.front.get_or_init(of_crowd).as_ref()
    }

    /// Whether so many bodies move that marks are for the front ones.
    pub fn is_crowd(&self) -> bool {
        self.front().is_some()
    }

    /// Whether marks of a body are drawn: in a crowd those of the front ones, and of what is meant.
    pub fn shows_marks_of(&self, posed: &Posed<'_>) -> bool {
        let is_hidden = || self.front().is_some_and(|front| front.hides_ball_at(posed.position));
        posed.selected || posed.hovered || !is_hidden()
    }

    /// Whether a mark at a place where bodies touch is drawn.
    pub fn shows_mark_at(&self, place: DVec3) -> bool {
        self.front().is_none_or(|front| !front.hides(place))
    }

    /// Metres per point at `place`.
    pub fn metres_per_point(&self, place: DVec3) -> f64 {
        self.camera.world_per_pixel_at(place, self.input.viewport.height)
    }

    /// Where a place is seen, in points from the top left corner; `None` behind the eye or far outside.
    pub fn on_screen(&self, place: DVec3) -> Option<glam::DVec2> {
        let ndc = self.camera.project(place, self.input.viewport.aspect())?;
        let inside = ndc.x.abs() < 1.5 && ndc.y.abs() < 1.5;
        inside.then(|| self.input.viewport.points(ndc.truncate()))
    }

    /// Adds the visible part of a world line.
    pub fn add_line(&self, list: &mut DrawList, ends: [DVec3; 2], pen: Pen) {
        if let Some((from, to)) = self.camera.clip_segment(ends[0], ends[1], self.input.viewport.aspect()) {
            let (from, to) = (list.local(from), list.local(to));
            list.lines.push(Line { from, to, color: pen.color, width: pen.width, on_top: pen.on_top });
        }
    }

    /// Adds the twelve edges of a box.
    pub fn add_box(&self, list: &mut DrawList, bounds: Bounds, pen: Pen) {
        let corners = bounds.corners();
        for (i, corner) in corners.iter().enumerate() {
            for bit in [1, 2, 4] {
                if i & bit == 0 {
                    self.add_line(list, [*corner, corners[i | bit]], pen);
                }
            }
        }
    }

    /// Whether this body is a wall in front of the scene.
    pub fn is_see_through(&self, posed: &Posed<'_>) -> bool {
        posed.inward.is_some_and(|inward| is_between(inward, posed.position, &self.camera))
    }
}
