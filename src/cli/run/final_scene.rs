//! The scene with the last state as its start.

use std::path::Path;

use crate::cli::CliError;
use crate::cli::output::{self, is_stdout};
use crate::scene::{BodyChange, Document, Edit, check_writable};
use crate::sim::Simulation;

/// Refuses a file that can't be written, before a long run.
pub fn check(path: &Path) -> Result<(), CliError> {
    if is_stdout(path) {
        return Ok(());
    }
    check_writable(path).map_err(|error| CliError::unwritable(path.display(), &error))
}

/// Writes `document` with the positions and velocities of `sim` now; a file is replaced in one go.
pub fn write(document: &Document, sim: &Simulation, path: &Path) -> Result<(), CliError> {
    let changes = sim.dynamic_bodies().filter_map(|body| {
        let (key, state) = (sim.key(body), sim.state(body)?);
        Some([
            Edit::Body { key, change: BodyChange::Position(state.position) },
            Edit::Body { key, change: BodyChange::Velocity(state.velocity) },
        ])
    });
    let edited = document
        .apply(&Edit::All(changes.flatten().collect()))
        .map_err(|error| CliError::Usage(format!("can't write the last state into the scene: {error}")))?;
    if is_stdout(path) {
        return output::print(&edited.document.to_bytes());
    }
    edited.document.save(path).map_err(|error| CliError::unwritable(path.display(), &error))
}
