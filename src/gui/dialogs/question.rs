//! Questions before something could be lost.

use egui::{Context, Id, Modal};

use crate::editor::{Answer, Question};

/// The answer, once it is given. Escape gives the harmless one, Enter the first.
pub fn show(ctx: &Context, question: &Question) -> Option<Answer> {
    let mut answer = None;
    let modal = Modal::new(Id::unique("question")).show(ctx, |ui| {
        ui.set_width(400.0);
        ui.heading(question.title());
        ui.add_space(6.0);
        ui.label(question.text());
        ui.add_space(12.0);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            for choice in question.answers().iter().rev() {
                let first = question.answers().first() == Some(choice);
                let button = egui::Button::new(choice.label()).min_size(egui::vec2(76.0, 24.0));
                let button = if first { button.fill(ui.visuals().selection.bg_fill) } else { button };
                if ui.add(button).clicked() {
                    answer = Some(*choice);
                }
            }
        });
        if ui.input(|input| input.key_pressed(egui::Key::Enter))
            && ctx.memory(|memory| memory.focused().is_none())
        {
            answer = answer.or(question.answers().first().copied());
        }
    });
    // A click beside it answers nothing: what is asked about would be out of sight, and perhaps lost.
    if modal.should_close() && !modal.backdrop_response.clicked() {
        answer = answer.or(Some(question.dismissal()));
    }
    answer
}
