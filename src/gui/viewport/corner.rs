//! The corners of a view: its title with what to look along, and its overlays.

use egui::{Align, Button, Layout, Rect, RichText, Ui, UiBuilder, vec2};

use super::pane::Pane;
use super::{Scenery, look_name};
use crate::editor::{self, Command, SessionCommand, ViewCommand, WindowCommand};
use crate::gui::colors::color32;
use crate::gui::icons;
use crate::gui::menu;
use crate::view::{AxisView, OVERLAYS, OverlaySet, Projection};

/// What was asked in a corner.
#[derive(Default)]
pub struct Asked {
    pub maximize: bool,
    pub activate: bool,
}

impl Pane {
    pub(super) fn corners(&mut self, ui: &mut Ui, rect: Rect, scenery: &Scenery<'_>) -> Asked {
        let mut asked = Asked::default();
        let strip = Rect::from_min_size(rect.min + vec2(4.0, 4.0), vec2(rect.width() - 8.0, 22.0));
        let left = UiBuilder::new().max_rect(strip).layout(Layout::left_to_right(Align::Center));
        let back = ui.painter().add(egui::Shape::Noop);
        let title = ui.scope_builder(left, |ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            self.title(ui, &mut asked);
            self.overlay_button(ui, scenery, &mut asked);
        });
        // legible over whatever the view shows
        let color = color32(scenery.context.palette().label_back);
        ui.painter().set(back, egui::Shape::rect_filled(title.response.rect, 3.0, color));
        let right = UiBuilder::new().max_rect(strip).layout(Layout::right_to_left(Align::Center));
        ui.scope_builder(right, |ui| {
            let name = format!("Maximize {} view", look_name(&self.camera));
            let (square, response) = ui.allocate_exact_size(vec2(20.0, 20.0), egui::Sense::click());
            let color = ui.style().interact(&response).text_color();
            icons::paint_panes(ui.painter(), square.shrink(4.0), color, 1);
            crate::gui::widgets::name_button(ui, &response, &name, false);
            let info = editor::info(ViewCommand::Maximize);
            let help = info.map_or(String::new(), |info| info.tooltip(scenery.context.session));
            asked.maximize |= response.on_hover_text(help).clicked();
        });
        asked
    }

    /// Double click maximises; a click lets choose another direction.
    fn title(&mut self, ui: &mut Ui, asked: &mut Asked) {
        let name = look_name(&self.camera);
        let title = Button::new(RichText::new(name).strong()).frame_when_inactive(false);
        let (response, _) = egui::containers::menu::MenuButton::from_button(title).ui(ui, |ui| {
            ui.set_min_width(130.0);
            if ui.selectable_label(name == "Perspective", "Perspective").clicked() {
                self.look_from(None);
                asked.activate = true;
            }
            for axis in AxisView::ALL {
                if ui.selectable_label(name == axis.label(), axis.label()).clicked() {
                    self.look_from(Some(axis));
                    asked.activate = true;
                }
            }
            ui.separator();
            let mut parallel = self.camera.projection == Projection::Orthographic;
            if ui.checkbox(&mut parallel, "Parallel projection").changed() {
                self.camera.projection =
                    if parallel { Projection::Orthographic } else { Projection::Perspective };
            }
        });
        let response =
            response.on_hover_text("Click: look from another side. Double click: fill the middle (M).");
        if response.double_clicked() {
            egui::Popup::close_all(ui.ctx());
            asked.maximize = true;
        }
    }

    fn overlay_button(&mut self, ui: &mut Ui, scenery: &Scenery<'_>, asked: &mut Asked) {
        let count = self.overlays.ids().count();
        let button = Button::new(RichText::new("Overlays ▾")).frame_when_inactive(false);
        let name = format!("Overlays of {} view", look_name(&self.camera));
        let (response, _) = egui::containers::menu::MenuButton::from_button(button)
            .config(
                egui::containers::menu::MenuConfig::new()
                    .close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside),
            )
            .ui(ui, |ui| {
                ui.set_min_width(150.0);
                for overlay in OVERLAYS {
                    let mut on = self.overlays.contains(overlay.id);
                    if ui.checkbox(&mut on, overlay.label).on_hover_text(overlay.help).changed() {
                        self.overlays.set(overlay.id, on);
                        asked.activate = true;
                    }
                }
                ui.separator();
                if ui.button("Same in all views").clicked() {
                    scenery
                        .context
                        .outbox
                        .send(crate::gui::context::Message::OverlaysInAllViews(self.overlays));
                    ui.close();
                }
                if ui.button("None").clicked() {
                    self.overlays = OverlaySet::NONE;
                }
            });
        response.clone().on_hover_text(format!("What this view shows besides the bodies ({count} on)"));
        crate::gui::widgets::name_button(ui, &response, &name, false);
    }

    /// Right click in a view.
    pub(super) fn context_menu(response: &egui::Response, scenery: &Scenery<'_>) {
        const COMMANDS: [Command; 8] = [
            Command::View(ViewCommand::FrameSelection),
            Command::View(ViewCommand::FrameAll),
            Command::Window(WindowCommand::Rename),
            Command::Session(SessionCommand::Duplicate),
            Command::Session(SessionCommand::Delete),
            Command::Session(SessionCommand::Hide),
            Command::Session(SessionCommand::ShowAll),
            Command::Session(SessionCommand::SelectNone),
        ];
        response.context_menu(|ui| {
            ui.set_min_width(200.0);
            COMMANDS.iter().filter_map(|command| editor::info(*command)).for_each(|info| {
                menu::entry(ui, scenery.context, info);
            });
        });
    }
}
