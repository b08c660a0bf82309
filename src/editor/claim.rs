//! Who has a file open: two windows on one file tell so, since each could save over the other.

use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use crate::scene::canonical_target;

/// A file that this window has open. Dropped, it is free again.
pub(super) struct Claim {
    path: PathBuf,
    lock: PathBuf,
    _locked: Option<File>,
}

impl Claim {
    /// Takes a file, by a lock in `folder` that ends with this process; whether another window has it.
    pub fn take(folder: &Path, path: &Path) -> (Self, bool) {
        let path = canonical_target(path);
        let mut hasher = DefaultHasher::new();
        path.hash(&mut hasher);
        let lock = folder.join(format!("{:016x}.lock", hasher.finish()));
        let file = std::fs::create_dir_all(folder)
            .and_then(|()| File::options().write(true).create(true).truncate(false).open(&lock));
        let (locked, taken) = match file {
            Ok(file) => match file.try_lock() {
                Ok(()) => (Some(file), false),
                Err(std::fs::TryLockError::WouldBlock) => (None, true),
                // where locks are not supported nobody is warned
                Err(std::fs::TryLockError::Error(_)) => (None, false),
            },
            Err(_) => (None, false),
        };
        (Self { path, lock, _locked: locked }, taken)
    }

    pub fn is_of(&self, path: &Path) -> bool {
        self.path == canonical_target(path)
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        if self._locked.is_some() {
            // what stays behind is empty and free
            let _ = std::fs::remove_file(&self.lock);
        }
    }
}
