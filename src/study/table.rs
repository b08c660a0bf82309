//! The report as an aligned table for people.

use super::{AXES, Axis, RunFigures, Stop, StudyReport, seconds, short};

/// The statement about the horizon and the table, with units, lines ended by a line feed.
pub fn table(report: &StudyReport) -> String {
    let mut text = format!("{}\n{}\n", report.title(), report.horizon_statement());
    if report.cancelled {
        text += report.ended();
        text += ": this is what was done until then.\n";
    }
    if report.points.is_empty() {
        return text;
    }
    text += "\n";
    let unit = |unit: &str| if unit.is_empty() { String::new() } else { format!("[{unit}]") };
    let heads = row_heads();
    let mut rows = vec![
        heads.iter().map(|head| head.name.to_owned()).collect(),
        heads.iter().map(|head| unit(head.unit)).collect::<Vec<_>>(),
    ];
    rows.extend(report.points.iter().map(row_cells));
    let widths: Vec<usize> = (0..rows[0].len())
        .map(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0))
        .collect();
    for row in &rows {
        let mut line = String::new();
        for (nth, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let space = " ".repeat(width - cell.chars().count());
            // Names to the left, numbers to the right.
            line += &if nth == 0 { format!("{cell}{space}") } else { format!("  {space}{cell}") };
        }
        text += line.trim_end();
        text += "\n";
    }
    for point in &report.points {
        if let Some(stop) = &point.stopped {
            text += &format!("{} at t = {} s: {}\n", name(point), short(point.reached), reason(stop));
        }
    }
    text
}

/// Head of one column.
pub struct Head {
    pub name: &'static str,
    /// Empty where dimensionless.
    pub unit: &'static str,
    pub meaning: &'static str,
}

/// The columns of the table.
pub fn row_heads() -> Vec<Head> {
    let plain = |name, meaning| Head { name, unit: "", meaning };
    let mut heads = vec![
        plain("method", "How it was stepped"),
        plain("Δt", "Step of the methods whose result depends on it"),
        plain("tolerance", "Field tolerance of exact, where the scene has fields"),
        plain("group step", "Step of stepped groups of exact, where it is not the scene's own"),
    ];
    heads.extend(columns().map(|axis| Head { name: axis.column, unit: axis.unit, meaning: axis.meaning }));
    heads.extend([
        plain("impacts", "Impacts of the whole run"),
        plain("missed", "Impacts of the reference up to the horizon that the run lacks"),
        plain("wrong", "Impacts of the run up to the horizon that the reference lacks"),
    ]);
    heads
}

/// The measures with a column; missed and wrong impacts have one each.
fn columns() -> impl Iterator<Item = &'static Axis> {
    AXES.iter().filter(|axis| axis.id != "missed_or_wrong")
}

/// The cells of one run, one for each of [`row_heads`].
pub fn row_cells(point: &RunFigures) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or("n/a".into(), short);
    let count = |value: Option<u64>| value.map_or("n/a".into(), |value| value.to_string());
    let mut cells = vec![
        point.method.name().to_owned(),
        point.dt.map_or("–".into(), seconds),
        point.tolerance.map_or("–".into(), short),
        point.group_step.map_or("–".into(), seconds),
    ];
    cells.extend(columns().map(|axis| number((axis.get)(point))));
    cells.extend([point.impacts.to_string(), count(point.missed), count(point.wrong)]);
    cells
}

fn name(point: &RunFigures) -> String {
    point.dt.map_or(point.method.name().into(), |dt| format!("{}, Δt {},", point.method.name(), seconds(dt)))
}

fn reason(stop: &Stop) -> String {
    match stop {
        Stop::RunLimit => "its wall time was over; the figures are those of this part".into(),
        Stop::EventLimit => "it had the most events allowed; the figures are those of this part".into(),
        Stop::Fault(what) => what.clone(),
    }
}
