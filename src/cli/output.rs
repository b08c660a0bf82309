//! Where rows go: a file or standard output, always in whole lines.

use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::CliError;
use crate::scene::{FileId, canonical_target, check_writable, shown_path, write_atomically};

/// Bytes gathered before they are handed to the system in one call.
const BATCH: usize = 32 * 1024;

/// Whether `path` means standard output.
pub fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// What an output or the scene is: a name and, where the system has one, the file behind it.
struct Place {
    name: PathBuf,
    file: Option<FileId>,
}

impl Place {
    fn of_output(path: &Path) -> Self {
        let stdout = || stream_file(std::io::stdout());
        Self::of(path, stdout)
    }

    fn of_scene(path: &Path) -> Self {
        let mut place = Self::of(path, || stream_file(std::io::stdin()));
        if is_stdout(path) {
            // The name of standard input is not that of standard output.
            place.name = "<stdin>".into();
        }
        place
    }

    fn of(path: &Path, stream: impl Fn() -> Option<File>) -> Self {
        if is_stdout(path) {
            let file = stream().and_then(|file| FileId::of(&file.metadata().ok()?));
            return Self { name: path.into(), file };
        }
        let file = std::fs::metadata(path).ok().and_then(|metadata| FileId::of(&metadata));
        Self { name: canonical_target(path), file }
    }

    fn is_same(&self, other: &Self) -> bool {
        self.name == other.name || (self.file.is_some() && self.file == other.file)
    }
}

/// A file of its own that reads or writes where a standard stream does.
#[cfg(unix)]
fn stream_file(stream: impl std::os::fd::AsFd) -> Option<File> {
    stream.as_fd().try_clone_to_owned().ok().map(File::from)
}

#[cfg(not(unix))]
fn stream_file<S>(_stream: S) -> Option<File> {
    None
}

/// Whether writing to `output` would destroy `scene`, by whatever name; both may be standard streams.
pub fn overwrites(output: &Path, scene: &Path) -> bool {
    Place::of_output(output).is_same(&Place::of_scene(scene))
}

/// Refuses, unless `force`, a place given by an option that holds something.
pub fn refuse_taken(option: &str, output: &Path, force: bool) -> Result<(), CliError> {
    if force || !holds_something(output) {
        return Ok(());
    }
    let name = shown_path(output);
    Err(CliError::Usage(format!("{option} would overwrite {name}: give another name, or --force")))
}

/// Whether a file is there that may be somebody's work. What holds no bytes, such as a fresh temporary file or a device,
/// is no loss.
fn holds_something(path: &Path) -> bool {
    !is_stdout(path) && path.metadata().is_ok_and(|metadata| metadata.is_file() && metadata.len() > 0)
}

/// Refuses two outputs, given with the names of their options, in one place.
pub fn refuse_shared(outputs: &[(&str, &Path)]) -> Result<(), CliError> {
    let mut taken: Vec<(&str, Place)> = Vec::new();
    for (option, path) in outputs {
        let place = Place::of_output(path);
        if let Some((other, _)) = taken.iter().find(|(_, taken)| taken.is_same(&place)) {
            let place = if is_stdout(path) { "standard output".into() } else { shown_path(path) };
            return Err(CliError::Usage(format!("{other} and {option} cannot both write to {place}")));
        }
        taken.push((option, place));
    }
    Ok(())
}

/// Writes to standard output. A reader that went away (`| head`) has seen enough.
pub fn print(bytes: &[u8]) -> Result<(), CliError> {
    let mut sink = LineSink::create(Path::new("-"))?;
    sink.lines = bytes.to_vec();
    sink.flush()
}

/// Before the work: refuses a place, given by an option, that cannot be written, that is the input itself (`what` says what
/// that is), or unless `force` one that holds something.
pub fn refuse_bad(
    option: &str,
    output: &Path,
    (what, input): (&str, &Path),
    force: bool,
) -> Result<(), CliError> {
    let name = shown_path(output);
    if overwrites(output, input) {
        return Err(CliError::Usage(format!("{option} would overwrite {what} {name}")));
    }
    refuse_taken(option, output, force)?;
    if is_stdout(output) {
        return Ok(());
    }
    check_writable(output).map_err(|error| CliError::unwritable(output, &error))
}

/// Writes a whole file in one go, or to standard output for `-`.
pub fn write(output: &Path, bytes: &[u8]) -> Result<(), CliError> {
    if is_stdout(output) {
        return print(bytes);
    }
    write_atomically(output, bytes).map_err(|error| CliError::unwritable(output, &error))
}

/// Writes JSON Lines. Only whole lines are ever handed to the system, and where a disk is full the file ends
/// with a whole line.
pub struct LineSink {
    out: Box<dyn Write>,
    /// What holds the bytes, if they can be taken back.
    file: Option<File>,
    name: PathBuf,
    lines: Vec<u8>,
    closed: bool,
}

impl LineSink {
    /// Creates the file, or takes standard output for `-`.
    pub fn create(path: &Path) -> Result<Self, CliError> {
        let file = if is_stdout(path) {
            stream_file(std::io::stdout())
        } else {
            Some(File::create(path).map_err(|error| CliError::unwritable(path, &error))?)
        };
        let out: Box<dyn Write> = match file.as_ref().and_then(|file| file.try_clone().ok()) {
            // Not through the buffer of standard output, which would try again at the end.
            Some(file) => Box::new(file),
            None => Box::new(std::io::stdout()),
        };
        let file = file.filter(|file| file.metadata().is_ok_and(|metadata| metadata.is_file()));
        Ok(Self { out, file, name: path.into(), lines: Vec::with_capacity(2 * BATCH), closed: false })
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

    /// Appends one line of text.
    pub fn line(&mut self, text: &str) -> Result<(), CliError> {
        self.lines.extend(text.as_bytes());
        self.lines.push(b'\n');
        if self.lines.len() >= BATCH { self.flush() } else { Ok(()) }
    }

    /// Hands all rows so far to the system.
    pub fn flush(&mut self) -> Result<(), CliError> {
        let before = self.length();
        let written = if self.closed { Ok(()) } else { self.out.write_all(&self.lines) };
        let outcome = match written.and_then(|()| self.out.flush()) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(())
            }
            Err(error) => {
                self.take_back_part_of_line(before);
                Err(self.failed(&error))
            }
            Ok(()) => Ok(()),
        };
        self.lines.clear();
        outcome
    }

    fn length(&self) -> Option<u64> {
        Some(self.file.as_ref()?.metadata().ok()?.len())
    }

    /// After a batch that did not fit: shortens the file to its last whole line.
    fn take_back_part_of_line(&self, before: Option<u64>) {
        let (Some(file), Some(before), Some(after)) = (&self.file, before, self.length()) else { return };
        let written = usize::try_from(after.saturating_sub(before)).unwrap_or(usize::MAX);
        let part = self.lines.get(..written).unwrap_or(&self.lines);
        let whole = part.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        // Best effort: the error of the disk is reported either way.
        let _ = file.set_len(before + whole as u64);
    }

    fn failed(&self, error: &std::io::Error) -> CliError {
        if is_stdout(&self.name) {
            CliError::unprintable("standard output", error)
        } else {
            CliError::unwritable(&self.name, error)
        }
    }
}
