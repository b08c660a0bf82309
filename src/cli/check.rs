//! `polyscene check`: every problem of scene files, one per line.

use std::path::PathBuf;

use clap::Args;

use super::{CliError, input, output};
use crate::sim::Method;

/// Print every problem of scene files
///
/// One line each: `file:line:column: error|warning: text (element path); hint`. Besides the text this
/// covers what it means and the geometry at the start, such as bodies that overlap.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  polyscene check scenes/*.xml\n  polyscene check - < scene.xml")]
pub struct CheckArgs {
    /// Scene files; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
}

pub(super) fn check(args: &CheckArgs) -> Result<(), CliError> {
    let (mut errors, mut warnings) = (0, 0);
    for file in &args.files {
        let examined = input::open(file, Method::Exact)?;
        for line in examined.lines(&input::display_name(file)) {
            output::print(format!("{line}\n").as_bytes())?;
        }
        errors += examined.error_count();
        warnings += examined.problems.len() - examined.error_count();
    }
    let summary = format!(
        "{}, {}, {}",
        counted(args.files.len(), "file"),
        counted(errors, "error"),
        counted(warnings, "warning")
    );
    if errors > 0 {
        return Err(CliError::Scene(summary));
    }
    super::say(summary);
    Ok(())
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
