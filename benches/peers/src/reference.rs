//! Closed forms of the scenes, in the order of the bodies' UserIDs.

use std::f64::consts::PI;

use glam::DVec3;
use polyscene::scene::{Body, ForceKind, Motion, Scene, Shape, rotation_matrix};

use crate::engines::Ball;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// x = x₀ + v₀t + ½gt².
    Throw,
    /// The same, thrown back from the floor without loss.
    Bounce,
    /// Equal balls on a line between two walls along x, without loss.
    Row,
    /// An ellipse around the attractor, started at an apse.
    Kepler,
    /// Two balls on a line along z and a wall (Galperin 2003).
    Pi,
    /// A ball without spin on a plate that falls along x: it slides until |s₀|/(7/2 μ a_n − a_t), then rolls with 5/7 a_t.
    Roll,
    /// Chaotic, and loses nothing: none.
    None,
    /// Balls that come to rest: no closed form, but they must not overlap or gain energy.
    Pile,
}

impl Reference {
    /// All balls at time `t`, s; `None` where there is no closed form.
    pub fn at(self, scene: &Scene, t: f64) -> Option<Vec<Ball>> {
        let balls = moving(scene);
        match self {
            Self::Throw => Some(vec![throw(balls[0], gravity(scene), t)]),
            Self::Bounce => Some(vec![bounce(scene, balls[0], t)]),
            Self::Row => Some(row(scene, &balls, t)),
            Self::Kepler => Some(vec![kepler(scene, balls[0], t)]),
            Self::Pi => Some(pi(&balls, t).0),
            Self::Roll => Some(vec![roll(scene, balls[0], t)]),
            Self::None | Self::Pile => None,
        }
    }

    /// Impacts until `t`, where they are worth counting.
    pub fn impacts(self, scene: &Scene, t: f64) -> Option<u64> {
        (self == Self::Pi).then(|| pi(&moving(scene), t).1)
    }
}

/// The dynamic bodies in the order of their UserIDs.
pub fn moving(scene: &Scene) -> Vec<&Body> {
    let mut balls: Vec<&Body> = scene.bodies.iter().filter(|body| body.is_dynamic()).collect();
    balls.sort_by_key(|body| body.id);
    balls
}

pub fn mass_and_velocity(body: &Body) -> (f64, DVec3) {
    match body.motion {
        Motion::Dynamic { mass, velocity } => (mass, velocity),
        Motion::Static => (f64::INFINITY, DVec3::ZERO),
    }
}

pub fn radius(body: &Body) -> f64 {
    match body.shape {
        Shape::Sphere { radius } => radius,
        _ => 0.0,
    }
}

pub fn gravity(scene: &Scene) -> DVec3 {
    let uniform = scene.forces.iter().map(|force| match force.kind {
        ForceKind::GravityPlane { acceleration, .. } => acceleration,
        _ => DVec3::ZERO,
    });
    uniform.sum()
}

fn throw(ball: &Body, gravity: DVec3, t: f64) -> Ball {
    let (_, velocity) = mass_and_velocity(ball);
    Ball { position: ball.position + t * (velocity + 0.5 * t * gravity), velocity: velocity + t * gravity }
}

/// Dropped from rest: flights of equal length, a half one first.
fn roll(scene: &Scene, ball: &Body, t: f64) -> Ball {
    let (_, velocity) = mass_and_velocity(ball);
    let plates = scene.bodies.iter().filter(|body| !body.is_dynamic());
    let normal = plates.map(|body| rotation_matrix(body.rotation).z_axis).sum::<DVec3>();
    let (pull, friction) = (gravity(scene), ball.roughness.friction);
    let load = -pull.dot(normal);
    let along = pull + load * normal;
    let direction = velocity.normalize_or_zero();
    let ends = velocity.length() / (3.5 * friction * load - along.dot(direction));
    let sliding = along - friction * load * direction;
    let (slid, rolled) = (t.min(ends), (t - ends).max(0.0));
    let rolling = along * (5.0 / 7.0);
    let then = velocity + slid * sliding;
    let way = slid * (velocity + 0.5 * slid * sliding) + rolled * (then + 0.5 * rolled * rolling);
    Ball { position: ball.position + way, velocity: then + rolled * rolling }
}

fn bounce(scene: &Scene, ball: &Body, t: f64) -> Ball {
    let floor = scene.bodies.iter().find(|body| !body.is_dynamic()).map_or(0.0, |body| body.position.y);
    let (g, lowest) = (-gravity(scene).y, floor + radius(ball));
    let half = (2.0 * (ball.position.y - lowest) / g).sqrt();
    // Time since the top of the present flight.
    let since_top = (t + half).rem_euclid(2.0 * half) - half;
    let y = ball.position.y - 0.5 * g * since_top * since_top;
    Ball {
        position: DVec3::new(ball.position.x, y, ball.position.z),
        velocity: DVec3::new(0.0, -g * since_top, 0.0),
    }
}

/// With their lengths taken out, equal balls on a line pass through each other: each velocity runs on its own
/// between the walls, and the balls are these runners in order.
fn row(scene: &Scene, balls: &[&Body], t: f64) -> Vec<Ball> {
    let walls = scene.bodies.iter().filter(|body| !body.is_dynamic()).map(|body| body.position.x);
    let (left, right) = walls.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
    let length = 2.0 * radius(balls[0]);
    let width = right - left - length * balls.len() as f64;
    let place = |index: usize| left + length * (index as f64 + 0.5);
    let mut order: Vec<&Body> = balls.to_vec();
    order.sort_by(|a, b| a.position.x.total_cmp(&b.position.x));
    let mut runners: Vec<(f64, f64)> = order
        .iter()
        .enumerate()
        .map(|(index, ball)| {
            let v = mass_and_velocity(ball).1.x;
            let run = (ball.position.x - place(index) + v * t).rem_euclid(2.0 * width);
            if run <= width { (run, v) } else { (2.0 * width - run, -v) }
        })
        .collect();
    runners.sort_by(|a, b| a.0.total_cmp(&b.0));
    let by_ball = balls.iter().map(|ball| {
        let index = order.iter().position(|other| std::ptr::eq(*other, *ball)).unwrap_or(0);
        let (x, v) = runners[index];
        let position = DVec3::new(x + place(index), ball.position.y, ball.position.z);
        Ball { position, velocity: DVec3::new(v, 0.0, 0.0) }
    });
    by_ball.collect()
}

/// Kepler's equation M = E − e sin E by Newton's method, in the frame of the starting apse.
fn kepler(scene: &Scene, ball: &Body, t: f64) -> Ball {
    let attractor = scene.forces.iter().find_map(|force| match force.kind {
        ForceKind::GravityPoint { position, intensity } => Some((position, intensity)),
        _ => None,
    });
    let (center, intensity) = attractor.unwrap_or((DVec3::ZERO, 1.0));
    let (start, velocity) = (ball.position - center, mass_and_velocity(ball).1);
    let (r, speed) = (start.length(), velocity.length());
    let semi_axis = 1.0 / (2.0 / r - speed * speed / intensity);
    // Positive where the start is the near apse, negative where it is the far one.
    let e = 1.0 - r / semi_axis;
    let rate = (intensity / semi_axis.powi(3)).sqrt();
    let mean = (rate * t).rem_euclid(2.0 * PI);
    let mut anomaly = if e.abs() > 0.8 { PI } else { mean };
    for _ in 0..60 {
        anomaly -= (anomaly - e * libm::sin(anomaly) - mean) / (1.0 - e * libm::cos(anomaly));
    }
    let (sin, cos) = (libm::sin(anomaly), libm::cos(anomaly));
    let (along, across) = (start / r, velocity / speed);
    let minor = semi_axis * (1.0 - e * e).sqrt();
    let anomaly_rate = rate / (1.0 - e * cos);
    Ball {
        position: center + semi_axis * (cos - e) * along + minor * sin * across,
        velocity: anomaly_rate * (minor * cos * across - semi_axis * sin * along),
    }
}

/// In the plane of (√M X, √m y), with the balls' lengths taken out, the pair is a point in a wedge of angle
/// α = atan √(m/M) that flies straight once the wedge is unfolded. Also the number of sides crossed.
fn pi(balls: &[&Body], t: f64) -> (Vec<Ball>, u64) {
    let (light, heavy) = (balls[0], balls[1]);
    let (m, v) = mass_and_velocity(light);
    let (heavy_mass, heavy_v) = mass_and_velocity(heavy);
    let (light_at, heavy_at) = (radius(light), 2.0 * radius(light) + radius(heavy));
    let (scale, heavy_scale) = (m.sqrt(), heavy_mass.sqrt());
    let wedge = libm::atan(scale / heavy_scale);
    let (vx, vy) = (heavy_scale * heavy_v.z, scale * v.z);
    let x = heavy_scale * (heavy.position.z - heavy_at) + vx * t;
    let y = scale * (light.position.z - light_at) + vy * t;
    let (r, angle) = (libm::hypot(x, y), libm::atan2(y, x));
    let crossed = (angle / wedge).floor();
    let within = angle - crossed * wedge;
    let mirrored = crossed.rem_euclid(2.0) == 1.0;
    let folded = if mirrored { wedge - within } else { within };
    let radial = (x * vx + y * vy) / r;
    let turning = (x * vy - y * vx) / r * if mirrored { -1.0 } else { 1.0 };
    let (sin, cos) = (libm::sin(folded), libm::cos(folded));
    let ball = |body: &Body, z: f64, v: f64| Ball {
        position: DVec3::new(body.position.x, body.position.y, z),
        velocity: DVec3::new(0.0, 0.0, v),
    };
    let balls = vec![
        ball(light, r * sin / scale + light_at, (radial * sin + turning * cos) / scale),
        ball(heavy, r * cos / heavy_scale + heavy_at, (radial * cos - turning * sin) / heavy_scale),
    ];
    (balls, crossed as u64)
}
