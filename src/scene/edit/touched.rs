//! What an edit touched: known from the edit itself, so that nobody compares whole scenes to find out.

use std::collections::{BTreeMap, BTreeSet};

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
        let bodies = self.differing(before.bodies.as_slice(), after.bodies.as_slice(), |body| body.key);
        let forces = self.differing(&before.forces, &after.forces, |force| force.key);
        let keys = bodies.into_iter().chain(forces).collect();
        let settings = self.settings
            && (before.map != after.map
                || before.params != after.params
                || before.time_speed != after.time_speed);
        Self { keys, settings, cosmetics: self.cosmetics }
    }

    /// The touched items of a list that differ or are in one of both versions only.
    fn differing<T: PartialEq>(&self, before: &[T], after: &[T], key: fn(&T) -> NodeKey) -> Vec<NodeKey> {
        let pairs = || before.iter().zip(after);
        // Most edits leave the order of the list, where what belongs together stands in one place.
        if before.len() == after.len() && pairs().all(|(old, new)| key(old) == key(new)) {
            let touched = pairs().filter(|(_, new)| self.keys.contains(&key(new)));
            return touched.filter(|(old, new)| old != new).map(|(_, new)| key(new)).collect();
        }
        let by_key = |items: &'_ [T]| items.iter().enumerate().map(|(at, item)| (key(item), at)).collect();
        let (old, new): (BTreeMap<NodeKey, usize>, BTreeMap<NodeKey, usize>) =
            (by_key(before), by_key(after));
        let of_old = |of: &NodeKey| old.get(of).and_then(|at| before.get(*at));
        let of_new = |of: &NodeKey| new.get(of).and_then(|at| after.get(*at));
        self.keys.iter().copied().filter(|of| of_old(of) != of_new(of)).collect()
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
