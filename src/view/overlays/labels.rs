//! Names beside bodies and forces. Where names would overlap, the more important one stays.

use glam::{DVec2, DVec3};

use crate::scene::{Shape, rotation_matrix};
use crate::view::stage::{Posed, Stage};
use crate::view::{Align, DrawList, Label, forces};

const MOST: usize = 400;
const SIZE: f64 = 12.0;

/// Width of a letter over the size of the font; close enough to keep names apart.
const LETTER_WIDTH: f64 = 0.52;

struct Name<'a> {
    text: &'a str,
    at: DVec2,
    /// Smaller is more important.
    rank: (u8, f64),
}

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let bodies = stage.bodies.iter().filter(|posed| is_named(stage, posed));
    let mut names: Vec<Name<'_>> = bodies
        .filter_map(|posed| {
            name(stage, posed.body.display_name(), posed.position, above(stage, posed), rank(posed))
        })
        .collect();
    names.extend(forces::visible(stage.input.scene).filter_map(|(force, place)| {
        let text = force.display_name();
        name(stage, text, place, 10.0, 1)
    }));
    names.sort_by(|a, b| a.rank.0.cmp(&b.rank.0).then(a.rank.1.total_cmp(&b.rank.1)));

    let mut taken: Vec<(DVec2, DVec2)> = Vec::new();
    let mut left_out = 0;
    for Name { text, at, .. } in &names {
        let half = DVec2::new(0.5 * SIZE * LETTER_WIDTH * text.chars().count() as f64 + 4.0, 0.7 * SIZE);
        let center = *at - DVec2::new(0.0, half.y);
        let free = |(other, size): &(DVec2, DVec2)| (center - *other).abs().cmpgt(half + *size).any();
        if taken.len() >= MOST || !taken.iter().all(free) {
            left_out += 1;
            continue;
        }
        taken.push((center, half));
        list.labels.push(Label {
            position: at.as_vec2(),
            text: (*text).to_owned(),
            color: stage.palette.text,
            size: SIZE as f32,
            align: Align::CenterBottom,
            back: stage.palette.label_back,
        });
    }
    if left_out > 0 {
        list.notes.push(format!("Names: {left_out} have no room; zoom in to see them."));
    }
}

/// Not walls in front of the scene, nor plates seen edge-on, unless they are meant.
fn is_named(stage: &Stage<'_>, posed: &Posed<'_>) -> bool {
    const EDGE_ON: f64 = 0.1;
    let edge_on = || {
        let normal = rotation_matrix(posed.body.rotation).z_axis;
        matches!(posed.body.shape, Shape::Plane { .. }) && normal.dot(stage.camera.backward()).abs() < EDGE_ON
    };
    posed.selected || posed.hovered || !(stage.is_see_through(posed) || edge_on())
}

fn name<'a>(stage: &Stage<'_>, text: &'a str, place: DVec3, above: f64, rank: u8) -> Option<Name<'a>> {
    let depth = stage.camera.project(place, stage.input.viewport.aspect())?.z;
    let at = stage.on_screen(place)? - DVec2::new(0.0, above);
    let viewport = stage.input.viewport;
    let inside = at.cmpge(DVec2::ZERO).all() && at.cmple(DVec2::new(viewport.width, viewport.height)).all();
    inside.then_some(Name { text, at, rank: (rank, depth) })
}

/// From the body's middle to its name, points.
fn above(stage: &Stage<'_>, posed: &Posed<'_>) -> f64 {
    match posed.body.shape {
        Shape::Sphere { radius } => radius / stage.metres_per_point(posed.position) + 3.0,
        // Over the middle of a plate, above the cross of what cannot be drawn.
        Shape::Plane { .. } => -0.5 * SIZE,
        Shape::Unbuilt { .. } => SIZE,
    }
}

fn rank(posed: &Posed<'_>) -> u8 {
    match (posed.selected || posed.hovered, posed.body.is_dynamic()) {
        (true, _) => 0,
        (false, true) => 1,
        (false, false) => 2,
    }
}
