//! rapier3d's side: the same bodies and forces, and the settings it is measured with.

use glam::DVec3;
use polyscene::scene::{Body, ForceKind, Motion, Scene, Shape, rotation_matrix};
use rapier3d::prelude::*;

use crate::engines::{Ball, World};

/// One way to set the solver. All of them are measured and each counts with its best figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    pub name: &'static str,
    pub solver_iterations: usize,
    pub ccd_substeps: usize,
}

/// Rapier's solver iterations are substeps with the force held: more of them cost more and are better for
/// contacts and uniform gravity, but one is best for a force that changes along the way.
pub const SETTINGS: [Settings; 3] = [
    Settings { name: "1 iteration", solver_iterations: 1, ccd_substeps: 0 },
    Settings { name: "default", solver_iterations: 4, ccd_substeps: 1 },
    Settings { name: "8 iterations", solver_iterations: 8, ccd_substeps: 4 },
];

/// Steps per second.
pub const RATES: [f64; 4] = [60.0, 240.0, 1000.0, 4000.0];

pub struct Peer {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    attractors: Vec<(Vector, f32)>,
    rate: f64,
    steps: u64,
    /// Changes of velocity of each ball that no force explains, to count impacts by.
    watched: Option<Watch>,
}

struct Watch {
    before: Vector,
    impacts: u64,
}

impl Peer {
    /// `watch_first` counts the impacts of the first ball, at the price of looking at it after each step.
    pub fn new(scene: &Scene, dt: f64, settings: &Settings, watch_first: bool) -> Self {
        let mut world = PhysicsWorld::default();
        let parameters = &mut world.integration_parameters;
        parameters.dt = dt as f32;
        parameters.num_solver_iterations = settings.solver_iterations;
        parameters.max_ccd_substeps = settings.ccd_substeps;
        parameters.normalized_max_linear_velocity = f32::MAX;
        world.gravity = Vector::ZERO;
        let mut attractors = Vec::new();
        for force in &scene.forces {
            match force.kind {
                ForceKind::GravityPlane { acceleration, .. } => world.gravity += narrow(acceleration),
                ForceKind::GravityPoint { position, intensity } => {
                    attractors.push((narrow(position), intensity as f32));
                }
                ForceKind::Drag { .. } => {}
            }
        }
        let mut bodies: Vec<&Body> = scene.bodies.iter().collect();
        bodies.sort_by_key(|body| body.id);
        let inside = middle(&bodies);
        let mut moving = Vec::new();
        for body in bodies {
            let (handle, _) = world.insert(rigid_body(body), collider(body, inside));
            if body.is_dynamic() {
                moving.push(handle);
            }
        }
        let watched = (watch_first && !moving.is_empty())
            .then(|| Watch { before: world.bodies[moving[0]].linvel(), impacts: 0 });
        Self { world, bodies: moving, attractors, rate: 1.0 / dt, steps: 0, watched }
    }

    fn step(&mut self) {
        if !self.attractors.is_empty() {
            for handle in &self.bodies {
                let body = &mut self.world.bodies[*handle];
                let (at, mass) = (body.translation(), body.mass());
                let force = self.attractors.iter().map(|(center, intensity)| {
                    let r = *center - at;
                    r * (mass * intensity / r.length().powi(3))
                });
                let force: Vector = force.fold(Vector::ZERO, |sum, force| sum + force);
                body.reset_forces(true);
                body.add_force(force, true);
            }
        }
        self.world.step();
        self.steps += 1;
        if let Some(watch) = &mut self.watched {
            let now = self.world.bodies[self.bodies[0]].linvel();
            watch.impacts += u64::from((now - watch.before).length() > 1e-4 * now.length());
            watch.before = now;
        }
    }
}

impl World for Peer {
    fn advance(&mut self, time: f64) {
        let steps = (time * self.rate).round() as u64;
        while self.steps < steps {
            self.step();
        }
    }

    fn read(&self, into: &mut Vec<Ball>) {
        into.clear();
        into.extend(self.bodies.iter().map(|handle| {
            let body = &self.world.bodies[*handle];
            Ball { position: widen(body.translation()), velocity: widen(body.linvel()) }
        }));
    }

    fn impacts(&self) -> Option<u64> {
        self.watched.as_ref().map(|watch| watch.impacts)
    }
}

fn rigid_body(body: &Body) -> RigidBodyBuilder {
    let builder = match body.motion {
        Motion::Static => RigidBodyBuilder::fixed(),
        Motion::Dynamic { velocity, .. } => RigidBodyBuilder::dynamic().linvel(narrow(velocity)),
    };
    builder.translation(narrow(body.position))
}

/// No friction, Bounce values multiplied, mass as given. A plate is a half-space that faces the balls: it is
/// the quickest and the safest against tunnelling, and no ball in these scenes goes past a plate's edge.
fn collider(body: &Body, inside: DVec3) -> ColliderBuilder {
    let builder = match body.shape {
        Shape::Sphere { radius } => ColliderBuilder::ball(radius as f32),
        _ => ColliderBuilder::new(SharedShape::halfspace(narrow(facing(body, inside)))),
    };
    let builder = match body.motion {
        Motion::Dynamic { mass, .. } => builder.mass(mass as f32),
        Motion::Static => builder,
    };
    builder
        .friction(0.0)
        .restitution(body.bounce as f32)
        .restitution_combine_rule(CoefficientCombineRule::Multiply)
}

/// Mean place of the balls, m.
fn middle(bodies: &[&Body]) -> DVec3 {
    let moving = bodies.iter().filter(|body| body.is_dynamic());
    let (sum, count) = moving.fold((DVec3::ZERO, 0.0_f64), |(sum, n), body| (sum + body.position, n + 1.0));
    sum / count.max(1.0)
}

/// The plate's normal on the side of `inside`.
fn facing(body: &Body, inside: DVec3) -> DVec3 {
    let normal = rotation_matrix(body.rotation).z_axis;
    if normal.dot(inside - body.position) < 0.0 { -normal } else { normal }
}

fn narrow(v: DVec3) -> Vector {
    Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

fn widen(v: Vector) -> DVec3 {
    DVec3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z))
}
