//! Where rows go: a file or standard output, always in whole lines.

use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::CliError;
use crate::scene::canonical_target;

/// Bytes gathered before they are handed to the system in one call.
const BATCH: usize = 32 * 1024;

/// Whether `path` means standard output.
pub fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// One name for the file that `path` means, or `-`.
pub fn place(path: &Path) -> PathBuf {
    if is_stdout(path) { path.into() } else { canonical_target(path) }
}

/// Whether writing to `output` would destroy `scene`, which may be standard input.
pub fn overwrites(output: &Path, scene: &Path) -> bool {
    !is_stdout(scene) && place(output) == place(scene)
}

/// Writes to standard output. A reader that went away (`| head`) has seen enough.
pub fn print(bytes: &[u8]) -> Result<(), CliError> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(CliError::unwritable("standard output", &error))
        }
        _ => Ok(()),
    }
}

/// Writes JSON Lines. Only whole lines are ever handed to the system.
pub struct LineSink {
    out: Box<dyn Write>,
    name: PathBuf,
    lines: Vec<u8>,
    closed: bool,
}

impl LineSink {
    /// Creates the file, or takes standard output for `-`.
    pub fn create(path: &Path) -> Result<Self, CliError> {
        let out: Box<dyn Write> = if is_stdout(path) {
            Box::new(std::io::stdout())
        } else {
            Box::new(File::create(path).map_err(|error| CliError::unwritable(path.display(), &error))?)
        };
        Ok(Self { out, name: path.into(), lines: Vec::with_capacity(2 * BATCH), closed: false })
    }

    /// Whether the reader of a pipe went away. Further rows are dropped.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Appends one row. Non-finite numbers become `null`.
    pub fn row(&mut self, row: &impl Serialize) -> Result<(), CliError> {
        serde_json::to_writer(&mut self.lines, row).map_err(|error| self.failed(&error.into()))?;
        self.lines.push(b'\n');
        if self.lines.len() >= BATCH { self.flush() } else { Ok(()) }
    }

    /// Hands all rows so far to the system.
    pub fn flush(&mut self) -> Result<(), CliError> {
        let written = if self.closed { Ok(()) } else { self.out.write_all(&self.lines) };
        self.lines.clear();
        match written.and_then(|()| self.out.flush()) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(())
            }
            Err(error) => Err(self.failed(&error)),
            Ok(()) => Ok(()),
        }
    }

    fn failed(&self, error: &std::io::Error) -> CliError {
        if is_stdout(&self.name) {
            CliError::unwritable("standard output", error)
        } else {
            CliError::unwritable(self.name.display(), error)
        }
    }
}
