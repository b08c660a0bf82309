//! What an empty window offers: open a file, a sample, or begin.

use egui::{Align2, RichText, Ui};

use super::context::AppContext;
use crate::editor::{SAMPLES, SampleGroup, Session, SessionCommand};
use crate::scene::shown_path;

/// Whether there is nothing to lose and nothing to see yet.
pub fn is_wanted(session: &Session) -> bool {
    let empty = session.scene().is_some_and(|scene| scene.bodies.is_empty() && scene.forces.is_empty());
    empty && session.path().is_none() && !session.is_dirty()
}

/// A card over the views. Returns whether it was closed.
pub fn show(ctx: &egui::Context, area: egui::Rect, context: &AppContext<'_>) -> bool {
    let mut closed = false;
    egui::Area::new(egui::Id::unique("start"))
        .fixed_pos(area.center())
        .pivot(Align2::CENTER_CENTER)
        .order(egui::Order::Middle)
        .show(ctx, |ui| {
            egui::Frame::window(ui.style()).inner_margin(egui::Margin::same(18)).show(ui, |ui| {
                ui.set_width(460.0);
                ui.label(RichText::new("PolyScene").heading().strong());
                ui.label(
                    RichText::new("Design a scene of rigid bodies, then step through its collisions.").weak(),
                );
                ui.add_space(8.0);
                ui.horizontal(|ui| {
                    if ui.button("Open…").on_hover_text("Opens a scene file (Ctrl+O)").clicked() {
                        context.outbox.command(SessionCommand::Open);
                    }
                    let empty = ui.button("Empty scene");
                    if empty.on_hover_text("Closes this card; add bodies from the Add menu").clicked() {
                        closed = true;
                    }
                });
                ui.add_space(8.0);
                samples(ui, context);
                recent(ui, context);
                ui.add_space(4.0);
                ui.label(RichText::new("A scene file can also be dropped on the window.").weak());
            });
        });
    closed
}

fn samples(ui: &mut Ui, context: &AppContext<'_>) {
    ui.label(RichText::new("Samples").strong());
    egui::Grid::new("start samples").num_columns(2).spacing([12.0, 3.0]).show(ui, |ui| {
        let introductions = SAMPLES.iter().enumerate();
        for (index, sample) in introductions.filter(|(_, sample)| sample.group == SampleGroup::Introduction) {
            if ui.link(sample.title).clicked() {
                context.outbox.command(SessionCommand::OpenSample(index));
            }
            ui.label(RichText::new(sample.shows).weak());
            ui.end_row();
        }
    });
    ui.label(RichText::new("The hard cases of numerics are under File, Samples, Hard cases.").weak());
    ui.add_space(8.0);
}

fn recent(ui: &mut Ui, context: &AppContext<'_>) {
    let recent = &context.session.settings().recent;
    if recent.is_empty() {
        return;
    }
    ui.label(RichText::new("Recent").strong());
    for (index, path) in recent.iter().take(5).enumerate() {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        if ui.link(name.as_ref()).on_hover_text(shown_path(path)).clicked() {
            context.outbox.command(SessionCommand::OpenRecent(index));
        }
    }
    ui.add_space(4.0);
}
