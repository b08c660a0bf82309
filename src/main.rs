//! Chooses between the editor's window and the verbs, and turns what happened into an exit code.

use std::process::ExitCode;

use polyscene::cli::{self, CliError, EditArgs, Request};

fn main() -> ExitCode {
    let outcome = match cli::parse(std::env::args_os()) {
        Request::Help(error) => return cli::print_help(&error),
        Request::Edit(args) => open_editor(args),
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
fn open_editor(args: EditArgs) -> Result<(), CliError> {
    use polyscene::gui::{self, GuiError};

    let EditArgs { scene, window_size, screenshot, steps, bench_orbit, bench_edit, bench_play } = args;
    let options = gui::Options { scene, window_size, screenshot, steps, bench_orbit, bench_edit, bench_play };
    let report = gui::run(options).map_err(|error| match error {
        GuiError::NoWindow(reason) => CliError::no_window(reason),
        GuiError::Script(why) => CliError::Usage(why),
        GuiError::Scene(why) => CliError::Scene(why),
    })?;
    if bench_orbit.is_some() || bench_edit.is_some() || bench_play.is_some() {
        cli::say(report);
    }
    Ok(())
}

#[cfg(not(feature = "gui"))]
fn open_editor(_args: EditArgs) -> Result<(), CliError> {
    Err(CliError::no_window("this program was built without its window (the feature `gui`)"))
}
