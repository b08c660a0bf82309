//! The copies made last: the next ones go on by the same step.

use glam::DVec3;

use crate::scene::{NodeKey, Scene};

/// The copies made last, so that the next ones go on from them.
#[derive(Clone, Debug)]
pub(super) struct LastCopies {
    /// The first body that was copied, and the copies in the order of their originals.
    pub original: NodeKey,
    pub copies: Vec<NodeKey>,
}

impl LastCopies {
    /// From the originals to the copies as they lie now, if these are what is selected.
    pub fn step(&self, scene: &Scene, selected: &[NodeKey]) -> Option<DVec3> {
        let place = |key: NodeKey| scene.bodies.iter().find(|body| body.key == key).map(|body| body.position);
        if selected != self.copies {
            return None;
        }
        let step = self.copies.iter().find_map(|key| place(*key))? - place(self.original)?;
        (step != DVec3::ZERO).then_some(step)
    }
}
