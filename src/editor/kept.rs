//! What the session keeps on the disk beside the user's files: settings, and a copy of unsaved work.

use super::recovery::Recovery;
use super::{EditorSettings, Storage};

pub(super) struct Kept {
    pub settings: EditorSettings,
    pub storage: Storage,
    pub recovery: Recovery,
}

impl Kept {
    pub fn in_storage(storage: Storage) -> Self {
        Self { settings: EditorSettings::load(&storage), recovery: Recovery::new(&storage), storage }
    }
}
