//! What lies under the pointer, nearest first, and what lies in a rectangle.

use glam::{DVec2, DVec3};

use super::sight::Sight;
use super::stage::{Posed, Stage};
use super::{Ray, ViewInput, forces};
use crate::scene::{NodeKey, Shape, rotation_matrix};

/// Something under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// A body or a force.
    pub key: NodeKey,
    /// Along the ray, m.
    pub distance: f64,
    /// World coordinates, m.
    pub point: DVec3,
}

/// Bodies that look smaller than this are picked as if they had this radius, points.
const SMALLEST_RADIUS: f64 = 4.0;

/// Radius in which a force's marker is picked, points.
const MARKER_RADIUS: f64 = 9.0;

/// Everything under `ndc`, nearest first: repeated clicks go through it. Hidden bodies and see-through
/// walls are left out; markers of forces, drawn over everything, come first.
pub fn pick(input: &ViewInput<'_>, ndc: DVec2) -> Vec<Hit> {
    let stage = Stage::new(input);
    let ray = stage.camera.ray(ndc, input.viewport.aspect());
    let mut hits: Vec<Hit> = stage
        .bodies
        .iter()
        .filter(|posed| !stage.is_see_through(posed))
        .filter_map(|posed| Some((posed.body.key, ray_body(&stage, &ray, posed)?)))
        .map(|(key, distance)| Hit { key, distance, point: ray.at(distance) })
        .collect();
    hits.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.key.cmp(&b.key)));
    let mut all = markers_at(&stage, ndc);
    all.append(&mut hits);
    all
}

/// Bodies and forces whose centre is seen inside the rectangle of two corners, in file order. Without `through`, no
/// body whose centre is behind another one.
pub fn pick_rect(input: &ViewInput<'_>, corner_a: DVec2, corner_b: DVec2, through: bool) -> Vec<NodeKey> {
    let (min, max) = (corner_a.min(corner_b), corner_a.max(corner_b));
    pick_where(input, through, |at| at.cmpge(min).all() && at.cmple(max).all())
}

/// As [`pick_rect`], inside a closed outline; where it crosses itself, the even-odd rule says what is inside.
pub fn pick_outline(input: &ViewInput<'_>, outline: &[DVec2], through: bool) -> Vec<NodeKey> {
    pick_where(input, through, |at| is_inside(outline, at))
}

/// Whether a half-line to the right crosses the outline an odd number of times.
fn is_inside(outline: &[DVec2], at: DVec2) -> bool {
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    let crosses = |(a, b): &(&DVec2, &DVec2)| {
        let share = (at.y - a.y) / (b.y - a.y);
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + share * (b.x - a.x)
    };
    ends.filter(crosses).count() % 2 == 1
}

fn pick_where(input: &ViewInput<'_>, through: bool, within: impl Fn(DVec2) -> bool) -> Vec<NodeKey> {
    let stage = Stage::new(input);
    let aspect = input.viewport.aspect();
    let inside = |place: DVec3| stage.camera.project(place, aspect).is_some_and(|at| within(at.truncate()));
    let sight = (!through).then(|| Sight::of(&stage, |posed| reach(&stage, posed)));
    let bodies = stage
        .bodies
        .iter()
        .filter(|posed| !stage.is_see_through(posed) && inside(posed.position))
        .filter(|posed| sight.as_ref().is_none_or(|sight| is_in_sight(&stage, sight, posed)))
        .map(|posed| posed.body.key);
    let forces = forces::visible(input.scene).filter(|(_, place)| inside(*place)).map(|(force, _)| force.key);
    bodies.chain(forces).collect()
}

/// Whether nothing is seen before a body in the direction of its centre.
fn is_in_sight(stage: &Stage<'_>, sight: &Sight, posed: &Posed<'_>) -> bool {
    let aspect = stage.input.viewport.aspect();
    let Some(at) = stage.camera.project(posed.position, aspect).map(DVec3::truncate) else { return false };
    let ray = stage.camera.ray(at, aspect);
    let Some(own) = ray_body(stage, &ray, posed) else { return true };
    let before = |other: &Posed<'_>| {
        other.body.key != posed.body.key
            && !stage.is_see_through(other)
            && ray_body(stage, &ray, other).is_some_and(|distance| distance < own)
    };
    !sight.at(at).any(|index| before(&stage.bodies[index]))
}

/// Radius around its centre within which a body is picked, m.
fn reach(stage: &Stage<'_>, posed: &Posed<'_>) -> f64 {
    let points = |points: f64| points * stage.metres_per_point(posed.position);
    match posed.body.shape {
        Shape::Sphere { radius } => radius.max(points(SMALLEST_RADIUS)),
        Shape::Plane { half_x, half_y } => libm::hypot(half_x, half_y),
        Shape::Unbuilt { .. } => points(MARKER_RADIUS),
    }
}

fn markers_at(stage: &Stage<'_>, ndc: DVec2) -> Vec<Hit> {
    let viewport = stage.input.viewport;
    let pointer = viewport.points(ndc);
    let mut near: Vec<(f64, Hit)> = forces::visible(stage.input.scene)
        .filter_map(|(force, place)| {
            let seen = stage.camera.project(place, viewport.aspect())?;
            let off = viewport.points(seen.truncate()).distance(pointer);
            (off <= MARKER_RADIUS).then_some((off, Hit { key: force.key, distance: seen.z, point: place }))
        })
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.key.cmp(&b.1.key)));
    near.into_iter().map(|(_, hit)| hit).collect()
}

fn ray_body(stage: &Stage<'_>, ray: &Ray, posed: &Posed<'_>) -> Option<f64> {
    let center = posed.position;
    match posed.body.shape {
        Shape::Sphere { .. } | Shape::Unbuilt { .. } => ray_sphere(ray, center, reach(stage, posed)),
        Shape::Plane { half_x, half_y } => {
            ray_plate(ray, center, rotation_matrix(posed.body.rotation), half_x, half_y)
        }
    }
}

/// Distance to the first point of a sphere ahead of the ray's origin.
fn ray_sphere(ray: &Ray, center: DVec3, radius: f64) -> Option<f64> {
    let to_center = center - ray.origin;
    let along = to_center.dot(ray.direction);
    // The squared distance from the line: as a rejection it loses no digits when the centre is far away.
    let off_squared = (to_center - ray.direction * along).length_squared();
    let half_chord = (radius * radius - off_squared).sqrt();
    // NaN when the line misses.
    [along - half_chord, along + half_chord].into_iter().find(|distance| *distance > 0.0)
}

/// Distance to a rectangle in its own frame: |x| ≤ half_x, |y| ≤ half_y at z = 0.
fn ray_plate(ray: &Ray, center: DVec3, rotation: glam::DMat3, half_x: f64, half_y: f64) -> Option<f64> {
    let local = rotation.transpose();
    let (origin, direction) = (local * (ray.origin - center), local * ray.direction);
    let distance = -origin.z / direction.z;
    let hit = origin + direction * distance;
    (distance.is_finite() && distance > 0.0 && hit.x.abs() <= half_x && hit.y.abs() <= half_y)
        .then_some(distance)
}
