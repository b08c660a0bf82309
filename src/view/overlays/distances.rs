//! Between two to four things that are selected: the gap of each to the next, and the angle of plates or of three in a row.

use glam::{DVec2, DVec3};

use crate::scene::NodeKey;
use crate::view::format::{number, with_unit};
use crate::view::measure::{Measurable, Measured, angle_at};
use crate::view::stage::{Pen, Stage};
use crate::view::{Align, DrawList, Label, Point, PointShape};

/// More of them are a crowd, not something to measure.
const MOST: usize = 4;
const SIZE: f32 = 12.0;

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let selection = stage.input.selection;
    if !(2..=MOST).contains(&selection.len()) {
        return;
    }
    let things: Vec<Measurable<'_>> = selection.iter().filter_map(|key| thing(stage, *key)).collect();
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
        label(stage, list, 0.5 * (measured.ends[0] + measured.ends[1]), text(&measured));
    }
    for three in things.windows(3) {
        let [before, middle, after] = [three[0], three[1], three[2]].map(Measurable::place);
        if let Some(angle) = angle_at(before, middle, after) {
            label(stage, list, middle, in_degrees(angle));
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
    let gap = measured.gap.map(|gap| match gap.distance {
        gap if gap < 0.0 => format!("overlap {}", with_unit(-gap)),
        gap => format!("gap {}", with_unit(gap)),
    });
    let angle = measured.angle.filter(|angle| *angle > 0.0).map(in_degrees);
    let centres = format!("centres {}", with_unit(measured.centres));
    let parts: Vec<String> = gap.into_iter().chain(angle).chain([centres]).collect();
    parts.join(" · ")
}

fn in_degrees(angle: f64) -> String {
    format!("{}°", number(angle.to_degrees(), 2))
}

fn label(stage: &Stage<'_>, list: &mut DrawList, at: DVec3, text: String) {
    let Some(place) = stage.on_screen(at) else { return };
    list.labels.push(Label {
        position: (place - DVec2::new(0.0, 6.0)).as_vec2(),
        text,
        color: stage.palette.measure,
        size: SIZE,
        align: Align::CenterBottom,
        back: stage.palette.label_back,
    });
}
