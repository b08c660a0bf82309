//! Paths in JSON. A name that is no UTF-8 cannot be a string there: it becomes its bytes, `{"bytes": [255]}`.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written<'a> {
    Text(Cow<'a, str>),
    Bytes { bytes: Vec<u8> },
}

impl<'a> Written<'a> {
    fn of(path: &'a Path) -> Self {
        match path.to_str() {
            Some(text) => Self::Text(text.into()),
            None => Self::Bytes { bytes: bytes_of(path) },
        }
    }

    fn into_path(self) -> PathBuf {
        match self {
            Self::Text(text) => text.into_owned().into(),
            Self::Bytes { bytes } => path_of(bytes),
        }
    }
}

#[cfg(unix)]
fn bytes_of(path: &Path) -> Vec<u8> {
    use std::os::unix::ffi::OsStrExt as _;
    path.as_os_str().as_bytes().to_vec()
}

#[cfg(unix)]
fn path_of(bytes: Vec<u8>) -> PathBuf {
    use std::os::unix::ffi::OsStringExt as _;
    std::ffi::OsString::from_vec(bytes).into()
}

/// Elsewhere names are Unicode but for unpaired surrogates, which are lost.
#[cfg(not(unix))]
fn bytes_of(path: &Path) -> Vec<u8> {
    path.to_string_lossy().into_owned().into_bytes()
}

#[cfg(not(unix))]
fn path_of(bytes: Vec<u8>) -> PathBuf {
    String::from_utf8_lossy(&bytes).into_owned().into()
}

/// For `#[serde(with)]` of an `Option<PathBuf>`.
pub(super) mod optional {
    use super::{Deserialize as _, Deserializer, PathBuf, Serialize as _, Serializer, Written};

    pub fn serialize<S: Serializer>(path: &Option<PathBuf>, serializer: S) -> Result<S::Ok, S::Error> {
        path.as_deref().map(Written::of).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<PathBuf>, D::Error> {
        Ok(Option::<Written<'_>>::deserialize(deserializer)?.map(Written::into_path))
    }
}

/// For `#[serde(with)]` of a `Vec<PathBuf>`.
pub(super) mod list {
    use super::{Deserialize as _, Deserializer, PathBuf, Serializer, Written};

    pub fn serialize<S: Serializer>(paths: &[PathBuf], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(paths.iter().map(|path| Written::of(path)))
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<PathBuf>, D::Error> {
        let paths = Vec::<Written<'_>>::deserialize(deserializer)?;
        Ok(paths.into_iter().map(Written::into_path).collect())
    }
}
