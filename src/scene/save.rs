//! Saving so that a crash or a full disk leaves either the old file or the new one, never a part.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes a file: a temporary one beside it, synced, then renamed over it. A link is followed, the
/// permissions of an existing file are kept, and a write-protected file is refused. What holds no bytes of
/// its own, such as `/dev/null` or a pipe, is written to as it is.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = Target::of(path)?;
    if target.is_stream() {
        return File::options().write(true).open(&target.path)?.write_all(bytes);
    }
    let mut temporary = target.temporary()?;
    // Not through the temporary file itself, whose errors tell its name.
    temporary.as_file_mut().write_all(bytes)?;
    if let Some(metadata) = &target.existing {
        temporary.as_file().set_permissions(metadata.permissions())?;
    }
    temporary.as_file().sync_all()?;
    temporary.persist(&target.path).map_err(|err| err.error)?;
    sync_folder(target.folder());
    Ok(())
}

/// Whether [`write_atomically`] could begin now, so that a long computation need not end in vain.
pub fn check_writable(path: &Path) -> io::Result<()> {
    let target = Target::of(path)?;
    if target.is_stream() { Ok(()) } else { target.temporary().map(drop) }
}

/// Where a file goes: links followed, and what is there now.
struct Target {
    path: PathBuf,
    existing: Option<fs::Metadata>,
}

impl Target {
    /// Refuses what can't be replaced.
    fn of(path: &Path) -> io::Result<Self> {
        let path = match fs::metadata(path) {
            // The link of an open pipe (`/dev/fd/3`) names no place; only the system can follow it.
            Ok(metadata) if !metadata.is_file() => path.to_path_buf(),
            _ => follow_links(path)?,
        };
        let existing = match fs::metadata(&path) {
            Ok(metadata) => Some(metadata),
            Err(err) if matches!(err.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => None,
            Err(err) => return Err(err),
        };
        match &existing {
            Some(metadata) if metadata.is_dir() => {
                Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"))
            }
            Some(metadata) if metadata.permissions().readonly() => {
                Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is write-protected"))
            }
            _ => Ok(Self { path, existing }),
        }
    }

    fn is_stream(&self) -> bool {
        self.existing.as_ref().is_some_and(|metadata| !metadata.is_file())
    }

    fn folder(&self) -> &Path {
        folder_of(&self.path)
    }

    fn temporary(&self) -> io::Result<tempfile::NamedTempFile> {
        temporary_in(self.folder()).map_err(|err| about_folder(&err, self.folder()))
    }
}

/// The folder that holds `path`.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Says what is wrong with the folder. The error names the temporary file, which tells nobody anything.
fn about_folder(err: &io::Error, folder: &Path) -> io::Error {
    let folder = folder.display();
    let text = match err.kind() {
        io::ErrorKind::NotFound => format!("the folder {folder} does not exist"),
        io::ErrorKind::NotADirectory => format!("{folder} is not a folder"),
        io::ErrorKind::PermissionDenied => format!("there is no permission to make files in {folder}"),
        io::ErrorKind::ReadOnlyFilesystem => format!("nothing can be written in {folder}"),
        kind => match err.get_ref().and_then(std::error::Error::source) {
            Some(cause) => cause.to_string(),
            None => kind.to_string(),
        },
    };
    io::Error::new(err.kind(), text)
}

/// One name for one file, however it is spelt: links followed, the folder absolute. The file need not exist;
/// where its folder doesn't either, the path stays as it is.
pub fn canonical_target(path: &Path) -> PathBuf {
    let target = follow_links(path).unwrap_or_else(|_| path.to_path_buf());
    match (folder_of(&target).canonicalize(), target.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => target,
    }
}

/// The file that a path means in the end, which need not exist yet.
fn follow_links(path: &Path) -> io::Result<PathBuf> {
    /// As many as Linux follows.
    const MOST_LINKS: usize = 40;
    let mut target = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match fs::symlink_metadata(&target) {
            Ok(metadata) if metadata.is_symlink() => {
                let next = fs::read_link(&target)?;
                target = target.parent().map_or_else(|| next.clone(), |parent| parent.join(&next));
            }
            _ => return Ok(target),
        }
    }
    Err(io::Error::other("too many levels of symbolic links"))
}

fn temporary_in(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".polyscene-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What any new file gets; the umask takes its part away.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Makes the rename itself last. Not every file system can; the file is whole either way.
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}
