//! The scene files of the repository.

use std::path::PathBuf;

use polyscene::scene::{Document, Scene};

pub fn scene_path(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes").join(file)
}

/// A scene of `scenes/`, which must have no errors.
pub fn load(file: &str) -> Scene {
    let document = Document::open(&scene_path(file));
    assert!(!document.has_errors(), "{file}: {:?}", document.diagnostics());
    document.scene().unwrap_or_else(|| panic!("{file}: no scene")).clone()
}
