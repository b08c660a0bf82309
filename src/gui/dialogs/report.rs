//! What became of a scene on its way to or from another program, line by line, losses first.

use std::sync::Arc;

use egui::{Context, Id, Modal, RichText, ScrollArea, Ui};

use crate::export::Verdict;
use crate::gui::colors::tones;
use crate::gui::widgets::mono;
use crate::import::ImportReport;
use crate::scene::escaped;

/// One line to show.
pub struct Line<'a> {
    pub verdict: Verdict,
    pub what: String,
    pub how: &'a str,
    /// Of the file that was read.
    pub place: Option<(u32, u32)>,
}

/// Such as `12 kept, 1 approximated, 2 dropped`.
pub fn summary(verdicts: impl Iterator<Item = Verdict>) -> String {
    let verdicts: Vec<Verdict> = verdicts.collect();
    let counted = |verdict: Verdict| {
        let count = verdicts.iter().filter(|found| **found == verdict).count();
        (count > 0).then(|| format!("{count} {verdict}"))
    };
    let all = [Verdict::Kept, Verdict::NotNeeded, Verdict::Approximated, Verdict::Dropped];
    all.into_iter().filter_map(counted).collect::<Vec<_>>().join(", ")
}

/// The lines, those that lose something first.
pub fn show(ui: &mut Ui, lines: &[Line<'_>]) {
    let tones = tones(ui);
    for verdict in [Verdict::Dropped, Verdict::Approximated, Verdict::NotNeeded, Verdict::Kept] {
        for line in lines.iter().filter(|line| line.verdict == verdict) {
            let color = match verdict {
                Verdict::Dropped => tones.error,
                Verdict::Approximated => tones.warning,
                Verdict::NotNeeded => tones.weak,
                Verdict::Kept => tones.good,
            };
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 6.0;
                ui.label(RichText::new(verdict.to_string()).color(color).strong());
                ui.label(escaped(&line.what));
                if let Some((line, column)) = line.place {
                    ui.label(mono(format!("{line}:{column}")).color(tones.weak));
                }
                if !line.how.is_empty() {
                    ui.label(RichText::new(escaped(line.how)).color(tones.weak));
                }
            });
        }
    }
}

/// What became of a file that was imported.
pub struct ImportDialog {
    title: String,
    report: Arc<ImportReport>,
}

impl ImportDialog {
    pub fn new(title: String, report: Arc<ImportReport>) -> Self {
        Self { title, report }
    }

    /// Whether it was closed.
    pub fn show(&self, ctx: &Context) -> bool {
        let mut closed = false;
        let modal = Modal::new(Id::unique("import report")).show(ctx, |ui| {
            ui.set_width(620.0);
            ui.heading(format!("Imported {}", escaped(&self.title)));
            let verdicts = self.report.lines.iter().map(|line| line.verdict);
            ui.label(format!("{}. Save it to keep it as a scene.", summary(verdicts)));
            ui.add_space(6.0);
            let lines = self.report.lines.iter().map(|line| Line {
                verdict: line.verdict,
                what: if line.count > 1 {
                    format!("{} × {}", line.count, line.what)
                } else {
                    line.what.clone()
                },
                how: &line.how,
                place: line.position,
            });
            let lines: Vec<_> = lines.collect();
            let height = (ctx.content_rect().height() - 220.0).clamp(120.0, 420.0);
            ScrollArea::vertical()
                .max_height(height)
                .auto_shrink([false, true])
                .show(ui, |ui| show(ui, &lines));
            ui.add_space(8.0);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                closed = ui.button("Close").clicked();
            });
        });
        closed || modal.should_close()
    }
}
