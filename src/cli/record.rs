//! `polyscene record`: a run as a file that makes the same run again.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;

use super::limits::LimitArgs;
use super::{CliError, input, method, number, output};
use crate::record::{InlineRunner, RunCommand, RunState, Runner as _};
use crate::sim::{Fault, Method};

/// Run a scene and write what makes the same run again
///
/// The file has the scene's bytes, how it was stepped, and hashes of the state along the way. `polyscene replay` runs it
/// again, on any machine, and says where the runs part if they do: the best report of a fault.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene record scene.xml --until 10 -o run.psrec\n  polyscene replay run.psrec --verify"
)]
pub struct RecordArgs {
    /// Scene file; `-` is standard input
    scene: PathBuf,

    /// How long to run, in seconds of model time
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true)]
    until: f64,

    /// Δt in seconds; fractions such as 1/60 are fine. In `exact` it says only where states are kept
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true, default_value = "1/60")]
    dt: f64,

    /// How to step
    #[arg(long, default_value = Method::Exact.name(), value_parser = method::parser())]
    method: Method,

    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE.psrec")]
    output: PathBuf,

    /// Let --output replace a file other than the scene
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    limits: LimitArgs,
}

pub(super) fn record(args: &RecordArgs) -> Result<(), CliError> {
    output::refuse_bad("--output", &args.output, ("the scene", &args.scene), args.force)?;
    let name = input::display_name(&args.scene);
    let examined = input::open(&args.scene, args.method)?;
    for line in examined.lines(&name) {
        super::say(line);
    }
    let scene = examined.document.scene().filter(|_| examined.error_count() == 0);
    let scene = scene.ok_or_else(|| CliError::Scene(format!("{name} cannot be run: it has errors")))?;
    let _watchdog = args.limits.watchdog();
    let mut runner = InlineRunner::limited(args.limits.limits());
    runner.send(RunCommand::Method(args.method));
    runner.send(RunCommand::Load(Arc::new(scene.clone())));
    runner.send(RunCommand::Seek { dt: args.dt, time: args.until });
    let frame = runner.frame();
    let file_name =
        args.scene.file_name().map_or_else(|| name.clone(), |file| file.to_string_lossy().into_owned());
    let file = runner.recording(&file_name, &examined.document.to_bytes());
    let file = file.ok_or_else(|| CliError::Scene(format!("{name} cannot be run")))?;
    let bytes = file.to_bytes().map_err(|error| CliError::Usage(error.to_string()))?;
    output::write(&args.output, &bytes)?;
    super::say(format!(
        "{name}: {} s, {} events, {} states to compare, hash {:016x}",
        frame.time,
        frame.event_count,
        file.checkpoints.len(),
        runner.hash().unwrap_or_default()
    ));
    match (runner.exceeded(), frame.state, &frame.fault) {
        (Some(why), ..) => Err(CliError::Stopped { time: frame.time, why }),
        (None, RunState::Faulted, Some(message)) => {
            Err(CliError::Fault(Fault { time: frame.time, message: message.to_string(), key: None }))
        }
        _ => Ok(()),
    }
}
