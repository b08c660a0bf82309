//! Looks at every pair of a running simulation with the reference's geometry, not the core's.

use glam::DVec3;
use polyscene::scene::{Scene, Shape};
use polyscene::sim::Simulation;

use polyscene::study::reference::geometry::{Surface, sphere_gap};

/// The bodies of a scene that does not change while it runs.
pub struct Monitor {
    /// Radius of each dynamic body, in UserID order as the simulation lists them.
    radii: Vec<f64>,
    statics: Vec<(String, Surface)>,
}

impl Monitor {
    pub fn new(scene: &Scene) -> Self {
        let mut bodies: Vec<_> = scene.bodies.iter().collect();
        bodies.sort_by_key(|body| body.id);
        let radii = bodies.iter().filter(|body| body.is_dynamic()).map(|body| match body.shape {
            Shape::Sphere { radius } => radius,
            ref other => panic!("a dynamic {other:?}"),
        });
        let statics = bodies.iter().filter(|body| !body.is_dynamic());
        Self {
            radii: radii.collect(),
            statics: statics
                .map(|body| (body.label.clone(), Surface::of(body).expect("a known shape")))
                .collect(),
        }
    }

    /// The deepest overlap of any pair now, m; 0 when none overlaps.
    pub fn worst_overlap(&self, sim: &Simulation) -> f64 {
        let positions = self.positions(sim);
        let mut worst = 0.0_f64;
        for (i, (&a, &radius)) in positions.iter().zip(&self.radii).enumerate() {
            for (&b, &other) in positions.iter().zip(&self.radii).take(i) {
                worst = worst.max(-sphere_gap(a, radius, b, other).distance);
            }
            for (_, surface) in &self.statics {
                worst = worst.max(-surface.gap(a, radius).distance);
            }
        }
        worst
    }

    /// How far any sphere reaches through the planes of these statics, whose normals point inwards.
    pub fn worst_escape(&self, sim: &Simulation, walls: &[i64]) -> f64 {
        let positions = self.positions(sim);
        let mut worst = f64::NEG_INFINITY;
        for (label, surface) in &self.statics {
            if walls.iter().any(|wall| wall.to_string() == *label) {
                for (&point, &radius) in positions.iter().zip(&self.radii) {
                    worst = worst.max(surface.depth_behind(point, radius).expect("a wall is a plate"));
                }
            }
        }
        worst
    }

    fn positions(&self, sim: &Simulation) -> Vec<DVec3> {
        let states = sim.dynamic_bodies().filter_map(|body| sim.state(body));
        let positions: Vec<_> = states.map(|state| state.position).collect();
        assert_eq!(positions.len(), self.radii.len(), "a body got lost");
        positions
    }
}
