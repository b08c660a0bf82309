//! The scene with the last state as its start.

use std::path::{Path, PathBuf};

use crate::cli::CliError;
use crate::cli::output::{self, is_stdout};
use crate::record::as_start;
use crate::scene::{Document, Edit, FileStamp, check_writable, shown_path};
use crate::sim::Simulation;

/// Where the last state goes, and what was there before the run.
pub struct FinalScene<'a> {
    path: &'a Path,
    before: FileStamp,
}

impl<'a> FinalScene<'a> {
    /// Takes down what is at `path` now: before the scene is read, which may be that very file.
    pub fn new(path: &'a Path) -> Self {
        Self { path, before: FileStamp::of(path) }
    }

    /// Refuses a file that cannot be written, before a long run.
    pub fn check(&self) -> Result<(), CliError> {
        if is_stdout(self.path) {
            return Ok(());
        }
        check_writable(self.path).map_err(|error| CliError::unwritable(self.path, &error))
    }

    /// Writes `document` with the positions, velocities and spins of `sim` now; a file is replaced in one go. A file
    /// that another program wrote during the run stays, and the state goes beside it: neither is lost.
    pub fn write(&self, document: &Document, sim: &Simulation) -> Result<(), CliError> {
        let last = with_state_of(document, sim)?;
        if is_stdout(self.path) {
            return output::print(&last.to_bytes());
        }
        let save = |path: &Path| last.save(path).map_err(|error| CliError::unwritable(path, &error));
        if FileStamp::of(self.path) == self.before {
            return save(self.path);
        }
        let free = free_name(self.path);
        save(&free)?;
        Err(CliError::Usage(format!(
            "{} was changed by another program during the run and stays as it is; the last state is in {}",
            shown_path(self.path),
            shown_path(&free)
        )))
    }
}

fn with_state_of(document: &Document, sim: &Simulation) -> Result<Document, CliError> {
    let changes = sim.dynamic_bodies().filter_map(|body| {
        let (key, state) = (sim.key(body), sim.state(body)?);
        let changes = as_start(state.position, state.velocity, state.turn);
        Some(changes.map(move |change| Edit::Body { key, change }))
    });
    let edited = document.apply(&Edit::All(changes.flatten().collect()));
    let edited = edited
        .map_err(|error| CliError::Usage(format!("cannot write the last state into the scene: {error}")))?;
    Ok(edited.document)
}

/// `name-2.xml` for `name.xml`, or the first number at which there is no file yet.
fn free_name(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default();
    let named = |number: u32| {
        let mut name = stem.to_owned();
        name.push(format!("-{number}"));
        if let Some(extension) = path.extension() {
            name.push(".");
            name.push(extension);
        }
        path.with_file_name(name)
    };
    (2..=u32::MAX).map(named).find(|path| path.symlink_metadata().is_err()).unwrap_or_else(|| path.into())
}
