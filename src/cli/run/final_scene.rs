//! The scene with the last state as its start.

use std::io::Write as _;
use std::path::Path;

use crate::cli::CliError;
use crate::cli::output::is_stdout;
use crate::scene::{BodyChange, Document, Edit};
use crate::sim::Simulation;

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
        return match std::io::stdout().write_all(&edited.document.to_bytes()) {
            Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
                Err(CliError::unwritable("standard output", &error))
            }
            _ => Ok(()),
        };
    }
    edited.document.save(path).map_err(|error| CliError::unwritable(path.display(), &error))
}
