//! Help: the window on one page, all keys and gestures, and what this program is.

use egui::{Context, Grid, Id, Modal, RichText, ScrollArea, Ui};

use crate::editor::{COMMANDS, Menu};
use crate::gui::widgets::mono;
use crate::view::OVERLAYS;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HelpPage {
    Window,
    Keys,
    About,
}

const WINDOW: [(&str, &str); 9] = [
    (
        "Scene",
        "Map, simulation, forces and bodies. Click selects, Ctrl adds, Shift takes a range; double click renames. Drag rows onto a group, or out of it onto a heading. The eye hides, the lock protects.",
    ),
    (
        "Inspector",
        "Every number of the selection: on the left what it starts with, which you edit; on the right what it is now. Type with comma or point, or a fraction.",
    ),
    (
        "Views",
        "Each has its own camera and its own overlays. Walls that stand in front of the scene become glass, so that a closed box shows its inside.",
    ),
    (
        "Transport",
        "Step by Δt, or event by event inside a Δt. Δt only says where to look: events and states are the same for every Δt. Where playing falls behind, the button beside the speeds says by how much, what the time goes to, and what helps.",
    ),
    (
        "Heaps",
        "Bodies that touch too often for single events are stepped together until they come to rest: the events “dense” and “group rest” say how many. The status bar counts them, diamonds mark them in views and tree, and the overlay Force chains shows what presses on what.",
    ),
    (
        "Editing while it runs",
        "Forces, static bodies, bounce and mass take hold at once. Positions, velocities and settings change the start and wait for a reset.",
    ),
    ("Events", "Every event of the run. A click goes there and shows the place in all views."),
    (
        "XML",
        "The file as it would be saved, with what is selected marked; a click selects. When another program saves the file, its changes are listed; taken over, they do not stop what runs.",
    ),
    (
        "Problems",
        "What is wrong with the file or the scene, with line and column, and a button where there is a fix.",
    ),
];

const GESTURES: [(&str, &str); 16] = [
    ("Click", "Select; again at the same place: what lies behind"),
    ("Ctrl or Shift + click", "Add to the selection or take out"),
    ("Drag", "Select by a rectangle; Ctrl or Shift adds"),
    ("Alt + drag", "Select by an outline drawn by hand, which may begin on a body; Ctrl or Shift adds"),
    (
        "Drag a handle or a ball",
        "Move, turn or size what is selected. Esc cancels, Shift is fine, Ctrl snaps",
    ),
    ("A number while dragging", "Takes that, by Enter; X, Y or Z before it chooses the axis"),
    ("Drag a tab, or a view's dots", "Put a panel or view elsewhere"),
    ("Middle or right drag", "Turn a perspective view, move a view along an axis"),
    ("Shift + middle drag", "Move the view"),
    ("Wheel", "Magnify at the pointer"),
    ("Right click", "Select what is there, and its menu"),
    ("Double click a body", "Bring it into the middle"),
    ("Double click a view's title", "Fill the middle with it"),
    ("Arrows", "Move the selection by a round step; with nothing selected, or Alt, turn or move the view"),
    ("Page Up and Down", "Magnify the view that has the keyboard"),
    (
        "While flying (V)",
        "W, A, S, D ahead and aside, E and Q up and down, the mouse turns, Shift is faster, the wheel sets the speed; Esc ends",
    ),
];

/// Whether it was closed.
pub fn show(ctx: &Context, page: HelpPage) -> bool {
    let mut closed = false;
    let modal = Modal::new(Id::unique("help")).show(ctx, |ui| {
        let wanted: f32 = if page == HelpPage::About { 480.0 } else { 760.0 };
        ui.set_width(wanted.min(ctx.content_rect().width() - 60.0));
        let height = (ctx.content_rect().height() - 180.0).clamp(200.0, 620.0);
        ui.heading(match page {
            HelpPage::Window => "The window",
            HelpPage::Keys => "Keys and gestures",
            HelpPage::About => "About PolyScene",
        });
        ui.add_space(6.0);
        ScrollArea::vertical().max_height(height).auto_shrink([false, true]).show(ui, |ui| match page {
            HelpPage::Window => window(ui),
            HelpPage::Keys => keys(ui),
            HelpPage::About => about(ui),
        });
        ui.add_space(8.0);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            closed = ui.button("Close").clicked();
        });
    });
    closed || modal.should_close()
}

fn window(ui: &mut Ui) {
    for (name, text) in WINDOW {
        ui.label(RichText::new(name).strong());
        ui.label(text);
        ui.add_space(6.0);
    }
    ui.label(RichText::new("Overlays").strong());
    Grid::new("overlay help").num_columns(2).min_col_width(110.0).spacing([12.0, 3.0]).show(ui, |ui| {
        for overlay in OVERLAYS {
            ui.label(overlay.label);
            ui.label(RichText::new(overlay.help).weak());
            ui.end_row();
        }
    });
}

fn keys(ui: &mut Ui) {
    for menu in Menu::ALL {
        ui.label(RichText::new(menu.label()).strong());
        Grid::new(("keys", menu.label())).num_columns(3).min_col_width(150.0).spacing([12.0, 2.0]).show(
            ui,
            |ui| {
                for row in COMMANDS.iter().filter(|row| row.menu == menu && !row.shortcuts.is_empty()) {
                    let keys: Vec<String> = row.shortcuts.iter().map(ToString::to_string).collect();
                    ui.label(mono(keys.join("  ")));
                    ui.label(row.label);
                    ui.label(RichText::new(row.help).weak());
                    ui.end_row();
                }
            },
        );
        ui.add_space(6.0);
    }
    ui.label(RichText::new("Mouse, in the views").strong());
    Grid::new("gestures").num_columns(2).min_col_width(150.0).spacing([12.0, 2.0]).show(ui, |ui| {
        for (gesture, effect) in GESTURES {
            ui.label(gesture);
            ui.label(RichText::new(effect).weak());
            ui.end_row();
        }
    });
}

fn about(ui: &mut Ui) {
    ui.label(RichText::new(format!("PolyScene {}", env!("CARGO_PKG_VERSION"))).strong());
    ui.label(env!("CARGO_PKG_DESCRIPTION"));
    ui.add_space(6.0);
    ui.label("Licensed under MIT or Apache-2.0, at your choice. It comes without any warranty.");
    ui.add_space(6.0);
    ui.label(RichText::new("To report a bug").strong());
    let steps = [
        "Go to the moment at which something is wrong, and mark it with K.",
        "File, Save recording… writes a .psrec file: the scene, the edits made while it ran, and the marks.",
        "Send that file with what you saw and what you expected, and with the version above.",
    ];
    for (nth, step) in steps.into_iter().enumerate() {
        ui.label(format!("{}. {step}", nth + 1));
    }
    ui.add_space(6.0);
    ui.label(
        RichText::new(
            "The same recording gives the same bits on every machine, so others see what you see. Where nothing runs, \
             a small scene file with the steps that show the bug does as well.",
        )
        .weak(),
    );
}
