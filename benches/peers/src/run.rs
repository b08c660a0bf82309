//! Runs a case in every engine: once for the errors, several times in turn for the time.

use cpu_time::ThreadTime;
use glam::DVec3;
use polyscene::scene::{ForceKind, Scene};

use crate::cases::Case;
use crate::engines::{Ball, Engine, World};
use crate::ours::Ours;
use crate::peer::{Peer, SETTINGS};
use crate::reference::{mass_and_velocity, moving};

/// While timed, both engines are read as often as a window draws: 60 times a second.
const FRAME: f64 = 1.0 / 60.0;
/// Errors are looked at where every step length ends a step.
const LOOK: f64 = 1.0 / 20.0;
/// A timing repeats short runs until it has taken so long, s of processor time.
const SHORTEST_TIMING: f64 = 0.02;

/// One engine on one case.
#[derive(Clone, Debug)]
pub struct Point {
    pub case: &'static str,
    pub promised: Option<f64>,
    pub engine: Engine,
    /// Processor time per simulated second, s: the median.
    pub cost: f64,
    /// Largest distance of any ball from the closed form, m.
    pub position_error: Option<f64>,
    /// Largest difference of any velocity from the closed form at the end, m/s.
    pub velocity_error: Option<f64>,
    /// Largest |E − E₀| over the largest kinetic energy.
    pub energy_error: f64,
    /// Counted and right number of impacts.
    pub impacts: Option<(u64, u64)>,
}

impl Point {
    /// What accuracy is compared by: the distance from the closed form, else the energy.
    pub fn error(&self) -> f64 {
        self.position_error.unwrap_or(self.energy_error)
    }
}

pub fn measure(case: &Case, quick: bool) -> Vec<Point> {
    let peers = case
        .rates
        .iter()
        .flat_map(|rate| SETTINGS.iter().map(move |settings| Engine::Rapier { dt: 1.0 / rate, settings }));
    let engines: Vec<Engine> = std::iter::once(Engine::Polyscene).chain(peers).collect();
    let mut costs = vec![Vec::new(); engines.len()];
    // They take turns, so that a machine that slows down slows all of them.
    for _ in 0..if quick { 1 } else { case.repeats } {
        for (engine, costs) in engines.iter().zip(&mut costs) {
            costs.push(cost(case, *engine));
        }
    }
    engines.into_iter().zip(costs).map(|(engine, costs)| errors(case, engine, median(costs))).collect()
}

fn world(case: &Case, engine: Engine, watch_impacts: bool) -> Option<Box<dyn World>> {
    match engine {
        Engine::Polyscene => Some(Box::new(Ours::new(&case.scene).ok()?)),
        Engine::Rapier { dt, settings } => {
            Some(Box::new(Peer::new(&case.scene, dt, settings, watch_impacts)))
        }
    }
}

/// Processor time per simulated second, without setting up.
fn cost(case: &Case, engine: Engine) -> f64 {
    let (mut spent, mut simulated) = (0.0, 0.0);
    let mut balls = Vec::new();
    while spent < SHORTEST_TIMING {
        let Some(mut world) = world(case, engine, false) else { return f64::NAN };
        let start = ThreadTime::now();
        for frame in 1..=(case.until / FRAME).round() as u32 {
            world.advance(f64::from(frame) * FRAME);
            world.read(&mut balls);
            std::hint::black_box(&balls);
        }
        spent += start.elapsed().as_secs_f64();
        simulated += case.until;
    }
    spent / simulated
}

fn errors(case: &Case, engine: Engine, cost: f64) -> Point {
    let expected_impacts = case.reference.impacts(&case.scene, case.until);
    let mut point = Point {
        case: case.name,
        promised: case.promised,
        engine,
        cost,
        position_error: None,
        velocity_error: None,
        energy_error: f64::NAN,
        impacts: None,
    };
    let Some(mut world) = world(case, engine, expected_impacts.is_some()) else { return point };
    let mut balls = Vec::new();
    world.read(&mut balls);
    let (start, mut largest_kinetic) = energy(&case.scene, &balls);
    let mut worst_drift = 0.0_f64;
    for look in 1..=(case.until / LOOK).round() as u32 {
        let time = f64::from(look) * LOOK;
        world.advance(time);
        world.read(&mut balls);
        let (total, kinetic) = energy(&case.scene, &balls);
        worst_drift = larger(worst_drift, (total - start).abs());
        largest_kinetic = largest_kinetic.max(kinetic);
        if let Some(expected) = case.reference.at(&case.scene, time) {
            let worst = worst(&balls, &expected, |ball| ball.position);
            point.position_error = Some(larger(point.position_error.unwrap_or(0.0), worst));
            point.velocity_error = Some(self::worst(&balls, &expected, |ball| ball.velocity));
        }
    }
    point.energy_error = worst_drift / largest_kinetic;
    point.impacts = world.impacts().zip(expected_impacts);
    point
}

/// The larger of two errors; one that is not a number is the largest.
fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() || b > a { b } else { a }
}

fn worst(balls: &[Ball], expected: &[Ball], of: impl Fn(&Ball) -> DVec3) -> f64 {
    balls.iter().zip(expected).map(|(got, right)| (of(got) - of(right)).length()).fold(0.0, larger)
}

/// Total and kinetic energy, J.
fn energy(scene: &Scene, balls: &[Ball]) -> (f64, f64) {
    let (mut kinetic, mut potential) = (0.0, 0.0);
    for (body, ball) in moving(scene).into_iter().zip(balls) {
        let mass = mass_and_velocity(body).0;
        kinetic += 0.5 * mass * ball.velocity.length_squared();
        for force in &scene.forces {
            potential += match force.kind {
                ForceKind::GravityPlane { acceleration, .. } => -mass * acceleration.dot(ball.position),
                ForceKind::GravityPoint { position, intensity } => {
                    -mass * intensity / (ball.position - position).length()
                }
                ForceKind::Drag { .. } => 0.0,
            };
        }
    }
    (kinetic + potential, kinetic)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
