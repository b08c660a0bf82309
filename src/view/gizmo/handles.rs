//! The handles of what is selected, as they are seen: points from the view's top left corner.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::Axis;
use crate::view::{Camera, Viewport};

/// What the handles do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// None are shown.
    Select,
    #[default]
    Move,
    Turn,
    Size,
}

/// What several selected things are turned about, and grow from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pivot {
    /// The mean of their centres.
    #[default]
    Middle,
    /// The centre of the one selected last.
    Last,
    /// Each its own centre.
    Each,
}

impl Pivot {
    pub const ALL: [Self; 3] = [Self::Middle, Self::Last, Self::Each];
}

/// What can be taken hold of. Axes are those of [`Subject::axes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Handle {
    /// The body itself, dragged in its [natural](super::Freedom::natural) plane.
    Body,
    MoveAlong(Axis),
    /// Moves in the plane at right angles to the axis.
    MoveAcross(Axis),
    /// Moves in the plane of the picture.
    MoveFacing,
    TurnAbout(Axis),
    /// Turns about the direction of the view.
    TurnFacing,
    Radius,
    /// Sizes of several, and their ways from the pivot.
    Scale,
    /// A side of a plate: along its local x or y, at the positive or negative end.
    Side {
        along: Axis,
        positive: bool,
    },
    MapSide(Axis),
    /// The tip of a velocity or of an acceleration.
    Vector,
}

/// What the handles belong to.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    pub tool: Tool,
    /// Where the handles sit, and what is turned about, m.
    pub pivot: DVec3,
    /// Unit vectors: those of the world, or of the body.
    pub axes: [DVec3; 3],
    pub sides: Option<Sides>,
    pub vector: Option<Vector>,
}

/// Sizes that have handles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sides {
    Sphere {
        radius: f64,
    },
    /// Half the sides, and the unit vectors along them.
    Plate {
        half: [f64; 2],
        along: [DVec3; 2],
    },
    /// From the world's origin.
    Map(DVec3),
    /// More than one thing: they grow by a factor.
    Several,
}

/// An arrow whose tip can be dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector {
    pub kind: VectorKind,
    /// m/s or m/s².
    pub value: DVec3,
    /// How long one unit is drawn.
    pub metres_per_unit: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VectorKind {
    Velocity,
    Acceleration,
}

/// A handle as it is seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Knob {
    pub handle: Handle,
    pub outline: Vec<DVec2>,
    /// A closed outline is grabbed inside too.
    pub closed: bool,
}

/// Lengths on the screen, points.
const ARROW: f64 = 74.0;
const ARROW_FROM: f64 = 14.0;
const SQUARE: [f64; 2] = [22.0, 36.0];
const RING: f64 = 66.0;
const FACING_RING: f64 = 80.0;
const DISC: f64 = 8.0;
const KNOB: f64 = 5.0;

/// Where the tip of a vector without a length is offered, to the right and up.
const PULL_OUT: DVec2 = DVec2::new(34.0, 34.0);

/// Arrows seen shorter than this point at the viewer and cannot be dragged sensibly, points.
const SHORTEST_ARROW: f64 = 14.0;

/// Cosine below which a ring or square is seen edge-on.
const EDGE_ON: f64 = 0.13;

/// Most segments of a ring.
const SEGMENTS: u32 = 64;

/// A pointer this near to a line has it, points.
const REACH: f64 = 6.0;

/// The handles of a subject; what points at the viewer or is seen edge-on is left out.
pub fn knobs(subject: &Subject, camera: &Camera, viewport: Viewport) -> Vec<Knob> {
    let scene = Seen { camera, viewport, pivot: subject.pivot, axes: subject.axes };
    let mut knobs = Vec::new();
    match (subject.tool, &subject.sides) {
        (Tool::Select, _) => return knobs,
        (_, Some(Sides::Map(size))) => return scene.map_sides(*size).collect(),
        (Tool::Move, _) => knobs.extend(scene.movers()),
        (Tool::Turn, _) => knobs.extend(scene.rings()),
        (Tool::Size, Some(Sides::Sphere { radius })) => knobs.extend(scene.radius(*radius)),
        (Tool::Size, Some(Sides::Plate { half, along })) => knobs.extend(scene.plate_sides(*half, *along)),
        (Tool::Size, Some(Sides::Several)) => knobs.extend(scene.frame_of_several()),
        (Tool::Size, None) => {}
    }
    knobs.extend(subject.vector.and_then(|vector| scene.vector(&vector)));
    knobs
}

/// The handle under the pointer: what was drawn last lies on top.
pub fn handle_at(knobs: &[Knob], pointer: DVec2) -> Option<Handle> {
    let near = |knob: &&Knob| knob.distance(pointer) <= REACH;
    let best = knobs.iter().filter(near).min_by(|a, b| {
        let order = |knob: &Knob| (knob.rank(), knob.distance(pointer));
        let ((rank_a, a), (rank_b, b)) = (order(a), order(b));
        rank_a.cmp(&rank_b).then(a.total_cmp(&b))
    });
    best.map(|knob| knob.handle)
}

impl Knob {
    /// From the pointer, points; zero inside a closed outline.
    fn distance(&self, pointer: DVec2) -> f64 {
        if self.closed && self.holds(pointer) {
            return 0.0;
        }
        let ends = self.outline.iter().zip(self.outline.iter().skip(1));
        ends.map(|(a, b)| distance_to_segment(pointer, *a, *b)).fold(f64::INFINITY, f64::min)
    }

    /// Whether a convex outline holds a point.
    fn holds(&self, point: DVec2) -> bool {
        let ends = self.outline.iter().zip(self.outline.iter().skip(1));
        let sides = ends.map(|(a, b)| (*b - *a).perp_dot(point - *a));
        let (mut left, mut right) = (false, false);
        sides.for_each(|side| (left, right) = (left || side > 0.0, right || side < 0.0));
        !(left && right)
    }

    /// The middle of the outline, whose last point may be its first.
    pub fn middle(&self) -> DVec2 {
        let points = self.outline.get(1..).unwrap_or_default();
        points.iter().sum::<DVec2>() / points.len().max(1) as f64
    }

    /// Where to take hold of it with the least doubt.
    pub fn grab_point(&self) -> DVec2 {
        let at = |share: usize| self.outline.get(self.outline.len() * share / 8).copied();
        let ends = (self.outline.first(), self.outline.last());
        match (self.handle, ends) {
            (Handle::MoveAlong(_), (Some(from), Some(to))) => from.lerp(*to, 0.8),
            (Handle::TurnAbout(_), _) => at(3).unwrap_or_default(),
            (Handle::TurnFacing, _) => at(1).unwrap_or_default(),
            _ => self.middle(),
        }
    }

    /// Small handles lie on top of large ones.
    fn rank(&self) -> u8 {
        match self.handle {
            Handle::Vector | Handle::Radius | Handle::Scale | Handle::Side { .. } | Handle::MapSide(_) => 0,
            Handle::MoveFacing => 1,
            Handle::MoveAcross(_) | Handle::MoveAlong(_) | Handle::TurnAbout(_) => 2,
            Handle::TurnFacing | Handle::Body => 3,
        }
    }
}

fn distance_to_segment(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    point.distance(if share.is_nan() { a } else { a + along * share })
}

/// What a view sees of a subject.
struct Seen<'a> {
    camera: &'a Camera,
    viewport: Viewport,
    pivot: DVec3,
    axes: [DVec3; 3],
}

impl Seen<'_> {
    fn point(&self, place: DVec3) -> Option<DVec2> {
        let ndc = self.camera.project(place, self.viewport.aspect())?;
        let at = self.viewport.points(ndc.truncate());
        at.is_finite().then_some(at)
    }

    /// Metres that a point of the screen measures at the pivot.
    fn scale(&self) -> f64 {
        self.camera.world_per_pixel_at(self.pivot, self.viewport.height)
    }

    /// From the pivot to the eye.
    fn to_eye(&self) -> DVec3 {
        match self.camera.projection {
            crate::view::Projection::Orthographic => self.camera.backward(),
            crate::view::Projection::Perspective => (self.camera.eye() - self.pivot).normalize_or(DVec3::Z),
        }
    }

    fn polyline(&self, places: impl IntoIterator<Item = DVec3>) -> Option<Vec<DVec2>> {
        places.into_iter().map(|place| self.point(place)).collect()
    }

    fn movers(&self) -> Vec<Knob> {
        let squares = Axis::ALL.into_iter().filter_map(|normal| self.square(normal));
        let arrows = Axis::ALL.into_iter().filter_map(|axis| self.arrow(axis));
        let disc = self.point(self.pivot).map(|at| disc(Handle::MoveFacing, at, DISC));
        squares.chain(arrows).chain(disc).collect()
    }

    fn arrow(&self, axis: Axis) -> Option<Knob> {
        let unit = self.axes[axis as usize] * self.scale();
        let outline = self.polyline([self.pivot + unit * ARROW_FROM, self.pivot + unit * ARROW])?;
        let long = outline.first()?.distance(*outline.last()?) >= SHORTEST_ARROW;
        long.then_some(Knob { handle: Handle::MoveAlong(axis), outline, closed: false })
    }

    fn square(&self, normal: Axis) -> Option<Knob> {
        let [u, v] = self.others(normal).map(|unit| unit * self.scale());
        let [near, far] = SQUARE;
        let corners = [(near, near), (far, near), (far, far), (near, far), (near, near)];
        let outline = self.polyline(corners.map(|(a, b)| self.pivot + u * a + v * b))?;
        let faces = self.axes[normal as usize].dot(self.to_eye()).abs() > 2.0 * EDGE_ON;
        faces.then_some(Knob { handle: Handle::MoveAcross(normal), outline, closed: true })
    }

    fn others(&self, axis: Axis) -> [DVec3; 2] {
        let at = axis as usize;
        [self.axes[(at + 1) % 3], self.axes[(at + 2) % 3]]
    }

    fn rings(&self) -> Vec<Knob> {
        let about = Axis::ALL.into_iter().filter_map(|axis| self.ring(axis));
        let [u, v] = [self.camera.right(), self.camera.up()];
        let facing = self.circle(u, v, FACING_RING, 0.0..TAU);
        let facing = facing.map(|outline| Knob { handle: Handle::TurnFacing, outline, closed: false });
        about.chain(facing).collect()
    }

    /// The half of a ring that lies nearer to the eye; a ring seen from the front is whole.
    fn ring(&self, axis: Axis) -> Option<Knob> {
        let normal = self.axes[axis as usize];
        let to_eye = self.to_eye();
        let facing = normal.dot(to_eye).abs();
        if facing < EDGE_ON {
            return None;
        }
        let near = (to_eye - normal * normal.dot(to_eye)).normalize_or_zero();
        let [u, v] = if facing > 0.99 { self.others(axis) } else { [near, normal.cross(near)] };
        let span = if facing > 0.99 { 0.0..TAU } else { -0.25 * TAU..0.25 * TAU };
        let outline = self.circle(u, v, RING, span)?;
        Some(Knob { handle: Handle::TurnAbout(axis), outline, closed: false })
    }

    fn circle(&self, u: DVec3, v: DVec3, points: f64, span: std::ops::Range<f64>) -> Option<Vec<DVec2>> {
        let radius = points * self.scale();
        self.polyline((0..=SEGMENTS).map(|i| {
            let angle = span.start + (span.end - span.start) * f64::from(i) / f64::from(SEGMENTS);
            let (sine, cosine) = libm::sincos(angle);
            self.pivot + (u * cosine + v * sine) * radius
        }))
    }

    /// To the right, up, left and down, on the silhouette.
    fn radius(&self, radius: f64) -> Vec<Knob> {
        let (right, up) = (self.camera.right(), self.camera.up());
        let places = [right, up, -right, -up].map(|unit| self.pivot + unit * radius);
        places.into_iter().filter_map(|place| self.knob(Handle::Radius, place)).collect()
    }

    /// A square around the pivot that faces the view, with knobs at its corners.
    fn frame_of_several(&self) -> Vec<Knob> {
        let [right, up] = [self.camera.right(), self.camera.up()].map(|unit| unit * (RING * self.scale()));
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let corners = corners.map(|(x, y)| self.pivot + right * x + up * y);
        let knobs = corners.into_iter().filter_map(|place| self.knob(Handle::Scale, place));
        let outline = self.polyline(corners.into_iter().chain([corners[0]]));
        let frame = outline.map(|outline| Knob { handle: Handle::Scale, outline, closed: false });
        knobs.chain(frame).collect()
    }

    fn plate_sides(&self, half: [f64; 2], along: [DVec3; 2]) -> Vec<Knob> {
        let ends = [(Axis::X, true), (Axis::X, false), (Axis::Y, true), (Axis::Y, false)];
        let knob = |(axis, positive): (Axis, bool)| {
            let at = axis as usize;
            let place = self.pivot + along[at] * if positive { half[at] } else { -half[at] };
            self.knob(Handle::Side { along: axis, positive }, place)
        };
        ends.into_iter().filter_map(knob).collect()
    }

    fn map_sides(&self, size: DVec3) -> impl Iterator<Item = Knob> {
        Axis::ALL.into_iter().filter_map(move |axis| {
            let place = 0.5 * size + 0.5 * size * axis.unit();
            self.knob(Handle::MapSide(axis), place)
        })
    }

    fn vector(&self, vector: &Vector) -> Option<Knob> {
        let tip = self.point(self.pivot + vector.value * vector.metres_per_unit)?;
        let from = self.point(self.pivot)?;
        let hidden = tip.distance(from) < DISC + KNOB;
        let at = if hidden { from + PULL_OUT * DVec2::new(1.0, -1.0) } else { tip };
        Some(disc(Handle::Vector, at, KNOB + 1.0))
    }

    fn knob(&self, handle: Handle, place: DVec3) -> Option<Knob> {
        Some(disc(handle, self.point(place)?, KNOB))
    }
}

fn disc(handle: Handle, center: DVec2, radius: f64) -> Knob {
    let corner = |i: u32| {
        let (sine, cosine) = libm::sincos(TAU * f64::from(i) / 16.0);
        center + DVec2::new(cosine, sine) * radius
    };
    Knob { handle, outline: (0..=16).map(corner).collect(), closed: true }
}
