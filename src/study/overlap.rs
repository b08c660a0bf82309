//! The deepest overlap of any two bodies, by a sweep along x with the reference's geometry: what the core
//! believes about its tiles plays no part.

use glam::DVec3;

use super::reference::geometry::{Surface, dynamic_radius, sphere_gap};
use crate::scene::Scene;

/// The shapes of a scene that does not change while it runs.
pub struct OverlapMonitor {
    /// Of the dynamic bodies, in the order of the file.
    radii: Vec<f64>,
    statics: Vec<Surface>,
    /// Tests of a pair that may still be made at events.
    budget: u64,
}

/// So many tests of a pair take about a second.
const TESTS: u64 = 30_000_000;

impl OverlapMonitor {
    pub fn new(scene: &Scene) -> Self {
        let statics = scene.bodies.iter().filter(|body| !body.is_dynamic());
        Self {
            radii: scene.bodies.iter().filter_map(dynamic_radius).collect(),
            statics: statics.filter_map(Surface::of).collect(),
            budget: TESTS,
        }
    }

    /// Whether there is time left to look at every event too, not at samples alone.
    pub fn may_look_often(&mut self) -> bool {
        let tests = self.radii.len() as u64 * (8 + self.statics.len() as u64);
        self.budget = self.budget.saturating_sub(tests);
        self.budget > 0
    }

    /// The deepest overlap, m, ≥ 0; `positions` in the order of the file.
    pub fn worst(&self, positions: &[DVec3]) -> f64 {
        let mut worst = 0.0_f64;
        let mut balls: Vec<(DVec3, f64)> =
            positions.iter().copied().zip(self.radii.iter().copied()).collect();
        balls.sort_by(|left, right| (left.0.x - left.1).total_cmp(&(right.0.x - right.1)));
        for (nth, &(a, radius)) in balls.iter().enumerate() {
            for &(b, other) in balls[nth + 1..].iter().take_while(|(b, other)| b.x - other < a.x + radius) {
                worst = worst.max(-sphere_gap(a, radius, b, other).distance);
            }
            for surface in &self.statics {
                worst = worst.max(-surface.gap(a, radius).distance);
            }
        }
        worst
    }
}
