//! Dialogs: questions, files, the command palette, help.

mod export;
mod files;
mod help;
mod palette;
mod path;
mod question;
mod report;
mod settings;
mod tool;

use egui::Context;

use super::accuracy::Export;
use super::context::{AppContext, Shown};
use crate::design::Eye;
use crate::editor::{Action, Request, Session};

use export::ExportDialog;
pub use files::{FileAnswer, FileDialogs, FileRequest, NativeFileDialogs, NoFileDialogs};
pub use help::HelpPage;
use palette::Palette;
use path::PathDialog;
use report::ImportDialog;
use settings::SettingsDialog;
use tool::ToolDialog;

/// All dialogs; at most one of them is open beside a question.
pub struct Dialogs {
    files: Box<dyn FileDialogs>,
    /// What the open file dialog is for.
    asked: Option<FileRequest>,
    path: Option<PathDialog>,
    palette: Option<Palette>,
    help: Option<HelpPage>,
    tool: Option<ToolDialog>,
    export: Option<ExportDialog>,
    import: Option<ImportDialog>,
    settings: Option<SettingsDialog>,
}

impl Dialogs {
    pub fn new(files: Box<dyn FileDialogs>) -> Self {
        Self {
            files,
            asked: None,
            path: None,
            palette: None,
            help: None,
            tool: None,
            export: None,
            import: None,
            settings: None,
        }
    }

    /// Whether a dialog has the keyboard, so that shortcuts wait.
    pub fn are_open(&self) -> bool {
        self.asked.is_some()
            || self.path.is_some()
            || self.palette.is_some()
            || self.help.is_some()
            || self.tool.is_some()
            || self.export.is_some()
            || self.import.is_some()
            || self.settings.is_some()
    }

    /// Whether a dialog waits for a thread of its own.
    pub fn are_working(&self) -> bool {
        self.export.as_ref().is_some_and(ExportDialog::is_working)
    }

    /// Opens the dialog that exports the scene, with a format of [`crate::export::FORMATS`] chosen.
    pub fn open_export(&mut self, format: Option<usize>) {
        self.export = Some(ExportDialog::new(format.unwrap_or_default()));
    }

    pub fn open_palette(&mut self) {
        self.palette = Some(Palette::default());
    }

    pub fn open_settings(&mut self, session: &Session) {
        self.settings = Some(SettingsDialog::new(session));
    }

    pub fn open_help(&mut self, page: HelpPage) {
        self.help = Some(page);
    }

    /// Asks for what a tool of [`crate::design::TOOLS`] needs to know.
    pub fn ask_for_tool(&mut self, index: usize, eye: Eye) {
        self.tool = ToolDialog::new(index, eye);
    }

    /// What the views show while a tool asks: the scene as it would be.
    pub fn preview(&self) -> Option<&Shown> {
        self.tool.as_ref().and_then(ToolDialog::preview)
    }

    /// Opens a file dialog that the session asks for.
    pub fn ask_for_file(&mut self, ctx: &Context, request: &Request) {
        let request = match request {
            Request::ShowImport { title, report } => {
                self.import = Some(ImportDialog::new(title.clone(), report.clone()));
                return;
            }
            Request::ChooseOpenPath => FileRequest::Open,
            Request::ChooseRecordingPath { file_name } => {
                FileRequest::Recording { file_name: file_name.clone() }
            }
            Request::ChooseSavePath { directory, file_name } => {
                FileRequest::Save { directory: directory.clone(), file_name: file_name.clone() }
            }
            _ => return,
        };
        self.files.ask(ctx, &request);
        self.asked = Some(request);
    }

    /// Opens a file dialog for figures or diagrams of a study.
    pub fn ask_for_export(&mut self, ctx: &Context, export: Export, file_name: String) {
        let request = FileRequest::Export { export, file_name };
        self.ask(ctx, request);
    }

    pub fn ask(&mut self, ctx: &Context, request: FileRequest) {
        self.files.ask(ctx, &request);
        self.asked = Some(request);
        // the answer may be there already
        ctx.request_repaint();
    }

    pub fn show(&mut self, ctx: &Context, context: &AppContext<'_>) {
        self.take_file_answer(context);
        if let Some(dialog) = &mut self.path
            && let Some(message) = dialog.show(ctx)
        {
            context.outbox.send(message);
            self.path = None;
        }
        if let Some(palette) = &mut self.palette
            && palette.show(ctx, context)
        {
            self.palette = None;
        }
        if let Some(tool) = &mut self.tool
            && tool.show(ctx, context)
        {
            self.tool = None;
        }
        match self.export.as_mut().map(|export| export.show(ctx, context)) {
            Some(export::Decision::Write(request)) => {
                self.export = None;
                self.ask(ctx, request);
            }
            Some(export::Decision::Cancel) => {
                self.export.take().into_iter().for_each(|mut export| export.end(context));
            }
            Some(export::Decision::Open) | None => {}
        }
        if let Some(import) = &self.import
            && import.show(ctx)
        {
            self.import = None;
        }
        if let Some(settings) = &mut self.settings
            && settings.show(ctx, context)
        {
            self.settings = None;
        }
        if let Some(page) = self.help
            && help::show(ctx, page)
        {
            self.help = None;
        }
        if let Some(question) = context.session.question()
            && let Some(answer) = question::show(ctx, question)
        {
            context.outbox.act(Action::Answer(answer));
        }
    }

    fn take_file_answer(&mut self, context: &AppContext<'_>) {
        let Some(answer) = self.asked.as_ref().and_then(|_| self.files.answer()) else { return };
        let Some(request) = self.asked.take() else { return };
        match answer {
            FileAnswer::Chosen(path) => context.outbox.send(request.message(path)),
            FileAnswer::Cancelled => context.outbox.act(Action::DialogCancelled),
            FileAnswer::Unavailable => self.path = Some(PathDialog::new(request, context.session)),
        }
    }
}
