//! Bookmarks as flags on the timeline: a click goes there, a right click renames or removes.

use egui::{
    FontId, Popup, PopupCloseBehavior, Rect, Role, Sense, Shape, Stroke, TextEdit, Ui, WidgetInfo, pos2, vec2,
};

use super::axis::Axis;
use crate::editor::Action;
use crate::gui::colors::tones;
use crate::gui::context::AppContext;

/// Keeps a name while it is typed.
#[derive(Default)]
pub(super) struct Flags {
    name: String,
}

/// Size of a flag, points.
const SIZE: f32 = 10.0;

impl Flags {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>, axis: &Axis) {
        for (index, mark) in context.session.travel().bookmarks().iter().enumerate() {
            let x = axis.x(mark.time);
            if !axis.line.x_range().contains(x) {
                continue;
            }
            let top = pos2(x, axis.line.top());
            let rect = Rect::from_min_size(top, vec2(SIZE, SIZE));
            let id = ui.scope_id().with(("bookmark", index));
            let response = ui.interact(rect, id, Sense::click());
            let label = format!("Bookmark {}", mark.name);
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
            let color = tones(ui).good;
            ui.painter().vline(x, axis.line.y_range(), Stroke::new(1.0, color));
            let flag = vec![top, top + vec2(SIZE, 0.35 * SIZE), top + vec2(0.0, 0.7 * SIZE)];
            ui.painter().add(Shape::convex_polygon(flag, color, Stroke::NONE));
            if response.clicked() {
                context.outbox.act(Action::GoToBookmark(index));
            }
            if response.secondary_clicked() {
                self.name.clone_from(&mark.name);
            }
            Popup::context_menu(&response)
                .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
                .show(|ui| self.menu(ui, context, index));
            response.on_hover_text(format!(
                "{}\nt = {:.9} s\nRight click: rename or remove",
                mark.name, mark.time
            ));
        }
    }

    fn menu(&mut self, ui: &mut Ui, context: &AppContext<'_>, index: usize) {
        let label = ui.label("Name");
        let edit = TextEdit::singleline(&mut self.name).font(FontId::proportional(12.0)).desired_width(140.0);
        let response = ui.add(edit).labelled_by(label.id);
        if response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter)) {
            context.outbox.act(Action::RenameBookmark(index, self.name.clone()));
            ui.close();
        }
        if ui.button("Remove bookmark").clicked() {
            context.outbox.act(Action::RemoveBookmark(index));
            ui.close();
        }
    }
}
