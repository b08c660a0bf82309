//! What an edit touched: known from the edit itself, so that nobody compares whole scenes to find out.

use std::collections::BTreeSet;

use crate::scene::{Body, Force, NodeKey, Scene};

/// Bodies, forces and settings that an edit changed, added or removed.
///
/// An edit of one body may change the *label* of another that shares its UserID; that alone touches nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Touched {
    pub keys: BTreeSet<NodeKey>,
    /// Map, time speed or solver.
    pub settings: bool,
    /// What the simulation does not see: saved viewpoints, the order in the file.
    pub cosmetics: bool,
}

impl Touched {
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty() && !self.settings && !self.cosmetics
    }

    pub fn extend(&mut self, other: &Self) {
        self.keys.extend(&other.keys);
        self.settings |= other.settings;
        self.cosmetics |= other.cosmetics;
    }

    /// What of this differs between two scenes.
    pub fn that_differs(&self, before: &Scene, after: &Scene) -> Self {
        let (old, new) = (self.items(before), self.items(after));
        let keys = self.keys.iter().copied().filter(|key| old.get(key) != new.get(key)).collect();
        let settings = self.settings
            && (before.map != after.map
                || before.params != after.params
                || before.time_speed != after.time_speed);
        Self { keys, settings, cosmetics: self.cosmetics }
    }

    /// The touched bodies and forces of a scene.
    fn items<'s>(&self, scene: &'s Scene) -> std::collections::BTreeMap<NodeKey, Item<'s>> {
        let bodies = self.bodies(scene).map(|body| (body.key, Item::Body(body)));
        bodies.chain(self.forces(scene).map(|force| (force.key, Item::Force(force)))).collect()
    }

    /// The touched bodies of a scene, in file order.
    pub fn bodies<'s>(&self, scene: &'s Scene) -> impl Iterator<Item = &'s Body> {
        scene.bodies.iter().filter(|body| self.keys.contains(&body.key))
    }

    /// The touched forces of a scene, in file order.
    pub fn forces<'s>(&self, scene: &'s Scene) -> impl Iterator<Item = &'s Force> {
        scene.forces.iter().filter(|force| self.keys.contains(&force.key))
    }
}

#[derive(PartialEq)]
enum Item<'s> {
    Body(&'s Body),
    Force(&'s Force),
}
