//! Chooses between the editor's window and the verbs, and turns what happened into an exit code.

use std::path::PathBuf;
use std::process::ExitCode;

use polyscene::cli::{self, CliError, Request};

fn main() -> ExitCode {
    let outcome = match cli::parse(std::env::args_os()) {
        Request::Help(error) => return cli::print_help(&error),
        Request::Edit(scene) => open_editor(scene),
        Request::Verb(verb) => verb.execute(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cli::say(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

#[cfg(feature = "gui")]
fn open_editor(_scene: Option<PathBuf>) -> Result<(), CliError> {
    Err(CliError::no_window("the window is not there yet"))
}

#[cfg(not(feature = "gui"))]
fn open_editor(_scene: Option<PathBuf>) -> Result<(), CliError> {
    Err(CliError::no_window("this program was built without its window (the feature `gui`)"))
}
