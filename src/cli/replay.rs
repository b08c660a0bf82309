//! `polyscene replay`: runs a recording again, and says where it parts from what was recorded.

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use super::limits::LimitArgs;
use super::table::{Happened, RowArgs, Wanted};
use super::{CliError, input, number, output};
use crate::record::{
    Compared, Frame, InlineRunner, MOST_BYTES, RecordingFile, Rerun, RerunError, RunCommand, RunState,
    Runner as _,
};
use crate::sim::{Fault, SimEdit};

/// Run a recording again
///
/// Makes the same run, with its edits, and with --verify compares the state with that recorded at every place of the file:
/// the first that differs is reported, with exit code 3.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene replay run.psrec --verify\n  polyscene replay run.psrec --to-event 12\n  polyscene \
                  replay run.psrec --events - | head"
)]
pub struct ReplayArgs {
    /// Recording; `-` is standard input
    file: PathBuf,

    /// Compare with the states in the file
    #[arg(long)]
    verify: bool,

    /// Stop right after the event of this number
    #[arg(long, value_name = "N", conflicts_with = "to", value_parser = clap::value_parser!(u64).range(1..))]
    to_event: Option<u64>,

    /// Stop at this time in seconds
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true)]
    to: Option<f64>,

    /// Write the events up to there as `run --events` does, as JSON Lines or CSV; `-` is standard output
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,

    /// Let --events replace a file
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    rows: RowArgs,

    #[command(flatten)]
    limits: LimitArgs,
}

pub(super) fn replay(args: &ReplayArgs) -> Result<(), CliError> {
    let name = input::display_name(&args.file);
    if let Some(events) = &args.events {
        output::refuse_bad("--events", events, ("the recording", &args.file), args.force)?;
    }
    args.rows.check(None, args.events.as_deref(), "--events FILE")?;
    let of = |error: RerunError| stopped(&name, error);
    let file = RecordingFile::read(&read(&args.file)?).map_err(|error| of(error.into()))?;
    let wanted = wanted(args, &file)?;
    let _watchdog = args.limits.watchdog();
    let mut rerun = Rerun::of(file, args.limits.limits(), &mut |_| true).map_err(of)?;
    if args.verify {
        let compared = rerun.verify(&mut |_| true).map_err(of)?;
        say_compared(&name, compared, &rerun.file().build);
    }
    let scene_name = rerun.file().scene_name.clone();
    let runner = rerun.runner();
    let frame = go_to(runner, args)?;
    super::say(format!(
        "{name}: {scene_name} at {} s, {} events, hash {:016x}",
        frame.time,
        frame.event_count,
        runner.hash().unwrap_or_default()
    ));
    write_events(args, rerun.file(), &frame, &wanted)
}

/// The rows that are wanted, with the names of all bodies that are or come into the run.
fn wanted(args: &ReplayArgs, file: &RecordingFile) -> Result<Wanted, CliError> {
    let scene = file.document().and_then(|document| RecordingFile::scene(&document));
    let scene = scene.map_err(|error| stopped(&input::display_name(&args.file), error.into()))?;
    let mut wanted = args.rows.wanted(&scene)?;
    wanted.name(file.edits.iter().flat_map(|edits| &edits.edits).filter_map(|edit| match edit {
        SimEdit::AddBody(body) => Some(&**body),
        _ => None,
    }));
    Ok(wanted)
}

fn say_compared(name: &str, compared: Compared, build: &str) {
    let Compared { same, left_out } = compared;
    super::say(format!("{name}: {same} states are the same, recorded by version {build}"));
    if left_out > 0 {
        super::say(format!(
            "{name}: {left_out} states before them were too early to be kept, and were not compared"
        ));
    }
}

/// Why the run did not come to its end, or is another one.
pub(super) fn stopped(name: &str, error: RerunError) -> CliError {
    match error {
        RerunError::Exceeded { time, why } => CliError::Unwritten { time, why },
        RerunError::Parted { time, message } => {
            CliError::Fault(Fault { time, message: format!("{name}: {message}"), key: None })
        }
        RerunError::Cancelled { time } => CliError::Abandoned { time },
        RerunError::Recording(_) => CliError::Usage(format!("{name}: {error}")),
    }
}

pub(super) fn read(path: &Path) -> Result<Vec<u8>, CliError> {
    let mut bytes = Vec::new();
    let unreadable = |error: std::io::Error| {
        CliError::Usage(format!("cannot read {}: {error}", input::display_name(path)))
    };
    if path.as_os_str() == "-" {
        std::io::stdin().lock().take(MOST_BYTES).read_to_end(&mut bytes).map_err(unreadable)?;
    } else {
        std::fs::File::open(path)
            .map_err(unreadable)?
            .take(MOST_BYTES)
            .read_to_end(&mut bytes)
            .map_err(unreadable)?;
    }
    Ok(bytes)
}

/// To where the command line says, else to the end.
fn go_to(runner: &mut InlineRunner, args: &ReplayArgs) -> Result<Arc<Frame>, CliError> {
    let end = runner.frame().recorded.to;
    match (args.to_event, args.to) {
        (Some(event), _) => runner.send(RunCommand::GoTo { event }),
        (None, Some(time)) if time > end => {
            return Err(CliError::Usage(format!("the recording ends at {end} s, before --to {time}")));
        }
        (None, time) => runner.send(RunCommand::Seek { dt: 1.0, time: time.unwrap_or(end) }),
    };
    let frame = runner.frame();
    match (frame.complaint(), frame.state) {
        (Some(message), RunState::Paused) => Err(CliError::Usage(message.to_owned())),
        _ => Ok(frame),
    }
}

/// The events up to what is shown, as `run --events` writes them.
fn write_events(
    args: &ReplayArgs,
    file: &RecordingFile,
    frame: &Frame,
    wanted: &Wanted,
) -> Result<(), CliError> {
    let Some(path) = &args.events else { return Ok(()) };
    let mut table = args.rows.events(path)?;
    for row in frame.ledger.iter_from(0).take_while(|row| row.event.seq <= frame.event_count) {
        let event = &row.event;
        let happened = Happened {
            event,
            a: &row.a_label,
            b: row.b_key.map(|_| &*row.b_label),
            dt_index: file.step_of(event.time),
            cost: frame.ledger.cost(event.seq).unwrap_or_default(),
        };
        table.event(&happened, wanted)?;
    }
    table.sink.flush()
}
