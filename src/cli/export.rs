//! `polyscene export`: a scene for another program, and what that program cannot be told.

use std::io::IsTerminal as _;
use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};

use super::limits::LimitArgs;
use super::output::{self, is_stdout};
use super::{CliError, input, interrupt, number, replay};
use crate::export::{ExportError, Exported, FORMATS, Format, Frames, Report, When};
use crate::record::{RecordingFile, Rerun, RerunError, RunCommand, Runner as _, Watch};
use crate::scene::Document;
use crate::sim::Method;

/// Write a scene for another program
///
/// Says on standard error what became of everything in the scene: kept, not needed there, approximated, dropped.
/// Nothing is lost silently. Coordinates become z up where that is the custom (MuJoCo, Gazebo), gravity with them.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene export scene.xml --to mjcf -o scene.mjcf.xml\n  polyscene export scene.xml --to \
                  csv | head\n  polyscene export scene.xml --to gltf --until 5 -o motion.glb\n  polyscene export scene.xml --to sdf --at 2.5 -o later.sdf\n  polyscene export scene.xml --to polyphysics-1.0 --strict -o old.xml\n  polyscene export run.psrec --to gltf --from 2 --until 4 --fps 24 -o motion.glb"
)]
pub struct ExportArgs {
    /// Scene file, or a recording (.psrec), of which the motion is exported; `-` is a scene from standard input
    scene: PathBuf,

    /// The format
    #[arg(long, value_name = "FORMAT", value_parser = formats())]
    to: String,

    /// Export the state at this time instead of the start, in seconds
    #[arg(long, value_name = "S", value_parser = number::any_seconds, allow_negative_numbers = true,
          conflicts_with_all = ["from", "until", "fps"])]
    at: Option<f64>,

    /// Export the motion up to this time, in seconds: an animation for gltf and usd, rows for csv
    #[arg(long, value_name = "S", value_parser = number::seconds, allow_negative_numbers = true)]
    until: Option<f64>,

    /// When the motion begins, in seconds; 0 unless given
    #[arg(long, value_name = "S", value_parser = number::any_seconds, allow_negative_numbers = true)]
    from: Option<f64>,

    /// Frames of the motion per second; 60 unless given
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    fps: Option<f64>,

    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,

    /// Let --output replace a file other than the scene
    #[arg(long)]
    force: bool,

    /// Write nothing and end with exit code 1 if something is approximated or dropped
    #[arg(long)]
    strict: bool,

    #[command(flatten)]
    limits: LimitArgs,
}

/// Frames per second of a motion, as screens have.
const USUAL_FPS: f64 = 60.0;

fn formats() -> PossibleValuesParser {
    let value = |format: &Format| {
        PossibleValue::new(format.id)
            .help(format!("{} (.{}): {}", format.name, format.extension, format.holds))
    };
    PossibleValuesParser::new(FORMATS.iter().map(value))
}

pub(super) fn export(args: &ExportArgs) -> Result<(), CliError> {
    let format = FORMATS.iter().find(|format| format.id == args.to);
    let format = format.ok_or_else(|| CliError::Usage(format!("there is no format {}", args.to)))?;
    output::refuse_bad("--output", &args.output, ("the scene", &args.scene), args.force)?;
    refuse_terminal(args, format)?;
    if args.is_recording() {
        return finish(args, format, exported_recording(args, format)?);
    }
    let name = input::display_name(&args.scene);
    let when = args.when()?;
    let watchdog = args.limits.watchdog();
    let examined = input::open(&args.scene, Method::Exact)?;
    for line in examined.lines(&name) {
        super::say(line);
    }
    if examined.error_count() > 0 {
        return Err(CliError::Scene(format!("{name} cannot be exported: it has errors")));
    }
    let exported = exported(args, format, &examined.document, when)?;
    drop(watchdog);
    finish(args, format, exported)
}

/// Says what became of everything, and writes the file.
fn finish(args: &ExportArgs, format: &Format, exported: Exported) -> Result<(), CliError> {
    let Exported { bytes, report } = exported;
    for line in &report.lines {
        super::say(line);
    }
    if args.strict {
        refuse_losses(&input::display_name(&args.scene), format, &report)?;
    }
    output::write(&args.output, &bytes)
}

/// Makes the run of a recording again, with its edits, and writes how its bodies moved.
fn exported_recording(args: &ExportArgs, format: &Format) -> Result<Exported, CliError> {
    let name = input::display_name(&args.scene);
    if args.at.is_some() {
        let message =
            format!("{name} is a recording, of which the motion is exported: give --from and --until");
        return Err(CliError::Usage(message));
    }
    let interrupt = interrupt::on_interrupt();
    let _watchdog = args.limits.watchdog();
    let of = |error: RerunError| replay::stopped(&name, error);
    let file = RecordingFile::read(&replay::read(&args.scene)?).map_err(|error| of(error.into()))?;
    let document = file.document().map_err(|error| of(error.into()))?;
    let go_on = &mut |_: f64| !interrupt.is_raised();
    let mut rerun = Rerun::of(file, args.limits.limits(), go_on).map_err(of)?;
    let runner = rerun.runner();
    runner.send(RunCommand::ShareMotion(true));
    let motion = runner.frame().motion.clone();
    let motion = motion.ok_or_else(|| CliError::Usage(format!("{name} holds no motion")))?;
    let (from, to) = motion.span();
    let fps = args.fps.unwrap_or(USUAL_FPS);
    let frames = Frames { from: args.from.unwrap_or(from), to: args.until.unwrap_or(to), fps };
    if let Some(refusal) = frames.refusal() {
        return Err(CliError::Usage(refusal));
    }
    let exported = format.export_recorded(&document, &motion, frames, go_on);
    exported.map_err(|error| refused(args, &error))
}

impl ExportArgs {
    fn is_recording(&self) -> bool {
        self.scene.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("psrec"))
    }

    fn when(&self) -> Result<When, CliError> {
        if let Some(time) = self.at {
            return if time < 0.0 {
                Err(CliError::Usage("--at must not be before 0 s".into()))
            } else {
                Ok(When::At(time))
            };
        }
        let Some(to) = self.until else {
            return match (self.from, self.fps) {
                (None, None) => Ok(When::Start),
                _ => Err(CliError::Usage("a motion has an end: --from and --fps need --until".into())),
            };
        };
        let frames = Frames { from: self.from.unwrap_or(0.0), to, fps: self.fps.unwrap_or(USUAL_FPS) };
        match frames.refusal() {
            Some(refusal) => Err(CliError::Usage(refusal)),
            None => Ok(When::Motion(frames)),
        }
    }
}

/// Writes the scene, after simulating it where that is asked for.
fn exported(
    args: &ExportArgs,
    format: &Format,
    document: &Document,
    when: When,
) -> Result<Exported, CliError> {
    let interrupt = interrupt::on_interrupt();
    let watch = Watch::start(args.limits.limits());
    let mut over = None;
    let mut go_on = |_part: f64, events: u64| {
        over = watch.exceeded(events);
        over.is_none() && !interrupt.is_raised()
    };
    let exported = format.export_when(document, when, &mut go_on);
    exported.map_err(|error| match (error, over) {
        (ExportError::Cancelled { time }, Some(why)) => CliError::Unwritten { time, why },
        (error, _) => refused(args, &error),
    })
}

/// What stood in the way.
fn refused(args: &ExportArgs, error: &ExportError) -> CliError {
    match error {
        ExportError::Cancelled { time } => CliError::Abandoned { time: *time },
        ExportError::NoMotion(_) => {
            let able: Vec<_> = FORMATS.iter().filter(|format| format.moves).map(|format| format.id).collect();
            CliError::Usage(format!("--until: {error}; {} can hold it", able.join(", ")))
        }
        _ => CliError::Usage(format!("{} cannot be exported: {error}", input::display_name(&args.scene))),
    }
}

/// A binary file is not for a terminal.
fn refuse_terminal(args: &ExportArgs, format: &Format) -> Result<(), CliError> {
    if is_stdout(&args.output) && format.is_binary && std::io::stdout().is_terminal() {
        let message = "a terminal cannot show a binary file; give --output a file or a pipe";
        return Err(CliError::Usage(message.into()));
    }
    Ok(())
}

fn refuse_losses(name: &str, format: &Format, report: &Report) -> Result<(), CliError> {
    match report.losses().count() {
        0 => Ok(()),
        losses => Err(CliError::Scene(format!(
            "--strict: {name} was not written, {} would lose {losses} of {} kinds of things",
            format.name,
            report.lines.len()
        ))),
    }
}
