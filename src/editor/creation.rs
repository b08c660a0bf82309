//! New bodies and forces: sensible sizes for the map at hand, in a place that is free.

use compact_str::CompactString;
use glam::DVec3;

use super::{Addition, Outcome, Session};
use crate::design;
use crate::scene::{Body, Edit, Force, ForceKind, Motion, NodeKey, Scene, Shape};

/// Density of air, kg/m³, at 15 °C and sea level rounded as the predecessor had it.
const AIR_DENSITY: f64 = 1.276;

/// m/s².
const EARTH_GRAVITY: f64 = 9.81;

/// How many places around the middle of the map are tried for a new sphere.
const PLACES_TRIED: u32 = 400;

impl Session {
    /// Adds a body or force, and selects it.
    pub(super) fn add(&mut self, what: Addition) -> Outcome {
        let Some(scene) = self.scene() else { return Outcome::no_scene() };
        let middle = scene.map.size / 2.0;
        let edit = match what {
            Addition::SphereDynamic => {
                add_body(sphere(scene, Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO }))
            }
            Addition::SphereStatic => add_body(sphere(scene, Motion::Static)),
            Addition::Plane => add_body(plane(scene)),
            Addition::GravityPlane => add_force(
                scene,
                ForceKind::GravityPlane {
                    position: middle,
                    acceleration: DVec3::new(0.0, -EARTH_GRAVITY, 0.0),
                },
            ),
            Addition::GravityPoint => {
                add_force(scene, ForceKind::GravityPoint { position: middle, intensity: 8.0 })
            }
            Addition::Drag => add_force(scene, ForceKind::Drag { density: AIR_DENSITY }),
        };
        self.edit(&edit, None)
    }
}

fn add_body(body: Body) -> Edit {
    Edit::AddBody(Box::new(body))
}

fn add_force(scene: &Scene, kind: ForceKind) -> Edit {
    let id = scene.forces.iter().map(|force| force.id).max().unwrap_or(0).saturating_add(1);
    Edit::AddForce(Box::new(Force::new(id, kind)))
}

fn sphere(scene: &Scene, motion: Motion) -> Body {
    // 0.5 m in a map of 10 m
    let radius = design::round_size(scene.map.size.min_element() / 20.0);
    let position = free_place(scene, radius);
    Body { motion, position, ..blank(scene, Shape::Sphere { radius }) }
}

/// A level plate in the middle of the map, seen from above.
fn plane(scene: &Scene) -> Body {
    let half = design::round_size(scene.map.size.min_element() / 10.0);
    Body {
        position: scene.map.size / 2.0,
        rotation: DVec3::new(-std::f64::consts::FRAC_PI_2, 0.0, 0.0),
        ..blank(scene, Shape::Plane { half_x: half, half_y: half })
    }
}

fn blank(scene: &Scene, shape: Shape) -> Body {
    let id = scene.bodies.iter().map(|body| body.id).max().unwrap_or(0).saturating_add(1);
    Body {
        key: NodeKey::default(),
        label: CompactString::default(),
        ..Body::new(id, DVec3::ZERO, Motion::Static, shape)
    }
}

/// The first of some places around the middle of the map where a sphere touches nothing; the middle when
/// all are taken.
fn free_place(scene: &Scene, radius: f64) -> DVec3 {
    let middle = scene.map.size / 2.0;
    let reach = (scene.map.size / 2.0 - DVec3::splat(radius)).max(DVec3::ZERO);
    let spiral = (0..PLACES_TRIED).map(|k| {
        // a sunflower spiral in the level plane, then higher and higher: even cover without a pattern
        let share = f64::from(k) / f64::from(PLACES_TRIED);
        let angle = f64::from(k) * 2.399_963_229_728_653;
        let out = share.sqrt();
        middle
            + reach
                * DVec3::new(
                    out * libm::cos(angle),
                    (f64::from(k % 9) - 4.0) / 4.0 * share,
                    out * libm::sin(angle),
                )
    });
    let rounded = spiral.map(|place| (place * 1e3).round() / 1e3);
    rounded
        .into_iter()
        .find(|place| {
            let ball = Body::new(0, *place, Motion::Static, Shape::Sphere { radius });
            design::is_clear(scene, &[&ball], DVec3::ZERO)
        })
        .unwrap_or(middle)
}
