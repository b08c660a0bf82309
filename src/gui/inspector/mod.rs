//! The inspector: every number of what is selected, at the start and now, for one object or several.

mod between;
mod bodies;
mod contacts;
mod forces;
pub mod number;
mod place;
mod text;

use egui::{RichText, ScrollArea, Ui};

use super::colors::tones;
use super::context::{AppContext, Shown};
use super::widgets::panel_heading;
use crate::editor::Place;
use crate::scene::NodeKey;
use text::TextFields;

/// Keeps what is being typed.
#[derive(Default)]
pub struct Inspector {
    texts: TextFields,
}

impl Inspector {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let Some(shown) = context.shown else {
            ui.label(RichText::new("  There is no scene to look at.").color(tones(ui).weak));
            return;
        };
        let selection = context.session.selection();
        let keys = selection.keys();
        let bodies: Vec<NodeKey> = keys.iter().copied().filter(|key| shown.body(*key).is_some()).collect();
        let forces: Vec<NodeKey> = keys.iter().copied().filter(|key| shown.force(*key).is_some()).collect();
        panel_heading(ui, &title(context, shown, &bodies, &forces), |_| {});
        ScrollArea::vertical().auto_shrink([false, false]).id_salt("inspector").show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 4)).show(ui, |ui| {
                match selection.place() {
                    Some(Place::Map) => place::map(ui, context, shown),
                    Some(Place::Simulation) => place::simulation(ui, context, shown),
                    None if keys.is_empty() => {
                        place::map(ui, context, shown);
                        place::simulation(ui, context, shown);
                    }
                    None => {}
                }
                between::show(ui, context, shown, keys);
                if !bodies.is_empty() {
                    bodies::show(ui, context, shown, &bodies, &mut self.texts);
                    if let [body] = bodies[..] {
                        contacts::show(ui, context, body);
                    }
                }
                if !forces.is_empty() {
                    forces::show(ui, context, shown, &forces, &mut self.texts);
                }
            });
        });
    }
}

fn title(context: &AppContext<'_>, shown: &Shown, bodies: &[NodeKey], forces: &[NodeKey]) -> String {
    match (bodies, forces, context.session.selection().place()) {
        (_, _, Some(Place::Map)) => "Map".to_owned(),
        (_, _, Some(Place::Simulation)) => "Simulation".to_owned(),
        ([], [], None) => "Scene".to_owned(),
        ([key], [], _) | ([], [key], _) => {
            let kind = shown.body(*key).map(bodies::kind);
            let kind = kind.or_else(|| shown.force(*key).map(super::tree::force_kind));
            format!("{} · {}", shown.name(*key).unwrap_or_default(), kind.unwrap_or_default())
        }
        (bodies, [], _) => format!("{} bodies", bodies.len()),
        ([], forces, _) => format!("{} forces", forces.len()),
        (bodies, forces, _) => {
            let counted = |count, one, many| format!("{count} {}", if count == 1 { one } else { many });
            let bodies = counted(bodies.len(), "body", "bodies");
            format!("{bodies}, {}", counted(forces.len(), "force", "forces"))
        }
    }
}

/// A section's name with a line under it.
fn section(ui: &mut Ui, name: &str) {
    ui.add_space(6.0);
    ui.label(RichText::new(name).small().strong().color(tones(ui).weak));
    ui.separator();
}
