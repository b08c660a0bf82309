//! The table of the hard cases: as text for a terminal, and as Markdown for the documentation.

use std::fmt::Write as _;

use super::case::{Case, CaseResult, Figure};

/// The Δt at which every figure is demanded, s.
pub const STEPS: [(f64, &str); 3] = [(1.0, "1 s"), (1.0 / 60.0, "1/60 s"), (1e-4, "0.1 ms")];

/// A figure at each Δt, as the columns of a table show it.
fn columns(outcomes: &[CaseResult], index: usize) -> impl Iterator<Item = &Figure> {
    outcomes.iter().filter_map(move |outcome| outcome.figures.get(index))
}

/// One line per figure of a case.
pub fn text(case: &Case, outcomes: &[CaseResult]) -> String {
    let mut text = format!("{:>2}  {} ({})\n", case.number, case.title, case.id);
    for (index, demand) in case.demands.iter().enumerate() {
        let values: Vec<String> =
            columns(outcomes, index).map(|figure| format!("{:>9}", shown(figure.value))).collect();
        let held = columns(outcomes, index).all(Figure::held);
        let limit =
            if demand.limit.is_finite() { format!("≤ {}", shown(demand.limit)) } else { String::new() };
        let verdict = if held { "" } else { "  MISSED" };
        let _ = writeln!(
            text,
            "    {:<52} {:>4} {:>9} {}{verdict}",
            demand.name,
            demand.unit,
            limit,
            values.join(" ")
        );
    }
    for outcome in outcomes {
        if let Some(why) = &outcome.stopped {
            let _ = writeln!(text, "    at Δt {} s: {why}", outcome.dt);
        }
    }
    text
}

/// A Markdown table of all cases given.
pub fn markdown(cases: &[(&Case, Vec<CaseResult>)]) -> String {
    let steps: Vec<String> = STEPS.iter().map(|(_, name)| format!("Δt {name}")).collect();
    let mut text = format!("| # | case and figure | demanded | {} |\n| --- | --- | --- |", steps.join(" | "));
    text.push_str(&" --- |".repeat(STEPS.len()));
    text.push('\n');
    for (case, outcomes) in cases {
        let peers =
            if case.peers.is_empty() { String::new() } else { format!("<br>*Peers:* {}", case.peers) };
        let blanks = " |".repeat(STEPS.len() + 1);
        let _ = writeln!(text, "| {} | **{}**: {}{peers} |{blanks}", case.number, case.title, case.reference);
        for (index, demand) in case.demands.iter().enumerate() {
            let limit =
                if demand.limit.is_finite() { format!("≤ {}", shown(demand.limit)) } else { "–".into() };
            let unit = if demand.unit.is_empty() { String::new() } else { format!(", {}", demand.unit) };
            let values: Vec<String> =
                columns(outcomes, index)
                    .map(|figure| {
                        if figure.held() {
                            shown(figure.value)
                        } else {
                            format!("**{}**", shown(figure.value))
                        }
                    })
                    .collect();
            let _ = writeln!(text, "| | {}{unit} | {limit} | {} |", demand.name, values.join(" | "));
        }
    }
    text
}

/// Two digits, as a person would write them.
fn shown(value: f64) -> String {
    if value.is_nan() {
        "none".into()
    } else if value == 0.0 {
        "0".into()
    } else if (10.0..1e7).contains(&value) && value.fract() == 0.0 {
        format!("{value}")
    } else if (0.1..1e4).contains(&value.abs()) {
        format!("{value:.2}")
    } else {
        format!("{value:.1e}").replace(".0e", "e")
    }
}
