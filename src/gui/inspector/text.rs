//! Text fields that become an edit when they are left.

use egui::{TextEdit, Ui};

use crate::editor::Action;
use crate::gui::context::{Message, Outbox};
use crate::scene::Edit;

/// The text being typed, and into which field.
#[derive(Default)]
pub struct TextFields {
    typing: Option<(egui::Id, String)>,
}

impl TextFields {
    /// `value` is what the field holds now; `hint` stands in an empty field; `edit` may say why a text is
    /// refused.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        outbox: &Outbox,
        name: &str,
        value: &str,
        hint: &str,
        edit: impl FnOnce(&str) -> Result<Edit, String>,
    ) {
        let id = ui.make_persistent_id(("text field", name));
        let mut text = match &self.typing {
            Some((field, text)) if *field == id => text.clone(),
            _ => value.to_owned(),
        };
        let widget = TextEdit::singleline(&mut text).id(id).hint_text(hint).desired_width(f32::INFINITY);
        let response = ui.add(widget).accessible_name(name);
        if response.has_focus() {
            self.typing = Some((id, text));
        } else if response.lost_focus() {
            self.typing = None;
            let cancelled = ui.input(|input| input.key_pressed(egui::Key::Escape));
            let text = text.trim();
            if !cancelled && text != value {
                match edit(text) {
                    Ok(edit) => outbox.act(Action::Edit { edit, gesture: None }),
                    Err(reason) => outbox.send(Message::Warn(reason)),
                }
            }
        }
    }
}

/// Reads a typed UserID, or the reason why it is not one.
pub fn user_id(text: &str) -> Result<i64, String> {
    text.parse().map_err(|_| format!("“{text}” is not a UserID: it must be a whole number, such as 17"))
}
