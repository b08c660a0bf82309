//! The Accuracy panel: runs a study of the scene as it is edited, and shows speed against error.

mod diagram;
mod figures;
mod job;
mod knobs;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{ComboBox, Context, ProgressBar, RichText, ScrollArea, Ui, vec2};

use self::job::Job;
use self::knobs::Knobs;
use super::colors::tones;
use super::context::{AppContext, Message, Shown};
use super::widgets::severity_icon;
use crate::scene::{Scene, shown_path, write_atomically};
use crate::study::{self, AXES, StudyReport};

/// Width of the column with the knobs, points.
const KNOBS_WIDTH: f32 = 268.0;

/// A form in which a report leaves the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Export {
    Csv,
    Svg,
}

impl Export {
    /// Ending of the file's name.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Svg => "svg",
        }
    }
}

/// The panel's own state.
#[derive(Default)]
pub struct Accuracy {
    knobs: Knobs,
    job: Option<Job>,
    /// The scene that the job or the report is about.
    studied: Option<Arc<Scene>>,
    report: Option<StudyReport>,
    /// Grows with every report.
    serial: u64,
    problem: Option<String>,
    /// Index in [`AXES`] of the measure drawn; position error unless chosen.
    axis: Option<usize>,
    /// Revision of the scene that was compared last, and whether it differs from the one studied.
    stale: (u64, bool),
}

/// A diagram less high than this shows nothing, in points; where the panel is lower, it scrolls.
const LEAST_HEIGHT: f32 = 230.0;

/// Width from which diagram and figures have room beside each other, in points.
const LEAST_WIDTH: f32 = 640.0;

impl Accuracy {
    /// Whether a study is going on.
    pub fn is_running(&self) -> bool {
        self.job.is_some()
    }

    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let height = ui.available_height();
        ui.horizontal_top(|ui| {
            ui.allocate_ui_with_layout(
                vec2(KNOBS_WIDTH, height),
                egui::Layout::top_down(egui::Align::Min),
                |ui| {
                    ui.set_width(KNOBS_WIDTH);
                    ScrollArea::vertical().id_salt("study knobs").show(ui, |ui| self.controls(ui, context));
                },
            );
            ui.separator();
            match &self.report {
                None => empty(ui),
                Some(_) => self.results(ui, context, height),
            }
        });
    }

    /// Starts a study of a scene with what is typed, or says what is wrong with that.
    pub fn start(&mut self, ctx: &Context, shown: &Shown, title: &str) -> Result<(), String> {
        let settings = self.knobs.settings().map_err(|error| knobs::complaint(&error))?;
        self.job = Some(Job::start(ctx, shown.scene.clone(), title.to_owned(), settings));
        (self.studied, self.stale) = (Some(shown.scene.clone()), (shown.revision, false));
        (self.report, self.problem) = (None, None);
        Ok(())
    }

    /// Takes what a study has found, in every turn of the window: also while another panel lies before this one.
    pub fn take_outcome(&mut self) {
        let Some(outcome) = self.job.as_ref().and_then(Job::take) else { return };
        self.job = None;
        self.serial += 1;
        match outcome {
            Ok(report) => self.report = Some(report),
            Err(problem) => self.problem = Some(problem),
        }
    }

    fn controls(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        if let Some(job) = &self.job {
            let progress = job.progress();
            ui.add_space(4.0);
            ui.add(ProgressBar::new(progress.part as f32).show_percentage().desired_height(16.0));
            ui.label(RichText::new(progress.what).small());
            let stopping = job.is_cancelled();
            let text = if stopping { "Stopping…" } else { "Cancel study" };
            let button = ui.add_enabled(!stopping, egui::Button::new(text));
            if button.on_hover_text("Ends the study; what is done so far is shown").clicked() {
                job.cancel();
            }
            return;
        }
        self.knobs.show(ui);
        ui.add_space(4.0);
        let settings = self.knobs.settings();
        let refusal = match (&settings, context.shown) {
            (_, None) => Some("The scene has errors, see Problems.".to_owned()),
            (Err(error), _) => Some(knobs::complaint(error)),
            _ => None,
        };
        let button = ui.add_enabled(refusal.is_none(), egui::Button::new("Run study"));
        let button = button.on_hover_text(
            "Runs the scene as it is edited, saved or not, by every method and Δt, and compares it with an \
             independent reference. The simulation in the views goes on meanwhile.",
        );
        if let (true, Some(shown)) = (button.clicked(), context.shown) {
            // Without a refusal nothing is wrong with what is typed.
            let _ = self.start(ui.ctx(), shown, context.session.title());
        }
        if let Some(refusal) = refusal.or_else(|| self.problem.clone()) {
            ui.horizontal_wrapped(|ui| {
                severity_icon(ui, true);
                ui.label(refusal);
            });
        }
    }

    fn results(&mut self, ui: &mut Ui, context: &AppContext<'_>, height: f32) {
        let stale = self.is_stale(context);
        let Some(report) = &self.report else { return };
        let axis_index = self.axis.unwrap_or(1);
        let mut chosen = axis_index;
        let layout = egui::Layout::top_down(egui::Align::Min);
        ui.allocate_ui_with_layout(vec2(ui.available_width(), height), layout, |ui| {
            ScrollArea::vertical().id_salt("study results").auto_shrink(false).show(ui, |ui| {
                let top = ui.cursor().top();
                ui.horizontal_wrapped(|ui| {
                    chosen = axis_menu(ui, axis_index);
                    ui.add_space(8.0);
                    export_buttons(ui, context, report);
                    ui.add_space(8.0);
                    state(ui, report, stale);
                });
                ui.label(RichText::new(report.horizon_statement()).small());
                let rest = height - (ui.cursor().top() - top);
                let mut diagram = |ui: &mut Ui| {
                    if let Some(axis) = AXES.get(axis_index) {
                        diagram::show(ui, report, axis, self.serial);
                    }
                };
                beside_or_below(ui, rest, &mut diagram, &mut |ui| figures::show(ui, report));
            });
        });
        self.axis = Some(chosen);
    }

    /// Whether the scene is another one than the one studied; looked up once per change.
    fn is_stale(&mut self, context: &AppContext<'_>) -> bool {
        let Some(shown) = context.shown else { return true };
        if self.stale.0 != shown.revision {
            let same = self.studied.as_deref() == Some(&*shown.scene);
            self.stale = (shown.revision, !same);
        }
        self.stale.1
    }

    /// Writes the report into a file.
    pub fn write(&self, export: Export, path: &Path) -> Result<(), String> {
        let report = self.report.as_ref().ok_or("there is no report yet")?;
        let text = match export {
            Export::Csv => study::csv(report),
            Export::Svg => study::svg(report).map_err(|error| error.to_string())?,
        };
        write_atomically(path, text.as_bytes())
            .map_err(|error| format!("cannot write {}: {error}", shown_path(path)))
    }
}

/// Whether the figures are those of the scene as it is, and all of them.
fn state(ui: &mut Ui, report: &StudyReport, stale: bool) {
    if stale {
        severity_icon(ui, false);
        let text = "The scene was edited since: these figures are of the scene before.";
        ui.label(RichText::new(text).color(tones(ui).warning));
    } else if report.cancelled {
        severity_icon(ui, false);
        ui.label("Cancelled: this is what was done until then.");
    }
}

/// The diagram beside the figures, or above them where that would leave little of either.
fn beside_or_below(
    ui: &mut Ui,
    rest: f32,
    diagram: &mut dyn FnMut(&mut Ui),
    figures: &mut dyn FnMut(&mut Ui),
) {
    let layout = egui::Layout::top_down(egui::Align::Min);
    let (width, height) = (ui.available_width(), rest.max(LEAST_HEIGHT));
    if width < LEAST_WIDTH {
        ui.allocate_ui_with_layout(vec2(width, height), layout, diagram);
        ui.allocate_ui_with_layout(vec2(width, height), layout, figures);
        return;
    }
    ui.horizontal_top(|ui| {
        ui.allocate_ui_with_layout(vec2(0.46 * width, height), layout, |ui| {
            ui.set_width(0.46 * width);
            diagram(ui);
        });
        ui.allocate_ui_with_layout(vec2(ui.available_width(), height), layout, figures);
    });
}

fn empty(ui: &mut Ui) {
    ui.vertical(|ui| {
        ui.add_space(8.0);
        ui.label(RichText::new("How accurate is this scene, and what does that cost?").strong());
        let text = "A study runs it by every method and Δt, compares it with an independent reference (another \
                    integrator, another root finder, all pairs) as far as that can be trusted itself, and shows \
                    wall time against each error.";
        ui.label(RichText::new(text).color(tones(ui).weak));
    });
}

fn axis_menu(ui: &mut Ui, current: usize) -> usize {
    let mut chosen = current;
    let label = ui.label("Shown");
    let title = AXES.get(current).map_or("", |axis| axis.title);
    let response = ComboBox::from_id_salt("study axis")
        .selected_text(title)
        .width(190.0)
        .show_ui(ui, |ui| {
            for (nth, axis) in AXES.iter().enumerate().skip(1) {
                if ui.selectable_label(nth == current, axis.title).on_hover_text(axis.meaning).clicked() {
                    chosen = nth;
                }
            }
        })
        .response;
    response.labelled_by(label.id).on_hover_text("What is drawn against the wall time");
    chosen
}

fn export_buttons(ui: &mut Ui, context: &AppContext<'_>, report: &StudyReport) {
    let exports = [
        (Export::Csv, "Export CSV…", "All figures, full digits, for a spreadsheet"),
        (Export::Svg, "Export SVG…", "All diagrams as one picture"),
    ];
    for (export, text, help) in exports {
        if ui.button(text).on_hover_text(help).clicked() {
            let stem = PathBuf::from(&report.scene);
            let stem = stem.file_stem().map_or("study".into(), |stem| stem.to_string_lossy().into_owned());
            let file_name = format!("{stem}-study.{}", export.extension());
            context.outbox.send(Message::AskExport { export, file_name });
        }
    }
}
