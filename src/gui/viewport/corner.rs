//! The corners of a view: its title with what to look along, and its overlays.

use egui::{Align, Button, Layout, Rect, RichText, Ui, UiBuilder, vec2};

use super::pane::Pane;
use super::{Scenery, look_name};
use crate::editor::{self, Command, SessionCommand, ViewCommand, WindowCommand};
use crate::gui::colors::color32;
use crate::gui::icons;
use crate::gui::menu;
use crate::gui::widgets::{TOOL_SIZE, icon_button};
use crate::scene::{Edit, Viewpoint};
use crate::view::{AxisView, Camera, OVERLAYS, OverlaySet, Pivot, Projection, Tool};

/// What was asked in a corner.
#[derive(Default)]
pub struct Asked {
    pub maximize: bool,
    pub activate: bool,
    pub moved: bool,
}

impl Pane {
    pub(super) fn corners(&mut self, ui: &mut Ui, rect: Rect, scenery: &Scenery<'_>) -> Asked {
        let mut asked = Asked::default();
        let strip = Rect::from_min_size(rect.min + vec2(4.0, 4.0), vec2(rect.width() - 8.0, 22.0));
        let left = UiBuilder::new().max_rect(strip).layout(Layout::left_to_right(Align::Center));
        let back = ui.painter().add(egui::Shape::Noop);
        let title = ui.scope_builder(left, |ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            self.grip(ui, &mut asked);
            self.title(ui, scenery, &mut asked);
            self.overlay_button(ui, scenery, &mut asked);
            self.company(ui, scenery, &mut asked);
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

    /// What the handles do, down the left side of the active view; in a low one in columns.
    pub(super) fn tools(ui: &mut Ui, rect: Rect, scenery: &Scenery<'_>) {
        const TOOLS: [Tool; 4] = [Tool::Select, Tool::Move, Tool::Turn, Tool::Size];
        const BUTTONS: usize = TOOLS.len() + 2;
        const PITCH: f32 = TOOL_SIZE + 2.0;
        /// Of the axes in the lower corner, points.
        const AXES: f32 = 86.0;
        let top = rect.min + vec2(6.0, 34.0);
        let in_column = ((rect.bottom() - AXES - top.y) / PITCH).floor().min(BUTTONS as f32);
        if in_column < 1.0 || BUTTONS as f32 / in_column * PITCH > 0.4 * rect.width() {
            return;
        }
        let in_column = in_column as usize;
        let columns = BUTTONS.div_ceil(in_column);
        let size = vec2(columns as f32 * PITCH, in_column as f32 * PITCH) - vec2(2.0, 2.0);
        let color = color32(scenery.context.palette().label_back);
        ui.painter().rect_filled(Rect::from_min_size(top, size), 3.0, color);
        for nth in 0..BUTTONS {
            let (column, row) = (nth / in_column, nth % in_column);
            let corner = top + vec2(column as f32 * PITCH, row as f32 * PITCH);
            let place = Rect::from_min_size(corner, vec2(TOOL_SIZE, TOOL_SIZE));
            ui.scope_builder(UiBuilder::new().max_rect(place), |ui| match TOOLS.get(nth) {
                Some(tool) => tool_button(ui, scenery, ViewCommand::Tool(*tool), scenery.tool == *tool),
                None if nth == TOOLS.len() => {
                    tool_button(ui, scenery, ViewCommand::ToggleLocalAxes, scenery.local_axes);
                }
                None => pivot_button(ui, scenery),
            });
        }
    }

    /// Dragged, it takes the view to another place in the window.
    fn grip(&self, ui: &mut Ui, asked: &mut Asked) {
        let (rect, response) = ui.allocate_exact_size(vec2(12.0, 18.0), egui::Sense::drag());
        let color = ui.style().interact(&response).text_color();
        for (column, row) in [(0, 0), (1, 0), (0, 1), (1, 1), (0, 2), (1, 2)] {
            let at = rect.center() + vec2(column as f32 * 4.0 - 2.0, row as f32 * 4.0 - 4.0);
            ui.painter().circle_filled(at, 1.1, color);
        }
        let name = format!("Move {} view", look_name(&self.camera));
        crate::gui::widgets::name_button(ui, &response, &name, false);
        let response = response.on_hover_cursor(egui::CursorIcon::Grab);
        asked.moved = response.on_hover_text("Drag: put this view elsewhere").drag_started();
    }

    /// Double click maximises; a click lets choose another direction.
    fn title(&mut self, ui: &mut Ui, scenery: &Scenery<'_>, asked: &mut Asked) {
        let name = look_name(&self.camera);
        let title = Button::new(RichText::new(name).strong()).frame_when_inactive(false);
        let config = egui::containers::menu::MenuConfig::new()
            .close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
        let (response, _) =
            egui::containers::menu::MenuButton::from_button(title).config(config).ui(ui, |ui| {
                ui.set_min_width(150.0);
                self.directions(ui, name, asked);
                ui.separator();
                self.viewpoints(ui, scenery, asked);
            });
        let response =
            response.on_hover_text("Click: look from another side. Double click: fill the middle (M).");
        if response.double_clicked() {
            egui::Popup::close_all(ui.ctx());
            asked.maximize = true;
        }
    }

    fn directions(&mut self, ui: &mut Ui, name: &str, asked: &mut Asked) {
        if ui.selectable_label(name == "Perspective", "Perspective").clicked() {
            self.look_from(None);
            asked.activate = true;
            ui.close();
        }
        for axis in AxisView::ALL {
            if ui.selectable_label(name == axis.label(), axis.label()).clicked() {
                self.look_from(Some(axis));
                asked.activate = true;
                ui.close();
            }
        }
        ui.separator();
        let mut parallel = self.camera.projection == Projection::Orthographic;
        if ui.checkbox(&mut parallel, "Parallel projection").changed() {
            self.camera.projection =
                if parallel { Projection::Orthographic } else { Projection::Perspective };
        }
    }

    /// The viewpoints saved with the scene, and a field to save this one.
    fn viewpoints(&mut self, ui: &mut Ui, scenery: &Scenery<'_>, asked: &mut Asked) {
        let saved = scenery.context.session.document().viewpoints();
        for (index, viewpoint) in saved.iter().enumerate() {
            ui.horizontal(|ui| {
                if ui.button(&viewpoint.name).on_hover_text("Look from there").clicked() {
                    self.part();
                    self.camera = Camera::of_viewpoint(viewpoint);
                    asked.activate = true;
                    ui.close();
                }
                let drop = ui.small_button("×").on_hover_text("Forget this viewpoint");
                let name = format!("Forget viewpoint {}", viewpoint.name);
                crate::gui::widgets::name_button(ui, &drop, &name, false);
                if drop.clicked() {
                    let mut left = saved.clone();
                    left.remove(index);
                    keep(scenery, left);
                }
            });
        }
        ui.horizontal(|ui| {
            let field = egui::TextEdit::singleline(&mut self.viewpoint_name).desired_width(90.0);
            let field = ui.add(field.hint_text("Name"));
            let field = field.on_hover_text("What to call the present look; it is saved with the scene");
            field.widget_info(|| {
                egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Name of the viewpoint")
            });
            let enter = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
            let name = self.viewpoint_name.trim().to_owned();
            let save = ui.add_enabled(!name.is_empty(), Button::new("Save viewpoint"));
            if (save.clicked() || enter) && !name.is_empty() {
                let others = saved.iter().filter(|other| other.name != name).cloned();
                let all = others.chain([self.camera.viewpoint(&name)]).collect();
                keep(scenery, all);
                self.viewpoint_name.clear();
                ui.close();
            }
        });
    }

    fn overlay_button(&mut self, ui: &mut Ui, scenery: &Scenery<'_>, asked: &mut Asked) {
        let count = self.overlays.ids().count();
        /// Of the word and of the button at the other end, points.
        const WITH_WORD: f32 = 104.0;
        let text = if ui.available_width() < WITH_WORD { "▾" } else { "Overlays ▾" };
        let button = Button::new(RichText::new(text)).frame_when_inactive(false);
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

    /// What the view goes along with, or that it flies; a click ends it.
    fn company(&mut self, ui: &mut Ui, scenery: &Scenery<'_>, asked: &mut Asked) {
        let going = self.company.and_then(|company| Some(company.words(scenery.shown.name(company.key)?)));
        let Some(words) = self.flying.map(super::flying::Flying::words).or(going) else { return };
        let button = ui.add(Button::new(words).frame_when_inactive(false));
        if button.on_hover_text("How the view moves. Click: no longer").clicked() {
            self.part();
            asked.activate = true;
        }
    }

    /// Right click in a view.
    pub(super) fn context_menu(response: &egui::Response, scenery: &Scenery<'_>) {
        const COMMANDS: [Command; 10] = [
            Command::View(ViewCommand::FrameSelection),
            Command::View(ViewCommand::Follow),
            Command::View(ViewCommand::LookFromBody),
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

fn tool_button(ui: &mut Ui, scenery: &Scenery<'_>, command: ViewCommand, chosen: bool) {
    let Some(info) = editor::info(command) else { return };
    let response = icon_button(ui, info.label, chosen, |painter, square, color| {
        icons::paint(painter, square, command.into(), color);
    });
    if response.on_hover_text(info.tooltip(scenery.context.session)).clicked() {
        scenery.context.outbox.command(command);
    }
}

/// The choice of what several things are turned about.
fn pivot_button(ui: &mut Ui, scenery: &Scenery<'_>) {
    let chosen = scenery.pivot;
    let now = editor::info(ViewCommand::Pivot(chosen)).map_or("Pivot", |info| info.label);
    let response = icon_button(ui, now, false, |painter, square, color| {
        icons::paint(painter, square, ViewCommand::Pivot(chosen).into(), color);
    });
    let response = response.on_hover_text("What several things are turned about, and grow from");
    egui::Popup::menu(&response).show(|ui| {
        ui.set_min_width(190.0);
        for pivot in Pivot::ALL {
            let Some(info) = editor::info(ViewCommand::Pivot(pivot)) else { continue };
            let choice = ui.selectable_label(pivot == chosen, info.label);
            if choice.on_hover_text(info.help).clicked() {
                scenery.context.outbox.command(ViewCommand::Pivot(pivot));
                ui.close();
            }
        }
    });
}

fn keep(scenery: &Scenery<'_>, viewpoints: Vec<Viewpoint>) {
    let edit = Edit::Viewpoints(viewpoints);
    scenery.context.outbox.act(editor::Action::Edit { edit, gesture: None });
}
