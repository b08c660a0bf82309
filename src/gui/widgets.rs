//! Small widgets that several panels use.

use egui::{Color32, Rect, Response, RichText, Role, Sense, Ui, WidgetInfo, vec2};

use super::colors::tones;
use super::context::AppContext;
use super::icons;
use crate::editor::{self, Command, SessionCommand};

/// Side of a tool bar button, points.
pub const TOOL_SIZE: f32 = 26.0;

/// A square button that shows what `paint` draws into it.
pub fn icon_button(
    ui: &mut Ui,
    name: &str,
    selected: bool,
    paint: impl FnOnce(&egui::Painter, Rect, Color32),
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(TOOL_SIZE, TOOL_SIZE), Sense::click());
    paint_icon_button(ui, rect, &response, selected, paint);
    name_button(ui, &response, name, selected);
    response
}

fn paint_icon_button(
    ui: &Ui,
    rect: Rect,
    response: &Response,
    selected: bool,
    paint: impl FnOnce(&egui::Painter, Rect, Color32),
) {
    let visuals = ui.style().interact_selectable(response, selected);
    if selected || response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, visuals.corner_radius, visuals.weak_bg_fill);
    }
    let mut color = visuals.text_color();
    if !ui.is_enabled() {
        color = color.gamma_multiply(0.9);
    }
    let side = (rect.height() * 0.56).round();
    let square = Rect::from_center_size(rect.center(), vec2(side, side));
    paint(ui.painter(), square, color);
}

/// Tells screen readers and tests what a button without text is.
pub fn name_button(ui: &Ui, response: &Response, name: &str, selected: bool) {
    let enabled = ui.is_enabled();
    let info = || {
        let mut info = WidgetInfo::labeled(Role::Button, enabled, name);
        info.selected = selected.then_some(true);
        info
    };
    response.widget_info(info);
}

/// A tool bar button of a command: its icon, its tooltip, and why it is disabled.
pub fn command_button(ui: &mut Ui, context: &AppContext<'_>, command: impl Into<Command>) {
    let command = command.into();
    let Some(info) = editor::info(command) else { return };
    let enabled = (info.enabled)(context.session).is_ok();
    let pause = command == SessionCommand::PlayPause.into() && context.session.is_busy();
    let name = if pause { "Pause" } else { info.label };
    let response = ui
        .add_enabled_ui(enabled, |ui| {
            icon_button(ui, name, false, |painter, square, color| {
                if pause {
                    icons::paint_pause(painter, square, color);
                } else {
                    icons::paint(painter, square, command, color);
                }
            })
        })
        .inner;
    let tooltip = || info.tooltip(context.session);
    if response.hovered() || !enabled {
        let response = response.clone().on_hover_text(tooltip());
        response.on_disabled_hover_text(tooltip());
    }
    if response.clicked() {
        context.outbox.command(command);
    }
}

/// A panel's heading: a quiet bar with a name.
pub fn panel_heading(ui: &mut Ui, text: &str, add_right: impl FnOnce(&mut Ui)) {
    let tones = tones(ui);
    egui::Frame::new().fill(tones.heading).inner_margin(egui::Margin::symmetric(8, 3)).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.label(RichText::new(text).strong().color(tones.strong));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), add_right);
        });
        ui.take_available_width();
    });
}

/// A number that stays in its column.
pub fn mono(text: impl Into<String>) -> RichText {
    RichText::new(text).monospace()
}

/// Severity by shape, then by colour: a triangle for warnings, a disc with a cross for errors.
pub fn severity_icon(ui: &mut Ui, is_error: bool) -> Response {
    let tones = tones(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
    let (painter, center) = (ui.painter(), rect.center());
    if is_error {
        painter.circle_filled(center, 6.0, tones.error);
        let pen = egui::Stroke::new(1.6, ui.visuals().panel_fill);
        painter.line_segment([center - vec2(2.5, 2.5), center + vec2(2.5, 2.5)], pen);
        painter.line_segment([center - vec2(2.5, -2.5), center + vec2(2.5, -2.5)], pen);
    } else {
        let corners = vec![center + vec2(0.0, -6.0), center + vec2(6.5, 5.5), center + vec2(-6.5, 5.5)];
        painter.add(egui::Shape::convex_polygon(corners, tones.warning, egui::Stroke::NONE));
        let pen = egui::Stroke::new(1.6, ui.visuals().panel_fill);
        painter.line_segment([center + vec2(0.0, -2.0), center + vec2(0.0, 2.2)], pen);
        painter.circle_filled(center + vec2(0.0, 4.0), 0.9, ui.visuals().panel_fill);
    }
    let name = if is_error { "error" } else { "warning" };
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    response
}

/// A cell whose text ends with "…" where it is wider than its column. It needs no clipping of its own, only that of the rows:
/// what is clipped differently is drawn by itself, and so many cells would be felt in each frame.
pub fn short_cell(row: &mut egui_extras::TableRow<'_, '_>, clip: Rect, text: RichText, help: &str) {
    row.col(|ui| {
        ui.set_clip_rect(clip);
        let label = egui::Label::new(text).truncate();
        let response = ui.add(label.show_tooltip_when_elided(help.is_empty()));
        if !help.is_empty() {
            response.on_hover_text(help);
        }
    });
}

/// One cell of a table's row.
pub fn cell(row: &mut egui_extras::TableRow<'_, '_>, text: RichText, help: &str) {
    row.col(|ui| {
        let response = ui.label(text);
        if !help.is_empty() {
            response.on_hover_text(help);
        }
    });
}
