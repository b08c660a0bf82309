//! A whole scene.

use super::SimParams;
use super::body_list::BodyList;
use super::types::{Body, Force, Map, Shape};

/// Everything a simulation needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub map: Map,
    /// Model seconds per wall-clock second while watching; never scales Δt.
    pub time_speed: f64,
    pub params: SimParams,
    pub forces: Vec<Force>,
    /// In file order.
    pub bodies: BodyList,
}

impl Scene {
    /// Whether a UserID stands twice, among bodies or among forces.
    pub fn has_repeated_ids(&self) -> bool {
        self.bodies.iter().any(Body::repeats_id) || self.forces.iter().any(Force::repeats_id)
    }

    /// Of the moving spheres, m; `None` without any.
    pub fn smallest_radius(&self) -> Option<f64> {
        let radii = self.bodies.iter().filter_map(|body| match body.shape {
            Shape::Sphere { radius } if body.is_dynamic() => Some(radius),
            _ => None,
        });
        radii.reduce(f64::min)
    }
}
