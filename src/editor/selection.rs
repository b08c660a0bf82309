//! What is selected: bodies and forces by their document keys, or the map or the simulation.

use std::collections::BTreeSet;

use crate::scene::{NodeKey, Scene, Touched};

/// What the inspector can show that is neither a body nor a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    Map,
    Simulation,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// In the order of selecting: the last one is the primary.
    keys: Vec<NodeKey>,
    /// The same, for lists that ask of each of their rows.
    known: BTreeSet<NodeKey>,
    place: Option<Place>,
}

impl Selection {
    pub fn keys(&self) -> &[NodeKey] {
        &self.keys
    }

    /// The one selected last, which gizmos and single values belong to.
    pub fn primary(&self) -> Option<NodeKey> {
        self.keys.last().copied()
    }

    pub fn place(&self) -> Option<Place> {
        self.place
    }

    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    pub fn len(&self) -> usize {
        self.keys.len()
    }

    pub fn contains(&self, key: NodeKey) -> bool {
        self.known.contains(&key)
    }

    /// Selects these and nothing else.
    pub fn set(&mut self, keys: &[NodeKey]) {
        self.clear();
        self.add(keys);
    }

    pub fn add(&mut self, keys: &[NodeKey]) {
        self.place = None;
        self.keys.extend(keys.iter().filter(|key| self.known.insert(**key)));
    }

    pub fn toggle(&mut self, key: NodeKey) {
        if self.known.remove(&key) {
            self.keys.retain(|other| *other != key);
        } else {
            self.add(&[key]);
        }
    }

    pub fn set_place(&mut self, place: Place) {
        self.clear();
        self.place = Some(place);
    }

    pub fn clear(&mut self) {
        self.keys.clear();
        self.known.clear();
        self.place = None;
    }

    /// Forgets what is no longer in the scene after an edit; only what that touched can have gone.
    pub fn purge(&mut self, scene: Option<&Scene>, touched: &Touched) {
        let Some(scene) = scene else {
            self.keys.clear();
            self.known.clear();
            return;
        };
        let there =
            || touched.bodies(scene).map(|body| body.key).chain(touched.forces(scene).map(|force| force.key));
        if self.keys.is_empty() || there().count() == touched.keys.len() {
            return;
        }
        let there: BTreeSet<NodeKey> = there().collect();
        let stays = |key: &NodeKey| there.contains(key) || !touched.keys.contains(key);
        self.keys.retain(stays);
        self.known.retain(stays);
    }
}
