//! The command palette: everything that can be done, found by its name.

use egui::{Align2, Area, Context, Id, Key, Modal, RichText, ScrollArea, TextEdit, vec2};

use crate::editor::{self, PaletteEntry};
use crate::gui::colors::tones;
use crate::gui::context::AppContext;

#[derive(Default)]
pub struct Palette {
    query: String,
    chosen: usize,
    started: bool,
}

impl Palette {
    /// Whether it is done with.
    pub fn show(&mut self, ctx: &Context, context: &AppContext<'_>) -> bool {
        let area = Area::new(Id::unique("command palette area"))
            .anchor(Align2::CENTER_TOP, vec2(0.0, 90.0))
            .order(egui::Order::Foreground);
        let mut done = false;
        let modal = Modal::new(Id::unique("command palette")).area(area).show(ctx, |ui| {
            ui.set_width(520.0);
            let edit = TextEdit::singleline(&mut self.query)
                .hint_text("Type part of the name of a command, sample, file or overlay")
                .desired_width(f32::INFINITY);
            let response = ui.add(edit).accessible_name("Search commands");
            if !std::mem::replace(&mut self.started, true) {
                response.request_focus();
            }
            if response.changed() {
                self.chosen = 0;
            }
            let found = editor::palette(context.session, &self.query);
            let (up, down, enter) = ui.input(|input| {
                (
                    input.key_pressed(Key::ArrowUp),
                    input.key_pressed(Key::ArrowDown),
                    input.key_pressed(Key::Enter),
                )
            });
            let last = found.len().saturating_sub(1);
            self.chosen = match (up, down) {
                (true, _) => self.chosen.saturating_sub(1),
                (_, true) => (self.chosen + 1).min(last),
                _ => self.chosen.min(last),
            };
            ui.add_space(4.0);
            let moved = up || down;
            let clicked = list(ui, &found, self.chosen, moved);
            let chosen = clicked.or((enter && !found.is_empty()).then_some(self.chosen));
            if let Some(entry) = chosen.and_then(|index| found.get(index)) {
                if entry.disabled.is_none() {
                    context.outbox.command(entry.command);
                }
                done = true;
            }
            if enter && found.is_empty() {
                response.request_focus();
            }
        });
        done || modal.should_close()
    }
}

/// The line that was clicked.
fn list(ui: &mut egui::Ui, found: &[PaletteEntry], chosen: usize, scroll: bool) -> Option<usize> {
    let mut clicked = None;
    if found.is_empty() {
        ui.label(RichText::new("Nothing has that name.").color(tones(ui).weak));
    }
    ScrollArea::vertical().max_height(340.0).auto_shrink([false, true]).show(ui, |ui| {
        for (index, entry) in found.iter().enumerate() {
            let shortcut = editor::info(entry.command).and_then(|info| info.shortcuts.first());
            let button = egui::Button::selectable(index == chosen, entry.label.as_str())
                .right_text(shortcut.map_or(String::new(), ToString::to_string))
                .min_size(vec2(ui.available_width(), 22.0));
            let response = ui.add_enabled(entry.disabled.is_none(), button);
            let response = response.on_hover_text(&entry.help);
            let reason = entry.disabled.map_or(String::new(), |reason| format!("Not now: {reason}."));
            let response = response.on_disabled_hover_text(reason);
            if index == chosen && scroll {
                response.scroll_to_me(None);
            }
            if response.clicked() {
                clicked = Some(index);
            }
        }
    });
    clicked
}
