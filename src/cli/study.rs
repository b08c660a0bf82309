//! `polyscene study`: speed against error of every method, as a table, CSV, SVG and JSON.

use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use super::limits::LimitArgs;
use super::output::{self, is_stdout};
use super::{CliError, input, interrupt, method, number};
use crate::scene::escaped;
use crate::sim::Method;
use crate::study::{
    self, AXES, Control, KNOBS, Stop, StudyError, StudyReport as Report, StudySettings as Settings,
};

/// Compare the speed and the errors of every method on a scene
///
/// Every method runs over every Δt (`exact` has no such axis: it runs over field tolerances where the scene
/// has fields) and is compared with an independent reference: another integrator, another root finder, all
/// pairs. Chaotic scenes are compared up to the horizon where the reference's own error estimate reaches
/// --trusted-error, and by invariants beyond. Ctrl-C ends a study and reports what is done so far; so does
/// --max-wall, while --max-events ends each run.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = long_help())]
pub struct StudyArgs {
    /// Scene file; `-` is standard input
    scene: PathBuf,

    /// Model time of every run, in seconds; at most 1e9
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true, default_value = "10")]
    until: f64,

    /// How to step, separated by commas
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = method::parser(), default_value = "exact,thesis,fixed")]
    methods: Vec<Method>,

    /// Δt of the methods that depend on it, in seconds, separated by commas
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = number::seconds, allow_negative_numbers = true, default_value = "1/15,1/30,1/60,1/120,1/240,1/480,1/960")]
    dt: Vec<f64>,

    /// Field tolerances of exact besides the scene's own, separated by commas
    #[arg(
        long,
        value_name = "LIST",
        value_delimiter = ',',
        allow_negative_numbers = true,
        default_value = "1e-3,1e-5,1e-7,1e-9,1e-11"
    )]
    tolerances: Vec<f64>,

    /// Steps of the groups of exact besides the scene's own, as parts of it: 1/2,1/4
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = number::part, allow_negative_numbers = true)]
    group_steps: Vec<f64>,

    /// Timings of each run; the median counts
    #[arg(long, value_name = "N", default_value_t = Settings::default().repeat)]
    repeat: u32,

    /// Samples of a run at which it is compared
    #[arg(long, value_name = "N", default_value_t = Settings::default().samples)]
    samples: u32,

    /// Error estimate of the reference at which comparing ends, in metres
    #[arg(long, value_name = "M", allow_negative_numbers = true, default_value_t = Settings::default().trusted_error)]
    trusted_error: f64,

    /// Position error up to which a run follows the reference, in metres
    #[arg(long, value_name = "M", allow_negative_numbers = true, default_value_t = Settings::default().agreement)]
    agreement: f64,

    /// How far apart in time, besides one Δt, the same event may come, in seconds
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true, default_value = "0.001")]
    event_window: f64,

    /// Longest wall time of the reference, in seconds
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true, default_value = "30")]
    reference_limit: f64,

    /// Longest wall time of one run, in seconds
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true, default_value = "20")]
    run_limit: f64,

    /// Write the figures as CSV to this file; `-` is standard output
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,

    /// Write the work-precision diagrams as SVG to this file; `-` is standard output
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,

    /// Let --csv and --svg replace files
    #[arg(long)]
    force: bool,

    /// Print the whole report as one JSON object to standard output
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    limits: LimitArgs,
}

pub(super) fn study(args: &StudyArgs) -> Result<(), CliError> {
    let settings = args.settings();
    settings.check().map_err(|error| CliError::Usage(format!("--{error}")))?;
    refuse_clashing_outputs(args)?;
    let watchdog = args.limits.watchdog();
    let name = input::display_name(&args.scene);
    let examined = input::open(&args.scene, Method::Exact)?;
    for line in examined.lines(&name) {
        super::say(line);
    }
    let (Some(scene), Some(_)) = (examined.document.scene(), &examined.simulation) else {
        let errors = examined.error_count();
        return Err(CliError::Scene(format!("{name} cannot be studied: {errors} error(s)")));
    };

    let bar = bar();
    let mut show = |progress: &study::StudyProgress| {
        bar.set_position((progress.part * PARTS) as u64);
        bar.set_message(progress.what.clone());
    };
    let interrupt = interrupt::on_interrupt();
    let mut control = Control::new(interrupt.flag(), &mut show).until(args.limits.wall());
    let outcome = study::run(scene, &title_of(&args.scene), &settings, &mut control);
    drop(watchdog);
    let is_interrupted = interrupt.is_raised();
    bar.finish_and_clear();
    let report = outcome.map_err(|error| match error {
        StudyError::Settings(error) => CliError::Usage(format!("--{error}")),
        StudyError::Scene(error) => CliError::Scene(error.to_string()),
    })?;
    write(args, &report)?;
    early_end(args, &report, is_interrupted)
}

/// How a study that was not carried out in full ends.
fn early_end(args: &StudyArgs, report: &Report, is_interrupted: bool) -> Result<(), CliError> {
    if report.cancelled && is_interrupted {
        return Err(CliError::Cancelled);
    }
    if let (true, Some(wall)) = (report.cancelled, args.limits.max_wall) {
        return Err(CliError::StudyStopped(format!(
            "it has taken {wall} s of wall time, the longest allowed"
        )));
    }
    let stopped = report.points.iter().filter(|point| point.stopped == Some(Stop::EventLimit)).count();
    match (stopped, args.limits.max_events) {
        (1.., Some(most)) => {
            let runs = if stopped == 1 { "1 run has".into() } else { format!("{stopped} runs have") };
            Err(CliError::StudyStopped(format!("{runs} had {most} events, the most allowed")))
        }
        _ => Ok(()),
    }
}

/// What to call the scene in the report: the file's name without its folder.
fn title_of(path: &Path) -> String {
    if is_stdout(path) {
        return "Standard input".into();
    }
    path.file_name().map_or(String::new(), |name| escaped(&name.to_string_lossy()))
}

/// The bar counts thousandths of the study.
const PARTS: f64 = 1000.0;

fn bar() -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}");
    ProgressBar::new(PARTS as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn write(args: &StudyArgs, report: &Report) -> Result<(), CliError> {
    if let Some(path) = &args.csv {
        output::write(path, study::csv(report).as_bytes())?;
    }
    if let Some(path) = &args.svg {
        let picture = study::svg(report).map_err(|error| CliError::Usage(error.to_string()))?;
        output::write(path, picture.as_bytes())?;
    }
    if args.json {
        let text = serde_json::to_string(report);
        let text = text.map_err(|error| CliError::unprintable("--json", &error.into()))?;
        output::print(format!("{text}\n").as_bytes())
    } else if args.outputs().any(|(_, path)| is_stdout(path)) {
        Ok(())
    } else {
        output::print(study::table(report).as_bytes())
    }
}

impl StudyArgs {
    fn settings(&self) -> Settings {
        Settings {
            until: self.until,
            methods: self.methods.clone(),
            dts: self.dt.clone(),
            tolerances: self.tolerances.clone(),
            group_steps: self.group_steps.clone(),
            repeat: self.repeat,
            samples: self.samples,
            trusted_error: self.trusted_error,
            agreement: self.agreement,
            event_window: self.event_window,
            reference_limit: self.reference_limit,
            run_limit: self.run_limit,
            max_events: self.limits.max_events,
        }
    }

    /// The output files with their options' names.
    fn outputs(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        [("--csv", &self.csv), ("--svg", &self.svg)]
            .into_iter()
            .filter_map(|(option, path)| Some((option, path.as_deref()?)))
    }
}

/// Two outputs in one place, or an output over the scene itself, would spoil both.
fn refuse_clashing_outputs(args: &StudyArgs) -> Result<(), CliError> {
    let json = args.json.then_some(("--json", Path::new("-")));
    let all: Vec<_> = json.into_iter().chain(args.outputs()).collect();
    output::refuse_shared(&all)?;
    args.outputs().try_for_each(|(option, path)| {
        output::refuse_bad(option, path, ("the scene", &args.scene), args.force)
    })
}

const EXAMPLES: &str = "Examples:\n  \
     polyscene study scene.xml\n  \
     polyscene study scene.xml --until 20 --svg diagrams.svg --csv figures.csv\n  \
     polyscene study scene.xml --methods exact,fixed --dt 1/60,1/240,1/1000 --repeat 9 --json";

fn long_help() -> String {
    let measures: String =
        AXES.iter().map(|axis| format!("  {:<14} {}\n", axis.column, axis.meaning)).collect();
    let knobs: String = KNOBS
        .iter()
        .map(|knob| {
            let unit = if knob.unit.is_empty() { String::new() } else { format!(" [{}]", knob.unit) };
            format!("  --{}{unit}\n      {}\n", knob.name, knob.reason)
        })
        .collect();
    format!("Columns of the table:\n{measures}\nWhy the defaults are what they are:\n{knobs}\n{EXAMPLES}")
}
