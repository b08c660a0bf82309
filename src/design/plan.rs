//! What a tool is given, and what it gives back.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::scene::{Body, Edit, Force, NodeKey, Scene};

/// How the active view looks at the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// What it looks at.
    pub focus: DVec3,
    /// Unit vectors: to the right of the view, and from the scene to the eye.
    pub right: DVec3,
    pub towards: DVec3,
}

impl Default for Eye {
    /// From the front, at the origin.
    fn default() -> Self {
        Self { focus: DVec3::ZERO, right: DVec3::X, towards: DVec3::Z }
    }
}

/// The scene, the selection and the view that a tool works on.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a> {
    pub scene: &'a Scene,
    /// What is selected, in the order of selecting.
    pub keys: &'a [NodeKey],
    pub eye: Eye,
}

impl<'a> Given<'a> {
    /// Selected bodies in file order.
    pub fn bodies(&self) -> Vec<&'a Body> {
        let keys: BTreeSet<NodeKey> = self.keys.iter().copied().collect();
        self.scene.bodies.iter().filter(|body| keys.contains(&body.key)).collect()
    }

    /// Selected bodies that may be moved, in file order.
    pub fn movable(&self) -> Vec<&'a Body> {
        self.bodies().into_iter().filter(|body| !body.locked).collect()
    }

    /// Selected forces in file order.
    pub fn forces(&self) -> Vec<&'a Force> {
        let keys: BTreeSet<NodeKey> = self.keys.iter().copied().collect();
        self.scene.forces.iter().filter(|force| keys.contains(&force.key)).collect()
    }
}

/// What a tool does: edits that make one undo step, and what is selected then.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// What the Edit menu calls it, such as `Add a rack`.
    pub label: String,
    pub edits: Vec<Edit>,
    /// What to select; `None` selects what was added.
    pub select: Option<Vec<NodeKey>>,
    /// What a person should know about it, such as `38 of 50 found room`.
    pub remark: Option<String>,
}

impl Plan {
    pub fn new(label: impl Into<String>, edits: Vec<Edit>) -> Self {
        Self { label: label.into(), edits, select: None, remark: None }
    }

    /// Bodies and forces that it adds.
    pub fn added(&self) -> usize {
        self.edits.iter().map(added).sum()
    }
}

fn added(edit: &Edit) -> usize {
    match edit {
        Edit::AddBody(_) | Edit::AddForce(_) => 1,
        Edit::Duplicate { keys, .. } => keys.len(),
        Edit::CopyBodies(copies) => copies.len(),
        Edit::All(edits) => edits.iter().map(added).sum(),
        _ => 0,
    }
}
