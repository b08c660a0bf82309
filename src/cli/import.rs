//! `polyscene import`: a scene of another program, and what became of everything in it.

use std::path::PathBuf;

use clap::Args;

use super::output::{self, is_stdout};
use super::{CliError, input};
use crate::import::{self, Imported};
use crate::scene::Document;
use crate::sim::Method;

/// Read a scene of MuJoCo (MJCF) or Gazebo (SDF)
///
/// Spheres, planes, boxes that stand still, and gravity. Says on standard error what became of everything in the file,
/// with its line: kept, not needed here, approximated, dropped. What cannot be here, such as a joint, is an error.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene import robot-balls.xml -o scene.xml\n  polyscene import world.sdf --leave-out | \
                  polyscene check -"
)]
pub struct ImportArgs {
    /// File to read; `-` is standard input
    file: PathBuf,

    /// Scene file to write; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,

    /// Let --output replace a file other than the one read
    #[arg(long)]
    force: bool,

    /// Leave out what cannot be here, instead of ending with an error
    #[arg(long)]
    leave_out: bool,

    /// Write nothing and end with exit code 1 if something is approximated or dropped
    #[arg(long)]
    strict: bool,
}

pub(super) fn import(args: &ImportArgs) -> Result<(), CliError> {
    output::refuse_bad("--output", &args.output, ("the file read,", &args.file), args.force)?;
    let name = input::display_name(&args.file);
    let document = input::read(&args.file)?;
    let imported = import::import(&document, args.leave_out);
    let Imported { document, report, problems, .. } = &imported;
    for line in &report.lines {
        let separator = if line.position.is_some() { ":" } else { ": " };
        super::say(format!("{name}{separator}{line}"));
    }
    for problem in problems {
        super::say(input::problem_line(&name, problem));
    }
    let Some(document) = document else {
        return Err(CliError::Scene(format!("{name} cannot be imported: {} error(s)", problems.len())));
    };
    refuse_unusable(&name, &imported, document)?;
    let losses = report.losses().count();
    if args.strict && losses > 0 {
        return Err(CliError::Scene(format!(
            "--strict: {name} was not imported, it would lose {losses} kinds of things"
        )));
    }
    if is_stdout(&args.output) {
        return output::print(&document.to_bytes());
    }
    document.save(&args.output).map_err(|error| CliError::unwritable(&args.output, &error))
}

/// A scene that `check` finds errors in is of no use to anybody.
fn refuse_unusable(name: &str, imported: &Imported, document: &Document) -> Result<(), CliError> {
    let examined = input::examine(document.clone(), Method::Exact);
    for problem in examined.problems.iter().filter(|problem| problem.is_error()) {
        super::say(input::problem_line(name, &imported.in_the_file(problem.clone())));
    }
    match examined.error_count() {
        0 => Ok(()),
        count => Err(CliError::Scene(format!(
            "{name} was not imported: the scene that comes of it has {count} error(s), so that it could not be run"
        ))),
    }
}
