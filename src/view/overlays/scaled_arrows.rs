//! Arrows whose lengths stand for a quantity, all at one round scale.

use glam::DVec3;

use crate::scene::{Body, Map, Motion, Scene};
use crate::view::format::{one_digit, round_down_125};
use crate::view::overlays::crowd::share_of_size;
use crate::view::stage::{Posed, Stage};
use crate::view::{Arrow, Camera, Color, DrawList, Viewport};

/// More arrows are a thicket, and each takes as long to draw as a ball.
const MOST: usize = 1000;

/// Length of the longest arrow, and the shortest that a quantity above zero is drawn with, points.
const LONGEST: f64 = 90.0;
const SHORTEST: f64 = 12.0;

/// Width of arrows drawn at a share of their size, points: thin ones that are not lost.
pub(super) fn width_of(share: f64) -> f32 {
    (2.0 * share).max(1.0) as f32
}

/// A vector of a body.
pub(super) type OfBody<'a> = (&'a Posed<'a>, DVec3);

/// What the arrows show.
pub(super) struct Quantity {
    pub name: &'static str,
    pub unit: &'static str,
    pub color: Color,
}

/// How long one unit is drawn, so that the largest of so many vectors is as long as an arrow can be among them.
fn metres_per_unit((largest, count): (f64, usize), camera: &Camera, viewport: Viewport) -> f64 {
    let longest = LONGEST * share_of_size(viewport, count);
    // Rounded, so that arrows do not breathe with every change of the largest.
    round_down_125(longest * camera.world_per_pixel(viewport.height) / largest)
}

/// The scale of a view's velocity arrows at the start of a scene. Where nothing moves, it is such that a body
/// as fast as the longest arrow crosses the map in four seconds.
pub fn velocity_scale(scene: &Scene, camera: &Camera, viewport: Viewport) -> f64 {
    let velocity = |body: &Body| match body.motion {
        Motion::Dynamic { velocity, .. } if !body.hidden => Some((body.position, velocity)),
        _ => None,
    };
    let (largest, count) = largest(&scene.map, scene.bodies.iter().filter_map(velocity));
    let usual = 0.25 * scene.map.size.max_element();
    let largest = if largest.is_finite() && largest > 0.0 { largest } else { usual };
    metres_per_unit((largest, count), camera, viewport)
}

/// The largest length of so many vectors at their places. What has left the map does not decide how long the arrows of all others
/// are, unless nothing else moves: a ball that falls for ever is soon the fastest by far.
fn largest(map: &Map, vectors: impl Iterator<Item = (DVec3, DVec3)>) -> (f64, usize) {
    let (mut inside, mut all, mut count) = (0.0_f64, 0.0_f64, 0);
    for (place, vector) in vectors {
        let length = vector.length();
        if map.contains(place) {
            inside = inside.max(length);
        }
        (all, count) = (all.max(length), count + 1);
    }
    (if inside > 0.0 { inside } else { all }, count)
}

/// How long one unit is drawn, m, for vectors at their places; `None` without any.
pub(super) fn scale_at(stage: &Stage<'_>, vectors: &[(DVec3, DVec3)]) -> Option<f64> {
    scale_for(stage, largest(&stage.input.scene.map, vectors.iter().copied()))
}

/// The largest length of some vectors, and how many they are.
fn longest(vectors: impl Iterator<Item = DVec3>) -> (f64, usize) {
    vectors.map(DVec3::length).fold((0.0, 0), |(largest, count), length| (length.max(largest), count + 1))
}

fn scale_for(stage: &Stage<'_>, (largest, count): (f64, usize)) -> Option<f64> {
    let is_drawable = largest.is_finite() && largest > 0.0;
    is_drawable.then(|| metres_per_unit((largest, count), &stage.camera, stage.input.viewport))
}

/// Adds an arrow for each body's vector, and a line with the scale to the legend.
pub(super) fn add(stage: &Stage<'_>, list: &mut DrawList, quantity: &Quantity, vectors: &[OfBody<'_>]) {
    let scale = scale_for(stage, longest(vectors.iter().map(|(_, vector)| *vector)));
    add_of_bodies(stage, list, quantity, vectors, scale);
}

/// As [`add`], at a scale.
pub(super) fn add_of_bodies(
    stage: &Stage<'_>,
    list: &mut DrawList,
    quantity: &Quantity,
    vectors: &[OfBody<'_>],
    scale: Option<f64>,
) {
    let shown = vectors.iter().filter(|(posed, _)| stage.shows_marks_of(posed));
    let shown: Vec<_> = shown.map(|(posed, vector)| (posed.position, *vector)).collect();
    add_at(stage, list, quantity, &shown, scale);
    add_to_legend(list, quantity, scale);
}

/// Adds a line with the scale to the legend.
pub(super) fn add_to_legend(list: &mut DrawList, quantity: &Quantity, scale: Option<f64>) {
    if let Some(metres_per_unit) = scale {
        let Quantity { name, unit, color } = quantity;
        list.legend
            .push((*color, format!("{name} arrows: 1 m = {} {unit}", one_digit(1.0 / metres_per_unit))));
    }
}

/// Adds an arrow for each (place, vector) at a scale.
pub(super) fn add_at(
    stage: &Stage<'_>,
    list: &mut DrawList,
    quantity: &Quantity,
    vectors: &[(DVec3, DVec3)],
    scale: Option<f64>,
) {
    add_arrows(stage, list, quantity, vectors, (scale, 0.0));
}

/// As [`add_at`], with arrows that end at their places.
pub(super) fn add_ending(
    stage: &Stage<'_>,
    list: &mut DrawList,
    quantity: &Quantity,
    vectors: &[(DVec3, DVec3)],
    scale: Option<f64>,
) {
    add_arrows(stage, list, quantity, vectors, (scale, 1.0));
}

/// `back`: how much of an arrow lies before its place.
fn add_arrows(
    stage: &Stage<'_>,
    list: &mut DrawList,
    quantity: &Quantity,
    vectors: &[(DVec3, DVec3)],
    (scale, back): (Option<f64>, f64),
) {
    let Some(metres_per_unit) = scale else { return };
    let share = share_of_size(stage.input.viewport, vectors.len());
    for (place, vector) in vectors.iter().take(MOST) {
        let Some(direction) = vector.try_normalize() else { continue };
        let shortest = SHORTEST * share * stage.metres_per_point(*place);
        let arrow = direction * (vector.length() * metres_per_unit).max(shortest);
        let start = *place - back * arrow;
        let (from, to) = (list.local(start), list.local(start + arrow));
        list.arrows.push(Arrow { from, to, color: quantity.color, width: width_of(share) });
    }
    if vectors.len() > MOST {
        let name = quantity.name;
        list.notes.push(format!("{name}: the first {MOST} of {} arrows.", vectors.len()));
    }
}
