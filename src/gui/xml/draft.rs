//! The text while a person edits it: checked as they type, with what is wrong underlined, until it is applied or dropped.

use std::ops::Range;
use std::sync::Arc;

use egui::text::{CCursor, CCursorRange, LayoutJob, TextFormat};
use egui::text_edit::TextEditState;
use egui::{Color32, FontId, Galley, Id, Label, RichText, ScrollArea, Sense, Stroke, TextEdit, Ui};

use super::colors::piece;
use crate::editor::Action;
use crate::gui::colors::{Tones, tones};
use crate::gui::context::AppContext;
use crate::scene::{Diagnostic, Document};

/// Longer texts are for another program: they would be laid out anew with every letter.
pub(super) const LONGEST: usize = 1 << 19;

/// Texts longer than this are checked once typing pauses, after so many seconds.
const CHECKED_AT_ONCE: usize = 1 << 16;
const PAUSE: f64 = 0.4;

/// Problems that are listed; the number of the others is said.
const LISTED: usize = 3;

pub(super) struct Draft {
    text: String,
    /// Ends of lines are \r\n in the file; while editing they are \n.
    carriage_returns: bool,
    /// The document it began as.
    pub of: (u64, u64),
    before: String,
    problems: Vec<Problem>,
    /// What is underlined, by where it begins: bytes of the text, and whether it is an error.
    underlines: Vec<(Range<usize>, bool)>,
    /// When something was typed that is not checked yet, s of the window's clock.
    typed: Option<f64>,
    /// Where the cursor goes, in characters.
    jump: Option<usize>,
}

struct Problem {
    is_error: bool,
    text: String,
    /// Bytes of the text that are underlined.
    place: Range<usize>,
}

impl Draft {
    /// Begins with the text of a document, where the byte given stands.
    pub fn of(document: &Document, (text, at): (&str, usize), of: (u64, u64)) -> Self {
        let carriage_returns =
            text.contains("\r\n") && text.matches('\n').count() == text.matches("\r\n").count();
        let typed = |text: &str| if carriage_returns { text.replace("\r\n", "\n") } else { text.to_owned() };
        let jump = Some(typed(text.get(..at).unwrap_or_default()).chars().count());
        let (text, problems) = (typed(text), Vec::new());
        let mut draft = Self {
            before: text.clone(),
            text,
            carriage_returns,
            of,
            problems,
            underlines: Vec::new(),
            typed: None,
            jump,
        };
        draft.check(document);
        draft
    }

    /// Goes on with a text that was typed before.
    pub fn take(&mut self, text: &str) {
        self.text = if self.carriage_returns { text.replace("\r\n", "\n") } else { text.to_owned() };
        self.typed = Some(f64::NEG_INFINITY);
    }

    pub fn is_changed(&self) -> bool {
        self.text != self.before
    }

    /// The text as the file would have it.
    pub fn written(&self) -> String {
        if self.carriage_returns { self.text.replace('\n', "\r\n") } else { self.text.clone() }
    }

    pub fn errors(&self) -> usize {
        self.problems.iter().filter(|problem| problem.is_error).count()
    }

    /// Whether the problems are those of the text as it is.
    pub fn is_checked(&self) -> bool {
        self.typed.is_none()
    }

    fn check(&mut self, document: &Document) {
        let read = document.rewritten(&self.written());
        let lines: Vec<usize> =
            std::iter::once(0).chain(self.text.match_indices('\n').map(|(end, _)| end + 1)).collect();
        self.problems = read.diagnostics().iter().map(|one| Problem::of(one, &self.text, &lines)).collect();
        self.problems.sort_by_key(|problem| !problem.is_error);
        let places = self.problems.iter().map(|problem| (problem.place.clone(), problem.is_error));
        self.underlines = places.collect();
        self.underlines.sort_by_key(|(place, is_error)| (place.start, !is_error));
        self.typed = None;
    }

    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let now = ui.input(|input| input.time);
        if let Some(since) = self.typed {
            if self.text.len() <= CHECKED_AT_ONCE || now - since >= PAUSE {
                self.check(context.session.document());
            } else {
                ui.ctx().request_repaint_after_secs(PAUSE as f32);
            }
        }
        self.list(ui);
        ScrollArea::both().id_salt("xml draft").auto_shrink([false, false]).show(ui, |ui| {
            if self.edit(ui) {
                self.typed = Some(now);
                let kept = self.is_changed().then(|| self.written().into());
                context.outbox.act(Action::KeepDraft(kept));
                ui.ctx().request_repaint();
            }
        });
    }

    /// The first problems; a click goes to the place.
    fn list(&mut self, ui: &mut Ui) {
        let tones = tones(ui);
        for problem in self.problems.iter().take(LISTED) {
            let color = if problem.is_error { tones.error } else { tones.warning };
            let text = RichText::new(&problem.text).color(color).small();
            let response = ui.add(Label::new(text).truncate().sense(Sense::click()));
            if response.on_hover_text("A click goes to the place").clicked() {
                let before = self.text.get(..problem.place.start).unwrap_or_default();
                self.jump = Some(before.chars().count());
            }
        }
        let more = self.problems.len().saturating_sub(LISTED);
        if more > 0 {
            ui.label(RichText::new(format!("and {more} more")).color(tones.weak).small());
        }
    }

    /// Whether something was typed.
    fn edit(&mut self, ui: &mut Ui) -> bool {
        let (tones, font) = (tones(ui), FontId::monospace(12.0));
        let digits = self.text.lines().count().max(1).to_string().len();
        let width = ui.fonts_mut(|fonts| fonts.glyph_width(&font, '0'));
        let gutter = (digits + 2) as f32 * width;
        let id = Id::unique("xml draft text");
        let (underlines, layout_font) = (&self.underlines, font.clone());
        let mut layouter = |ui: &Ui, text: &dyn egui::TextBuffer, _: f32| -> Arc<Galley> {
            let job = job(text.as_str(), underlines, &layout_font, &tones);
            ui.fonts_mut(|fonts| fonts.layout_job(job))
        };
        let margin = egui::Margin { left: gutter.min(120.0) as i8, right: 4, top: 2, bottom: 2 };
        let field = TextEdit::multiline(&mut self.text)
            .id(id)
            .code_editor()
            .desired_width(f32::INFINITY)
            .desired_rows(4)
            .layouter(&mut layouter)
            .frame(egui::Frame::NONE.inner_margin(margin));
        let output = field.show(ui);
        let response = &output.response.response;
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::Role::MultilineTextInput, true, "Text of the file")
        });
        numbers(ui, &output, &font, gutter, tones.weak);
        if let Some(at) = self.jump.take() {
            let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
            state.cursor.set_char_range(Some(CCursorRange::one(CCursor::new(at))));
            state.store(ui.ctx(), id);
            response.request_focus();
            let place = output.galley.pos_from_cursor(CCursor::new(at));
            ui.scroll_to_rect(place.translate(output.galley_pos.to_vec2()).expand(24.0), None);
        }
        response.changed()
    }
}

/// The numbers of the lines that are in sight.
fn numbers(ui: &Ui, output: &egui::text_edit::TextEditOutput, font: &FontId, gutter: f32, color: Color32) {
    let clip = ui.clip_rect();
    let right = output.galley_pos.x - 0.15 * gutter;
    for (nth, row) in output.galley.rows.iter().enumerate() {
        let top = output.galley_pos.y + row.pos.y;
        if top > clip.bottom() {
            break;
        }
        if top + row.height() >= clip.top() {
            let place = egui::pos2(right, top);
            ui.painter().text(
                place,
                egui::Align2::RIGHT_TOP,
                nth + 1,
                font.clone(),
                color.gamma_multiply(0.7),
            );
        }
    }
}

/// The text in its colours, with problems underlined, which stand in order. Lines are not broken.
fn job(text: &str, underlines: &[(Range<usize>, bool)], font: &FontId, tones: &Tones) -> LayoutJob {
    let mut job = LayoutJob { wrap: egui::text::TextWrapping::no_max_width(), ..LayoutJob::default() };
    // While something is typed they may be those of the text before it.
    let ends = underlines.iter().flat_map(|(place, _)| [place.start, place.end]);
    let mut cuts: Vec<usize> = ends.filter(|cut| text.is_char_boundary(*cut)).collect();
    cuts.sort_unstable();
    let (mut at, mut next) = (0, 0);
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        let (length, color) = piece(rest, rest.starts_with("<!--"), tones);
        let mut end = (at + length).min(text.len());
        if let Some(cut) = cuts.get(cuts.partition_point(|cut| *cut <= at)) {
            end = end.min(*cut);
        }
        let Some(part) = text.get(at..end) else { break };
        let mut format = TextFormat { font_id: font.clone(), color, ..TextFormat::default() };
        while underlines.get(next).is_some_and(|(place, _)| place.end <= at) {
            next += 1;
        }
        if let Some((_, is_error)) = underlines.get(next).filter(|(place, _)| place.contains(&at)) {
            let line = if *is_error { tones.error } else { tones.warning };
            format.underline = Stroke::new(1.5, line);
        }
        job.append(part, 0.0, format);
        at = end;
    }
    job
}

impl Problem {
    fn of(diagnostic: &Diagnostic, text: &str, lines: &[usize]) -> Self {
        let place = diagnostic.position.map_or(0..0, |position| underlined(text, lines, position));
        Self { is_error: diagnostic.is_error(), text: diagnostic.to_string(), place }
    }
}

/// From a line and a column, both counted from 1, to the end of the word there, one letter at least. `lines` are where
/// lines begin.
fn underlined(text: &str, lines: &[usize], (line, column): (u32, u32)) -> Range<usize> {
    let start = lines.get(line.saturating_sub(1) as usize).copied().unwrap_or(text.len());
    let line = text.get(start..).and_then(|rest| rest.lines().next()).unwrap_or_default().trim_end();
    let at = line.char_indices().nth(column.saturating_sub(1) as usize).map_or(line.len(), |(at, _)| at);
    let rest = line.get(at..).unwrap_or_default();
    let length = rest.char_indices().skip(1).find(|(_, c)| c.is_whitespace() || matches!(c, '>' | '/'));
    let length = length.map_or(rest.len(), |(end, _)| end);
    start + at..start + at + length
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symptom: a letter of two bytes typed before an underlined word hid the rest of the text until it was checked.
    /// Expected: all of the text is laid out, whatever is underlined. Cause: an end inside a letter ended the layout.
    #[test]
    fn all_of_the_text_is_laid_out_with_underlines_of_another() {
        let text = "<a> ěščř <b X=\"ž\" /></a>";
        let tones = crate::gui::colors::of(true);
        for start in 0..text.len() + 3 {
            let underlines = [(start..start + 1, true), (start + 2..start + 5, false)];
            let job = job(text, &underlines, &FontId::monospace(12.0), &tones);
            assert_eq!(job.text, text, "{start}");
        }
    }

    #[test]
    fn a_problem_is_underlined_to_the_end_of_its_word() {
        let text = "<a>\n  <bö X=\"1\" />\r\n</a>";
        let lines = [0, 4, 21];
        let word = |line, column| text.get(underlined(text, &lines, (line, column))).unwrap_or("none");
        assert_eq!(word(2, 3), "<bö");
        assert_eq!(word(2, 7), "X=\"1\"");
        assert_eq!(word(1, 1), "<a");
        assert_eq!(word(2, 99), "");
        assert_eq!(word(9, 9), "");
    }
}
