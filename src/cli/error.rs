//! How a verb can end badly, and the exit code of each way.

use std::fmt::Display;
use std::io::{ErrorKind, Write as _};
use std::path::{MAIN_SEPARATOR, Path};

use crate::record::Exceeded;
use crate::scene::{escaped, shown_path};
use crate::sim::{Fault, Simulation};

/// Why a verb did not end well.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The problems themselves were printed already.
    #[error("{0}")]
    Scene(String),
    /// Bad arguments, or an output that cannot be written.
    #[error("{0}")]
    Usage(String),
    /// The run stopped where a number went wrong.
    #[error("the run stopped {0}")]
    Fault(Fault),
    /// `--max-events` or `--max-wall`.
    #[error("stopped early at t = {time} s: {why}; what was written is complete up to there")]
    Stopped { time: f64, why: Exceeded },
    /// The same, where nothing was written.
    #[error("stopped early at t = {time} s: {why}; nothing was written")]
    Unwritten { time: f64, why: Exceeded },
    /// The same, of a study.
    #[error("stopped early: {0}; the report holds what was done so far")]
    StudyStopped(String),
    /// Ctrl-C or a request to terminate.
    #[error("interrupted at t = {time} s; what was written so far is complete")]
    Interrupted { time: f64 },
    /// The same, where nothing was written.
    #[error("interrupted at t = {time} s; nothing was written")]
    Abandoned { time: f64 },
    /// The same, of a study.
    #[error("interrupted; the report holds what was done so far")]
    Cancelled,
}

impl CliError {
    /// 1 the scene has errors, 2 bad usage, 3 a numerical fault, 4 stopped early, 130 interrupted.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Scene(_) => 1,
            Self::Usage(_) => 2,
            Self::Fault(_) => 3,
            Self::Stopped { .. } | Self::Unwritten { .. } | Self::StudyStopped(_) => 4,
            Self::Interrupted { .. } | Self::Abandoned { .. } | Self::Cancelled => 130,
        }
    }

    /// The editor cannot open its window; the verbs do not need one.
    pub fn no_window(reason: impl Display) -> Self {
        let draw = if cfg!(feature = "render") {
            " and draw it with `polyscene render SCENE --out PICTURE.png`"
        } else {
            ""
        };
        Self::Usage(format!(
            "the editor cannot open a window: {reason}\n\
             Without a display, simulate a scene with `polyscene run SCENE --dt S --until S`{draw}."
        ))
    }

    /// `render` in a program that has none.
    #[cfg(not(feature = "render"))]
    pub(super) fn no_pictures() -> Self {
        Self::Usage(
            "this program was built without pictures: build it with the feature `render`, such as \
             `cargo build --release --no-default-features --features render`"
                .into(),
        )
    }

    /// An output file that cannot be written.
    pub(super) fn unwritable(path: &Path, error: &std::io::Error) -> Self {
        let name = shown_path(path);
        let is_folder = path.to_string_lossy().ends_with(['/', MAIN_SEPARATOR]);
        let folder = if is_folder { Some(path) } else { path.parent() };
        let folder = folder.filter(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        Self::Usage(match folder.map(shown_path) {
            Some(folder) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                format!(
                    "cannot write {name}: the folder {folder} does not exist; make it first, with mkdir {folder}"
                )
            }
            _ => format!("cannot write {name}: {error}"),
        })
    }

    /// The same, of standard output or what an option prints there.
    pub(super) fn unprintable(name: &str, error: &std::io::Error) -> Self {
        Self::Usage(format!("cannot write {name}: {error}"))
    }

    pub(super) fn interrupted(sim: &Simulation) -> Self {
        Self::Interrupted { time: sim.time() }
    }
}

/// Tells the person at the terminal. Nothing sensible is left to do when standard error is closed.
pub fn say(message: impl Display) {
    let _ = writeln!(std::io::stderr(), "polyscene: {}", escaped_lines(&message.to_string()));
}

/// Every line as text, whatever names it holds.
pub(super) fn escaped_lines(text: &str) -> String {
    text.split('\n').map(escaped).collect::<Vec<_>>().join("\n")
}
