//! The menu bar, made from the table of commands.

use egui::{Button, Ui};

use super::context::AppContext;
use crate::design::{TOOLS, ToolGroup};
use crate::editor::{
    COMMANDS, Command, CommandInfo, Menu, SAMPLES, SampleGroup, SessionCommand, ViewCommand, WindowCommand,
};
use crate::scene::shown_path;
use crate::view::OVERLAYS;

/// Height of an entry, points.
const ROW: f32 = 19.0;

/// Overlays of the active view and what is switched on in the views, for the marks in the View menu.
pub fn show(
    ui: &mut Ui,
    context: &AppContext<'_>,
    overlays: crate::view::OverlaySet,
    switched_on: &[ViewCommand],
) {
    egui::MenuBar::new().ui(ui, |ui| {
        for menu in Menu::ALL {
            ui.menu_button(menu.label(), |ui| {
                ui.set_min_width(230.0);
                // the longest menu has to fit a window of 800 points
                ui.spacing_mut().item_spacing.y = 0.0;
                ui.spacing_mut().interact_size.y = ROW;
                rows(ui, context, menu, switched_on);
                match menu {
                    Menu::File => files(ui, context),
                    Menu::View => overlay_menu(ui, context, overlays),
                    Menu::Add => tools(ui, context, &[ToolGroup::Part]),
                    Menu::Edit => {
                        tools(ui, context, &[ToolGroup::Arrange, ToolGroup::Select, ToolGroup::Repair]);
                    }
                    _ => {}
                }
            });
        }
    });
}

fn rows(ui: &mut Ui, context: &AppContext<'_>, menu: Menu, switched_on: &[ViewCommand]) {
    let mut group = None;
    for row in COMMANDS.iter().filter(|row| row.menu == menu) {
        if group.is_some_and(|group| group != row.group) {
            ui.separator();
        }
        group = Some(row.group);
        if row.command == SessionCommand::Quit.into() {
            // what opens files stands together, above the way out
            continue;
        }
        let on = matches!(row.command, Command::View(command) if switched_on.contains(&command));
        let mark = if on { ": on" } else { "" };
        marked_entry(ui, context, row, mark);
    }
}

/// One entry: label, shortcut, and in the tooltip what it does or why it cannot.
pub fn entry(ui: &mut Ui, context: &AppContext<'_>, row: &CommandInfo) {
    marked_entry(ui, context, row, "");
}

fn marked_entry(ui: &mut Ui, context: &AppContext<'_>, row: &CommandInfo, mark: &str) {
    let enabled = (row.enabled)(context.session).is_ok();
    let mut button = Button::new(format!("{}{mark}", row.label_now(context.session)));
    if let Some(shortcut) = row.shortcuts.first() {
        button = button.shortcut_text(shortcut.to_string());
    }
    let response = ui.add_enabled(enabled, button);
    let response = response.on_hover_text(row.help);
    let response =
        if enabled { response } else { response.on_disabled_hover_text(row.tooltip(context.session)) };
    if response.clicked() {
        context.outbox.command(row.command);
        ui.close();
    }
}

/// Submenus of the table of tools.
fn tools(ui: &mut Ui, context: &AppContext<'_>, groups: &[ToolGroup]) {
    ui.separator();
    for group in groups {
        ui.menu_button(group.label(), |ui| {
            ui.set_min_width(200.0);
            for (index, tool) in TOOLS.iter().enumerate().filter(|(_, tool)| tool.group == *group) {
                let can = context.session.can_use_tool(index);
                let response = ui.add_enabled(can.is_ok(), Button::new(tool.label)).on_hover_text(tool.help);
                let reason = || format!("{}\nNot now: {}.", tool.help, can.err().unwrap_or_default());
                let response = if can.is_ok() { response } else { response.on_disabled_hover_text(reason()) };
                if response.clicked() {
                    context.outbox.command(WindowCommand::DesignTool(index));
                    ui.close();
                }
            }
        });
    }
}

fn files(ui: &mut Ui, context: &AppContext<'_>) {
    let recent = &context.session.settings().recent;
    ui.add_enabled_ui(!recent.is_empty(), |ui| {
        ui.menu_button("Open recent", |ui| recent_files(ui, context))
            .response
            .on_disabled_hover_text("No file was opened or saved yet");
    });
    ui.menu_button("Samples", |ui| samples(ui, context));
    ui.separator();
    if let Some(quit) = crate::editor::info(SessionCommand::Quit) {
        entry(ui, context, quit);
    }
}

/// The files opened last, by name; the tooltip has the path.
pub fn recent_files(ui: &mut Ui, context: &AppContext<'_>) {
    for (index, path) in context.session.settings().recent.iter().enumerate() {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let response = ui.button(name.as_ref()).on_hover_text(shown_path(path));
        if response.clicked() {
            context.outbox.command(SessionCommand::OpenRecent(index));
            ui.close();
        }
    }
}

fn samples(ui: &mut Ui, context: &AppContext<'_>) {
    samples_of(ui, context, SampleGroup::Introduction);
    ui.separator();
    ui.menu_button("Hard cases", |ui| samples_of(ui, context, SampleGroup::HardCase));
}

fn samples_of(ui: &mut Ui, context: &AppContext<'_>, group: SampleGroup) {
    for (index, sample) in SAMPLES.iter().enumerate().filter(|(_, sample)| sample.group == group) {
        if ui.button(sample.title).on_hover_text(sample.shows).clicked() {
            context.outbox.command(SessionCommand::OpenSample(index));
            ui.close();
        }
    }
}

/// The overlays of a view, with marks.
pub fn overlay_menu(ui: &mut Ui, context: &AppContext<'_>, overlays: crate::view::OverlaySet) {
    ui.menu_button("Overlays of the active view", |ui| {
        for (index, overlay) in OVERLAYS.iter().enumerate() {
            let mut on = overlays.contains(overlay.id);
            if ui.checkbox(&mut on, overlay.label).on_hover_text(overlay.help).changed() {
                context.outbox.command(ViewCommand::ToggleOverlay(index));
            }
        }
    });
}
