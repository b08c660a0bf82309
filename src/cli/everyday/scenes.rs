//! Writes everyday scenes as files.

use std::path::Path;

use crate::cli::{CliError, output};
use crate::scene::{Document, NumberStyle, shown_path};
use crate::study::everyday::Setup;

/// Writes each scene as `FAMILY-N-E-SEED.xml` and prints the names; unless `force` none over a file that is there.
pub fn write_all(setups: &[Setup], folder: &Path, force: bool) -> Result<(), CliError> {
    let path_of =
        |Setup { family, n, e, seed }: &Setup| folder.join(format!("{}-{n}-{e}-{seed}.xml", family.name));
    setups.iter().try_for_each(|setup| output::refuse_taken("--write", &path_of(setup), force))?;
    std::fs::create_dir_all(folder).map_err(|error| CliError::unwritable(folder, &error))?;
    for setup in setups {
        let path = path_of(setup);
        let document = Document::of_scene(&setup.scene(), NumberStyle::Point)
            .map_err(|error| CliError::Usage(format!("cannot write the scene {setup}: {error}")))?;
        document.save(&path).map_err(|error| CliError::unwritable(&path, &error))?;
        output::print(format!("{}\n", shown_path(&path)).as_bytes())?;
    }
    Ok(())
}
