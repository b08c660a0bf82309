//! The timeline in two levels: the whole run above, the Δt being looked at below.

mod axis;
mod bookmarks;
mod run;
mod step;

use egui::Ui;

use super::context::AppContext;

/// Height of both levels, points.
pub const HEIGHT: f32 = run::HEIGHT + step::HEIGHT;

/// Keeps what part of the run is shown.
#[derive(Default)]
pub struct Timeline {
    run: run::RunLine,
    /// Whether the tile crossings of the selected bodies are marked.
    crossings: bool,
}

impl Timeline {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        ui.spacing_mut().item_spacing.y = 0.0;
        self.run.show(ui, context);
        step::show(ui, context, &mut self.crossings);
    }

    /// Another document: the whole run is shown again.
    pub fn opened(&mut self) {
        *self = Self { crossings: self.crossings, ..Self::default() };
    }

    pub fn shows_crossings(&self) -> bool {
        self.crossings
    }
}
