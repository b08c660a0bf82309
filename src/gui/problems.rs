//! The list of problems: where, what, what to do, and a button where there is a fix.

use egui::{RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder};

use super::colors::tones;
use super::context::{AppContext, Message};
use super::theme::ROW_HEIGHT;
use super::widgets::{cell, mono, severity_icon};
use crate::editor::{Action, Fix, Problem, ProblemSource, SessionCommand};
use crate::scene::Severity;

/// Keeps the list, which is made again only when document or frame changed, and not while a drag goes on: its search
/// for overlaps looks at all bodies.
#[derive(Default)]
pub struct Problems {
    of: Option<(u64, u64, u64)>,
    list: Vec<Problem>,
}

impl Problems {
    pub fn refresh(&mut self, context: &AppContext<'_>) {
        let session = context.session;
        let of = (session.opened_count(), session.document_state(), session.frame().revision);
        if self.of != Some(of) && !session.hand_moves() {
            self.list = session.problems();
            self.of = Some(of);
        }
    }

    pub fn errors(&self) -> usize {
        self.list.iter().filter(|problem| problem.severity == Severity::Error).count()
    }

    pub fn warnings(&self) -> usize {
        self.list.len() - self.errors()
    }

    /// What the panel is called, with how much is wrong.
    pub fn title(&self) -> String {
        let counted = |count: usize, what: &str| match count {
            0 => None,
            1 => Some(format!("1 {what}")),
            _ => Some(format!("{count} {what}s")),
        };
        let counts = [counted(self.errors(), "error"), counted(self.warnings(), "warning")];
        let counts: Vec<String> = counts.into_iter().flatten().collect();
        if counts.is_empty() { "Problems".to_owned() } else { format!("Problems ({})", counts.join(", ")) }
    }

    /// A button for all problems, where more than one can be put right.
    pub fn show_beside_tab(&self, ui: &mut Ui, context: &AppContext<'_>) {
        let fixes = self.list.iter().filter(|problem| matches!(problem.fix, Some(Fix::Repair(_)))).count();
        let help = "Makes IDs unique, pushes bodies apart, grows the map and fits the tiles, as far as each is needed";
        if fixes > 1 && ui.small_button("Put all right").on_hover_text(help).clicked() {
            context.outbox.act(Action::RepairAll);
        }
    }

    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        if self.list.is_empty() {
            ui.add_space(8.0);
            let text =
                RichText::new("No problems: the scene can be simulated and saved.").color(tones(ui).weak);
            ui.label(text);
            return;
        }
        // Half of what is left for the text, half for what to do: its buttons must be in sight.
        let text_width = (0.5 * (ui.available_width() - 190.0)).clamp(120.0, 430.0);
        let table = TableBuilder::new(ui)
            .id_salt("problems")
            .striped(true)
            .sense(Sense::click())
            .min_scrolled_height(0.0)
            .column(Column::exact(18.0))
            .column(Column::initial(52.0).resizable(true))
            .column(Column::initial(80.0).resizable(true).clip(true))
            .column(Column::initial(text_width).resizable(true).clip(true))
            .column(Column::remainder().clip(true));
        table
            .header(ROW_HEIGHT, |mut header| {
                for title in ["", "Place", "Object", "Problem", "What to do"] {
                    cell(&mut header, RichText::new(title).small().weak(), "");
                }
            })
            .body(|mut body| {
                let width = |nth: usize| body.widths().get(nth).copied().unwrap_or(text_width);
                let widths = [width(TEXT), width(TO_DO)];
                let heights: Vec<f32> =
                    self.list.iter().map(|problem| height(body.ui_mut(), problem, widths)).collect();
                body.heterogeneous_rows(heights.into_iter(), |mut row| {
                    let Some(problem) = self.list.get(row.index()) else { return };
                    row.set_selected(
                        problem.key.is_some_and(|key| context.session.selection().contains(key)),
                    );
                    row.col(|ui| drop(severity_icon(ui, problem.severity == Severity::Error)));
                    cell(&mut row, mono(place(problem)), &problem.path);
                    object(&mut row, context, problem);
                    row.col(|ui| wrapped(ui, RichText::new(&problem.message), &problem.message));
                    row.col(|ui| {
                        ui.horizontal_top(|ui| {
                            fix_button(ui, context, problem);
                            wrapped(ui, RichText::new(&problem.hint).weak(), &problem.hint);
                        });
                    });
                    click(&row.response(), context, problem);
                });
            });
    }
}

/// Columns of what is wrong and of what to do.
const TEXT: usize = 3;
const TO_DO: usize = 4;

/// What a row needs for all lines of its texts, in columns of these widths, points.
fn height(ui: &mut Ui, problem: &Problem, [text, to_do]: [f32; 2]) -> f32 {
    let font = egui::TextStyle::Body.resolve(ui.style());
    let color = ui.visuals().text_color();
    let (padding, gap) = (2.0 * ui.spacing().button_padding.x, ui.spacing().item_spacing.x);
    ui.fonts_mut(|fonts| {
        let mut size =
            |text: &str, width: f32| fonts.layout(text.to_owned(), font.clone(), color, width).size();
        let button = problem.fix.map_or(0.0, |fix| size(fix.label(), f32::INFINITY).x + padding + gap);
        let lines = size(&problem.message, text).y.max(size(&problem.hint, to_do - button).y);
        (lines + 4.0).max(ROW_HEIGHT)
    })
}

/// A text in as many lines as it needs; the tooltip has it where even they have no room.
fn wrapped(ui: &mut Ui, text: RichText, help: &str) {
    ui.add(egui::Label::new(text).wrap()).on_hover_text(help);
}

fn place(problem: &Problem) -> String {
    match (problem.position, problem.source) {
        (Some((line, column)), _) => format!("{line}:{column}"),
        (None, ProblemSource::Run) => "run".to_owned(),
        (None, ProblemSource::Scene) => "scene".to_owned(),
        (None, ProblemSource::Simulation) => "start".to_owned(),
        (None, ProblemSource::Document) => "file".to_owned(),
    }
}

/// What a person calls the body or force; the tooltip has its label.
fn object(row: &mut egui_extras::TableRow<'_, '_>, context: &AppContext<'_>, problem: &Problem) {
    let found = context.shown.zip(problem.key);
    let name = found.and_then(|(shown, key)| shown.name(key)).unwrap_or_default();
    let label = found.and_then(|(shown, key)| {
        let body = shown.body(key).map(|body| &body.label);
        body.or_else(|| shown.force(key).map(|force| &force.label))
    });
    cell(row, RichText::new(name), label.map_or("", |label| label));
}

fn fix_button(ui: &mut Ui, context: &AppContext<'_>, problem: &Problem) {
    let Some(fix) = problem.fix else { return };
    if ui.small_button(fix.label()).on_hover_text(fix.help()).clicked() {
        match fix {
            Fix::Repair(repair) => context.outbox.act(Action::Repair(repair)),
            Fix::Reset => context.outbox.command(SessionCommand::Reset),
        }
    }
}

fn click(response: &egui::Response, context: &AppContext<'_>, problem: &Problem) {
    let Some(key) = problem.key.filter(|key| context.shown.is_some_and(|shown| shown.item(*key).is_some()))
    else {
        return;
    };
    let keys: Vec<_> = [key].into_iter().chain(problem.others.iter().copied()).collect();
    if response.double_clicked() {
        context.outbox.send(Message::Frame(keys.clone()));
    }
    if response.clicked() {
        context.outbox.act(Action::Select(keys));
    }
}
