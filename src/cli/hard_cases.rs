//! `polyscene hard-cases`: measures the figures of the hard cases and says which are within their limits.

use std::io::IsTerminal as _;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use super::marks::Marked;
use super::{CliError, output};
use crate::study::cases::{CASES, Case, CaseResult as Outcome, Figure, STEPS, markdown, measure, text};

/// Measure the hard cases: scenes with known outcomes at which methods fail
///
/// Each case is run by the method exact in steps of 1 s, 1/60 s and 0.1 ms, and compared with closed forms and
/// invariants. A figure above its limit is marked, and the exit code is 1.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene hard-cases --quick\n  polyscene hard-cases --case 5 --case kepler\n  \
                        polyscene hard-cases --markdown docs/accuracy.md"
)]
pub struct HardCasesArgs {
    /// Only this case: its number or its name; may be repeated
    #[arg(long = "case", value_name = "CASE")]
    cases: Vec<String>,

    /// Leave out the large gases, which take minutes
    #[arg(long)]
    quick: bool,

    /// Rewrite the table between its two marks in this Markdown file
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,

    /// Print one JSON object instead of text
    #[arg(long)]
    json: bool,
}

/// The marks between which the table stands.
const BEGIN: &str = "<!-- hard cases: begin -->";
const END: &str = "<!-- hard cases: end -->";

pub(super) fn hard_cases(args: &HardCasesArgs) -> Result<(), CliError> {
    let chosen = chosen(args)?;
    // Found out before minutes of work rather than after.
    let marked = args.markdown.as_deref().map(|path| Marked::read(path, BEGIN, END)).transpose()?;
    let started = Instant::now();
    let bar = bar(chosen.len() * STEPS.len());
    let mut measured = Vec::new();
    for case in chosen {
        let mut outcomes = Vec::new();
        for (dt, name) in STEPS {
            bar.set_message(format!("{}, Δt {name}", case.title));
            outcomes.push(measure(case, dt));
            bar.inc(1);
        }
        if !args.json {
            bar.suspend(|| output::print(text(case, &outcomes).as_bytes()))?;
        }
        measured.push((case, outcomes));
    }
    bar.finish_and_clear();
    if args.json {
        let mut line = serde_json::to_vec(&Report::of(&measured)).map_err(|error| failed(&error.into()))?;
        line.push(b'\n');
        output::print(&line)?;
    } else {
        // Beside the figures, which are the same every time.
        super::say(closing(&measured, started.elapsed()));
    }
    if let Some(marked) = &marked {
        marked.write(&markdown(&measured))?;
    }
    let missed = |(case, outcomes): &(&Case, Vec<Outcome>)| {
        figures(case, outcomes).iter().filter(|figure| !figure.held).count()
    };
    match measured.iter().map(missed).sum::<usize>() {
        0 => Ok(()),
        1 => Err(CliError::Scene("1 figure is out of its limit".into())),
        count => Err(CliError::Scene(format!("{count} figures are out of their limits"))),
    }
}

/// How many cases there were, and in how many all figures held.
fn closing(measured: &[(&'static Case, Vec<Outcome>)], elapsed: Duration) -> String {
    let holds = |(case, outcomes): &&(&'static Case, Vec<Outcome>)| {
        figures(case, outcomes).iter().all(|figure| figure.held)
    };
    let (count, held) = (measured.len(), measured.iter().filter(holds).count());
    let cases = if count == 1 { "case" } else { "cases" };
    format!("{count} {cases}, {held} held, {:.1} s", elapsed.as_secs_f64())
}

fn chosen(args: &HardCasesArgs) -> Result<Vec<&'static Case>, CliError> {
    for name in &args.cases {
        if !CASES.iter().any(|case| is_called(case, name)) {
            let known: Vec<&str> = CASES.iter().map(|case| case.id).collect();
            let known = known.join(", ");
            return Err(CliError::Usage(format!("--case: there is no case `{name}`; there are {known}")));
        }
    }
    let wanted = |case: &&Case| {
        (args.cases.is_empty() || args.cases.iter().any(|name| is_called(case, name)))
            && !(args.quick && case.long)
    };
    Ok(CASES.iter().copied().filter(wanted).collect())
}

fn is_called(case: &Case, name: &str) -> bool {
    case.id == name || case.number.to_string() == name
}

fn bar(length: usize) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:24} {pos}/{len}  {msg}");
    ProgressBar::new(length as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn failed(error: &std::io::Error) -> CliError {
    CliError::unprintable("standard output", error)
}

#[derive(Serialize)]
struct Report {
    /// s.
    dt: Vec<f64>,
    cases: Vec<CaseReport>,
}

#[derive(Serialize)]
struct CaseReport {
    number: u32,
    id: &'static str,
    title: &'static str,
    reference: &'static str,
    figures: Vec<FigureReport>,
    /// Why the run at each Δt ended early; `null` where it did not.
    stopped: Vec<Option<String>>,
}

#[derive(Serialize)]
struct FigureReport {
    name: &'static str,
    unit: &'static str,
    /// `null` where nothing is demanded.
    limit: Option<f64>,
    /// At each Δt; `null` where the run did not get so far.
    values: Vec<f64>,
    held: bool,
}

impl Report {
    fn of(measured: &[(&'static Case, Vec<Outcome>)]) -> Self {
        let cases = measured.iter().map(|(case, outcomes)| CaseReport {
            number: case.number,
            id: case.id,
            title: case.title,
            reference: case.reference,
            figures: figures(case, outcomes),
            stopped: outcomes.iter().map(|outcome| outcome.stopped.clone()).collect(),
        });
        Self { dt: STEPS.iter().map(|(dt, _)| *dt).collect(), cases: cases.collect() }
    }
}

fn figures(case: &Case, outcomes: &[Outcome]) -> Vec<FigureReport> {
    let all = case.demands.iter().enumerate().map(|(index, demand)| {
        let measured: Vec<&Figure> =
            outcomes.iter().filter_map(|outcome| outcome.figures.get(index)).collect();
        FigureReport {
            name: demand.name,
            unit: demand.unit,
            limit: demand.limit.is_finite().then_some(demand.limit),
            values: measured.iter().map(|figure| figure.value).collect(),
            held: measured.iter().all(|figure| figure.held()),
        }
    });
    all.collect()
}
