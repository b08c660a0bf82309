//! What lies between two to four things that are selected, in the order in which they were: gap, way between centres, angle,
//! and how fast they come together.

use egui::{Grid, Ui};

use super::bodies::row;
use super::section;
use crate::gui::context::{AppContext, Shown};
use crate::gui::numbers::significant;
use crate::record::BodyFrame;
use crate::scene::NodeKey;
use crate::view::{Measurable, Measured};

/// More of them are a crowd, not something to measure.
const MOST: usize = 4;

pub fn show(ui: &mut Ui, context: &AppContext<'_>, shown: &Shown, keys: &[NodeKey]) {
    if !(2..=MOST).contains(&keys.len()) {
        return;
    }
    for pair in keys.windows(2) {
        let [Some(one), Some(other)] = [pair[0], pair[1]].map(|key| measurable(context, shown, key)) else {
            continue;
        };
        let [a, b] = [pair[0], pair[1]].map(|key| shown.name(key).unwrap_or_default());
        section(ui, &format!("{a} – {b}"));
        let measured = Measured::between(one, other);
        let closing = closing(context, [pair[0], pair[1]], &measured);
        Grid::new(("between", pair)).num_columns(3).spacing([6.0, 3.0]).show(ui, |ui| {
            rows(ui, &measured, closing);
        });
    }
    ui.add_space(6.0);
    ui.separator();
}

fn rows(ui: &mut Ui, measured: &Measured, closing: Option<f64>) {
    const DIGITS: usize = 8;
    if let Some(gap) = measured.gap {
        let help = "Between the surfaces; negative where they overlap";
        row(ui, ["Gap", ""], significant(gap.distance, DIGITS), "m", help);
    }
    row(ui, ["Centres", ""], significant(measured.centres, DIGITS), "m", "From centre to centre");
    if let Some(angle) = measured.angle {
        row(ui, ["Angle", ""], significant(angle.to_degrees(), DIGITS), "°", "Between the planes of both");
    }
    if let Some(closing) = closing {
        let help = "How fast the gap closes; negative where it opens";
        row(ui, ["Closing at", ""], significant(closing, DIGITS), "m/s", help);
    }
}

/// Something selected, where it is now.
fn measurable<'a>(context: &AppContext<'_>, shown: &'a Shown, key: NodeKey) -> Option<Measurable<'a>> {
    if let Some(body) = shown.body(key) {
        let at = moving(context, key).map_or(body.position, |now| now.position);
        return Some(Measurable::Body(body, at));
    }
    Measurable::of_force(shown.force(key)?)
}

/// m/s; `None` where nothing moves.
fn closing(context: &AppContext<'_>, keys: [NodeKey; 2], measured: &Measured) -> Option<f64> {
    let velocities = keys.map(|key| moving(context, key).map(|now| now.velocity));
    let gap = measured.gap.filter(|_| velocities.iter().any(Option::is_some))?;
    let [one, other] = velocities.map(Option::unwrap_or_default);
    Some((one - other).dot(gap.towards))
}

fn moving<'a>(context: &'a AppContext<'_>, key: NodeKey) -> Option<&'a BodyFrame> {
    context.session.frame().bodies.iter().find(|body| body.key == key)
}
