//! File ▸ Export: for which program, which moment or motion, and beforehand what becomes of everything in the scene.

use std::path::Path;

use egui::{
    Align, Button, Context, DragValue, Id, Layout, Modal, ProgressBar, RichText, ScrollArea, Ui, vec2,
};

use super::FileRequest;
use super::export_job::ExportJob;
use super::report::{self, Line};
use crate::editor::{ExportedFile, parse_number};
use crate::export::{Exported, FORMATS, Format, Frames, When};
use crate::gui::colors::tones;
use crate::gui::context::AppContext;
use crate::gui::numbers::{count, significant};

/// What of the scene's run.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Start,
    Now,
    Motion,
}

pub struct ExportDialog {
    format: usize,
    part: Part,
    frames: Frames,
    /// What was asked for last, with its answer once it is there.
    asked: Option<Asked>,
    job: Option<ExportJob>,
    outcome: Option<Result<Exported, String>>,
}

/// Document, format and moment, told apart by their numbers.
type Asked = (u64, u64, usize, [u64; 5]);

/// What a turn of the dialog ended with.
pub enum Decision {
    Open,
    Cancel,
    Write(FileRequest),
}

/// A first guess: some seconds, at the pace of screens.
const USUAL: Frames = Frames { from: 0.0, to: 5.0, fps: 60.0 };

impl ExportDialog {
    pub fn new(format: usize) -> Self {
        let format = format.min(FORMATS.len().saturating_sub(1));
        Self { format, part: Part::Start, frames: USUAL, asked: None, job: None, outcome: None }
    }

    pub fn is_working(&self) -> bool {
        self.job.is_some()
    }

    pub fn show(&mut self, ctx: &Context, context: &AppContext<'_>) -> Decision {
        self.refresh(ctx, context);
        let before = (self.format, self.part, self.frames);
        let mut decision = Decision::Open;
        let modal = Modal::new(Id::unique("export scene")).show(ctx, |ui| {
            ui.set_width(720.0);
            ui.heading("Export the scene");
            ui.add_space(6.0);
            ui.horizontal_top(|ui| {
                ui.vertical(|ui| {
                    ui.set_width(230.0);
                    self.formats(ui);
                    ui.add_space(8.0);
                    self.parts(ui, context);
                });
                ui.add_space(16.0);
                ui.vertical(|ui| {
                    ui.set_width(ui.available_width());
                    self.preview(ui, ctx);
                });
            });
            ui.add_space(8.0);
            let row = vec2(ui.available_width(), 24.0);
            ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
                decision = self.buttons(ui, context);
            });
        });
        if before != (self.format, self.part, self.frames) {
            ctx.request_repaint();
        }
        if modal.should_close() && matches!(decision, Decision::Open) {
            return Decision::Cancel;
        }
        decision
    }

    fn formats(&mut self, ui: &mut Ui) {
        for (index, format) in FORMATS.iter().enumerate() {
            let chosen = ui.radio_value(&mut self.format, index, format.name);
            chosen.on_hover_text(format!("Holds {}", format.holds));
        }
    }

    fn parts(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let moves = self.chosen().is_some_and(|format| format.moves);
        if !moves && self.part == Part::Motion {
            self.part = Part::Start;
        }
        ui.radio_value(&mut self.part, Part::Start, "The start");
        let time = significant(context.session.frame().time, 6);
        ui.add_enabled_ui(!context.session.shows_start(), |ui| {
            let now = ui.radio_value(&mut self.part, Part::Now, format!("This moment, t = {time} s"));
            now.on_disabled_hover_text("The simulation stands at its start");
        });
        ui.add_enabled_ui(moves, |ui| {
            let motion = ui.radio_value(&mut self.part, Part::Motion, "The motion");
            motion.on_disabled_hover_text("This format holds a start only");
        });
        if self.part == Part::Motion {
            let Frames { from, to, fps } = &mut self.frames;
            let fields = [("From", from, "s"), ("To", to, "s"), ("Frames per second", fps, "1/s")];
            egui::Grid::new("frames").num_columns(3).spacing([8.0, 4.0]).show(ui, |ui| {
                for (name, value, unit) in fields {
                    ui.label(name);
                    let number = DragValue::new(value).speed(0.1).update_while_editing(false);
                    let number = number.custom_formatter(|value, _| significant(value, 8));
                    ui.add(number.custom_parser(parse_number)).accessible_name(name);
                    ui.label(RichText::new(unit).color(tones(ui).weak));
                    ui.end_row();
                }
            });
        }
    }

    fn chosen(&self) -> Option<&'static Format> {
        FORMATS.get(self.format)
    }

    fn when(&self) -> When {
        if self.part == Part::Motion { When::Motion(self.frames) } else { When::Start }
    }

    /// Begins anew when something else is asked for, and takes what came out.
    fn refresh(&mut self, ctx: &Context, context: &AppContext<'_>) {
        let session = context.session;
        let now = if self.part == Part::Now { session.frame().time.to_bits() } else { 0 };
        let Frames { from, to, fps } = self.frames;
        let motion = if self.part == Part::Motion { [from, to, fps].map(f64::to_bits) } else { [0; 3] };
        let moment = [self.part as u64, now, motion[0], motion[1], motion[2]];
        let asked = (session.opened_count(), session.document_state(), self.format, moment);
        if self.asked != Some(asked) {
            (self.asked, self.job, self.outcome) = (Some(asked), None, None);
            let document = match self.part {
                Part::Now => session.document_now().map_err(|error| error.to_string()),
                Part::Start | Part::Motion => Ok(session.document().clone()),
            };
            let refusal = (self.part == Part::Motion).then(|| self.frames.refusal()).flatten();
            match (refusal, document, self.chosen()) {
                (None, Ok(document), Some(format)) => {
                    self.job = Some(ExportJob::start(ctx, format, document, self.when()));
                }
                (Some(problem), ..) | (None, Err(problem), _) => self.outcome = Some(Err(problem)),
                (None, Ok(_), None) => {}
            }
        }
        if let Some(outcome) = self.job.as_ref().and_then(ExportJob::take) {
            (self.job, self.outcome) = (None, Some(outcome));
        }
    }

    fn preview(&self, ui: &mut Ui, ctx: &Context) {
        let height = (ctx.content_rect().height() - 220.0).clamp(120.0, 360.0);
        match (&self.outcome, &self.job) {
            (Some(Ok(exported)), _) => {
                let lines = &exported.report.lines;
                let verdicts = lines.iter().map(|line| line.verdict);
                ui.label(RichText::new(report::summary(verdicts)).strong());
                let size = format!("{} bytes", count(exported.bytes.len() as u64));
                ui.label(RichText::new(size).color(tones(ui).weak));
                ui.add_space(4.0);
                let lines = lines.iter().map(|line| Line {
                    verdict: line.verdict,
                    what: line.what.clone(),
                    how: &line.how,
                    place: None,
                });
                let lines: Vec<_> = lines.collect();
                let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
                area.auto_shrink([false, false]).show(ui, |ui| report::show(ui, &lines));
            }
            (Some(Err(problem)), _) => {
                ui.label(RichText::new(problem).color(tones(ui).error));
            }
            (None, Some(job)) => {
                ui.label("Preparing…");
                ui.add(ProgressBar::new(job.part()).desired_height(16.0));
            }
            (None, None) => {}
        }
    }

    fn buttons(&self, ui: &mut Ui, context: &AppContext<'_>) -> Decision {
        let mut decision = Decision::Open;
        let ready = matches!(self.outcome, Some(Ok(_)));
        let button = Button::new("Choose a file…").fill(ui.visuals().selection.bg_fill);
        let write = ui.add_enabled(ready, button.min_size(vec2(110.0, 24.0)));
        if let (true, Some(Ok(exported)), Some(format)) = (write.clicked(), &self.outcome, self.chosen()) {
            let file = ExportedFile { extension: format.extension, bytes: exported.bytes.clone().into() };
            decision = Decision::Write(FileRequest::Made {
                title: "Export the scene as",
                file,
                directory: context.session.path().and_then(Path::parent).map(Path::to_owned),
                file_name: format!("{}.{}", stem(context.session.title()), format.extension),
            });
        }
        if ui.add(Button::new("Cancel").min_size(vec2(76.0, 24.0))).clicked() {
            decision = Decision::Cancel;
        }
        decision
    }
}

/// The title without the ending of a scene's file.
fn stem(title: &str) -> &str {
    title.strip_suffix(".xml").unwrap_or(title)
}
