//! Notices when another program changed the open file.

use std::fs::File;
use std::hash::{DefaultHasher, Hasher};
use std::io::{self, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};

/// What a file held at some time: enough to tell a change, also one that kept the length and the date.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct DiskStamp {
    length: u64,
    hash: u64,
}

impl DiskStamp {
    pub fn of(path: &Path) -> io::Result<Self> {
        let mut file = File::open(path)?;
        let mut hasher = DefaultHasher::new();
        let mut buffer = vec![0; 1 << 16];
        let mut length = 0;
        loop {
            let read = file.read(&mut buffer)?;
            if read == 0 {
                return Ok(Self { length, hash: hasher.finish() });
            }
            length += read as u64;
            hasher.write(buffer.get(..read).unwrap_or_default());
        }
    }
}

/// Whether the file no longer holds what it held at `stamp`; a file that is gone or cannot be read counts
/// as changed.
pub(super) fn has_changed(path: &Path, stamp: DiskStamp) -> bool {
    DiskStamp::of(path).ok() != Some(stamp)
}
