//! The text of the scene's file beside the picture: what is selected is marked, a click selects, changes since saving are
//! listed. It is read, or edited and then applied.

mod colors;
mod draft;

use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, FontId, Label, RichText, ScrollArea, Sense, Ui, vec2};

use self::colors::piece;
use self::draft::Draft;
use super::colors::tones;
use super::context::AppContext;
use super::numbers::count;
use crate::editor::{Action, DiffLine, DocumentText, Selection, diff};
use crate::scene::{NodeKey, escaped};

/// Longer lines are cut: a file may be one line.
const LONGEST: usize = 400;

/// While something is dragged, a text longer than this waits until the drag ends.
const LARGE: usize = 1 << 20;

/// The panel's own state.
#[derive(Default)]
pub struct XmlPane {
    text: DocumentText,
    /// Of which document the text is.
    of: Option<(u64, u64)>,
    /// What was selected when the text was scrolled last.
    shown: Option<NodeKey>,
    shows_changes: bool,
    /// The text while it is edited. It stays until it is applied or reverted; what was typed lies in the session too.
    draft: Option<Draft>,
    /// The changes since saving, and of which document.
    changes: Option<((u64, u64), Vec<DiffLine>)>,
}

impl XmlPane {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let of = (context.session.opened_count(), context.session.document_state());
        let is_old = self.of != Some(of);
        let waits = context.session.open_gesture().is_some() && self.text.text().len() > LARGE;
        if is_old && (!waits || self.of.is_none()) {
            self.text = DocumentText::of(context.session.document());
            self.of = Some(of);
        }
        self.look_at_draft(context, of);
        self.bar(ui, context, of);
        match &mut self.draft {
            _ if self.shows_changes => self.changes(ui, context, of),
            Some(draft) => draft.show(ui, context),
            None => self.text(ui, context),
        }
    }

    /// A draft belongs to the scene that is open: the session keeps it over a crash and asks before it goes.
    fn look_at_draft(&mut self, context: &AppContext<'_>, of: (u64, u64)) {
        let kept = context.session.draft();
        if kept.is_none() && self.draft.as_ref().is_some_and(|draft| draft.of.0 != of.0) {
            self.draft = None;
        }
        if let (Some(kept), None) = (kept, &self.draft) {
            let mut draft = Draft::of(context.session.document(), (self.text.text(), 0), of);
            draft.take(kept);
            self.draft = Some(draft);
            self.shows_changes = false;
        }
    }

    fn bar(&mut self, ui: &mut Ui, context: &AppContext<'_>, of: (u64, u64)) {
        ui.horizontal(|ui| {
            ui.selectable_value(&mut self.shows_changes, false, "Text").on_hover_text("As it would be saved");
            let changes = ui.selectable_value(&mut self.shows_changes, true, "Changes");
            changes.on_hover_text("What saving would change in the file");
            if self.draft.is_some() {
                self.edit_buttons(ui, context, of);
                return;
            }
            let short = self.text.text().len() <= draft::LONGEST;
            let edit = ui.add_enabled(short, egui::Button::new("Edit text"));
            let edit =
                edit.on_hover_text("Lets you type in the text, and apply what you typed as one undo step");
            let why_not =
                "Too long to edit here: edit the file in another program, and it is offered to be read again";
            if edit.on_disabled_hover_text(why_not).clicked() {
                self.shows_changes = false;
                let selected = context.session.selection().primary().and_then(|key| self.text.place(key));
                let at = selected.map_or(0, |place| place.start);
                self.draft = Some(Draft::of(context.session.document(), (self.text.text(), at), of));
            }
            let lines = format!("{} lines", count(self.text.line_count() as u64));
            ui.label(RichText::new(lines).color(tones(ui).weak));
            let (name, help) = if context.session.selection().is_empty() {
                ("Copy all", "The whole text, to the clipboard")
            } else {
                ("Copy as XML", "The elements of what is selected, as they stand, to the clipboard")
            };
            if ui.button(name).on_hover_text(help).clicked() {
                ui.ctx().copy_text(self.chosen(context.session.selection().keys()));
            }
        });
    }

    /// Apply and Revert, and what stands in the way.
    fn edit_buttons(&mut self, ui: &mut Ui, context: &AppContext<'_>, of: (u64, u64)) {
        let Some(draft) = &self.draft else { return };
        let can_apply = draft.is_changed() && draft.is_checked() && draft.errors() == 0;
        let apply = ui.add_enabled(can_apply, egui::Button::new("Apply"));
        let why_not = match draft.errors() {
            0 => "Nothing was changed",
            _ => "The text has errors",
        };
        let apply =
            apply.on_hover_text("Takes the text as the scene: one undo step").on_disabled_hover_text(why_not);
        let revert =
            ui.button("Revert").on_hover_text("Drops what was typed and shows the scene's text again");
        let tones = tones(ui);
        let (text, color) = match draft.errors() {
            0 if draft.of != of => {
                ("the scene changed meanwhile: applying replaces those changes".to_owned(), tones.warning)
            }
            0 => ("no errors".to_owned(), tones.weak),
            1 => ("1 error".to_owned(), tones.error),
            errors => (format!("{errors} errors"), tones.error),
        };
        ui.label(RichText::new(text).color(color));
        if apply.clicked() {
            context.outbox.act(Action::ReplaceText(draft.written()));
        }
        if revert.clicked() {
            context.outbox.act(Action::KeepDraft(None));
        }
        if apply.clicked() || revert.clicked() {
            self.draft = None;
        }
    }

    /// The elements of these bodies and forces in file order, or all.
    fn chosen(&self, keys: &[NodeKey]) -> String {
        if keys.is_empty() {
            return self.text.text().to_owned();
        }
        let mut places: Vec<_> = keys.iter().filter_map(|key| self.text.place(*key)).collect();
        places.sort_by_key(|place| place.start);
        let pieces = places.iter().filter_map(|place| self.text.text().get(place.clone()));
        pieces.map(|piece| format!("{piece}\n")).collect()
    }

    fn text(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let selection = context.session.selection();
        let font = FontId::monospace(12.0);
        let height = ui.fonts_mut(|fonts| fonts.row_height(&font)) + 2.0;
        let mut area = ScrollArea::both().id_salt("xml text").auto_shrink([false, false]);
        if self.shown != selection.primary() {
            self.shown = selection.primary();
            if let Some(place) = selection.primary().and_then(|key| self.text.place(key)) {
                let line = self.text.lines(&place).start as f32;
                area = area.vertical_scroll_offset(((line - 2.0) * height).max(0.0));
            }
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let text = &self.text;
        let mut clicked = None;
        area.show_rows(ui, height, text.line_count(), |ui, rows| {
            for row in rows {
                if let Some(byte) = line(ui, text, row, selection, &font, height) {
                    clicked = Some(byte);
                }
            }
        });
        let Some(key) = clicked.and_then(|byte| self.text.key_at(byte)) else { return };
        // the line that was clicked is in sight: nothing needs to scroll
        self.shown = Some(key);
        let add = ui.input(|input| input.modifiers.command || input.modifiers.shift);
        let act = if add { Action::ToggleSelected(key) } else { Action::Select(vec![key]) };
        context.outbox.act(act);
    }

    fn changes(&mut self, ui: &mut Ui, context: &AppContext<'_>, of: (u64, u64)) {
        let tones = tones(ui);
        let Some(saved) = context.session.saved_document() else {
            ui.label(RichText::new("This scene has no file yet: all of it is new.").color(tones.weak));
            return;
        };
        let known = self
            .changes
            .as_ref()
            .is_some_and(|(known, _)| (known, context.session.is_dirty()) == (&of, true));
        if !context.session.is_dirty() {
            ui.label(RichText::new("Nothing: the file holds this very text.").color(tones.weak));
            return;
        }
        if !known {
            let lines = diff(&saved.text_with_places().0, self.text.text());
            self.changes = Some((of, lines));
        }
        let Some((_, lines)) = &self.changes else { return };
        if lines.is_empty() {
            ui.label(
                RichText::new("No line differs; the file on the disk is gone or was replaced.")
                    .color(tones.weak),
            );
        }
        let font = FontId::monospace(12.0);
        let height = ui.fonts_mut(|fonts| fonts.row_height(&font)) + 2.0;
        ui.spacing_mut().item_spacing.y = 0.0;
        let area = ScrollArea::both().id_salt("xml changes").auto_shrink([false, false]);
        area.show_rows(ui, height, lines.len(), |ui, rows| {
            for line in lines.get(rows).unwrap_or_default() {
                let (text, color) = match line {
                    DiffLine::Same(text) => (format!("  {}", cut(text)), tones.weak),
                    DiffLine::Removed(text) => (format!("− {}", cut(text)), tones.error),
                    DiffLine::Added(text) => (format!("+ {}", cut(text)), tones.good),
                    DiffLine::Gap(1) => ("  ⋯ 1 line".to_owned(), tones.weak),
                    DiffLine::Gap(many) => (format!("  ⋯ {many} lines"), tones.weak),
                };
                ui.add(Label::new(RichText::new(text).font(font.clone()).color(color)).extend());
            }
        });
    }
}

/// One line; the byte that was clicked, if one was.
fn line(
    ui: &mut Ui,
    text: &DocumentText,
    row: usize,
    selection: &Selection,
    font: &FontId,
    height: f32,
) -> Option<usize> {
    let (line, start) = text.line(row);
    let shown = cut(line);
    let is_marked = text.keys_in_line(row).any(|key| selection.contains(key));
    let digits = text.line_count().to_string().len();
    let gutter = format!("{:>digits$}  ", row + 1);
    let job = colored(ui, text, &gutter, &shown, start, font);
    let top = ui.cursor().min;
    if is_marked {
        let size = vec2(ui.available_width().max(ui.clip_rect().width()), height);
        let rect = egui::Rect::from_min_size(top, size);
        ui.painter().rect_filled(rect, 0.0, ui.visuals().selection.bg_fill.gamma_multiply(0.6));
    }
    ui.allocate_ui_with_layout(
        vec2(ui.available_width(), height),
        egui::Layout::left_to_right(Align::Center),
        |ui| {
            let response = ui.add(Label::new(job).selectable(false).extend().sense(Sense::click()));
            let at = response.interact_pointer_pos().filter(|_| response.clicked())?;
            let width = ui.fonts_mut(|fonts| fonts.glyph_width(font, '0')).max(1.0);
            let column = ((at.x - response.rect.min.x) / width) as usize;
            let within = column.saturating_sub(gutter.len());
            Some(start + line.char_indices().nth(within).map_or(line.len(), |(at, _)| at))
        },
    )
    .inner
}

/// With tags, names, values and comments told apart.
fn colored(
    ui: &Ui,
    text: &DocumentText,
    gutter: &str,
    shown: &str,
    start: usize,
    font: &FontId,
) -> LayoutJob {
    let tones = tones(ui);
    let mut job = LayoutJob::default();
    let mut add = |piece: &str, color: Color32| {
        job.append(piece, 0.0, TextFormat { font_id: font.clone(), color, ..TextFormat::default() });
    };
    add(gutter, tones.weak.gamma_multiply(0.7));
    let mut rest = shown;
    let mut at = start;
    while !rest.is_empty() {
        let (length, color) = piece(rest, text.is_comment(at), &tones);
        let (piece, after) = rest.split_at(length);
        add(piece, color);
        (rest, at) = (after, at + length);
    }
    job
}

/// Fit for one line.
fn cut(line: &str) -> String {
    if line.chars().nth(LONGEST).is_none() {
        return escaped_spaces(line);
    }
    let short: String = line.chars().take(LONGEST).collect();
    format!("{}…", escaped_spaces(&short))
}

/// A tab is one space, so that a click finds its column; what hides or reorders is shown as an escape.
fn escaped_spaces(line: &str) -> String {
    escaped(&line.replace('\t', " "))
}
