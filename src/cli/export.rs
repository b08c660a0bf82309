//! `polyscene export`: a scene for another program, and what that program cannot be told.

use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};

use super::output::{self, is_stdout};
use super::{CliError, input};
use crate::export::{Exported, FORMATS, Format, Report};
use crate::scene::{check_writable, shown_path, write_atomically};
use crate::sim::Method;

/// Write a scene for another program
///
/// Says on standard error what became of everything in the scene: kept, not needed there, approximated, dropped.
/// Nothing is lost silently. Coordinates become z up where that is the custom (MuJoCo, Gazebo), gravity with them.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene export scene.xml --to mjcf -o scene.mjcf.xml\n  polyscene export scene.xml --to \
                  csv | head\n  polyscene export scene.xml --to polyphysics-1.0 --strict -o old.xml"
)]
pub struct ExportArgs {
    /// Scene file; `-` is standard input
    scene: PathBuf,

    /// The format
    #[arg(long, value_name = "FORMAT", value_parser = formats())]
    to: String,

    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,

    /// Let --output replace a file other than the scene
    #[arg(long)]
    force: bool,

    /// Write nothing and end with exit code 1 if something is approximated or dropped
    #[arg(long)]
    strict: bool,
}

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
    refuse_bad_output(args, format)?;
    let name = input::display_name(&args.scene);
    let examined = input::open(&args.scene, Method::Exact)?;
    for line in examined.lines(&name) {
        super::say(line);
    }
    if examined.error_count() > 0 {
        return Err(CliError::Scene(format!("{name} cannot be exported: it has errors")));
    }
    let exported = format.export(&examined.document);
    let Exported { bytes, report } =
        exported.map_err(|error| CliError::Usage(format!("{name} cannot be exported: {error}")))?;
    for line in &report.lines {
        super::say(line);
    }
    if args.strict {
        refuse_losses(&name, format, &report)?;
    }
    write(&args.output, &bytes)
}

/// Before the work: a place that must not or cannot be written.
fn refuse_bad_output(args: &ExportArgs, format: &Format) -> Result<(), CliError> {
    let output = &args.output;
    if output::overwrites(output, &args.scene) {
        let message = format!("--output would overwrite the scene {}", shown_path(output));
        return Err(CliError::Usage(message));
    }
    if !args.force && output::holds_something(output) {
        let name = shown_path(output);
        return Err(CliError::Usage(format!(
            "--output would overwrite {name}: give another name, or --force"
        )));
    }
    if !is_stdout(output) {
        return check_writable(output).map_err(|error| CliError::unwritable(output, &error));
    }
    if format.is_binary && std::io::stdout().is_terminal() {
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

fn write(output: &Path, bytes: &[u8]) -> Result<(), CliError> {
    if is_stdout(output) {
        return output::print(bytes);
    }
    write_atomically(output, bytes).map_err(|error| CliError::unwritable(output, &error))
}
