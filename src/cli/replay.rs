//! `polyscene replay`: runs a recording again, and says where it parts from what was recorded.

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use super::limits::LimitArgs;
use super::output::LineSink;
use super::{CliError, input, number};
use crate::record::{Frame, InlineRunner, MOST_BYTES, RecordingFile, RunCommand, RunState, Runner as _};
use crate::sim::Fault;

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

    /// Write the events up to there, one JSON object per line; `-` is standard output
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,

    #[command(flatten)]
    limits: LimitArgs,
}

pub(super) fn replay(args: &ReplayArgs) -> Result<(), CliError> {
    let name = input::display_name(&args.file);
    let wrong = |error: crate::record::RecordingError| CliError::Usage(format!("{name}: {error}"));
    let file = RecordingFile::read(&read(&args.file)?).map_err(wrong)?;
    let document = file.document().map_err(wrong)?;
    let scene = RecordingFile::scene(&document).map_err(wrong)?;
    let commands = file.commands(&scene).map_err(wrong)?;
    let _watchdog = args.limits.watchdog();
    let mut runner = InlineRunner::limited(args.limits.limits());
    runner.send(RunCommand::Method(file.method().map_err(wrong)?));
    runner.send(RunCommand::Load(Arc::new(scene)));
    for command in commands {
        runner.send(command);
        stop_at_limit(&runner)?;
    }
    let end = runner.frame();
    refuse_other_end(&name, &file, &end)?;
    if args.verify {
        let count = verify(&mut runner, &file)?;
        super::say(format!("{name}: {count} states are the same, recorded by version {}", file.build));
    }
    let frame = go_to(&mut runner, args)?;
    super::say(format!(
        "{name}: {} at {} s, {} events, hash {:016x}",
        file.scene_name,
        frame.time,
        frame.event_count,
        runner.hash().unwrap_or_default()
    ));
    write_events(args, &frame)
}

fn read(path: &Path) -> Result<Vec<u8>, CliError> {
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

fn stop_at_limit(runner: &InlineRunner) -> Result<(), CliError> {
    match runner.exceeded() {
        Some(why) => Err(CliError::Unwritten { time: runner.frame().time, why }),
        None => Ok(()),
    }
}

/// The run has to come to the recorded end.
fn refuse_other_end(name: &str, file: &RecordingFile, end: &Frame) -> Result<(), CliError> {
    let (time, events) = (file.end.time, file.end.event);
    let fault = |message: String| Err(CliError::Fault(Fault { time: end.time, message, key: None }));
    match (&end.fault, end.state) {
        (_, RunState::Faulted) if end.time == time => Ok(()),
        (Some(message), _) => fault(format!("{name} cannot be run again: {message}")),
        (None, _) if (end.time, end.event_count) != (time, events) => fault(format!(
            "{name} came to t = {} s with {} events where {time} s and {events} were recorded",
            end.time, end.event_count
        )),
        (None, _) => Ok(()),
    }
}

/// Compares the states with those of the file; how many there are.
fn verify(runner: &mut InlineRunner, file: &RecordingFile) -> Result<usize, CliError> {
    let mut last = 0.0;
    for checkpoint in &file.checkpoints {
        runner.send(RunCommand::Show(checkpoint.at));
        stop_at_limit(runner)?;
        let hash = runner.hash().map(|hash| format!("{hash:016x}"));
        let frame = runner.frame();
        if hash.as_deref() != Some(checkpoint.hash.as_str()) || frame.fault.is_some() {
            let (event, time) = (checkpoint.at.event, checkpoint.at.time);
            let why = frame.fault.clone().unwrap_or_else(|| "the state is another one".to_owned());
            let message = format!(
                "the run parts from the recording after t = {last} s and before {time} s, event {event}: {why}"
            );
            return Err(CliError::Fault(Fault { time, message, key: None }));
        }
        last = checkpoint.at.time;
    }
    Ok(file.checkpoints.len())
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
    match (&frame.fault, frame.state) {
        (Some(message), RunState::Paused) => Err(CliError::Usage(message.clone())),
        _ => Ok(frame),
    }
}

/// The events up to what is shown, as `run --events` writes them.
fn write_events(args: &ReplayArgs, frame: &Frame) -> Result<(), CliError> {
    let Some(path) = &args.events else { return Ok(()) };
    let mut lines = LineSink::create(path)?;
    for row in frame.ledger.iter_from(0).take_while(|row| row.event.seq <= frame.event_count) {
        let event = &row.event;
        lines.row(&serde_json::json!({
            "seq": event.seq,
            "t": event.time,
            "kind": event.kind.name(),
            "a": &*row.a_label,
            "b": row.b_key.map(|_| &*row.b_label),
            "point": event.point.to_array(),
            "normal": event.normal.to_array(),
            "impulse": event.impulse,
            "vn_before": event.vn_before,
            "vn_after": event.vn_after,
            "group": event.group,
        }))?;
    }
    lines.flush()
}
