//! One world of rapier's: the same bodies and forces.

use glam::DVec3;
use polyscene::scene::{Body, ForceKind, Motion, Scene, Shape, rotation_matrix};

use super::Real;
use super::engine::prelude::*;
use crate::engines::{Ball, World};
use crate::peer::{Settings, Walls};

pub struct Peer {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    attractors: Vec<(Vector, Real)>,
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
    pub fn new(scene: &Scene, dt: f64, settings: &Settings, walls: Walls, watch_first: bool) -> Self {
        let mut world = PhysicsWorld::default();
        let parameters = &mut world.integration_parameters;
        parameters.dt = dt as Real;
        parameters.num_solver_iterations = settings.solver_iterations;
        parameters.max_ccd_substeps = settings.ccd_substeps;
        parameters.normalized_max_linear_velocity = Real::MAX;
        world.gravity = Vector::ZERO;
        let mut attractors = Vec::new();
        for force in &scene.forces {
            match force.kind {
                ForceKind::GravityPlane { acceleration, .. } => world.gravity += narrow(acceleration),
                ForceKind::GravityPoint { position, intensity } => {
                    attractors.push((narrow(position), intensity as Real));
                }
                ForceKind::Drag { .. } => {}
            }
        }
        let mut bodies: Vec<&Body> = scene.bodies.iter().collect();
        bodies.sort_by_key(|body| body.id);
        let inside = middle(&bodies);
        let mut moving = Vec::new();
        for body in bodies {
            let (handle, _) = world.insert(rigid_body(body), collider(body, inside, walls));
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
    fn advance(&mut self, time: f64) -> bool {
        let steps = (time * self.rate).round() as u64;
        while self.steps < steps {
            self.step();
        }
        true
    }

    fn time(&self) -> f64 {
        self.steps as f64 / self.rate
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
        Motion::Dynamic { velocity, .. } => {
            RigidBodyBuilder::dynamic().linvel(narrow(velocity)).angvel(narrow(body.spin))
        }
    };
    builder.translation(narrow(body.position))
}

/// The geometric mean of both frictions, Bounce values multiplied, mass as given. No ball in these scenes goes past a plate's edge, so that a
/// half-space will do for a plate too.
fn collider(body: &Body, inside: DVec3, walls: Walls) -> ColliderBuilder {
    let builder = match (&body.shape, walls) {
        (&Shape::Sphere { radius }, _) => ColliderBuilder::ball(radius as Real),
        (&Shape::Plane { half_x, half_y }, Walls::Boxes) => thick_box(body, inside, half_x, half_y),
        _ => ColliderBuilder::new(SharedShape::halfspace(narrow(facing(body, inside)))),
    };
    let builder = match body.motion {
        Motion::Dynamic { mass, .. } => builder.mass(mass as Real),
        Motion::Static => builder,
    };
    builder
        .friction(body.roughness.friction as Real)
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .restitution(body.bounce as Real)
        .restitution_combine_rule(CoefficientCombineRule::Multiply)
}

/// A box as thick as the plate is long, so that nothing tunnels, whose face is the plate.
fn thick_box(body: &Body, inside: DVec3, half_x: f64, half_y: f64) -> ColliderBuilder {
    let (normal, turned) = (facing(body, inside), rotation_matrix(body.rotation));
    let half_z = half_x.max(half_y);
    let axes = [turned.x_axis, turned.y_axis, turned.z_axis].map(narrow);
    let rotation = Rotation::from_mat3(&Matrix::from_cols(axes[0], axes[1], axes[2]));
    let pose = Pose::from_parts(narrow(normal * -half_z), rotation);
    ColliderBuilder::cuboid(half_x as Real, half_y as Real, half_z as Real).position(pose)
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
    Vector::new(v.x as Real, v.y as Real, v.z as Real)
}

fn widen(v: Vector) -> DVec3 {
    DVec3::new(v.x as f64, v.y as f64, v.z as f64)
}
