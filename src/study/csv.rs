//! The report as CSV: one row per run, one column per measure, empty where there is none.

use std::fmt::Write as _;

use super::{AXES, RunFigures, Stop, StudyReport};

/// The columns that [`AXES`] does not have.
const MORE: &str =
    "wall_s_per_s_min,wall_s_per_s_max,impacts,missed,wrong,first_difference_s,reached_s,stopped,horizon_s";

/// The whole file, lines ended by a line feed, a decimal point, comma separated.
pub fn csv(report: &StudyReport) -> String {
    let mut text = "method,dt_s,tolerance,group_step_s".to_owned();
    for axis in AXES {
        text += ",";
        text += axis.id;
    }
    let _ = writeln!(text, ",{MORE}");
    for point in &report.points {
        row(&mut text, point, report.horizon.time);
    }
    text
}

fn row(text: &mut String, point: &RunFigures, horizon: f64) {
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:e}"));
    let count = |value: Option<u64>| value.map_or(String::new(), |value| value.to_string());
    let mut cells = vec![
        point.method.name().to_owned(),
        number(point.dt),
        number(point.tolerance),
        number(point.group_step),
    ];
    cells.extend(AXES.iter().map(|axis| number((axis.get)(point))));
    cells.extend([
        number(point.wall_range.map(|range| range[0])),
        number(point.wall_range.map(|range| range[1])),
        point.impacts.to_string(),
        count(point.missed),
        count(point.wrong),
        number(point.first_difference),
        number(Some(point.reached)),
        stopped(point.stopped.as_ref()),
        number(Some(horizon)),
    ]);
    let _ = writeln!(text, "{}", cells.join(","));
}

/// Quoted, since a fault may say anything.
fn stopped(stop: Option<&Stop>) -> String {
    match stop {
        None => String::new(),
        Some(Stop::RunLimit) => "run limit".into(),
        Some(Stop::EventLimit) => "event limit".into(),
        Some(Stop::Fault(what)) => format!("\"{}\"", what.replace('"', "\"\"").replace(['\n', '\r'], " ")),
    }
}
