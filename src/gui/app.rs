//! The application: owns the session and the panels, and is the one place that carries out what they ask.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Context, Ui, ViewportCommand};
use serde::{Deserialize, Serialize};

use super::accuracy::Accuracy;
use super::context::{AppContext, Message, Outbox, Shown};
use super::dialogs::{Dialogs, FileDialogs, FileRequest, HelpPage};
use super::dock::{Dock, Panel};
use super::inspector::Inspector;
use super::launch::Script;
use super::ledger::LedgerPanel;
use super::panels::Contents;
use super::problems::Problems;
use super::start::Start;
use super::status::Pace;
use super::timeline::{self, Timeline};
use super::toasts::Toasts;
use super::transport::Transport;
use super::tree::Tree;
use super::viewport::{self, Canvas, Views};
use super::xml::XmlPane;
use super::{menu, shortcuts, status, theme};
use crate::design::TOOLS;
use crate::editor::{
    Action, Command, Notice, Outcome, Ran, Request, Session, SessionCommand, Storage, Verified, WindowCommand,
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
    pub(super) session: Session,
    shown: Option<Shown>,
    /// What the views show where another scene ran than the document's.
    then: Option<(Ran, Shown)>,
    next_revision: u64,
    opened: u64,
    outbox: Outbox,
    pub(super) views: Views,
    tree: Tree,
    inspector: Inspector,
    transport: Transport,
    timeline: Timeline,
    pub(super) ledger: LedgerPanel,
    pub(super) problems: Problems,
    pub(super) accuracy: Accuracy,
    xml: XmlPane,
    pub(super) dialogs: Dialogs,
    toasts: Toasts,
    dock: Dock,
    start: Start,
    /// Whether a text field had the keyboard at the end of the last turn.
    was_typing: bool,
    title: String,
    pub(super) repaints: u64,
    pub(super) pace: Pace,
    pub(super) script: Option<Script>,
    /// A window for a script remembers nothing.
    pub(super) forgetful: bool,
}

/// What outlives a run.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct Remembered {
    panels: Option<egui_tiles::Tree<Panel>>,
    views: viewport::Remembered,
}

const STORAGE_KEY: &str = "polyscene layout";

/// What diagrams and texts need to be read, points.
const TALL: f32 = 330.0;

/// Size below which panels no longer have the room they want, points.
pub(super) const TIGHT: [f32; 2] = [800.0, 500.0];

impl App {
    /// Works without OpenGL (`cc.gl` is `None` in tests): the views are then empty.
    pub fn new(cc: &eframe::CreationContext<'_>, parts: Parts) -> Self {
        theme::install(&cc.egui_ctx);
        let remembered: Remembered =
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
            then: None,
            next_revision: 1,
            outbox: Outbox::default(),
            views: Views::new(canvas, &remembered.views),
            tree: Tree::default(),
            inspector: Inspector::default(),
            transport: Transport::default(),
            timeline: Timeline::default(),
            ledger: LedgerPanel::default(),
            problems: Problems::default(),
            accuracy: Accuracy::default(),
            xml: XmlPane::default(),
            dialogs: Dialogs::new(parts.files),
            toasts,
            dock: Dock::new(remembered.panels),
            start: Start::default(),
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

    /// What happened since the last turn: frames, keys, dropped files.
    fn begin(&mut self, ctx: &Context) {
        // whatever was dragged or picked, it is over when no button is held
        let is_held = ctx.input(|input| input.pointer.any_down())
            || self.script.as_ref().is_some_and(Script::is_dragging);
        if self.session.open_gesture().is_some() && !is_held {
            self.session.perform(Action::EndGesture);
        }
        self.session.poll(Instant::now());
        self.accuracy.take_outcome();
        self.look_at_scene();
        self.session.show_paths(self.views.show_overlay("trails").then_some(viewport::PATHS));
        self.session.show_tiles(self.views.show_overlay("tiles"));
        self.session.show_crossings(self.timeline.shows_crossings());
        self.session.show_cancelled(self.ledger.told_cancelled());
        let blocked = self.session.question().is_some()
            || self.dialogs.are_open()
            || egui::Popup::is_any_open(ctx)
            || self.views.is_dragging()
            || self.views.are_flying();
        if !blocked {
            shortcuts::collect(ctx, &self.outbox, self.views.have_focus(ctx), self.was_typing);
        }
        let (dropped, focused) = ctx.input(|input| {
            let dropped = input.raw.dropped_files.first().map(|file| file.path().to_owned());
            let focused = input.events.contains(&egui::Event::WindowFocused(true));
            (dropped, focused)
        });
        if let Some(path) = dropped {
            self.outbox.act(Action::OpenPath(path));
        }
        if focused {
            self.outbox.act(Action::LookAtDisk);
        }
        self.set_title(ctx);
    }

    /// Asks before a wish to close loses something, also what was typed in this very turn. A window for a script keeps
    /// nothing, so there is nothing to ask about.
    fn guard_closing(&mut self, ctx: &Context) {
        let closing = ctx.input(|input| input.viewport().close_requested());
        if closing && self.session.has_unsaved_work() && !self.forgetful {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.outbox.command(SessionCommand::Quit);
            ctx.request_repaint();
        }
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
        self.look_at_past(same);
        if self.opened != self.session.opened_count() {
            self.opened = self.session.opened_count();
            // the card is for the program's start; who asks for a new scene wants that
            self.start.close();
            self.views.opened();
            self.tree.opened();
            self.timeline.opened();
        }
    }

    /// Takes what ran at the moment shown; `same`: the document's scene is as before.
    fn look_at_past(&mut self, same: bool) {
        let then = self.session.scene_then();
        let is_known = match (&self.then, &then) {
            (Some((known, _)), Some(then)) => same && known.is(then),
            (None, None) => true,
            _ => false,
        };
        if !is_known {
            self.then = then.and_then(|then| {
                let scene = self.session.drawn(&then)?;
                Some((then, Shown::new(scene, self.next_revision)))
            });
            self.next_revision += 1;
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
        self.ledger.finish_writing(&ctx, &context);
        let bar = |margin| egui::Frame::new().inner_margin(margin);
        let (menu_bar, tool_bar) = (bar(egui::Margin::symmetric(6, 2)), bar(egui::Margin::symmetric(6, 3)));
        let flush = bar(egui::Margin::ZERO);
        egui::Panel::top("menu").frame(menu_bar).show(ui, |ui| {
            menu::show(ui, &context, self.views.active_overlays(), &self.views.switched_on());
        });
        egui::Panel::top("transport").frame(tool_bar).exact_size(34.0).show(ui, |ui| {
            self.transport.show(ui, &context, self.views.layout(), self.views.snapping);
        });
        egui::Panel::bottom("status").frame(menu_bar).exact_size(24.0).show(ui, |ui| {
            status::show(ui, &context, &self.pace);
        });
        egui::Panel::bottom("timeline").frame(flush).exact_size(timeline::HEIGHT).show(ui, |ui| {
            self.timeline.show(ui, &context);
        });
        let shown_views: [bool; 4] = std::array::from_fn(|index| self.views.is_shown(index));
        let then = self.then.as_ref().map(|(_, shown)| shown);
        // a part is seen in its place before it is made
        let preview = AppContext { shown: self.dialogs.preview().or(then).or(context.shown), ..context };
        let mut contents = Contents {
            context: &context,
            preview: &preview,
            tree: &mut self.tree,
            inspector: &mut self.inspector,
            ledger: &mut self.ledger,
            problems: &mut self.problems,
            accuracy: &mut self.accuracy,
            xml: &mut self.xml,
            views: &mut self.views,
            area: None,
        };
        egui::CentralPanel::no_frame().show(ui, |ui| {
            self.dock.show(ui, &mut contents, |index| shown_views.get(index).is_some_and(|shown| *shown));
        });
        let area = contents.area.unwrap_or_else(|| ctx.content_rect());
        let is_asked = context.session.question().is_some() || self.dialogs.are_open();
        if !is_asked {
            self.start.show(&ctx, area, &context);
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
                Request::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
                Request::ShowText => self.dock.show_tall(Panel::Xml, TALL),
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
            Message::ShowProblems => self.dock.bring_to_front(Panel::Problems),
            Message::ShowEvents => self.dock.bring_to_front(Panel::Events),
            Message::OverlaysInAllViews(overlays) => self.views.set_overlays(overlays),
            Message::Tell(text) => self.toasts.add(Notice::info(text)),
            Message::Warn(text) => self.toasts.add(Notice::warning(text)),
            Message::AskExport { export, file_name } => {
                self.dialogs.ask_for_export(ctx, export, file_name);
            }
            Message::AskWhere { title, file, file_name } => {
                let directory = self.session.path().and_then(Path::parent).map(Path::to_owned);
                self.dialogs.ask(ctx, FileRequest::Made { title, file, directory, file_name });
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
            (Command::Window(command), None) => return self.execute_here(ctx, command),
        }
        Outcome::Done
    }

    fn execute_here(&mut self, ctx: &Context, command: WindowCommand) -> Outcome {
        match command {
            WindowCommand::SwitchColors => {
                let dark = ctx.theme() == egui::Theme::Dark;
                ctx.set_theme(if dark { egui::Theme::Light } else { egui::Theme::Dark });
            }
            WindowCommand::ShowAccuracy => self.dock.show_tall(Panel::Accuracy, TALL),
            WindowCommand::ShowXml => self.dock.show_tall(Panel::Xml, TALL),
            WindowCommand::ShowCosts => {
                self.dock.bring_to_front(Panel::Events);
                self.ledger.show_costs();
            }
            WindowCommand::ResetLayout => self.dock.reset(),
            WindowCommand::DesignTool(index) => return self.use_tool(index),
            WindowCommand::Find => {
                self.dock.bring_to_front(Panel::Tree);
                self.tree.find();
            }
            WindowCommand::Rename => {
                if let Some(key) = self.session.selection().primary() {
                    self.outbox.send(Message::Rename(key));
                    ctx.request_repaint();
                }
            }
            WindowCommand::Export(format) => self.dialogs.open_export(format),
            WindowCommand::Settings => self.dialogs.open_settings(&self.session),
            WindowCommand::Help => self.dialogs.open_help(HelpPage::Window),
            WindowCommand::Shortcuts => self.dialogs.open_help(HelpPage::Keys),
            WindowCommand::About => self.dialogs.open_help(HelpPage::About),
            WindowCommand::Palette => self.dialogs.open_palette(),
        }
        Outcome::Done
    }

    /// At once, or after a dialog has asked for its sizes.
    fn use_tool(&mut self, index: usize) -> Outcome {
        let asks = TOOLS.get(index).is_some_and(|tool| !tool.inputs.is_empty());
        if !asks || self.session.can_use_tool(index).is_err() {
            return self.session.perform(Action::UseTool(index));
        }
        self.dialogs.ask_for_tool(index, self.views.eye());
        Outcome::Done
    }

    pub(super) fn perform(&mut self, action: Action) -> Outcome {
        self.session.perform(action)
    }

    /// As the button of the Accuracy panel does, which is shown.
    pub(super) fn run_study(&mut self, ctx: &Context) -> Outcome {
        self.look_at_scene();
        self.dock.show_tall(Panel::Accuracy, TALL);
        let Some(shown) = &self.shown else {
            return Outcome::Refused("the scene has errors, see Problems".to_owned());
        };
        match self.accuracy.start(ctx, shown, self.session.title()) {
            Ok(()) => Outcome::Done,
            Err(reason) => Outcome::Refused(reason),
        }
    }

    pub(super) fn show_panel(&mut self, panel: Panel) {
        self.dock.bring_to_front(panel);
    }

    fn with_views<R>(&mut self, ctx: &Context, run: impl FnOnce(&mut Views, &AppContext<'_>) -> R) -> R {
        let context = context_of(&self.session, self.shown.as_ref(), &self.outbox, ctx);
        run(&mut self.views, &context)
    }

    /// An idle window stays idle: the only clocks are an edit that settles, a comparison and the recovery copy.
    fn schedule(&self, ctx: &Context) {
        if self.session.open_gesture().is_some() {
            ctx.request_repaint_after(Duration::from_millis(160));
        } else if matches!(self.session.verified(), Some(Verified::Part(_))) {
            ctx.request_repaint_after(Duration::from_millis(100));
        } else if self.session.wants_recovery_copy() {
            ctx.request_repaint_after(crate::editor::RECOVERY_INTERVAL);
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

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let started = Instant::now();
        self.script.iter_mut().for_each(Script::begin_turn);
        self.repaints += 1;
        let ctx = ui.ctx().clone();
        self.begin(&ctx);
        self.show(ui);
        self.carry_out(&ctx);
        self.guard_closing(&ctx);
        self.schedule(&ctx);
        self.pace.frame_s = started.elapsed().as_secs_f64();
        self.was_typing = ctx.text_edit_focused();
        self.run_script(&ctx);
    }

    /// The colour of the panels, which so need no ground of their own: where the processor draws, each fill of the window takes
    /// some milliseconds.
    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn persist_egui_memory(&self) -> bool {
        !self.forgetful
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        if self.forgetful {
            return;
        }
        let panels = Some(self.dock.saved());
        eframe::set_value(storage, STORAGE_KEY, &Remembered { panels, views: self.views.remembered() });
    }
}
