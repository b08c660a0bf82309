//! What an empty window offers: open a file, a sample, or begin.

use egui::{Align2, Label, Response, RichText, Ui};

use super::context::AppContext;
use crate::editor::{SAMPLES, SampleGroup, Session, SessionCommand};
use crate::scene::shown_path;

/// Whether there is nothing to lose and nothing to see yet.
pub fn is_wanted(session: &Session) -> bool {
    let empty = session.scene().is_some_and(|scene| scene.bodies.is_empty() && scene.forces.is_empty());
    empty && session.path().is_none() && !session.is_dirty()
}

/// Width of the card within its frame, points.
const WIDTH: f32 = 500.0;

/// The card leaves the menus at the top of the window free, points.
const MENUS: f32 = 26.0;

/// Samples beside each other: all of them fit in a window of 500 points.
const COLUMNS: usize = 3;

/// A card over the views, as low as it can be: small windows show all of it. Returns whether it was closed.
pub fn show(ctx: &egui::Context, area: egui::Rect, context: &AppContext<'_>) -> bool {
    let mut closed = ctx.input(|input| input.key_pressed(egui::Key::Escape));
    egui::Area::new(egui::Id::unique("start"))
        .fixed_pos(area.center())
        .pivot(Align2::CENTER_CENTER)
        .constrain_to(ctx.content_rect().with_min_y(MENUS))
        .order(egui::Order::Middle)
        .show(ctx, |ui| {
            egui::Frame::window(ui.style()).inner_margin(egui::Margin::same(18)).show(ui, |ui| {
                ui.set_width(WIDTH);
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
                    if empty.on_hover_text("Closes this card (Esc); add bodies from the Add menu").clicked() {
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
    let introductions: Vec<usize> =
        (0..SAMPLES.len()).filter(|index| SAMPLES[*index].group == SampleGroup::Introduction).collect();
    // Down the first column, then the next: their order is that of learning.
    let rows = introductions.len().div_ceil(COLUMNS);
    let mut meant = None;
    let width = WIDTH / COLUMNS as f32 - 12.0;
    let grid =
        egui::Grid::new("start samples").num_columns(COLUMNS).min_col_width(width).spacing([12.0, 3.0]);
    grid.show(ui, |ui| {
        for row in 0..rows {
            for index in (0..COLUMNS).filter_map(|column| introductions.get(column * rows + row)) {
                if sample(ui, *index, &mut meant).clicked() {
                    context.outbox.command(SessionCommand::OpenSample(*index));
                }
            }
            ui.end_row();
        }
    });
    ui.add_space(4.0);
    // One line whatever it says, so that the card keeps its size under the pointer.
    let shows = meant.unwrap_or("Point at a sample to read what it shows. Hard cases: File, Samples.");
    ui.add(Label::new(RichText::new(shows).weak()).truncate());
    ui.add_space(8.0);
}

/// A link; `meant` becomes what the sample shows while the pointer or the keyboard is at it.
fn sample(ui: &mut Ui, index: usize, meant: &mut Option<&'static str>) -> Response {
    let sample = &SAMPLES[index];
    let link = ui.link(sample.title);
    if link.hovered() || link.has_focus() {
        *meant = Some(sample.shows);
    }
    link
}

fn recent(ui: &mut Ui, context: &AppContext<'_>) {
    let recent = &context.session.settings().recent;
    if recent.is_empty() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 12.0;
        ui.label(RichText::new("Recent").strong());
        for (index, path) in recent.iter().take(5).enumerate() {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            if ui.link(name.as_ref()).on_hover_text(shown_path(path)).clicked() {
                context.outbox.command(SessionCommand::OpenRecent(index));
            }
        }
    });
    ui.add_space(4.0);
}
