//! The application: owns the session and the panels, and is the one place that carries out what they ask.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Context, Ui, ViewportCommand};
use serde::{Deserialize, Serialize};

use super::accuracy::Accuracy;
use super::context::{AppContext, Message, Outbox, Shown};
use super::dialogs::{Dialogs, FileDialogs, HelpPage};
use super::inspector::Inspector;
use super::launch::Script;
use super::problems::Problems;
use super::status::Pace;
use super::toasts::Toasts;
use super::transport::Transport;
use super::tree::Tree;
use super::viewport::{self, Canvas, Views};
use super::{menu, shortcuts, start, status, strip, theme};
use crate::editor::{
    Action, Command, Notice, Outcome, Request, Session, SessionCommand, Storage, WindowCommand,
};
use crate::record::Runner;
use crate::scene::shown_path;

/// What an [`App`] is made of; tests choose other parts than the program does.
pub struct Parts {
    pub runner: Box<dyn Runner>,
    pub storage: Storage,
    pub files: Box<dyn FileDialogs>,
    /// Opened at the start.
    pub scene: Option<PathBuf>,
}

/// The window's content.
pub struct App {
    session: Session,
    shown: Option<Shown>,
    next_revision: u64,
    opened: u64,
    outbox: Outbox,
    pub(super) views: Views,
    tree: Tree,
    inspector: Inspector,
    transport: Transport,
    pub(super) problems: Problems,
    pub(super) accuracy: Accuracy,
    dialogs: Dialogs,
    toasts: Toasts,
    layout: PanelLayout,
    start_closed: bool,
    /// Whether a text field had the keyboard at the end of the last turn.
    was_typing: bool,
    title: String,
    pub(super) repaints: u64,
    pub(super) pace: Pace,
    pub(super) script: Option<Script>,
    /// A window for a script remembers nothing.
    pub(super) forgetful: bool,
}

/// Which list is shown below the views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Tab {
    #[default]
    Events,
    Problems,
    Accuracy,
}

/// What outlives a run, beside egui's own memory of the panels' sizes.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct PanelLayout {
    pub tab: Tab,
    views: viewport::Remembered,
}

const STORAGE_KEY: &str = "polyscene layout";

/// Size below which panels no longer have the room they want, points.
pub(super) const TIGHT: [f32; 2] = [800.0, 500.0];

impl App {
    /// Works without OpenGL (`cc.gl` is `None` in tests): the views are then empty.
    pub fn new(cc: &eframe::CreationContext<'_>, parts: Parts) -> Self {
        theme::install(&cc.egui_ctx);
        let layout: PanelLayout =
            cc.storage.and_then(|storage| eframe::get_value(storage, STORAGE_KEY)).unwrap_or_default();
        let (canvas, failure) = Canvas::new(cc.gl.as_ref());
        let mut toasts = Toasts::default();
        if let Some(failure) = failure {
            toasts.add(Notice::error(format!("The views stay empty: {failure}")));
        }
        let mut session = Session::with_storage(parts.runner, parts.storage);
        if let Some(path) = parts.scene {
            session.perform(Action::OpenPath(path));
        }
        Self {
            opened: session.opened_count(),
            session,
            shown: None,
            next_revision: 1,
            outbox: Outbox::default(),
            views: Views::new(canvas, &layout.views),
            tree: Tree::default(),
            inspector: Inspector::default(),
            transport: Transport::default(),
            problems: Problems::default(),
            accuracy: Accuracy::default(),
            dialogs: Dialogs::new(parts.files),
            toasts,
            layout,
            start_closed: false,
            was_typing: false,
            title: String::new(),
            repaints: 0,
            pace: Pace { frame_s: 0.0 },
            script: None,
            forgetful: false,
        }
    }

    pub fn session(&self) -> &Session {
        &self.session
    }

    /// How often the window has drawn itself.
    pub fn repaints(&self) -> u64 {
        self.repaints
    }

    /// How often a view was drawn anew, of all that were put on the window.
    pub fn view_redraws(&self) -> u64 {
        self.views.redraws()
    }

    /// What happened since the last turn: frames, keys, dropped files, a wish to close.
    fn begin(&mut self, ctx: &Context) {
        // whatever was dragged or picked, it is over when no button is held
        if self.session.open_gesture().is_some() && !ctx.input(|input| input.pointer.any_down()) {
            self.session.perform(Action::EndGesture);
        }
        self.session.poll(Instant::now());
        self.look_at_scene();
        self.views.look_at(self.session.frame());
        let blocked = self.session.question().is_some()
            || self.dialogs.are_open()
            || egui::Popup::is_any_open(ctx)
            || self.views.is_dragging();
        if !blocked {
            shortcuts::collect(ctx, &self.outbox, self.views.have_focus(ctx), self.was_typing);
        }
        let (dropped, focused, closing) = ctx.input(|input| {
            let dropped = input.raw.dropped_files.first().map(|file| file.path().to_owned());
            let focused = input.events.contains(&egui::Event::WindowFocused(true));
            (dropped, focused, input.viewport().close_requested())
        });
        if let Some(path) = dropped {
            self.outbox.act(Action::OpenPath(path));
        }
        if focused {
            self.outbox.act(Action::LookAtDisk);
        }
        // a window for a script keeps nothing, so there is nothing to ask about
        if closing && self.session.is_dirty() && !self.forgetful {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.outbox.command(SessionCommand::Quit);
        }
        self.set_title(ctx);
    }

    /// Notices that the document is another one.
    fn look_at_scene(&mut self) {
        let scene = self.session.document().scene_shared();
        let same = match (&self.shown, &scene) {
            (Some(shown), Some(scene)) => Arc::ptr_eq(&shown.scene, scene),
            (None, None) => true,
            _ => false,
        };
        if !same {
            self.shown = scene.map(|scene| Shown::new(scene, self.next_revision));
            self.next_revision += 1;
        }
        if self.opened != self.session.opened_count() {
            self.opened = self.session.opened_count();
            // the card is for the program's start; who asks for a new scene wants that
            self.start_closed = true;
            self.views.opened();
        }
    }

    fn set_title(&mut self, ctx: &Context) {
        let star = if self.session.is_dirty() { "*" } else { "" };
        let title = format!("{star}{} – PolyScene", self.session.title());
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let context = AppContext {
            session: &self.session,
            shown: self.shown.as_ref(),
            theme: viewport::theme_of(&ctx),
            outbox: &self.outbox,
        };
        self.problems.refresh(&context);
        let bar = |margin| egui::Frame::side_top_panel(ui.style()).inner_margin(margin);
        let (menu_bar, tool_bar) = (bar(egui::Margin::symmetric(6, 2)), bar(egui::Margin::symmetric(6, 3)));
        let flush = bar(egui::Margin::ZERO);
        egui::Panel::top("menu").frame(menu_bar).show(ui, |ui| {
            menu::show(ui, &context, self.views.active_overlays(), self.views.snapping);
        });
        egui::Panel::top("transport").frame(tool_bar).exact_size(34.0).show(ui, |ui| {
            self.transport.show(ui, &context, self.views.layout(), self.views.snapping);
        });
        egui::Panel::bottom("status").frame(menu_bar).exact_size(24.0).show(ui, |ui| {
            status::show(ui, &context, &self.pace);
        });
        // a window made tiny squeezes panels of its own, so that the usual ones come back as they were
        let tight = ctx.content_rect().width() < TIGHT[0] || ctx.content_rect().height() < TIGHT[1];
        let panel = |name: &'static str| (name, tight);
        egui::Panel::right(panel("inspector"))
            .frame(flush)
            .default_size(344.0)
            .size_range(240.0..=560.0)
            .show(ui, |ui| self.inspector.show(ui, &context));
        // a diagram wants more room than a list, and each keeps the height it was given
        let (name, height) =
            if self.layout.tab == Tab::Accuracy { ("accuracy", 330.0) } else { ("lists", 176.0) };
        egui::Panel::bottom(panel(name)).frame(flush).default_size(height).size_range(60.0..=560.0).show(
            ui,
            |ui| {
                lists(ui, &context, (&mut self.problems, &mut self.accuracy), &mut self.layout.tab);
            },
        );
        egui::Panel::bottom("strip").frame(flush).exact_size(strip::HEIGHT).show(ui, |ui| {
            strip::show(ui, &context);
        });
        egui::Panel::left(panel("tree")).frame(flush).default_size(228.0).size_range(140.0..=460.0).show(
            ui,
            |ui| {
                self.tree.show(ui, &context);
            },
        );
        let area = egui::CentralPanel::no_frame().show(ui, |ui| {
            self.views.show(ui, &context);
            ui.min_rect()
        });
        if !self.start_closed && start::is_wanted(&self.session) && context.session.question().is_none() {
            self.start_closed = start::show(&ctx, area.inner, &context);
        }
        self.dialogs.show(&ctx, &context);
        self.toasts.show(&ctx);
    }

    /// The one place where anything changes.
    fn carry_out(&mut self, ctx: &Context) {
        let messages = self.outbox.take();
        let anything = !messages.is_empty();
        for message in messages {
            self.carry_out_message(ctx, message);
        }
        for request in self.session.take_requests() {
            match request {
                Request::SetClipboard(text) => ctx.copy_text(text),
                Request::ReadClipboard => ctx.send_viewport_cmd(ViewportCommand::RequestPaste),
                Request::Quit => {
                    ctx.send_viewport_cmd(ViewportCommand::Close);
                }
                file => self.dialogs.ask_for_file(ctx, &file),
            }
        }
        for notice in self.session.take_notices() {
            self.toasts.add(notice);
            ctx.request_repaint();
        }
        if anything {
            ctx.request_repaint();
        }
    }

    fn carry_out_message(&mut self, ctx: &Context, message: Message) {
        match message {
            Message::Command(command) => drop(self.execute(ctx, command)),
            Message::Do(action) => drop(self.session.perform(action)),
            Message::Frame(keys) => {
                self.with_views(ctx, |views, context| views.frame(context, Some(&keys), None));
            }
            Message::FramePlace(place) => {
                self.with_views(ctx, |views, context| views.frame_place(context, place));
            }
            Message::Rename(key) => {
                let context = context_of(&self.session, self.shown.as_ref(), &self.outbox, ctx);
                self.tree.rename(key, &context);
            }
            Message::ShowProblems => self.layout.tab = Tab::Problems,
            Message::ShowEvents => self.layout.tab = Tab::Events,
            Message::OverlaysInAllViews(overlays) => self.views.set_overlays(overlays),
            Message::Tell(text) => self.toasts.add(Notice::info(text)),
            Message::Warn(text) => self.toasts.add(Notice::warning(text)),
            Message::AskExport { export, file_name } => {
                self.dialogs.ask_for_export(ctx, export, file_name);
            }
            Message::Export(export, path) => match self.accuracy.write(export, &path) {
                Ok(()) => self.toasts.add(Notice::info(format!("Wrote {}", shown_path(&path)))),
                Err(problem) => self.toasts.add(Notice::error(problem)),
            },
        }
    }

    /// Hands a command to who carries it out; one that its row of the table disables is refused.
    pub(super) fn execute(&mut self, ctx: &Context, command: Command) -> Outcome {
        let refusal = self.session.refusal(command);
        match (command, refusal) {
            (Command::Session(command), _) => return self.session.perform(Action::Command(command)),
            (_, Some(reason)) => {
                self.toasts.add(Notice::warning(reason.clone()));
                return Outcome::Refused(reason);
            }
            (Command::View(command), None) => {
                self.with_views(ctx, |views, context| views.execute(command, context));
            }
            (Command::Window(command), None) => self.execute_here(ctx, command),
        }
        Outcome::Done
    }

    fn execute_here(&mut self, ctx: &Context, command: WindowCommand) {
        match command {
            WindowCommand::SwitchColors => {
                let dark = ctx.theme() == egui::Theme::Dark;
                ctx.set_theme(if dark { egui::Theme::Light } else { egui::Theme::Dark });
            }
            WindowCommand::ShowAccuracy => self.layout.tab = Tab::Accuracy,
            WindowCommand::Find => self.tree.find(),
            WindowCommand::Rename => {
                if let Some(key) = self.session.selection().primary() {
                    self.outbox.send(Message::Rename(key));
                    ctx.request_repaint();
                }
            }
            WindowCommand::Help => self.dialogs.open_help(HelpPage::Window),
            WindowCommand::Shortcuts => self.dialogs.open_help(HelpPage::Keys),
            WindowCommand::About => self.dialogs.open_help(HelpPage::About),
            WindowCommand::Palette => self.dialogs.open_palette(),
        }
    }

    pub(super) fn perform(&mut self, action: Action) -> Outcome {
        self.session.perform(action)
    }

    /// As the button of the Accuracy panel does.
    pub(super) fn run_study(&mut self, ctx: &Context) {
        self.look_at_scene();
        if let Some(shown) = &self.shown {
            self.accuracy.start(ctx, shown, self.session.title());
        }
    }

    pub(super) fn show_tab(&mut self, tab: Tab) {
        self.layout.tab = tab;
    }

    fn with_views<R>(&mut self, ctx: &Context, run: impl FnOnce(&mut Views, &AppContext<'_>) -> R) -> R {
        let context = context_of(&self.session, self.shown.as_ref(), &self.outbox, ctx);
        run(&mut self.views, &context)
    }

    /// An idle window stays idle: the only clocks are an edit that settles and the recovery copy.
    fn schedule(&self, ctx: &Context) {
        if self.session.open_gesture().is_some() {
            ctx.request_repaint_after(Duration::from_millis(160));
        } else if self.session.wants_recovery_copy() {
            ctx.request_repaint_after(Duration::from_secs(10));
        }
    }
}

fn context_of<'a>(
    session: &'a Session,
    shown: Option<&'a Shown>,
    outbox: &'a Outbox,
    ctx: &Context,
) -> AppContext<'a> {
    AppContext { session, shown, theme: viewport::theme_of(ctx), outbox }
}

/// Events, problems and accuracy, one behind the other.
fn lists(
    ui: &mut Ui,
    context: &AppContext<'_>,
    (problems, accuracy): (&mut Problems, &mut Accuracy),
    tab: &mut Tab,
) {
    let tones = super::colors::tones(ui);
    egui::Frame::new().fill(tones.heading).inner_margin(egui::Margin::symmetric(6, 2)).show(ui, |ui| {
        ui.horizontal(|ui| {
            let events = context.session.frame().events.len();
            ui.selectable_value(tab, Tab::Events, format!("Events of this Δt ({events})"));
            let counted = |count: usize, what: &str| match count {
                0 => None,
                1 => Some(format!("1 {what}")),
                _ => Some(format!("{count} {what}s")),
            };
            let counts = [counted(problems.errors(), "error"), counted(problems.warnings(), "warning")];
            let counts: Vec<String> = counts.into_iter().flatten().collect();
            let count = if counts.is_empty() { String::new() } else { format!(" ({})", counts.join(", ")) };
            let count = format!("Problems{count}");
            ui.selectable_value(tab, Tab::Problems, count);
            let running = if accuracy.is_running() { " (running)" } else { "" };
            ui.selectable_value(tab, Tab::Accuracy, format!("Accuracy{running}"));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if *tab == Tab::Events && events > 0 {
                    let copy = ui
                        .small_button("Copy")
                        .on_hover_text("All rows as text with tabs, for a spreadsheet");
                    if copy.clicked() {
                        ui.ctx().copy_text(super::events::as_text(context.session.frame()));
                    }
                }
                ui.take_available_width();
            });
        });
    });
    egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 2)).show(ui, |ui| {
        match tab {
            Tab::Events => super::events::show(ui, context),
            Tab::Problems => problems.show(ui, context),
            Tab::Accuracy => accuracy.show(ui, context),
        }
        ui.take_available_space();
    });
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let started = Instant::now();
        self.repaints += 1;
        let ctx = ui.ctx().clone();
        self.begin(&ctx);
        self.show(ui);
        self.carry_out(&ctx);
        self.schedule(&ctx);
        self.pace.frame_s = started.elapsed().as_secs_f64();
        self.was_typing = ctx.text_edit_focused();
        self.run_script(&ctx);
    }

    fn persist_egui_memory(&self) -> bool {
        !self.forgetful
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        if self.forgetful {
            return;
        }
        self.layout.views = self.views.remembered();
        eframe::set_value(storage, STORAGE_KEY, &self.layout);
    }
}
