//! What outlives a run: where it is kept, recent files and the last Δt.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::path_text;
use crate::record::DEFAULT_RECORDING_BYTES;
use crate::scene::write_private;

/// Most recent files remembered: what a menu shows without scrolling.
const MAX_RECENT: usize = 10;

/// MiB that a person may let a recording take: with less nothing can be gone back to, more no machine has.
pub const RECORDING_MIB: (u32, u32) = (1, 1 << 20);

/// Bytes of a MiB.
const MIB: usize = 1 << 20;

/// Folders for what outlives a run. `None` keeps nothing, as tests want it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Storage {
    /// Holds `settings.json`.
    pub config: Option<PathBuf>,
    /// Holds `recovery/`.
    pub data: Option<PathBuf>,
}

impl Storage {
    /// The user's own folders, as the platform has them.
    pub fn of_user() -> Self {
        let from_env =
            |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
        let home = from_env("HOME").or_else(|| from_env("USERPROFILE"));
        let folder = |first: &str, under_home: &str| {
            let base = from_env(first).or_else(|| home.as_ref().map(|home| home.join(under_home)));
            base.map(|base| base.join("polyscene"))
        };
        if cfg!(windows) {
            let base = folder("APPDATA", "AppData/Roaming");
            Self { config: base.clone(), data: base }
        } else if cfg!(target_os = "macos") {
            let base = folder("POLYSCENE_HOME", "Library/Application Support");
            Self { config: base.clone(), data: base }
        } else {
            Self {
                config: folder("XDG_CONFIG_HOME", ".config"),
                data: folder("XDG_DATA_HOME", ".local/share"),
            }
        }
    }
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct EditorSettings {
    /// Newest first.
    #[serde(with = "path_text::list")]
    pub recent: Vec<PathBuf>,
    /// Δt as typed last.
    pub dt: Option<String>,
    /// Bytes that the recording of a run may take.
    pub recording_bytes: Option<usize>,
}

impl EditorSettings {
    /// MiB that the recording of a run may take.
    pub fn recording_mib(&self) -> f64 {
        self.recording_bytes.unwrap_or(DEFAULT_RECORDING_BYTES) as f64 / MIB as f64
    }

    /// Keeps a typed number of MiB, or with `None` the default; gives the bytes, or says what is wrong.
    pub(super) fn set_recording_mib(&mut self, mib: Option<f64>) -> Result<usize, String> {
        let (low, high) = RECORDING_MIB;
        self.recording_bytes = match mib {
            None => None,
            Some(mib) if (f64::from(low)..=f64::from(high)).contains(&mib) => {
                Some((mib * MIB as f64) as usize)
            }
            Some(_) => {
                return Err(format!("The memory of a recording must lie between {low} and {high} MiB"));
            }
        };
        Ok(self.recording_bytes.unwrap_or(DEFAULT_RECORDING_BYTES))
    }

    /// Settings that cannot be read are the defaults: they hold nothing that matters.
    pub(super) fn load(storage: &Storage) -> Self {
        let text = settings_path(storage).and_then(|path| std::fs::read_to_string(path).ok());
        text.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }

    pub(super) fn store(&self, storage: &Storage) -> std::io::Result<()> {
        let Some(path) = settings_path(storage) else { return Ok(()) };
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        write_private(&path, serde_json::to_string_pretty(self)?.as_bytes())
    }

    pub(super) fn add_recent(&mut self, path: &Path) {
        self.recent.retain(|other| other != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MAX_RECENT);
    }
}

fn settings_path(storage: &Storage) -> Option<PathBuf> {
    storage.config.as_ref().map(|folder| folder.join("settings.json"))
}
