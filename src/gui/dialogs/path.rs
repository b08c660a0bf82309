//! The window's own file dialog: a path to type and a folder to look through. For systems without one.

use std::path::{Path, PathBuf};

use egui::{Context, Id, Key, Modal, RichText, ScrollArea, TextEdit, Ui};

use super::FileRequest;
use crate::editor::{Action, Session};
use crate::gui::colors::tones;
use crate::gui::context::Message;
use crate::scene::shown_path;

/// Most entries of a folder listed.
const MOST: usize = 2000;

pub struct PathDialog {
    request: FileRequest,
    folder: PathBuf,
    text: String,
    entries: Vec<Entry>,
    problem: Option<String>,
    started: bool,
    /// The file that a second press on Save replaces.
    confirmed: Option<PathBuf>,
}

struct Entry {
    name: String,
    is_folder: bool,
}

impl PathDialog {
    pub fn new(request: FileRequest, session: &Session) -> Self {
        let beside = session.path().and_then(Path::parent).map(Path::to_owned);
        let (folder, text) = match &request {
            FileRequest::Open => (beside, String::new()),
            FileRequest::Save { directory, file_name } | FileRequest::Made { directory, file_name, .. } => {
                (directory.clone().or(beside), file_name.clone())
            }
            FileRequest::Export { file_name, .. } | FileRequest::Recording { file_name } => {
                (beside, file_name.clone())
            }
        };
        let folder = folder.or_else(|| std::env::current_dir().ok()).unwrap_or_else(|| PathBuf::from("/"));
        let mut dialog = Self {
            request,
            folder: PathBuf::new(),
            text,
            entries: Vec::new(),
            problem: None,
            started: false,
            confirmed: None,
        };
        dialog.enter(folder);
        dialog
    }

    /// What was decided, once it is.
    pub fn show(&mut self, ctx: &Context) -> Option<Message> {
        let opening = self.request == FileRequest::Open;
        let mut decided = None;
        let modal = Modal::new(Id::unique("path dialog")).show(ctx, |ui| {
            ui.set_width(520.0);
            ui.heading(self.request.title());
            ui.add_space(6.0);
            self.folder_bar(ui);
            self.listing(ui, &mut decided);
            ui.add_space(6.0);
            let label = ui.label("File name or path");
            let edit = TextEdit::singleline(&mut self.text).desired_width(f32::INFINITY);
            let response = ui.add(edit).labelled_by(label.id);
            if !std::mem::replace(&mut self.started, true) {
                response.request_focus();
            }
            let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            if let Some(problem) = &self.problem {
                ui.label(RichText::new(problem).color(tones(ui).error));
            }
            ui.add_space(6.0);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.button("Cancel").clicked() {
                    decided = Some(Message::Do(Action::DialogCancelled));
                }
                let verb = if opening { "Open" } else { "Save" };
                if ui.button(verb).clicked() || entered {
                    decided = self.accept();
                }
            });
        });
        if modal.should_close() && decided.is_none() {
            decided = Some(Message::Do(Action::DialogCancelled));
        }
        decided
    }

    fn folder_bar(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let parent = self.folder.parent().map(Path::to_owned);
            let up = ui.add_enabled(parent.is_some(), egui::Button::new("⬆"));
            let up = up.on_hover_text("To the parent folder").accessible_name("Folder above");
            if let Some(parent) = parent.filter(|_| up.clicked()) {
                self.enter(parent);
            }
            ui.label(RichText::new(shown_path(&self.folder)).weak());
        });
    }

    fn listing(&mut self, ui: &mut Ui, decided: &mut Option<Message>) {
        let (mut enter, mut taken) = (None, false);
        egui::Frame::new().fill(ui.visuals().extreme_bg_color).inner_margin(4).show(ui, |ui| {
            ScrollArea::vertical().max_height(260.0).auto_shrink([false, false]).show(ui, |ui| {
                for entry in &self.entries {
                    let text = if entry.is_folder { format!("{}/", entry.name) } else { entry.name.clone() };
                    let response = ui.selectable_label(self.text == entry.name, text);
                    if response.clicked() && entry.is_folder {
                        enter = Some(self.folder.join(&entry.name));
                    } else if response.clicked() {
                        self.text.clone_from(&entry.name);
                    }
                    taken |= response.double_clicked() && !entry.is_folder;
                }
            });
        });
        if let Some(folder) = enter {
            self.enter(folder);
        } else if taken {
            // as the button does: it asks before a file is replaced
            *decided = self.accept();
        }
    }

    /// Lists folders, then files of the wanted kind.
    fn enter(&mut self, folder: PathBuf) {
        match std::fs::read_dir(&folder) {
            Ok(entries) => {
                let endings = self.request.extensions();
                self.entries =
                    entries.flatten().filter_map(|entry| listed(&entry, &endings)).take(MOST).collect();
                self.entries.sort_by(|a, b| {
                    b.is_folder
                        .cmp(&a.is_folder)
                        .then_with(|| a.name.to_lowercase().cmp(&b.name.to_lowercase()))
                });
                self.folder = folder;
                self.problem = None;
            }
            Err(error) => self.problem = Some(format!("{}: {error}", shown_path(&folder))),
        }
    }

    fn accept(&mut self) -> Option<Message> {
        let typed = self.text.trim();
        if typed.is_empty() {
            self.problem = Some("Type a file name, or choose a file above.".to_owned());
            return None;
        }
        let path = self.folder.join(expanded(typed));
        if path.is_dir() {
            self.text.clear();
            self.enter(path);
            return None;
        }
        let saving = self.request != FileRequest::Open;
        if !saving && !path.exists() {
            self.problem = Some(format!("There is no file {}", shown_path(&path)));
            return None;
        }
        if saving && path.exists() && self.confirmed.as_ref() != Some(&path) {
            self.problem = Some("This file exists. Press Save again to replace it.".to_owned());
            self.confirmed = Some(path);
            return None;
        }
        Some(self.request.message(path))
    }
}

fn listed(entry: &std::fs::DirEntry, endings: &[&str]) -> Option<Entry> {
    let name = entry.file_name().to_string_lossy().into_owned();
    // follows links, so that linked folders can be entered
    let is_folder = entry.path().is_dir();
    let lower = name.to_lowercase();
    let is_wanted = endings.iter().any(|ending| lower.ends_with(&format!(".{ending}")));
    (!name.starts_with('.') && (is_folder || is_wanted)).then_some(Entry { name, is_folder })
}

/// `~` is the user's home.
fn expanded(typed: &str) -> PathBuf {
    match (typed.strip_prefix("~/"), std::env::var_os("HOME")) {
        (Some(rest), Some(home)) => PathBuf::from(home).join(rest),
        _ => PathBuf::from(typed),
    }
}
