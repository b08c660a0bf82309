//! The deepest overlap of any two bodies, with the reference's geometry: what the core believes about its tiles
//! plays no part.

use glam::DVec3;

use super::reference::geometry::{Surface, dynamic_radius, sphere_gap};
use crate::scene::{Body, Scene};
use crate::sim::Simulation;

/// The shapes of a scene that is not edited while it runs.
#[derive(Clone, Debug)]
pub struct OverlapMonitor {
    /// Radius of each dynamic body, m, in the order in which positions are given.
    radii: Vec<f64>,
    /// UserID and surface.
    statics: Vec<(i64, Surface)>,
}

impl OverlapMonitor {
    /// For positions in the order of the file.
    pub fn in_file_order(scene: &Scene) -> Self {
        Self::of(&scene.bodies.iter().collect::<Vec<_>>())
    }

    /// For positions in UserID order, as a simulation lists its bodies.
    pub fn in_id_order(scene: &Scene) -> Self {
        let mut bodies: Vec<_> = scene.bodies.iter().collect();
        bodies.sort_by_key(|body| body.id);
        Self::of(&bodies)
    }

    fn of(bodies: &[&Body]) -> Self {
        let statics = bodies.iter().filter(|body| !body.is_dynamic());
        Self {
            radii: bodies.iter().filter_map(|body| dynamic_radius(body)).collect(),
            statics: statics.filter_map(|body| Some((body.id, Surface::of(body)?))).collect(),
        }
    }

    /// About how many pairs one look at all of them tests.
    pub fn tests(&self) -> u64 {
        self.radii.len() as u64 * (8 + self.statics.len() as u64)
    }

    /// The deepest overlap of any two bodies, m, ≥ 0: a sweep along x, so that pairs far apart cost nothing.
    pub fn worst(&self, positions: &[DVec3]) -> f64 {
        let mut worst = 0.0_f64;
        let mut balls: Vec<(DVec3, f64)> =
            positions.iter().copied().zip(self.radii.iter().copied()).collect();
        balls.sort_by(|left, right| (left.0.x - left.1).total_cmp(&(right.0.x - right.1)));
        for (nth, &(a, radius)) in balls.iter().enumerate() {
            for &(b, other) in balls[nth + 1..].iter().take_while(|(b, other)| b.x - other < a.x + radius) {
                worst = worst.max(-sphere_gap(a, radius, b, other).distance);
            }
            worst = worst.max(self.worst_with_statics(a, radius));
        }
        worst
    }

    /// The deepest overlap of one dynamic body with any other, m, ≥ 0.
    pub fn worst_of(&self, nth: usize, positions: &[DVec3]) -> f64 {
        let (Some(&own), Some(&radius)) = (positions.get(nth), self.radii.get(nth)) else { return 0.0 };
        let others = positions.iter().zip(&self.radii).enumerate().filter(|(other, _)| *other != nth);
        let overlaps = others.map(|(_, (&at, &other))| -sphere_gap(own, radius, at, other).distance);
        overlaps.fold(self.worst_with_statics(own, radius), f64::max)
    }

    /// The deepest overlap in a simulation now, m; infinite when it lost a body. For positions in UserID order.
    pub fn worst_now(&self, sim: &Simulation) -> f64 {
        let positions = positions(sim);
        if positions.len() == self.radii.len() { self.worst(&positions) } else { f64::INFINITY }
    }

    /// How far any sphere of a simulation reaches now through the planes of these plates, whose normals point
    /// inwards, m; negative when all are clear of them. For positions in UserID order.
    pub fn worst_escape(&self, sim: &Simulation, plates: &[i64]) -> f64 {
        let positions = positions(sim);
        let chosen = self.statics.iter().filter(|(id, _)| plates.contains(id));
        let depths = chosen.flat_map(|(_, surface)| {
            let balls = positions.iter().zip(&self.radii);
            balls.filter_map(|(&point, &radius)| surface.depth_behind(point, radius))
        });
        depths.fold(f64::NEG_INFINITY, f64::max)
    }

    fn worst_with_statics(&self, position: DVec3, radius: f64) -> f64 {
        let overlaps = self.statics.iter().map(|(_, surface)| -surface.gap(position, radius).distance);
        overlaps.fold(0.0, f64::max)
    }
}

/// Of the dynamic bodies, in UserID order.
fn positions(sim: &Simulation) -> Vec<DVec3> {
    sim.dynamic_bodies().filter_map(|body| sim.state(body)).map(|state| state.position).collect()
}
