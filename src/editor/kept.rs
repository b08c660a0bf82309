//! What the session keeps on the disk beside the user's files: settings, and a copy of unsaved work.

use super::claim::Claim;
use super::disk_watch::DiskWatch;
use super::recovery::Recovery;
use super::{EditorSettings, Storage};

pub(super) struct Kept {
    pub settings: EditorSettings,
    pub storage: Storage,
    pub recovery: Recovery,
    /// The open file, as other windows see it.
    pub claim: Option<Claim>,
    pub watch: Option<DiskWatch>,
}

impl Kept {
    pub fn in_storage(storage: Storage) -> Self {
        Self {
            settings: EditorSettings::load(&storage),
            recovery: Recovery::new(&storage),
            claim: None,
            watch: None,
            storage,
        }
    }
}
