//! Saving so that a crash or a full disk leaves either the old file or the new one, never a part.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes a file: a temporary one beside it, synced, then renamed over it. A link is followed, the
/// permissions and, as far as the system lets us, the owner of an existing file are kept, and a write-protected
/// file is refused. What holds no bytes of its own, such as `/dev/null` or a pipe, is written to as it is.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write(path, bytes, false)
}

/// As [`write_atomically`], and a new file can be read by its owner alone.
pub fn write_private(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write(path, bytes, true)
}

fn write(path: &Path, bytes: &[u8], private: bool) -> io::Result<()> {
    let target = Target::of(path)?;
    if target.is_stream() {
        return File::options().write(true).open(&target.path)?.write_all(bytes);
    }
    let mut temporary = target.temporary(private)?;
    remove_stale(target.folder(), temporary.as_file());
    // Not through the temporary file itself, whose errors tell its name.
    temporary.as_file_mut().write_all(bytes)?;
    if let Some(metadata) = &target.existing {
        keep_owner(temporary.as_file(), metadata);
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
    if target.is_stream() { Ok(()) } else { target.temporary(false).map(drop) }
}

/// Where a file goes: links followed, and what is there now.
struct Target {
    path: PathBuf,
    existing: Option<fs::Metadata>,
}

impl Target {
    /// Refuses what cannot be replaced.
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

    fn temporary(&self, private: bool) -> io::Result<tempfile::NamedTempFile> {
        temporary_in(self.folder(), private || self.existing.is_some())
            .map_err(|err| about_folder(&err, self.folder()))
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
/// where its folder does not either, the path stays as it is.
pub fn canonical_target(path: &Path) -> PathBuf {
    let target = follow_links(path).unwrap_or_else(|_| path.to_path_buf());
    match (folder_of(&target).canonicalize(), target.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => target,
    }
}

/// Whether two paths mean one file, which need not exist: by name, or as links of one file.
pub fn same_file(one: &Path, other: &Path) -> bool {
    let id = |path| fs::metadata(path).ok().and_then(|metadata| FileId::of(&metadata));
    canonical_target(one) == canonical_target(other) || id(one).is_some_and(|one| id(other) == Some(one))
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

const PREFIX: &str = ".polyscene-";
const SUFFIX: &str = ".tmp";

/// `private`: what it replaces may be readable by fewer people than a new file.
fn temporary_in(folder: &Path, private: bool) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What any new file gets; the umask takes its part away.
        builder.permissions(fs::Permissions::from_mode(if private { 0o600 } else { 0o666 }));
    }
    let file = builder.tempfile_in(folder)?;
    // Tells other runs that this one lives. Where locks are not supported, its age has to.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Seconds: a save takes less, however slow the disk.
const LONGEST_SAVE_S: u64 = 60;
/// Seconds, where the lock cannot be asked.
const SURELY_STALE_S: u64 = 24 * 3600;

/// Removes temporary files of runs that were killed while they saved here: old ones that nobody holds locked.
/// `new` was made just now: it has the time of the file system that dates the others.
fn remove_stale(folder: &Path, new: &File) {
    let (Ok(entries), Ok(new)) = (fs::read_dir(folder), new.metadata()) else { return };
    for entry in entries.flatten() {
        let is_ours =
            entry.file_name().to_str().is_some_and(|name| name.starts_with(PREFIX) && name.ends_with(SUFFIX));
        if is_ours && is_stale(&entry, &new) {
            // One that cannot be removed stays; that is no reason not to save.
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn is_stale(entry: &fs::DirEntry, new: &fs::Metadata) -> bool {
    // Of the entry itself: a link is none of ours.
    let Ok(metadata) = entry.metadata() else { return false };
    let dates = new.modified().ok().zip(metadata.modified().ok());
    let age = dates.and_then(|(now, then)| now.duration_since(then).ok()).map_or(0, |age| age.as_secs());
    if !metadata.is_file() || age < LONGEST_SAVE_S {
        return false;
    }
    match File::open(entry.path()).map(|file| file.try_lock()) {
        Ok(Ok(())) => true,
        Ok(Err(fs::TryLockError::WouldBlock)) => false,
        Ok(Err(fs::TryLockError::Error(_))) | Err(_) => age >= SURELY_STALE_S,
    }
}

/// Gives a file the owner and group of the one it replaces. Only root may give files away, so for others this
/// keeps what is possible.
#[cfg(unix)]
fn keep_owner(file: &File, replaced: &fs::Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    let Ok(own) = file.metadata() else { return };
    let group = (own.gid() != replaced.gid()).then_some(replaced.gid());
    let owner = (own.uid() != replaced.uid()).then_some(replaced.uid());
    if group.is_some() || owner.is_some() {
        let both = fchown(file, owner, group);
        if both.is_err() {
            let _ = fchown(file, None, group);
        }
    }
}

#[cfg(not(unix))]
fn keep_owner(_file: &File, _replaced: &fs::Metadata) {}

/// What tells a file from all others, whatever its names: device and inode. Streams have none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileId(u64, u64);

impl FileId {
    /// `None` for what is no file with bytes of its own, and where the system tells no such numbers.
    #[cfg(unix)]
    pub fn of(metadata: &fs::Metadata) -> Option<Self> {
        use std::os::unix::fs::MetadataExt;
        metadata.is_file().then(|| Self(metadata.dev(), metadata.ino()))
    }

    /// `None` for what is no file with bytes of its own, and where the system tells no such numbers.
    #[cfg(not(unix))]
    pub fn of(_metadata: &fs::Metadata) -> Option<Self> {
        None
    }
}

/// What was at a path at some time, to notice that another program wrote there since.
#[derive(Clone, Debug)]
pub struct FileStamp(Option<fs::Metadata>);

impl FileStamp {
    /// What is there now; nothing and streams are the same.
    pub fn of(path: &Path) -> Self {
        Self(fs::metadata(path).ok().filter(fs::Metadata::is_file))
    }
}

impl PartialEq for FileStamp {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (None, None) => true,
            (Some(one), Some(other)) => {
                one.len() == other.len()
                    && one.modified().ok() == other.modified().ok()
                    && FileId::of(one) == FileId::of(other)
            }
            _ => false,
        }
    }
}

/// Makes the rename itself last. Not every file system can; the file is whole either way.
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}
