//! Looks at the open file once a second, from a thread of its own: another program may write it while this window is only
//! looked at. Nothing but a look at the file's date, so that it works on any file system and across renames.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crate::scene::FileStamp;

/// How soon a change is seen.
const EVERY: Duration = Duration::from_secs(1);

/// A watch that is kept. Dropped, it ends.
pub(super) struct DiskWatch {
    shared: Arc<Shared>,
}

#[derive(Default)]
struct Shared {
    path: Mutex<Option<PathBuf>>,
    changed: AtomicBool,
}

impl DiskWatch {
    /// Calls `wake` after each change.
    pub fn start(wake: impl Fn() + Send + 'static) -> Self {
        let shared = Arc::<Shared>::default();
        let watched = Arc::downgrade(&shared);
        std::thread::spawn(move || {
            let mut last: Option<(PathBuf, FileStamp)> = None;
            while let Some(shared) = watched.upgrade() {
                if shared.look(&mut last) {
                    wake();
                }
                drop(shared);
                std::thread::sleep(EVERY);
            }
        });
        Self { shared }
    }

    /// Whether the file at `path` was changed since it was asked last; from now on that one is watched.
    pub fn has_changed(&self, path: Option<&Path>) -> bool {
        let mut watched = self.shared.path.lock().unwrap_or_else(PoisonError::into_inner);
        if watched.as_deref() != path {
            *watched = path.map(Path::to_owned);
        }
        self.shared.changed.swap(false, Ordering::Relaxed)
    }
}

impl Shared {
    fn look(&self, last: &mut Option<(PathBuf, FileStamp)>) -> bool {
        let path = self.path.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let now = path.map(|path| (FileStamp::of(&path), path)).map(|(stamp, path)| (path, stamp));
        let same_file = last.as_ref().zip(now.as_ref()).is_some_and(|(last, now)| last.0 == now.0);
        let changed =
            same_file && last.as_ref().map(|(_, stamp)| stamp) != now.as_ref().map(|(_, stamp)| stamp);
        *last = now;
        if changed {
            self.changed.store(true, Ordering::Relaxed);
        }
        changed
    }
}
