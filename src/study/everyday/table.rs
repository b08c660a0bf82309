//! The table of everyday scenes, a row for each family and size with its worst scene: for a terminal and for the
//! documentation.

use std::fmt::Write as _;

use super::demands::{Miss, misses};
use super::family::Setup;
use super::judge::Outcome;

/// The worst of a family's scenes of one size.
pub struct Row {
    pub family: &'static str,
    pub n: usize,
    pub scenes: usize,
    /// Scenes that miss a demand, by what they miss.
    pub missed: Vec<(Miss, usize)>,
    /// Processor time over model time reached.
    pub pace: f64,
    pub overlap: f64,
    pub gain: f64,
    pub residual: f64,
    pub events: u64,
}

/// One row for each family and size, in the order in which they come first.
pub fn rows(judged: &[(Setup, Outcome)]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for (setup, outcome) in judged {
        let found = rows.iter().position(|row| row.family == setup.family.name && row.n == setup.n);
        let at = found.unwrap_or_else(|| {
            rows.push(Row::empty(setup));
            rows.len() - 1
        });
        rows[at].add(outcome);
    }
    rows
}

impl Row {
    fn empty(setup: &Setup) -> Self {
        Self {
            family: setup.family.name,
            n: setup.n,
            scenes: 0,
            missed: Vec::new(),
            pace: 0.0,
            overlap: 0.0,
            gain: 0.0,
            residual: 0.0,
            events: 0,
        }
    }

    fn add(&mut self, outcome: &Outcome) {
        self.scenes += 1;
        for miss in misses(outcome) {
            match self.missed.iter_mut().find(|(known, _)| *known == miss) {
                Some((_, count)) => *count += 1,
                None => self.missed.push((miss, 1)),
            }
        }
        self.missed.sort_unstable();
        self.pace = self.pace.max(outcome.cost / outcome.reached);
        self.overlap = self.overlap.max(outcome.overlap);
        self.gain = self.gain.max(outcome.gain);
        self.residual = self.residual.max(outcome.energy_residual.max(outcome.momentum_residual));
        self.events = self.events.max(outcome.events);
    }

    fn cells(&self) -> [String; 8] {
        let missed: Vec<String> =
            self.missed.iter().map(|(miss, count)| format!("{count} {}", miss.name())).collect();
        [
            self.family.into(),
            self.n.to_string(),
            self.scenes.to_string(),
            if missed.is_empty() { "–".into() } else { missed.join(", ") },
            short(self.pace),
            short(self.overlap),
            short(self.gain),
            short(self.residual),
        ]
    }
}

const HEADS: [&str; 8] = ["family", "n", "scenes", "missed", "s per s", "overlap/r", "gain/mgr", "residual"];

/// For a terminal.
pub fn text(rows: &[Row]) -> String {
    let cells: Vec<[String; 8]> =
        std::iter::once(HEADS.map(String::from)).chain(rows.iter().map(Row::cells)).collect();
    let widths: [usize; 8] =
        std::array::from_fn(|column| cells.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let mut text = String::new();
    for row in cells {
        let padded: Vec<String> =
            row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        let _ = writeln!(text, "{}", padded.join("  ").trim_end());
    }
    text
}

/// For the documentation.
pub fn markdown(rows: &[Row]) -> String {
    let mut text = format!("| {} |\n|{}\n", HEADS.join(" | "), " --- |".repeat(HEADS.len()));
    for row in rows {
        let _ = writeln!(text, "| {} |", row.cells().join(" | "));
    }
    text
}

/// Two digits.
pub fn short(value: f64) -> String {
    match value {
        _ if value == 0.0 => "0".into(),
        _ if !value.is_finite() => "∞".into(),
        _ if (0.01..1000.0).contains(&value) => format!("{value:.2}"),
        _ => format!("{value:.0e}"),
    }
}
