//! A recording as a file: the scene's bytes, how it was stepped, the edits, bookmarks, and hashes of the state along the way.
//! Whoever has it runs the same again and sees where, if anywhere, the runs part.

mod check;
mod error;
mod keys;
mod lines;
mod script;
#[cfg(test)]
mod tests;

pub use error::RecordingError;
pub(super) use script::{file_of, write};

use std::path::PathBuf;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};

use super::moment::Moment;
use crate::scene::{Diagnostic, Document, Scene, escaped};
use crate::sim::{Method, SimEdit};
use error::VERSION;
use keys::NamedKey;

/// What the file calls itself.
const FORMAT: &str = "polyscene recording";

/// Bytes in which it calls itself so.
const HEAD_BYTES: usize = 200;

/// Length of a Δt where none is recorded, s.
const USUAL_DT: f64 = 1.0 / 60.0;

/// Largest file that is read: scenes of 256 MiB and what belongs to them.
pub const MOST_BYTES: u64 = 512 << 20;

/// All of a recording that others need. Motion and events are not in it: they come again with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordingFile {
    format: String,
    version: u32,
    /// Version of the program that wrote it.
    pub build: String,
    /// Name of the scene's file.
    pub scene_name: String,
    /// Its bytes, in base64: they may be in any encoding.
    scene: String,
    /// `exact`, `thesis` or `fixed`.
    method: String,
    /// The Δt in the order in which they were taken.
    pub steps: Vec<Steps>,
    /// Edits while it ran, in the order of their moments.
    pub edits: Vec<EditsAt>,
    /// Whom they name.
    names: Vec<NamedKey>,
    /// How far it was simulated.
    pub end: Moment,
    /// States along the way.
    pub checkpoints: Vec<Checkpoint>,
    #[serde(default)]
    pub bookmarks: Vec<NamedMoment>,
}

/// So many Δt of one length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Steps {
    /// s.
    pub dt: f64,
    pub count: u64,
}

/// Edits made together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EditsAt {
    pub at: Moment,
    pub edits: Vec<SimEdit>,
    /// Whether bodies went on anew once, after all of them; files of older programs tell of runs in which they did after each.
    #[serde(default)]
    pub at_once: bool,
}

/// A moment with the hash of the simulation there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    pub at: Moment,
    /// Hexadecimal.
    pub hash: String,
    /// Where it was read: the line of the file, from 1.
    #[serde(skip)]
    pub line: Option<usize>,
}

/// A bookmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NamedMoment {
    pub name: String,
    /// s.
    pub time: f64,
    /// The event that it stands right at.
    pub event: Option<u64>,
}

/// A recording that is to be written.
#[derive(Clone, Debug)]
pub struct WriteRequest {
    pub path: PathBuf,
    /// Name of the scene's file, and the bytes that were loaded.
    pub scene_name: String,
    pub scene: Vec<u8>,
    pub bookmarks: Vec<NamedMoment>,
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    pub path: PathBuf,
    pub problem: Option<String>,
}

impl RecordingFile {
    pub(super) fn new(scene_name: &str, scene: &[u8], method: Method) -> Self {
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            build: env!("CARGO_PKG_VERSION").to_owned(),
            scene_name: scene_name.to_owned(),
            scene: STANDARD.encode(scene),
            method: method.name().to_owned(),
            steps: Vec::new(),
            edits: Vec::new(),
            names: Vec::new(),
            end: Moment::default(),
            checkpoints: Vec::new(),
            bookmarks: Vec::new(),
        }
    }

    /// Reads a file's bytes and checks all that they claim.
    pub fn read(bytes: &[u8]) -> Result<Self, RecordingError> {
        let malformed = |error: serde_json::Error| RecordingError::Malformed(error.to_string());
        let head: Head = serde_json::from_slice(bytes).map_err(|error| headless(bytes, &error))?;
        if head.format != FORMAT {
            return Err(RecordingError::Foreign(format!("its format is “{}”", escaped(&head.format))));
        }
        if head.version != VERSION {
            return Err(RecordingError::Version(head.version));
        }
        let mut file: Self = serde_json::from_slice(bytes).map_err(malformed)?;
        let lines = lines::of_checkpoints(bytes).map_err(malformed)?;
        for (checkpoint, line) in file.checkpoints.iter_mut().zip(lines) {
            checkpoint.line = Some(line);
        }
        file.check()?;
        Ok(file)
    }

    /// Whether a file's bytes begin as those of a recording do, sound or not.
    pub fn is_meant(bytes: &[u8]) -> bool {
        bytes.windows(FORMAT.len()).take(HEAD_BYTES).any(|text| text == FORMAT.as_bytes())
    }

    /// As a file has it.
    pub fn to_bytes(&self) -> Result<Vec<u8>, RecordingError> {
        let mut bytes =
            serde_json::to_vec_pretty(self).map_err(|error| RecordingError::Content(error.to_string()))?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    pub fn method(&self) -> Result<Method, RecordingError> {
        let found = Method::ALL.into_iter().find(|method| method.name() == self.method);
        found
            .ok_or_else(|| RecordingError::Content(format!("there is no method “{}”", escaped(&self.method))))
    }

    /// The scene's document.
    pub fn document(&self) -> Result<Document, RecordingError> {
        let bytes = STANDARD.decode(&self.scene);
        let bytes =
            bytes.map_err(|error| RecordingError::Content(format!("its scene is not base64: {error}")))?;
        Ok(Document::from_bytes(&bytes))
    }

    /// The scene itself.
    pub fn scene(document: &Document) -> Result<Scene, RecordingError> {
        let problem = document.diagnostics().iter().find(|problem| problem.is_error());
        match (problem, document.scene()) {
            (None, Some(scene)) => Ok(scene.clone()),
            (problem, _) => {
                let text = problem.map_or_else(|| "it means nothing".to_owned(), placed);
                Err(RecordingError::Scene(text))
            }
        }
    }

    /// Number of the recorded Δt that a time (s) lies in, from 1; at its end it belongs to the one that ends there.
    pub fn step_of(&self, time: f64) -> u64 {
        let (mut origin, mut before) = (0.0, 0);
        for &Steps { dt, count } in &self.steps {
            let end = |nth: u64| origin + nth as f64 * dt;
            if time <= end(count) {
                // The quotient may be off by its rounding.
                let near = (((time - origin) / dt).ceil().max(1.0) as u64).min(count);
                let first = (near.saturating_sub(1).max(1)..=near).find(|nth| time <= end(*nth));
                return before + first.unwrap_or((near + 1).min(count));
            }
            origin = end(count);
            before += count;
        }
        before + 1
    }
}

/// What is looked at before the rest.
#[derive(Deserialize)]
struct Head {
    format: String,
    version: u32,
}

/// What begins as recordings do was one; anything else never was.
fn headless(bytes: &[u8], error: &serde_json::Error) -> RecordingError {
    let kind =
        if RecordingFile::is_meant(bytes) { RecordingError::Malformed } else { RecordingError::Foreign };
    kind(error.to_string())
}

/// A problem with the line of the scene that it stands in.
fn placed(problem: &Diagnostic) -> String {
    match problem.position {
        Some((line, column)) => format!("line {line}, column {column}: {}", problem.message),
        None => problem.message.clone(),
    }
}
