//! The figures of a study as a table.

use egui::{RichText, Ui};
use egui_extras::{Column, TableBuilder};

use crate::gui::colors::tones;
use crate::gui::theme::ROW_HEIGHT;
use crate::gui::widgets::{cell, mono};
use crate::study::{Stop, StudyReport, row_cells, row_heads};

pub fn show(ui: &mut Ui, report: &StudyReport) {
    let heads = row_heads();
    egui::ScrollArea::horizontal().id_salt("figures").show(ui, |ui| {
        let mut table = TableBuilder::new(ui).id_salt("study figures").striped(true);
        for (nth, _) in heads.iter().enumerate() {
            let width = if nth < 2 { 58.0 } else { 68.0 };
            table = table.column(Column::initial(width).resizable(true));
        }
        table
            .header(ROW_HEIGHT, |mut header| {
                for head in &heads {
                    let unit = if head.unit.is_empty() { String::new() } else { format!(" [{}]", head.unit) };
                    cell(
                        &mut header,
                        RichText::new(format!("{}{unit}", head.name)).small().weak(),
                        head.meaning,
                    );
                }
            })
            .body(|body| {
                body.rows(ROW_HEIGHT, report.points.len(), |mut row| {
                    let Some(point) = report.points.get(row.index()) else { return };
                    let help = point.stopped.as_ref().map_or(String::new(), stopped);
                    for (nth, text) in row_cells(point).into_iter().enumerate() {
                        let marked = nth == 0 && point.stopped.is_some();
                        let text = if marked { format!("{text} (part)") } else { text };
                        cell(&mut row, mono(text).size(11.5), &help);
                    }
                });
            });
    });
    let stops = report.points.iter().filter(|point| point.stopped.is_some()).count();
    if stops > 0 {
        let text = format!("{stops} run(s) ended early: hover for the reason.");
        ui.label(RichText::new(text).small().color(tones(ui).warning));
    }
}

fn stopped(stop: &Stop) -> String {
    match stop {
        Stop::EventLimit => "It had the most events allowed; the figures are those of this part.".into(),
        Stop::RunLimit => "Its wall time was over; the figures are those of this part.".into(),
        Stop::Fault(what) => format!("Stopped: {what}"),
    }
}
