//! File ▸ Export: for which program, which moment or motion, and beforehand what becomes of everything in the scene.

use std::path::Path;
use std::sync::Arc;

use egui::{
    Align, Button, Context, DragValue, Id, Layout, Modal, ProgressBar, RichText, ScrollArea, Ui, vec2,
};

use super::FileRequest;
use super::report::{self, Line};
use crate::editor::{Action, ExportedFile, parse_number};
use crate::export::{Exported, FORMATS, Format, Frames, When};
use crate::gui::background::Background;
use crate::gui::colors::tones;
use crate::gui::context::AppContext;
use crate::gui::numbers::{count, significant};
use crate::record::RecordedMotion;

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
    job: Option<Background<Exported>>,
    outcome: Option<Result<Exported, String>>,
    /// Whether the motion that is recorded has been asked for.
    awaits_motion: bool,
    /// Whether the times of the motion are the user's own.
    has_times: bool,
}

/// Document, format and moment, told apart by their numbers.
type Asked = (u64, u64, usize, [u64; 6]);

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
        Self {
            format,
            part: Part::Start,
            frames: USUAL,
            asked: None,
            job: None,
            outcome: None,
            awaits_motion: false,
            has_times: false,
        }
    }

    pub fn is_working(&self) -> bool {
        self.job.is_some() || self.awaits_motion
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
            self.take_recorded_times(context);
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
            ui.label(RichText::new(self.source(context)).color(tones(ui).weak).small());
        }
    }

    /// Proposes the part of the run that is recorded, once.
    fn take_recorded_times(&mut self, context: &AppContext<'_>) {
        let recorded = &context.session.frame().recorded;
        if !std::mem::replace(&mut self.has_times, true) && recorded.to > recorded.from {
            (self.frames.from, self.frames.to) = (recorded.from, recorded.to);
        }
    }

    /// Whether the run that is shown has the motion asked for.
    fn is_recorded(&self, context: &AppContext<'_>) -> bool {
        let recorded = &context.session.frame().recorded;
        let within = recorded.from <= self.frames.from && self.frames.to <= recorded.to;
        self.part == Part::Motion && within && !context.session.needs_reset()
    }

    /// Where the motion comes from, in words.
    fn source(&self, context: &AppContext<'_>) -> String {
        if self.is_recorded(context) {
            return "Looked up in what this run has recorded".to_owned();
        }
        let recorded = &context.session.frame().recorded;
        let [from, to] = [recorded.from, recorded.to].map(|time| significant(time, 6));
        format!("Simulated anew from the start: this run is recorded from {from} s to {to} s")
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
        let is_recorded = self.is_recorded(context);
        let moment = [self.part as u64, now, motion[0], motion[1], motion[2], u64::from(is_recorded)];
        let asked = (session.opened_count(), session.document_state(), self.format, moment);
        if self.asked != Some(asked) {
            self.end(context);
            (self.asked, self.job, self.outcome, self.awaits_motion) = (Some(asked), None, None, false);
            let document = match self.part {
                Part::Now => session.document_now().map_err(|error| error.to_string()),
                Part::Start | Part::Motion => Ok(session.document().clone()),
            };
            let refusal = (self.part == Part::Motion).then(|| self.frames.refusal()).flatten();
            match (refusal, document, self.chosen()) {
                (None, Ok(_), Some(_)) if is_recorded => {
                    self.awaits_motion = true;
                    context.outbox.act(Action::ShareMotion(true));
                }
                (None, Ok(document), Some(format)) => {
                    let when = self.when();
                    self.job = Some(Background::start(ctx, move |go_on| {
                        let exported = format.export_when(&document, when, &mut |part, _events| go_on(part));
                        exported.map_err(|error| error.to_string())
                    }));
                }
                (Some(problem), ..) | (None, Err(problem), _) => self.outcome = Some(Err(problem)),
                (None, Ok(_), None) => {}
            }
        }
        self.look_up(ctx, context);
        if let Some(outcome) = self.job.as_ref().and_then(Background::take) {
            (self.job, self.outcome) = (None, Some(outcome));
        }
    }

    /// Begins as soon as the motion is there that was asked for.
    fn look_up(&mut self, ctx: &Context, context: &AppContext<'_>) {
        let frames = self.frames;
        let has_all = |motion: &&Arc<RecordedMotion>| {
            let (from, to) = motion.span();
            from <= frames.from && frames.to <= to
        };
        let motion = context.session.frame().motion.as_ref().filter(has_all);
        let (true, Some(motion), Some(format)) = (self.awaits_motion, motion, self.chosen()) else { return };
        let (motion, document) = (motion.clone(), context.session.document().clone());
        self.awaits_motion = false;
        self.job = Some(Background::start(ctx, move |go_on| {
            let exported = format.export_recorded(&document, &motion, frames, go_on);
            exported.map_err(|error| error.to_string())
        }));
        // The job has its own hold on it.
        context.outbox.act(Action::ShareMotion(false));
    }

    /// Nothing is waited for any more.
    pub fn end(&mut self, context: &AppContext<'_>) {
        if std::mem::take(&mut self.awaits_motion) {
            context.outbox.act(Action::ShareMotion(false));
        }
    }

    fn preview(&self, ui: &mut Ui, ctx: &Context) {
        // As high whatever there is to show: a dialog in the middle of the window would move under the pointer.
        ui.set_height((ctx.content_rect().height() - 170.0).clamp(170.0, 410.0));
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
                ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| report::show(ui, &lines));
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
