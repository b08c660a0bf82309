//! Forces: their numbers, for one or several of the same kind.

use egui::{Grid, RichText, Ui};

use super::bodies::{row_label, speed};
use super::number::{Number, WIDTH, number};
use super::section;
use super::text::{TextFields, user_id};
use crate::editor::{FORCE_FIELDS, Shared, shared};
use crate::gui::colors::tones;
use crate::gui::context::{AppContext, Shown};
use crate::scene::{Edit, Force, ForceChange, ForceKind, NodeKey};

pub fn show(ui: &mut Ui, context: &AppContext<'_>, shown: &Shown, keys: &[NodeKey], texts: &mut TextFields) {
    let forces: Vec<&Force> = keys.iter().filter_map(|key| shown.force(*key)).collect();
    if let [force] = forces.as_slice() {
        // a body may be shown with it, whose fields have the same names
        ui.push_id(force.key, |ui| identity(ui, context, force, texts));
    }
    section(ui, "Values");
    Grid::new("force values").num_columns(3).spacing([6.0, 3.0]).show(ui, |ui| {
        for field in FORCE_FIELDS {
            for (axis, axis_name) in field.axes.iter().enumerate() {
                let value = shared(forces.iter().map(|force| field.value(force, axis)));
                if value == Shared::None {
                    continue;
                }
                row_label(ui, if axis == 0 { field.label } else { "" }, axis_name);
                let name = field.accessible_name(axis);
                let speed = speed(field.unit, value, shown.scene.map.size.max_element());
                let spec = Number {
                    name: &name,
                    value,
                    range: field.range,
                    speed,
                    width: WIDTH,
                    help: help(field.label, &forces),
                    angle: false,
                    whole: false,
                };
                number(ui, context.outbox, &spec, |typed| field.edit(&shown.scene, keys, axis, typed));
                ui.label(RichText::new(field.unit).color(tones(ui).weak));
                ui.end_row();
            }
        }
    });
    if let [force] = forces.as_slice() {
        ui.add_space(6.0);
        ui.label(RichText::new(law(force)).small().color(tones(ui).weak));
    }
}

fn identity(ui: &mut Ui, context: &AppContext<'_>, force: &Force, texts: &mut TextFields) {
    let key = force.key;
    Grid::new("force identity").num_columns(2).spacing([6.0, 4.0]).show(ui, |ui| {
        ui.label("Name");
        texts.show(ui, context.outbox, "Name", force.name.as_deref().unwrap_or(""), &force.label, |text| {
            let name = (!text.is_empty()).then(|| text.to_owned());
            Ok(Edit::Force { key, change: ForceChange::Name(name) })
        });
        ui.end_row();
        ui.label("User ID");
        texts.show(ui, context.outbox, "User ID", &force.id.to_string(), "", |text| {
            Ok(Edit::Force { key, change: ForceChange::Id(user_id(text)?) })
        });
        ui.end_row();
    });
}

fn help(label: &str, forces: &[&Force]) -> &'static str {
    let uniform = forces.iter().all(|force| matches!(force.kind, ForceKind::GravityPlane { .. }));
    match label {
        "Position" if uniform => "Only where the arrow is drawn: the field is the same everywhere",
        "Intensity" => "G: attracts when positive, repels when negative",
        _ => "",
    }
}

fn law(force: &Force) -> &'static str {
    match force.kind {
        ForceKind::GravityPlane { .. } => "F = m g, the same everywhere",
        ForceKind::GravityPoint { .. } => "F = G m r/|r|³, towards the point",
        ForceKind::Drag { .. } => {
            "F = −½ C ρ S |v| v, with C = 0.5 and S = π r². Makes the file Version 1.1."
        }
    }
}
