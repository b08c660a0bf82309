//! The command line: verbs that need no display. Knows neither the editor nor the window.

mod check;
mod edit;
mod error;
mod everyday;
mod export;
mod hard_cases;
mod import;
mod input;
mod interrupt;
mod limits;
mod marks;
mod method;
mod number;
mod output;
mod progress;
mod record;
#[cfg(feature = "render")]
mod render;
mod replay;
mod rows;
mod run;
mod samples;
mod schema;
mod study;
mod table;

use std::ffi::OsString;
use std::io::{ErrorKind, Write as _};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use self::error::escaped_lines;
use crate::scene::escaped;

pub use check::CheckArgs;
pub use edit::EditArgs;
pub use error::{CliError, say};
pub use everyday::EverydayArgs;
pub use export::ExportArgs;
pub use hard_cases::HardCasesArgs;
pub use import::ImportArgs;
pub use input::{Examined, examine};
pub use record::RecordArgs;
#[cfg(feature = "render")]
pub use render::RenderArgs;
pub use replay::ReplayArgs;
pub use run::RunArgs;
pub use schema::SchemaArgs;
pub use study::StudyArgs;

/// Design 3D rigid body scenes, step their simulation event by event, and see how accurate it is.
#[derive(Debug, Parser)]
#[command(
    name = "polyscene",
    version,
    args_conflicts_with_subcommands = true,
    subcommand_value_name = "VERB",
    subcommand_help_heading = "Verbs",
    disable_help_subcommand = true,
    after_help = "Without a verb the editor's window opens; a file named like a verb is given as ./run.\n\n\
                  Exit codes: 0 fine (warnings allowed), 1 the scene has errors or `export --strict` would lose something, 2 bad usage or an output that \
                  cannot be written, 3 the run stopped on a numerical fault or parts from its recording, 4 it stopped early at --max-events or \
                  --max-wall, 130 interrupted."
)]
struct Cli {
    #[command(subcommand)]
    verb: Option<Verb>,

    #[command(flatten)]
    edit: EditArgs,
}

/// The table of verbs: one line here and one in [`Verb::execute`].
#[derive(Debug, Subcommand)]
pub enum Verb {
    Run(RunArgs),
    Check(CheckArgs),
    Everyday(EverydayArgs),
    Export(ExportArgs),
    HardCases(HardCasesArgs),
    Import(ImportArgs),
    #[cfg(feature = "render")]
    Render(RenderArgs),
    /// A picture needs the feature `render`
    #[cfg(not(feature = "render"))]
    #[command(hide = true, disable_help_flag = true)]
    Render {
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
    Record(RecordArgs),
    Replay(ReplayArgs),
    Schema(SchemaArgs),
    Study(StudyArgs),
}

impl Verb {
    /// Does what was asked; the error says how it ended badly.
    pub fn execute(&self) -> Result<(), CliError> {
        match self {
            Self::Run(args) => run::run(args),
            Self::Check(args) => check::check(args),
            Self::Everyday(args) => everyday::everyday(args),
            Self::Export(args) => export::export(args),
            Self::HardCases(args) => hard_cases::hard_cases(args),
            Self::Import(args) => import::import(args),
            #[cfg(feature = "render")]
            Self::Render(args) => render::render(args),
            #[cfg(not(feature = "render"))]
            Self::Render { .. } => Err(CliError::no_pictures()),
            Self::Record(args) => record::record(args),
            Self::Replay(args) => replay::replay(args),
            Self::Schema(args) => schema::schema_of(args),
            Self::Study(args) => study::study(args),
        }
    }
}

/// What the command line asks for.
pub enum Request {
    /// Open the editor.
    Edit(EditArgs),
    Verb(Verb),
    /// Help, the version, or a complaint about the arguments.
    Help(clap::Error),
}

/// Reads the command line.
pub fn parse(arguments: impl IntoIterator<Item = OsString>) -> Request {
    match Cli::try_parse_from(arguments) {
        Ok(Cli { verb: Some(verb), .. }) => Request::Verb(verb),
        Ok(Cli { verb: None, edit }) => Request::Edit(edit),
        Err(error) => Request::Help(error),
    }
}

/// Prints help or a complaint where it belongs: exit code 0 for help, 2 for bad usage.
pub fn print_help(error: &clap::Error) -> ExitCode {
    let complaint = error.render().to_string();
    if error.use_stderr() && complaint.lines().any(|line| escaped(line) != line) {
        // Names from the command line, which may come from files, as text.
        let _ = std::io::stderr().write_all(escaped_lines(&complaint).as_bytes());
        return ExitCode::from(2);
    }
    let printed = error.print().and_then(|()| std::io::stdout().flush());
    match printed {
        _ if error.use_stderr() => ExitCode::from(2),
        // A closed pipe (`--help | head`) is no reason to complain.
        Err(failure) if failure.kind() != ErrorKind::BrokenPipe => {
            let complaint = CliError::unprintable("standard output", &failure);
            say(&complaint);
            ExitCode::from(complaint.exit_code())
        }
        _ => ExitCode::SUCCESS,
    }
}
