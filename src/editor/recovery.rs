//! This run's copy of unsaved work, in the user's data folder: its files and the lock that tells whether the
//! run still lives.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Instant, SystemTime};

use super::Storage;
use super::recovered::{Recovered, remove_files};
use crate::scene::write_private;

/// This run's own copy.
pub(super) struct Recovery {
    pub(super) folder: Option<PathBuf>,
    own: Option<OwnFiles>,
    /// The states of document and draft that the copy holds.
    pub(super) copied: Option<(u64, u64)>,
    pub(super) last: Option<Instant>,
    /// Reported once, not every three seconds.
    pub(super) failed: bool,
}

struct OwnFiles {
    base: PathBuf,
    /// Held locked for as long as this run lives.
    _lock: File,
}

impl Recovery {
    pub fn new(storage: &Storage) -> Self {
        let folder = storage.data.as_ref().map(|data| data.join("recovery"));
        Self { folder, own: None, copied: None, last: None, failed: false }
    }

    fn own_base(&mut self) -> std::io::Result<Option<PathBuf>> {
        let Some(folder) = &self.folder else { return Ok(None) };
        if self.own.is_none() {
            create_private_folder(folder)?;
            let nanos =
                SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default().as_nanos();
            let base = folder.join(format!("{}-{nanos}", std::process::id()));
            let lock = create_private(&base.with_extension("lock"))?;
            // where locks are not supported the worst is that two runs offer the same work
            let _ = lock.try_lock();
            self.own = Some(OwnFiles { base, _lock: lock });
        }
        Ok(self.own.as_ref().map(|own| own.base.clone()))
    }

    /// Replaces this run's copy.
    pub(super) fn write(
        &mut self,
        document: &[u8],
        draft: Option<&str>,
        about: &Recovered,
    ) -> std::io::Result<()> {
        let Some(base) = self.own_base()? else { return Ok(()) };
        // the description last: without it the copy is not offered
        write_private(&base.with_extension("xml"), document)?;
        if let Some(draft) = draft {
            write_private(&base.with_extension("draft"), draft.as_bytes())?;
        }
        write_private(&base.with_extension("json"), &serde_json::to_vec(about)?)
    }

    /// Removes this run's copy: there is nothing left to recover.
    pub(super) fn clear(&mut self) {
        if let Some(own) = self.own.take() {
            remove_files(&own.base);
        }
        self.copied = None;
    }
}

/// Unsaved work may be secret where the user's own file is: nobody else reads it.
fn create_private_folder(folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        std::fs::set_permissions(folder, std::fs::Permissions::from_mode(0o700))?;
    }
    Ok(())
}

fn create_private(path: &Path) -> std::io::Result<File> {
    let mut options = File::options();
    options.write(true).create(true).truncate(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)
}
