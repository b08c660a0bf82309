//! The tool bar: transport, Δt, speed, undo, and how many views there are.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{PopupCloseBehavior, Response, RichText, TextEdit, Ui};

use super::colors::tones;
use super::context::{AppContext, Message};
use super::inspector::number::{Number, number, single};
use super::still::{self, Still};
use super::viewport::Layout;
use super::widgets::{command_button, icon_button, severity_icon};
use super::{icons, lag, menu, numbers};
use crate::editor::{self, Action, Addition, SessionCommand, Shared, TravelCommand, ViewCommand};
use crate::record::{Goal, RunState};
use crate::scene::Edit;
use crate::sim::Method;

const TRANSPORT: [SessionCommand; 8] = [
    SessionCommand::Reset,
    SessionCommand::Travel(TravelCommand::PlayBack),
    SessionCommand::StepBack,
    SessionCommand::EventBack,
    SessionCommand::PlayPause,
    SessionCommand::NextEvent,
    SessionCommand::FinishStep,
    SessionCommand::StepForward,
];

const ADDITIONS: [SessionCommand; 6] = [
    SessionCommand::Add(Addition::SphereDynamic),
    SessionCommand::Add(Addition::SphereStatic),
    SessionCommand::Add(Addition::Plane),
    SessionCommand::Add(Addition::GravityPlane),
    SessionCommand::Add(Addition::GravityPoint),
    SessionCommand::Add(Addition::Drag),
];

/// Speeds offered by name; any other is reached with + and -.
const SPEEDS: [(f64, &str); 9] = [
    (1.0 / 64.0, "1/64 ×"),
    (1.0 / 16.0, "1/16 ×"),
    (0.25, "1/4 ×"),
    (0.5, "1/2 ×"),
    (1.0, "1 ×"),
    (2.0, "2 ×"),
    (4.0, "4 ×"),
    (16.0, "16 ×"),
    (64.0, "64 ×"),
];

/// Room in which everything has its place, points.
const WIDE: f32 = 1290.0;

/// Below this, points, undo and what is added would lie over the speed and what is said beside it: the menu More has them.
const NARROW: f32 = 1220.0;

/// Below this, points, the menu More has the time and the goals, too, and two choices stand without their names.
const TIGHT: f32 = 960.0;

/// Keeps what is being typed into Δt and the time.
#[derive(Default)]
pub struct Transport {
    dt_text: String,
    typing: bool,
    time_text: String,
    typing_time: bool,
}

impl Transport {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>, layout: Layout, snapping: bool) {
        // the scene's time speed is in the inspector too
        let wide = ui.available_width() > WIDE;
        let narrow = ui.available_width() < NARROW;
        let tight = ui.available_width() < TIGHT;
        ui.horizontal_centered(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            for command in TRANSPORT {
                command_button(ui, context, command);
            }
            if !tight {
                ui.add_space(6.0);
                self.time_field(ui, context);
                run_menu(ui, context);
            }
            ui.add_space(6.0);
            self.dt_field(ui, context);
            ui.add_space(6.0);
            method_menu(ui, context, !tight);
            ui.add_space(6.0);
            speed_menu(ui, context, !tight);
            if wide {
                ui.add_space(6.0);
                time_speed(ui, context);
            }
            ui.add_space(8.0);
            state(ui, context);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                view_buttons(ui, context, layout);
                snap_button(ui, context, snapping);
                ui.separator();
                if narrow {
                    self.more_menu(ui, context, tight);
                    return;
                }
                ADDITIONS.iter().rev().for_each(|command| command_button(ui, context, *command));
                ui.separator();
                command_button(ui, context, SessionCommand::Redo);
                command_button(ui, context, SessionCommand::Undo);
                ui.separator();
            });
        });
    }

    /// What has no room in the bar.
    fn more_menu(&mut self, ui: &mut Ui, context: &AppContext<'_>, tight: bool) {
        // a click into the field of the time must not close it
        let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
        let (menu, _) = MenuButton::new("More").config(config).ui(ui, |ui| {
            ui.set_min_width(190.0);
            if tight {
                ui.horizontal(|ui| self.time_field(ui, context));
                ui.menu_button("Run", |ui| goals(ui, context));
                ui.separator();
            }
            let commands = [SessionCommand::Undo, SessionCommand::Redo].into_iter().chain(ADDITIONS);
            for command in commands {
                editor::info(command).into_iter().for_each(|row| menu::entry(ui, context, row));
                if command == SessionCommand::Redo {
                    ui.separator();
                }
            }
        });
        menu.on_hover_text("What a wider window shows in this bar");
    }

    /// The time shown; one that is typed is gone to.
    fn time_field(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let frame = context.session.frame();
        let help = "Time of the run in seconds. Type any and press Enter to be there: what is recorded is looked up, \
                    beyond it the simulation runs on.";
        let label = ui.label("t").on_hover_text(help);
        if !self.typing_time {
            self.time_text = format!("{:.6}", frame.time);
        }
        let edit =
            TextEdit::singleline(&mut self.time_text).font(egui::TextStyle::Monospace).desired_width(78.0);
        let response = ui.add(edit).labelled_by(label.id).on_hover_text(help);
        ui.label(RichText::new("s").weak());
        self.typing_time = response.has_focus();
        if response.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter)) {
            match editor::parse_number(&self.time_text) {
                Some(time) => context.outbox.act(Action::Seek(time)),
                None => {
                    let text = format!("“{}” is not a time: type seconds, such as 1.25", self.time_text);
                    context.outbox.send(Message::Warn(text));
                }
            }
        }
    }

    fn dt_field(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let playback = context.session.playback();
        let meaning = if playback.method().depends_on_dt() {
            "This method's results depend on it."
        } else {
            "It only says where to look: events and states are the same for every Δt."
        };
        let help = format!(
            "Length of one step in seconds: a number or a fraction, such as 0.01 or 1/60.\n{meaning}"
        );
        let label = ui.label("Δt").on_hover_text(&help);
        if !self.typing {
            playback.dt_text().clone_into(&mut self.dt_text);
        }
        let valid = editor::parse_number(&self.dt_text).is_some_and(|dt| dt > 0.0);
        let color = if valid { ui.visuals().text_color() } else { tones(ui).error };
        let edit = TextEdit::singleline(&mut self.dt_text)
            .font(egui::TextStyle::Monospace)
            .text_color(color)
            .desired_width(64.0);
        let response = ui.add(edit).labelled_by(label.id).on_hover_text(help);
        ui.label(RichText::new("s").weak());
        self.typing = response.has_focus();
        if response.lost_focus()
            && !ui.input(|input| input.key_pressed(egui::Key::Escape))
            && self.dt_text.trim() != playback.dt_text()
        {
            context.outbox.act(Action::SetDt(self.dt_text.clone()));
        }
    }
}

/// What running goes on until.
fn run_menu(ui: &mut Ui, context: &AppContext<'_>) {
    ui.menu_button("Run", |ui| goals(ui, context))
        .response
        .on_hover_text("Runs as fast as it can until a goal is reached; Space stops it");
}

fn goals(ui: &mut Ui, context: &AppContext<'_>) {
    let now = context.session.frame().time;
    let events = [10_u64, 100, 1000].map(|count| (format!("For {count} events"), Goal::Events(count)));
    let times = [(1.0, "1 s more"), (10.0, "10 s more"), (60.0, "1 min more")];
    let times = times.map(|(more, text)| (text.to_owned(), Goal::Time(now + more)));
    let go = |ui: &mut Ui, text: String, action: Action| {
        if ui.button(text).clicked() {
            context.outbox.act(action);
            ui.close();
        }
    };
    events.into_iter().for_each(|(text, goal)| go(ui, text, Action::RunUntil(goal)));
    let rest = SessionCommand::Travel(TravelCommand::RunToRest);
    go(ui, "Until all is at rest".to_owned(), Action::Command(rest));
    ui.separator();
    times.into_iter().for_each(|(text, goal)| go(ui, text, Action::RunUntil(goal)));
}

/// How to step. Another method starts again, so the entries say so.
fn method_menu(ui: &mut Ui, context: &AppContext<'_>, is_named: bool) {
    let method = context.session.playback().method();
    let label = is_named.then(|| ui.label("Method"));
    let response = egui::ComboBox::from_id_salt("method")
        .selected_text(method.name())
        .width(64.0)
        .show_ui(ui, |ui| {
            for other in Method::ALL {
                let entry = ui.selectable_label(other == method, other.name());
                if entry.on_hover_text(other.meaning()).clicked() {
                    context.outbox.act(Action::SetMethod(other));
                }
            }
        })
        .response;
    name_choice(response, "Method", label).on_hover_text(format!(
        "How the simulation is stepped: {}.\nAnother one starts again from t = 0.",
        method.meaning()
    ));
}

/// A choice is named by the label before it, or where there is no room for one for screen readers alone.
fn name_choice(choice: Response, name: &str, label: Option<Response>) -> Response {
    match label {
        Some(label) => choice.labelled_by(label.id),
        None => choice.accessible_name(name),
    }
}

fn speed_menu(ui: &mut Ui, context: &AppContext<'_>, is_named: bool) {
    let speed = context.session.playback().speed();
    let named = SPEEDS.iter().find(|(value, _)| *value == speed).map(|(_, name)| (*name).to_owned());
    let text = named.unwrap_or_else(|| format!("{} ×", numbers::significant(speed, 3)));
    let label = is_named.then(|| ui.label("Speed"));
    let response = egui::ComboBox::from_id_salt("speed")
        .selected_text(text)
        .width(68.0)
        .show_ui(ui, |ui| {
            for (value, name) in SPEEDS {
                if ui.selectable_label(value == speed, name).clicked() {
                    context.outbox.act(Action::SetSpeed(value));
                }
            }
        })
        .response;
    name_choice(response, "Speed", label).on_hover_text(
        "Speed of playing, as a multiple of the scene's own time speed. Keys + and -.\n\
         Where the machine cannot keep up, playing becomes slower; Δt stays the same.",
    );
}

/// The largest speed with a name that is no larger.
fn reachable(speed: f64) -> Option<(f64, &'static str)> {
    SPEEDS.into_iter().rev().find(|(value, _)| *value <= speed)
}

/// The scene's own, which is saved with it.
fn time_speed(ui: &mut Ui, context: &AppContext<'_>) {
    let Some(scene) = context.scene() else { return };
    let value = Shared::Same(scene.time_speed);
    let help = "Model seconds per second of watching, as the file says. Never scales Δt.";
    ui.label("Time speed").on_hover_text(help);
    let spec = Number {
        name: "Time speed of the scene",
        value,
        range: (1e-9, f64::INFINITY),
        speed: 0.01 * scene.time_speed,
        width: 48.0,
        help,
        angle: false,
        whole: false,
    };
    number(ui, context.outbox, &spec, |typed| Ok(Edit::TimeSpeed(single(typed, scene.time_speed)?)));
}

/// What the simulation is doing, when that is not simply waiting; and what waits for a reset.
fn state(ui: &mut Ui, context: &AppContext<'_>) {
    let tones = tones(ui);
    let frame = context.session.frame();
    let behind = frame.lag.as_ref().filter(|_| frame.state == RunState::Playing);
    let still = Still::of(context);
    let (text, color, help) = match frame.state {
        _ if behind.is_some() || still.is_some() => (String::new(), tones.weak, ""),
        RunState::Playing => (
            format!("playing {} ×", numbers::significant(frame.real_speed, 2)),
            tones.good,
            "Model seconds per second that are really reached",
        ),
        RunState::Busy => ("working…".to_owned(), tones.accent, "Space stops after the current event"),
        RunState::Faulted => ("stopped on a fault".to_owned(), tones.error, "See Problems"),
        RunState::Empty => ("no simulation".to_owned(), tones.warning, "The scene has errors, see Problems"),
        RunState::Paused => (String::new(), tones.weak, ""),
    };
    if !text.is_empty() {
        ui.label(RichText::new(text).color(color)).on_hover_text(help);
    }
    if let Some(still) = still {
        still::show(ui, context, still);
    } else if let Some(lag) = behind {
        lag::show(ui, context, lag, reachable(context.session.playback().speed() * lag.share));
    }
    if context.session.needs_reset() {
        severity_icon(ui, false);
        let button = egui::Button::new(RichText::new("Reset to apply").color(tones.warning));
        let help = "The scene was edited in a way that the running simulation cannot take: positions, \
                    velocities, new moving bodies, map or settings. Reset starts the edited scene (R).";
        if ui.add(button).on_hover_text(help).clicked() {
            context.outbox.command(SessionCommand::Reset);
        }
    }
}

/// Pressed in while dragged bodies snap.
fn snap_button(ui: &mut Ui, context: &AppContext<'_>, snapping: bool) {
    let Some(info) = editor::info(ViewCommand::ToggleSnapping) else { return };
    let response = icon_button(ui, info.label, snapping, |painter, square, color| {
        icons::paint(painter, square, ViewCommand::ToggleSnapping.into(), color);
    });
    let state = if snapping { "on" } else { "off" };
    if response.on_hover_text(format!("{}\nNow {state}.", info.tooltip(context.session))).clicked() {
        context.outbox.command(ViewCommand::ToggleSnapping);
    }
}

fn view_buttons(ui: &mut Ui, context: &AppContext<'_>, layout: Layout) {
    let choices = [
        (ViewCommand::FourViews, Layout::Four, 4),
        (ViewCommand::TwoViews, Layout::Two, 2),
        (ViewCommand::OneView, Layout::One, 1),
    ];
    for (command, of, panes) in choices {
        let Some(info) = editor::info(command) else { continue };
        let response = icon_button(ui, info.label, layout == of, |painter, square, color| {
            icons::paint_panes(painter, square, color, panes);
        });
        if response.on_hover_text(info.tooltip(context.session)).clicked() {
            context.outbox.command(command);
        }
    }
}
