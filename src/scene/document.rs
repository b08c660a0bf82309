//! The lossless document and its edits.

use std::path::Path;

use glam::DVec3;

use super::{Body, Diagnostic, Force, ForceKind, NodeKey, Scene, Shape, SimParams};

/// How a new file writes its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum NumberStyle {
    /// `-9,8`, as the predecessor's tools wrote and read it.
    #[default]
    Comma,
    /// `-9.8`.
    Point,
}

/// A scene file in memory. Immutable: an edit gives a new document that shares what did not change,
/// so undo keeps the old one. Saving writes back the very bytes of everything not edited.
#[derive(Clone, Debug)]
pub struct Document {}

/// One change of the document. Each changes only the bytes it must.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    MapSize(DVec3),
    MapTiles([u32; 3]),
    TimeSpeed(f64),
    Params(SimParams),
    Body {
        key: NodeKey,
        change: BodyChange,
    },
    Force {
        key: NodeKey,
        change: ForceChange,
    },
    /// Adds a copy of `body` after the last body; its key and label are chosen, its id too if taken.
    AddBody(Box<Body>),
    AddForce(Box<Force>),
    /// Copies bodies and forces as they stand in the file, comments and unknown parts included, each
    /// after its original, with a fresh UserID, moved by `offset` metres.
    Duplicate {
        keys: Vec<NodeKey>,
        offset: DVec3,
    },
    Delete {
        keys: Vec<NodeKey>,
    },
    /// Gives a fresh UserID to every body (and force) whose id an earlier one has.
    MakeIdsUnique,
    /// Several edits as one.
    All(Vec<Edit>),
}

#[derive(Clone, Debug, PartialEq)]
pub enum BodyChange {
    Id(i64),
    Name(Option<String>),
    Color(Option<[u8; 3]>),
    Hidden(bool),
    Locked(bool),
    Position(DVec3),
    Rotation(DVec3),
    Bounce(f64),
    Material(Option<String>),
    /// Dynamic bodies only.
    Mass(f64),
    /// Dynamic bodies only.
    Velocity(DVec3),
    Shape(Shape),
}

#[derive(Clone, Debug, PartialEq)]
pub enum ForceChange {
    Id(i64),
    Name(Option<String>),
    Hidden(bool),
    Locked(bool),
    /// Same kind as before, other numbers.
    Kind(ForceKind),
}

/// A document after an edit, and the keys of what the edit added.
#[derive(Clone, Debug)]
pub struct Edited {
    pub document: Document,
    pub added: Vec<NodeKey>,
}

/// Why an edit was refused. The document is as it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EditError {
    #[error("that element is no longer in the scene")]
    Gone,
    #[error("{0}")]
    Invalid(String),
}

impl Document {
    /// An empty scene: a 10×10×10 m map of 10×10×10 tiles, no bodies, no forces.
    pub fn new(_style: NumberStyle) -> Self {
        todo!()
    }

    /// Reads a file's bytes, whatever they are. Never panics; every problem becomes a [`Diagnostic`].
    pub fn from_bytes(_bytes: &[u8]) -> Self {
        todo!()
    }

    /// Reads a file. A file that can't be read gives a diagnostic without a position.
    pub fn open(_path: &Path) -> Self {
        todo!()
    }

    /// What the document means; `None` if it has errors that leave no scene to work with.
    pub fn scene(&self) -> Option<&Scene> {
        todo!()
    }

    /// All problems, in the order of their places.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        todo!()
    }

    /// Whether any diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        self.diagnostics().iter().any(Diagnostic::is_error)
    }

    /// Line and column (1-based) and element path, for diagnostics that other layers make.
    pub fn place_of(&self, _key: NodeKey) -> (Option<(u32, u32)>, String) {
        todo!()
    }

    /// Why the file is Version 1.1: the new physics it uses, such as `SpaceAverse`. Empty for 1.0.
    pub fn reasons_for_1_1(&self) -> Vec<String> {
        todo!()
    }

    /// The file's bytes: in the encoding and with the line ends it came with.
    pub fn to_bytes(&self) -> Vec<u8> {
        todo!()
    }

    /// Writes the file atomically: temporary file beside it, sync, rename.
    pub fn save(&self, _path: &Path) -> std::io::Result<()> {
        todo!()
    }

    pub fn apply(&self, _edit: &Edit) -> Result<Edited, EditError> {
        todo!()
    }
}
