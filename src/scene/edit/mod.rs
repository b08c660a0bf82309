//! Edits: each gives a new document and changes only the bytes it must.

mod body;
mod compose;
mod cosmetic;
mod force;
mod moves;
mod order;
mod patch;
mod pen;
mod settings;
mod structure;
mod style;
mod touched;
mod work;

use glam::DVec3;

use super::{Body, Document, Force, ForceKind, NodeKey, Shape, SimParams, Viewpoint};

pub(super) use style::Style;
pub use touched::Touched;

/// One change of the document. Each changes only the bytes it must.
#[derive(Clone, Debug, PartialEq)]
pub enum Edit {
    MapSize(DVec3),
    MapTiles([u32; 3]),
    TimeSpeed(f64),
    Params(SimParams),
    /// All saved viewpoints.
    Viewpoints(Vec<Viewpoint>),
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
    /// Copies bodies and forces as they stand in the file, comments and unknown parts included, to the end of
    /// their list, with a fresh UserID and the next name (`wall 2`), moved by `offset` metres. At the end, so
    /// that no other body changes its place, by which views choose colours.
    Duplicate {
        keys: Vec<NodeKey>,
        offset: DVec3,
    },
    /// Copies bodies likewise, each with changes of its own.
    CopyBodies(Vec<BodyCopy>),
    Delete {
        keys: Vec<NodeKey>,
    },
    /// Puts bodies or forces elsewhere in the list of the file, in the order they have, with the comments about them.
    /// What they mean stays the same to the bit.
    Reorder {
        keys: Vec<NodeKey>,
        side: Side,
        /// One of the same list; it may be among those that move.
        anchor: NodeKey,
    },
    /// Gives a fresh UserID to every body (and force) whose id an earlier one has.
    MakeIdsUnique,
    /// Several edits as one.
    All(Vec<Edit>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Before,
    After,
}

/// A body to copy, and what is different about the copy.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyCopy {
    pub of: NodeKey,
    pub changes: Vec<BodyChange>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum BodyChange {
    Id(i64),
    Name(Option<String>),
    /// `None` takes it out of its group.
    Group(Option<String>),
    Color(Option<[u8; 3]>),
    Hidden(bool),
    Locked(bool),
    Position(DVec3),
    Rotation(DVec3),
    Bounce(f64),
    Friction(f64),
    RollingFriction(f64),
    Tangential(f64),
    Material(Option<String>),
    /// Dynamic bodies only.
    Mass(f64),
    /// Dynamic bodies only.
    Velocity(DVec3),
    /// Dynamic bodies only.
    Spin(DVec3),
    Shape(Shape),
}

#[derive(Clone, Debug, PartialEq)]
pub enum ForceChange {
    Id(i64),
    Name(Option<String>),
    /// `None` takes it out of its group.
    Group(Option<String>),
    Hidden(bool),
    Locked(bool),
    /// Same kind as before, other numbers.
    Kind(ForceKind),
}

/// A document after an edit, and what the edit did.
#[derive(Clone, Debug)]
pub struct Edited {
    pub document: Document,
    pub added: Vec<NodeKey>,
    pub touched: Touched,
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
    /// Applies an edit. The document it is applied to stays as it is, and is what undo goes back to.
    pub fn apply(&self, edit: &Edit) -> Result<Edited, EditError> {
        if let Some(moved) = moves::moved(self, edit) {
            return Ok(moved);
        }
        let mut work = work::Work::on(self)?;
        work.apply(edit)?;
        work.finish()
    }
}
