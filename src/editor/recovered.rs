//! Unsaved work that an earlier run left: `recovery/<run>.{xml,draft,json,lock}`, described by the JSON file.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use super::disk::DiskStamp;
use super::path_text;

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
    /// Whether there is text that was typed and not applied.
    #[serde(default)]
    has_draft: bool,
    /// Seconds since 1970.
    saved_at_s: u64,
}

impl Recovered {
    /// About a copy that is made now.
    pub(super) fn now(
        path: Option<PathBuf>,
        title: String,
        stamp: Option<DiskStamp>,
        has_draft: bool,
    ) -> Self {
        Self { base: PathBuf::new(), path, title, stamp, has_draft, saved_at_s: now_s() }
    }

    pub fn title(&self) -> &str {
        &self.title
    }

    pub fn has_draft(&self) -> bool {
        self.has_draft
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

    /// The text that was typed and not applied.
    pub(super) fn draft(&self) -> Option<String> {
        let bytes = std::fs::read(self.base.with_extension("draft")).ok().filter(|_| self.has_draft)?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    }

    pub(super) fn forget(&self) {
        remove_files(&self.base);
    }
}

/// Work of runs that have ended, newest first.
pub(super) fn find(folder: &Path) -> Vec<Recovered> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
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

fn is_alive(lock: &Path) -> bool {
    let Ok(file) = File::open(lock) else { return false };
    matches!(file.try_lock(), Err(std::fs::TryLockError::WouldBlock))
}

/// Removes the files of a copy.
pub(super) fn remove_files(base: &Path) {
    for extension in ["json", "xml", "draft", "lock"] {
        // what is not there needs no removing
        let _ = std::fs::remove_file(base.with_extension(extension));
    }
}

fn now_s() -> u64 {
    SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default().as_secs()
}
