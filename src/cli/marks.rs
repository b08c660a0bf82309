//! A table between two marks in a Markdown file, which a verb writes anew.

use std::path::{Path, PathBuf};

use super::CliError;
use crate::scene::{shown_path, write_atomically};

/// What stands around the table, read before the work that makes the table.
pub struct Marked {
    path: PathBuf,
    before: String,
    after: String,
}

impl Marked {
    /// Reads the file. `begin` and `end` are the lines between which the table stands.
    pub fn read(path: &Path, begin: &str, end: &str) -> Result<Self, CliError> {
        let whole = std::fs::read_to_string(path).map_err(|error| CliError::unwritable(path, &error))?;
        let opening = format!("{begin}\n");
        let from = whole.find(&opening).map(|at| at + opening.len());
        match (from, whole.find(end)) {
            (Some(from), Some(to)) if from <= to => {
                Ok(Self { path: path.into(), before: whole[..from].into(), after: whole[to..].into() })
            }
            _ => Err(CliError::Usage(format!(
                "--markdown: {} lacks the lines `{begin}` and `{end}` between which the table belongs",
                shown_path(path)
            ))),
        }
    }

    /// Puts `table` between the marks.
    pub fn write(&self, table: &str) -> Result<(), CliError> {
        let whole = format!("{}{table}{}", self.before, self.after);
        write_atomically(&self.path, whole.as_bytes())
            .map_err(|error| CliError::unwritable(&self.path, &error))
    }
}
