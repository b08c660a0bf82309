//! Between two to four things that are selected: the gap of each to the next, and the angle of plates or of three in a row.

use glam::{DVec2, DVec3};

use crate::scene::NodeKey;
use crate::view::format::{number, with_unit};
use crate::view::measure::{Measurable, Measured, angle_at};
use crate::view::stage::{Pen, Stage};
use crate::view::{Align, DrawList, Label, Point, PointShape};

/// More of them are a crowd, not something to measure.
const MOST: usize = 4;

/// Size of the font, width of a letter over it, and height of a line, points.
const SIZE: f64 = 12.0;
const LETTER_WIDTH: f64 = 0.55;
const LINE: f64 = 18.0;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let selection = stage.input.selection;
    if !(2..=MOST).contains(&selection.len()) {
        return;
    }
    let things: Vec<Measurable<'_>> = selection.iter().filter_map(|key| thing(stage, *key)).collect();
    let mut taken = Vec::new();
    for pair in things.windows(2) {
        let measured = Measured::between(pair[0], pair[1]);
        stage.add_line(list, measured.ends, Pen::over_bodies(stage.palette.measure, 1.5));
        for end in measured.ends {
            let position = list.local(end);
            list.points.push(Point {
                position,
                color: stage.palette.measure,
                size: 5.0,
                shape: PointShape::Disc,
            });
        }
        let middle = 0.5 * (measured.ends[0] + measured.ends[1]);
        label(stage, list, &mut taken, middle, text(&measured));
    }
    for three in things.windows(3) {
        let [before, middle, after] = [three[0], three[1], three[2]].map(Measurable::place);
        if let Some(angle) = angle_at(before, middle, after) {
            label(stage, list, &mut taken, middle, in_degrees(angle));
        }
    }
}

/// Something selected, where it is seen.
fn thing<'a>(stage: &'a Stage<'_>, key: NodeKey) -> Option<Measurable<'a>> {
    let body = stage.bodies.iter().find(|posed| posed.body.key == key);
    let force = || stage.input.scene.forces.iter().find(|force| force.key == key);
    match body {
        Some(posed) => Some(Measurable::Body(posed.body, posed.position)),
        None => force().and_then(Measurable::of_force),
    }
}

fn text(measured: &Measured) -> String {
    match (measured.gap, measured.angle) {
        (Some(gap), _) if gap.distance < 0.0 => format!("overlap {}", with_unit(-gap.distance)),
        (Some(gap), _) => format!("gap {}", with_unit(gap.distance)),
        (None, Some(angle)) => in_degrees(angle),
        (None, None) => with_unit(measured.centres),
    }
}

fn in_degrees(angle: f64) -> String {
    format!("{}°", number(angle.to_degrees(), 2))
}

/// Puts a text above a place, or higher where others are already.
fn label(stage: &Stage<'_>, list: &mut DrawList, taken: &mut Vec<(DVec2, f64)>, at: DVec3, text: String) {
    let Some(place) = stage.on_screen(at) else { return };
    let half = 0.5 * LETTER_WIDTH * SIZE * text.chars().count() as f64 + 4.0;
    let mut position = place - DVec2::new(0.0, 6.0);
    let meets = |position: DVec2, (other, width): &(DVec2, f64)| {
        (position.x - other.x).abs() < half + width && (position.y - other.y).abs() < LINE
    };
    while taken.iter().any(|other| meets(position, other)) {
        position.y -= LINE;
    }
    taken.push((position, half));
    list.labels.push(Label {
        position: position.as_vec2(),
        text,
        color: stage.palette.measure,
        size: SIZE as f32,
        align: Align::CenterBottom,
        back: stage.palette.label_back,
    });
}
