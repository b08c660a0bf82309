//! Where the dynamic bodies have been lately.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use glam::DVec3;

use crate::record::Frame;
use crate::scene::NodeKey;

/// Places kept per body.
const LENGTH: usize = 160;

/// The last places of one body, oldest first, m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trail {
    pub points: VecDeque<DVec3>,
}

/// The trails of all bodies. Give it every frame that is shown.
#[derive(Clone, Debug, Default)]
pub struct Trails {
    trails: BTreeMap<NodeKey, Trail>,
    time: f64,
    revision: u64,
}

impl Trails {
    /// Adds a frame's positions. A frame that is not later than the last one starts anew: the
    /// simulation was reset or went back.
    pub fn push(&mut self, frame: &Frame) {
        if frame.time == self.time && !self.trails.is_empty() {
            return;
        }
        if frame.time < self.time {
            self.trails.clear();
        }
        self.time = frame.time;
        self.revision += 1;
        let there: BTreeSet<NodeKey> = frame.bodies.iter().map(|body| body.key).collect();
        self.trails.retain(|key, _| there.contains(key));
        for body in &frame.bodies {
            let points = &mut self.trails.entry(body.key).or_default().points;
            if points.len() == LENGTH {
                points.pop_front();
            }
            points.push_back(body.position);
        }
    }

    pub fn clear(&mut self) {
        let revision = self.revision + 1;
        *self = Self { revision, ..Self::default() };
    }

    pub fn get(&self, key: NodeKey) -> Option<&Trail> {
        self.trails.get(&key)
    }

    /// Grows with every change.
    pub fn revision(&self) -> u64 {
        self.revision
    }
}
