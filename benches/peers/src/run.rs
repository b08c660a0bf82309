//! Runs a case in every engine: once for the errors, several times in turn for the time.

use cpu_time::ThreadTime;
use glam::DVec3;
use polyscene::scene::{ForceKind, Scene};
use polyscene::study::OverlapMonitor;

use crate::cases::Case;
use crate::engines::{Ball, Engine, World};
use crate::ours::Ours;
use crate::peer;
use crate::reference::{Reference, gravity, mass_and_velocity, moving, radius};

/// While timed, both engines are read as often as a window draws: 60 times a second.
const FRAME: f64 = 1.0 / 60.0;
/// Frames at the start that are not timed: engines find their neighbours and fill their caches in them.
const WARM_UP: u32 = 3;
/// Errors are looked at where every step length ends a step.
const LOOK: f64 = 1.0 / 20.0;
/// Overlaps of piles come and go quickly, and every step length of theirs ends a frame.
const LOOK_AT_PILE: f64 = FRAME;
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
    /// Model time reached, s: less than asked for where the engine gave up.
    pub reached: f64,
    /// Largest distance of any ball from the closed form, m.
    pub position_error: Option<f64>,
    /// Largest difference of any velocity from the closed form at the end, m/s.
    pub velocity_error: Option<f64>,
    /// Largest |E − E₀| over the largest kinetic energy; of a pile, the highest rise of the total energy over its
    /// lowest value before, in the m g r of one ball.
    pub energy_error: f64,
    /// Deepest overlap of any two bodies over the smallest radius, by one monitor for all engines.
    pub overlap: f64,
    /// Counted and right number of impacts.
    pub impacts: Option<(u64, u64)>,
}

impl Point {
    /// What accuracy is compared by: the distance from the closed form, else the energy.
    pub fn error(&self) -> f64 {
        self.position_error.unwrap_or(self.energy_error)
    }

    pub fn gave_up(&self, until: f64) -> bool {
        self.reached < until * (1.0 - 1e-9)
    }
}

pub fn measure(case: &Case, quick: bool) -> Vec<Point> {
    let engines: Vec<Engine> = std::iter::once(Engine::Polyscene).chain(case.peers.iter().copied()).collect();
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
        Engine::Polyscene => Some(Box::new(Ours::new(&case.scene, case.patience).ok()?)),
        Engine::Rapier { dt, settings, walls, precision } => {
            Some(peer::world(&case.scene, dt, settings, walls, precision, watch_impacts))
        }
    }
}

/// Processor time per simulated second, without setting up and the first frames.
fn cost(case: &Case, engine: Engine) -> f64 {
    let (mut spent, mut simulated) = (0.0, 0.0);
    let mut balls = Vec::new();
    while spent < SHORTEST_TIMING {
        let Some(mut world) = world(case, engine, false) else { return f64::NAN };
        let frames = (case.until / FRAME).round() as u32;
        let mut goes_on = (1..=WARM_UP).all(|frame| world.advance(f64::from(frame) * FRAME));
        let (from, start) = (world.time(), ThreadTime::now());
        for frame in WARM_UP + 1..=frames {
            goes_on = goes_on && world.advance(f64::from(frame) * FRAME);
            world.read(&mut balls);
            std::hint::black_box(&balls);
            if !goes_on {
                break;
            }
        }
        spent += start.elapsed().as_secs_f64();
        simulated += world.time() - from;
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
        reached: 0.0,
        position_error: None,
        velocity_error: None,
        energy_error: f64::NAN,
        overlap: 0.0,
        impacts: None,
    };
    let Some(mut world) = world(case, engine, expected_impacts.is_some()) else { return point };
    let watch = watched_with(case, &mut *world, |time, balls| {
        if let Some(expected) = case.reference.at(&case.scene, time) {
            let worst = worst(balls, &expected, |ball| ball.position);
            point.position_error = Some(larger(point.position_error.unwrap_or(0.0), worst));
            point.velocity_error = Some(self::worst(balls, &expected, |ball| ball.velocity));
        }
    });
    point.reached = world.time();
    point.energy_error = watch.energy_error(case);
    point.overlap = watch.overlap;
    point.impacts = world.impacts().zip(expected_impacts);
    point
}

/// Runs a world to the end of a case and looks at it.
pub fn watched<'a>(case: &'a Case, world: &mut dyn World) -> Watch<'a> {
    watched_with(case, world, |_, _| {})
}

/// As [`watched`]; `see` gets the time and the balls at each look.
fn watched_with<'a>(case: &'a Case, world: &mut dyn World, mut see: impl FnMut(f64, &[Ball])) -> Watch<'a> {
    let mut watch = Watch::new(case, world);
    let look_every = if case.reference == Reference::Pile { LOOK_AT_PILE } else { LOOK };
    for look in 1..=(case.until / look_every).round() as u32 {
        let time = f64::from(look) * look_every;
        let goes_on = world.advance(time);
        watch.look(world);
        if !goes_on {
            break;
        }
        see(time, &watch.balls);
    }
    watch
}

/// Looks at the overlaps and the energy of a world, the same for all engines.
pub struct Watch<'a> {
    scene: &'a Scene,
    monitor: OverlapMonitor,
    balls: Vec<Ball>,
    radius: f64,
    /// m g r of one ball, J.
    unit: f64,
    start: f64,
    lowest: f64,
    largest_kinetic: f64,
    worst_drift: f64,
    climb: f64,
    /// Over the smallest radius.
    pub overlap: f64,
}

impl<'a> Watch<'a> {
    fn new(case: &'a Case, world: &dyn World) -> Self {
        let balls = moving(&case.scene);
        let radius = balls.iter().map(|ball| radius(ball)).fold(f64::INFINITY, f64::min);
        let mass = balls.iter().map(|ball| mass_and_velocity(ball).0).sum::<f64>() / balls.len() as f64;
        let mut watch = Self {
            scene: &case.scene,
            monitor: OverlapMonitor::in_id_order(&case.scene),
            balls: Vec::new(),
            radius,
            unit: mass * gravity(&case.scene).length() * radius,
            start: f64::NAN,
            lowest: f64::INFINITY,
            largest_kinetic: 0.0,
            worst_drift: 0.0,
            climb: 0.0,
            overlap: 0.0,
        };
        world.read(&mut watch.balls);
        watch.start = energy(watch.scene, &watch.balls).0;
        watch.look(world);
        watch
    }

    fn look(&mut self, world: &dyn World) {
        world.read(&mut self.balls);
        let (total, kinetic) = energy(self.scene, &self.balls);
        self.worst_drift = larger(self.worst_drift, (total - self.start).abs());
        self.largest_kinetic = self.largest_kinetic.max(kinetic);
        self.lowest = self.lowest.min(total);
        self.climb = larger(self.climb, (total - self.lowest) / self.unit);
        let places: Vec<DVec3> = self.balls.iter().map(|ball| ball.position).collect();
        self.overlap = larger(self.overlap, self.monitor.worst(&places) / self.radius);
    }

    /// See [`Point::energy_error`].
    pub fn energy_error(&self, case: &Case) -> f64 {
        if case.reference == Reference::Pile { self.climb } else { self.worst_drift / self.largest_kinetic }
    }
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
