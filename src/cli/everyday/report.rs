//! The failures as text, and everything as JSON.

use std::fmt::Write as _;

use serde::Serialize;

use crate::cli::{CliError, output};
use crate::study::everyday::{Effort, Ending, Miss, Outcome, Setup, misses, short};

/// Each scene that misses a demand, with the command that runs it alone.
pub fn failures(judged: &[(Setup, Outcome)], effort: Effort) -> String {
    let mut text = String::new();
    for (setup, outcome) in judged {
        let missed: Vec<&str> = misses(outcome).into_iter().map(Miss::name).collect();
        if missed.is_empty() {
            continue;
        }
        let _ = writeln!(
            text,
            "{}: {}, overlap {} r, gain {} m g r, residuals {} and {}\n  {}",
            missed.join(", "),
            ending(outcome),
            short(outcome.overlap),
            short(outcome.gain),
            short(outcome.energy_residual),
            short(outcome.momentum_residual),
            command(setup, effort)
        );
    }
    text
}

fn ending(outcome: &Outcome) -> String {
    let (reached, cost) = (short(outcome.reached), short(outcome.cost));
    match &outcome.ending {
        Ending::Finished => format!("{reached} s in {cost} s"),
        Ending::Stalled => format!("at t = {reached} s after {cost} s and {} events", outcome.events),
        Ending::Faulted(fault) => format!("at t = {reached} s {fault}"),
        Ending::Refused(why) => why.clone(),
    }
}

fn command(setup: &Setup, effort: Effort) -> String {
    format!("polyscene everyday {setup} --until {} --max-wall {}", effort.until, effort.most)
}

/// The object that `--json` prints.
#[derive(Serialize)]
pub struct Report {
    /// Model time of every run, s.
    until: f64,
    /// Processor time that each may take, s.
    max_wall: f64,
    scenes: Vec<SceneReport>,
}

#[derive(Serialize)]
struct SceneReport {
    family: &'static str,
    n: usize,
    e: f64,
    seed: u64,
    /// Names of the demands that are not met.
    missed: Vec<&'static str>,
    ending: String,
    /// Model time, s.
    reached: f64,
    /// Processor time, s.
    cost: f64,
    /// Over the smallest radius.
    overlap: f64,
    /// In the mean body's m g r.
    gain: f64,
    /// Over the smallest radius; `null` without walls.
    escape: f64,
    energy_residual: f64,
    momentum_residual: f64,
    events: u64,
    command: String,
}

impl Report {
    pub fn of(judged: &[(Setup, Outcome)], effort: Effort) -> Self {
        let scenes = judged.iter().map(|(setup, outcome)| SceneReport {
            family: setup.family.name,
            n: setup.n,
            e: setup.e,
            seed: setup.seed,
            missed: misses(outcome).into_iter().map(Miss::name).collect(),
            ending: ending(outcome),
            reached: outcome.reached,
            cost: outcome.cost,
            overlap: outcome.overlap,
            gain: outcome.gain,
            escape: outcome.escape,
            energy_residual: outcome.energy_residual,
            momentum_residual: outcome.momentum_residual,
            events: outcome.events,
            command: command(setup, effort),
        });
        Self { until: effort.until, max_wall: effort.most, scenes: scenes.collect() }
    }

    pub fn print(&self) -> Result<(), CliError> {
        let mut line =
            serde_json::to_vec(self).map_err(|error| CliError::unprintable("--json", &error.into()))?;
        line.push(b'\n');
        output::print(&line)
    }
}
