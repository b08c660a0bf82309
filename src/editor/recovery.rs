//! Unsaved work outlives a crash: a copy in the user's data folder, never in the user's own file.
//! Each run has its own files `recovery/<run>.{xml,json,lock}`; the lock tells whether it still lives.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use serde::{Deserialize, Serialize};

use super::dialogue::Question;
use super::disk::DiskStamp;
use super::{Notice, Session, Storage, path_text};
use crate::scene::write_private;

/// Least time between two copies: what a crash may cost.
const INTERVAL: Duration = Duration::from_secs(10);

/// Unsaved work of a run that has ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Recovered {
    /// The recovery files' path without extension.
    #[serde(skip)]
    base: PathBuf,
    /// The user's file; `None` for work that never had one.
    #[serde(with = "path_text::optional", default)]
    pub(super) path: Option<PathBuf>,
    title: String,
    pub(super) stamp: Option<DiskStamp>,
    /// Seconds since 1970.
    saved_at_s: u64,
}

impl Recovered {
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Such as `3 minutes ago`.
    pub fn age_text(&self) -> String {
        let seconds = now_s().saturating_sub(self.saved_at_s);
        let (count, unit) = match seconds {
            0..60 => return "less than a minute ago".to_owned(),
            60..3600 => (seconds / 60, "minute"),
            3600..86_400 => (seconds / 3600, "hour"),
            _ => (seconds / 86_400, "day"),
        };
        format!("{count} {unit}{} ago", if count == 1 { "" } else { "s" })
    }

    pub(super) fn bytes(&self) -> std::io::Result<Vec<u8>> {
        std::fs::read(self.base.with_extension("xml"))
    }

    pub(super) fn forget(&self) {
        remove_files(&self.base);
    }
}

/// This run's own copy.
pub(super) struct Recovery {
    folder: Option<PathBuf>,
    own: Option<OwnFiles>,
    /// The document state that the copy holds.
    copied: Option<u64>,
    last: Option<Instant>,
    /// Told once, not every ten seconds.
    failed: bool,
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

    /// Work of runs that have ended, newest first.
    fn find(&self) -> Vec<Recovered> {
        let Some(entries) = self.folder.as_ref().and_then(|folder| std::fs::read_dir(folder).ok()) else {
            return Vec::new();
        };
        let paths = entries.flatten().map(|entry| entry.path());
        let mut found: Vec<Recovered> = paths
            .filter(|path| path.extension().is_some_and(|extension| extension == "json"))
            .filter(|path| !is_alive(&path.with_extension("lock")))
            .filter_map(|path| {
                let about: Recovered = serde_json::from_slice(&std::fs::read(&path).ok()?).ok()?;
                Some(Recovered { base: path.with_extension(""), ..about })
            })
            .collect();
        found.sort_by_key(|found| std::cmp::Reverse(found.saved_at_s));
        found
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

    /// Removes this run's copy: there is nothing left to recover.
    fn clear(&mut self) {
        if let Some(own) = self.own.take() {
            remove_files(&own.base);
        }
        self.copied = None;
    }
}

impl Session {
    /// Keeps a copy of unsaved work, at most every ten seconds, and none of saved work.
    pub(super) fn keep_recovery(&mut self, now: Instant) {
        if !self.is_dirty() {
            return self.recovery.clear();
        }
        let state = self.document_state();
        let too_soon = self.recovery.last.is_some_and(|last| now.saturating_duration_since(last) < INTERVAL);
        if self.recovery.copied == Some(state) || too_soon {
            return;
        }
        self.recovery.last = Some(now);
        match self.write_recovery() {
            Ok(()) => self.recovery.copied = Some(state),
            Err(err) if !self.recovery.failed => {
                self.recovery.failed = true;
                self.notices.push(Notice::warning(format!("Unsaved work can't be kept safe: {err}")));
            }
            Err(_) => {}
        }
    }

    /// Whether a copy of unsaved work is due: [`Session::poll`] makes it when called later.
    pub fn wants_recovery_copy(&self) -> bool {
        self.is_dirty()
            && self.recovery.folder.is_some()
            && self.recovery.copied != Some(self.document_state())
    }

    pub(super) fn write_recovery(&mut self) -> std::io::Result<()> {
        let Some(base) = self.recovery.own_base()? else { return Ok(()) };
        let about = Recovered {
            base: PathBuf::new(),
            path: self.file.path.clone(),
            title: self.file.title.clone(),
            stamp: self.file.stamp,
            saved_at_s: now_s(),
        };
        // the description last: without it the copy is not offered
        write_private(&base.with_extension("xml"), &self.document().to_bytes())?;
        write_private(&base.with_extension("json"), &serde_json::to_vec(&about)?)
    }

    /// Drops the copy of a document that was saved, discarded or replaced.
    pub(super) fn forget_recovery(&mut self) {
        self.recovery.clear();
    }

    /// Asks about the newest work that an earlier run left.
    pub(super) fn offer_recovery(&mut self) {
        self.question = self.recovery.find().into_iter().next().map(Question::Recover);
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

fn is_alive(lock: &Path) -> bool {
    let Ok(file) = File::open(lock) else { return false };
    matches!(file.try_lock(), Err(std::fs::TryLockError::WouldBlock))
}

fn remove_files(base: &Path) {
    for extension in ["json", "xml", "lock"] {
        // what is not there needs no removing
        let _ = std::fs::remove_file(base.with_extension(extension));
    }
}

fn now_s() -> u64 {
    SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default().as_secs()
}
