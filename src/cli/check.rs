//! `polyscene check`: every problem of scene files, one per line.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CliError, Examined, input, output};
use crate::design::{self, TroubleKind};
use crate::scene::{Diagnostic, Document, FileStamp, Severity, shown_path};
use crate::sim::Method;

/// Print every problem of scene files
///
/// One line each: `file:line:column: error|warning: text (element path); hint`. Besides the text this
/// covers what it means and the geometry at the start, such as bodies that overlap.
///
/// With --fix what can be put right is, and said: repeated UserIDs, overlaps, bodies outside the map, tiles that are
/// too fine or too coarse. The problems printed are then those that are left.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  polyscene check scenes/*.xml\n  polyscene check - < scene.xml\n  polyscene check --fix \
                  scene.xml -o fixed.xml"
)]
pub struct CheckArgs {
    /// Scene files; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Put right what can be, in the files themselves or in that of --output
    #[arg(long)]
    fix: bool,

    /// Where the one scene that --fix put right goes
    #[arg(long, short, value_name = "FILE", requires = "fix")]
    output: Option<PathBuf>,

    /// Replace the file of --output, should it exist
    #[arg(long, requires = "output")]
    force: bool,
}

pub(super) fn check(args: &CheckArgs) -> Result<(), CliError> {
    args.refuse_unclear_output()?;
    let (mut errors, mut warnings, mut unfixed) = (0, 0, 0);
    for file in &args.files {
        let before = FileStamp::of(file);
        let mut examined = input::open(file, Method::Exact)?;
        if args.fix {
            match fixed(file, &examined)? {
                Some(fixed) => {
                    write(args, file, &before, &examined.document, &fixed.document)?;
                    examined = fixed;
                }
                None => unfixed += 1,
            }
        }
        examined.problems.extend(troubles(&examined));
        // What is about no place sums up.
        examined.problems.sort_by_key(|problem| (problem.position.is_none(), problem.position));
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
    if unfixed > 0 {
        return Err(CliError::Scene(format!("{summary}; {} not fixed", counted(unfixed, "file"))));
    }
    if errors > 0 {
        return Err(CliError::Scene(summary));
    }
    super::say(summary);
    Ok(())
}

impl CheckArgs {
    fn refuse_unclear_output(&self) -> Result<(), CliError> {
        let refusal = match &self.output {
            Some(_) if self.files.len() > 1 => {
                "--output takes one scene; without it each file is put right itself"
            }
            Some(output) if output::is_stdout(output) => {
                "--output needs a file: standard output has the problems"
            }
            None if self.fix && self.files.iter().any(|file| output::is_stdout(file)) => {
                "--fix of standard input needs --output FILE"
            }
            _ => return self.refuse_bad_output(),
        };
        Err(CliError::Usage(refusal.into()))
    }

    fn refuse_bad_output(&self) -> Result<(), CliError> {
        match (&self.output, self.files.first()) {
            (Some(output), Some(file)) => {
                output::refuse_bad("--output", output, ("the scene", file), self.force)
            }
            _ => Ok(()),
        }
    }
}

/// The scene with all put right that can be; tells what was. None where that would make errors that were not there, as
/// enormous numbers do: told too, with the first of them.
fn fixed(file: &Path, examined: &Examined) -> Result<Option<Examined>, CliError> {
    let name = input::display_name(file);
    let fixed = design::repair_all(&examined.document)
        .map_err(|error| CliError::Usage(format!("cannot fix {name}: {error}")))?;
    let after = input::examine(fixed.document, Method::Exact);
    if after.error_count() > examined.error_count() {
        let error = after.problems.iter().find(|problem| problem.is_error());
        let error = error.map_or_else(String::new, |error| format!(": {}", error.message));
        super::say(format!(
            "{name}: the fix is not written, it would make {} that the scene does not have{error}; put the scene right \
             by hand",
            counted(after.error_count() - examined.error_count(), "error")
        ));
        return Ok(None);
    }
    for what in &fixed.done {
        super::say(format!("{name}: {what}"));
    }
    Ok(Some(after))
}

/// Writes the scene in one go. A file that nothing was changed in, or that another program wrote meanwhile, stays.
fn write(
    args: &CheckArgs,
    file: &Path,
    before: &FileStamp,
    document: &Document,
    fixed: &Document,
) -> Result<(), CliError> {
    let to = args.output.as_deref().unwrap_or(file);
    if args.output.is_none() && (fixed.scene().is_none() || fixed.to_bytes() == document.to_bytes()) {
        return Ok(());
    }
    if args.output.is_none() && FileStamp::of(file) != *before {
        return Err(CliError::Usage(format!(
            "{} was changed by another program meanwhile and stays as it is",
            shown_path(file)
        )));
    }
    fixed.save(to).map_err(|error| CliError::unwritable(to, &error))
}

/// What the compiler does not look at: tiles and masses.
fn troubles(examined: &Examined) -> Vec<Diagnostic> {
    let scene = examined.document.scene().filter(|_| !examined.document.has_errors());
    let found = scene.map(design::troubles).unwrap_or_default().into_iter();
    let found = found.filter(|trouble| matches!(trouble.kind, TroubleKind::Tiles | TroubleKind::Masses));
    let diagnostic = |trouble: design::Trouble| {
        let key = trouble.keys.first().copied();
        let (position, path) = key.map(|key| examined.document.place_of(key)).unwrap_or_default();
        let (severity, message, hint) = (Severity::Warning, trouble.message, trouble.hint);
        Diagnostic { severity, position, path, message, hint, key }
    };
    found.map(diagnostic).collect()
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
