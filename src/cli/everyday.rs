//! `polyscene everyday`: runs scenes of everyday kinds in all sizes and says which meet the demands.

mod report;
mod scenes;
mod work;

use std::path::PathBuf;

use clap::Args;

use self::report::Report;
use super::marks::Marked;
use super::{CliError, number, output};
use crate::study::everyday::{Effort, FAMILIES, Outcome, Setup, markdown, misses, rows, text};

/// Run everyday scenes: balls dropped, poured, stacked and rolled, in all sizes
///
/// Each scene is one of a family (a crate, a wedge, a billiard table, …), a number of balls, a restitution and a
/// seed. It has to run as fast as it happens on one core, gain no energy, overlap nowhere, keep its balls inside and
/// its books straight. Exit code 1 when a scene misses a demand.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene everyday --n 2,5,10\n  polyscene everyday --family crate --e 0.3 --seed 1,2,3\n  \
                  polyscene everyday --family table --n 16 --e 0.9 --write scenes\n  \
                  polyscene everyday --markdown docs/accuracy.md"
)]
pub struct EverydayArgs {
    /// Only these families, separated by commas
    #[arg(long = "family", value_name = "LIST", value_delimiter = ',', value_parser = family_names())]
    families: Vec<String>,

    /// Numbers of balls, separated by commas
    #[arg(long = "n", value_name = "LIST", value_delimiter = ',', default_value = "2,5,10,20,50,100,300",
          allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    sizes: Vec<u32>,

    /// Restitutions of a pair from 0 to 1, separated by commas
    #[arg(long = "e", value_name = "LIST", value_delimiter = ',', default_value = "0,0.1,0.3,0.5,0.7,0.9,1",
          allow_negative_numbers = true, value_parser = restitution)]
    restitutions: Vec<f64>,

    /// Seeds of the places and sizes, separated by commas
    #[arg(
        long = "seed",
        value_name = "LIST",
        value_delimiter = ',',
        allow_negative_numbers = true,
        default_value = "1"
    )]
    seeds: Vec<u64>,

    /// Model time of every run, in seconds
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true, default_value = "5")]
    until: f64,

    /// Processor time that a run may take, in seconds; by default as long as it lasts, --until
    #[arg(long, value_name = "SECONDS", value_parser = number::seconds, allow_negative_numbers = true)]
    max_wall: Option<f64>,

    /// Scenes that run at the same time; times are most reliable at 1
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u8).range(1..))]
    jobs: u8,

    /// Write the scenes into this folder instead of running them
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["markdown", "json"])]
    write: Option<PathBuf>,

    /// Let --write replace files
    #[arg(long, requires = "write")]
    force: bool,

    /// Rewrite the table between its two marks in this Markdown file
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,

    /// Print one JSON object instead of text
    #[arg(long)]
    json: bool,
}

/// The marks between which the table stands.
const BEGIN: &str = "<!-- everyday scenes: begin -->";
const END: &str = "<!-- everyday scenes: end -->";

pub(super) fn everyday(args: &EverydayArgs) -> Result<(), CliError> {
    let setups = setups(args);
    if let Some(folder) = &args.write {
        return scenes::write_all(&setups, folder, args.force);
    }
    // Found out before hours of work rather than after.
    let marked = args.markdown.as_deref().map(|path| Marked::read(path, BEGIN, END)).transpose()?;
    let effort = Effort { until: args.until, most: args.max_wall.unwrap_or(args.until) };
    let judged = work::judge_all(&setups, effort, args.jobs);
    if args.json {
        Report::of(&judged, effort).print()?;
    } else {
        output::print(text(&rows(&judged)).as_bytes())?;
        output::print(report::failures(&judged, effort).as_bytes())?;
    }
    if let Some(marked) = &marked {
        marked.write(&markdown(&rows(&judged)))?;
    }
    verdict(&judged)
}

fn verdict(judged: &[(Setup, Outcome)]) -> Result<(), CliError> {
    match judged.iter().filter(|(_, outcome)| !misses(outcome).is_empty()).count() {
        0 => Ok(()),
        missed => Err(CliError::Scene(format!("{missed} of {} scenes miss a demand", judged.len()))),
    }
}

/// Every family, size, restitution and seed asked for, in this order.
fn setups(args: &EverydayArgs) -> Vec<Setup> {
    let chosen = |name: &str| args.families.is_empty() || args.families.iter().any(|family| family == name);
    let mut setups = Vec::new();
    for family in FAMILIES.iter().filter(|family| chosen(family.name)) {
        for &n in &args.sizes {
            for &e in &args.restitutions {
                setups.extend(args.seeds.iter().map(|&seed| Setup { family, n: n as usize, e, seed }));
            }
        }
    }
    setups
}

fn family_names() -> clap::builder::PossibleValuesParser {
    let names =
        FAMILIES.iter().map(|family| clap::builder::PossibleValue::new(family.name).help(family.about));
    clap::builder::PossibleValuesParser::new(names)
}

fn restitution(text: &str) -> Result<f64, String> {
    let value: Option<f64> = text.trim().parse().ok().filter(|value| (0.0..=1.0).contains(value));
    value.ok_or_else(|| "expected a number from 0 to 1".into())
}
