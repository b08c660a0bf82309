//! What the program remembers by choice: the memory that the recording of a run may take.

use egui::{Context, Id, Key, Modal, RichText, TextEdit, Ui};

use crate::editor::{Action, RECORDING_MIB, Session, parse_number};
use crate::gui::colors::tones;
use crate::gui::context::AppContext;
use crate::gui::numbers::significant;
use crate::record::Recorded;

/// Digits of numbers of MiB.
const DIGITS: usize = 8;

pub struct SettingsDialog {
    /// MiB, as typed.
    text: String,
    typing: bool,
}

impl SettingsDialog {
    pub fn new(session: &Session) -> Self {
        Self { text: significant(session.settings().recording_mib(), DIGITS), typing: false }
    }

    /// Whether it is done with. What is typed holds at once, with Enter or when the field is left.
    pub fn show(&mut self, ctx: &Context, context: &AppContext<'_>) -> bool {
        let mut closed = false;
        let was_typing = self.typing;
        let modal = Modal::new(Id::unique("settings")).show(ctx, |ui| {
            ui.set_width(440.0);
            ui.heading("Settings");
            ui.add_space(6.0);
            self.memory(ui, context);
            ui.add_space(8.0);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                closed = ui.button("Close").clicked();
            });
        });
        // Escape out of the field leaves what was typed, not the dialog.
        closed || (modal.should_close() && !was_typing)
    }

    fn memory(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let (low, high) = RECORDING_MIB;
        let help = format!(
            "A run is kept as it goes on, so that you can go back to any moment of it. A recording that would take more \
             than this keeps fewer states to go on from, then its oldest part is dropped. From {low} to {high} MiB; \
             256 bytes for each flight from one event to the next are usual."
        );
        let known = significant(context.session.settings().recording_mib(), DIGITS);
        ui.horizontal(|ui| {
            let label = ui.label("Memory of a recording").on_hover_text(&help);
            if !self.typing {
                self.text.clone_from(&known);
            }
            let edit = TextEdit::singleline(&mut self.text).desired_width(80.0);
            let response = ui.add(edit).labelled_by(label.id).on_hover_text(&help);
            ui.label(RichText::new("MiB").color(tones(ui).weak));
            self.typing = response.has_focus();
            let left_alone = ui.input(|input| input.key_pressed(Key::Escape)) || self.text.trim() == known;
            if response.lost_focus() && !left_alone {
                // What is no number is out of range: the refusal says what would be in it.
                let mib = parse_number(&self.text).unwrap_or(f64::NAN);
                context.outbox.act(Action::SetMemory(Some(mib)));
            }
            let default = ui.small_button("↺").on_hover_text("Back to the default: 1024 MiB");
            if default.accessible_name("Reset memory of a recording").clicked() {
                context.outbox.act(Action::SetMemory(None));
            }
        });
        let recorded = &context.session.frame().recorded;
        ui.label(RichText::new(now(recorded)).color(tones(ui).weak));
        let wanted = parse_number(&self.text).unwrap_or(f64::INFINITY);
        if self.typing && wanted < recorded.bytes as f64 / f64::from(1 << 20) {
            let text = "This is less than the run has taken so far: its oldest part will be dropped.";
            ui.label(RichText::new(text).color(tones(ui).warning));
        }
    }
}

/// What the run that is open takes of it.
fn now(recorded: &Recorded) -> String {
    let used = significant(recorded.bytes as f64 / f64::from(1 << 20), 3);
    let taken = format!("This run takes {used} MiB so far");
    if recorded.from > 0.0 {
        let from = significant(recorded.from, 4);
        return format!("{taken}; what was before {from} s was dropped.");
    }
    format!("{taken}; nothing was dropped.")
}
