//! What leaving out saves: the same motion with and without what the plan of a scene finds unneeded.
//! Run with `cargo bench --bench plan`; each figure is a median of ratios taken in this one process.

#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a program that prints figures and stops at a surprise"
)]

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use glam::{DVec3, dvec3};
use polyscene::scene::{Document, Force as SceneForce, ForceKind, Scene};
use polyscene::sim::{Force, Simulation, Subject};

const GRAVITY: DVec3 = dvec3(0.0, -9.8, 0.0);
/// Pairs of runs, whose ratios are compared.
const REPEATS: usize = 7;

fn main() {
    println!("gas of 1000 balls in uniform gravity, 1 s");
    let gas = load("hard/gas-1000");
    compare("field integrator", &in_gravity(&gas), |scene| {
        // The same gravity as a force of the user's own: nothing is known of it, so it must be integrated.
        let mut simulation =
            Simulation::new(&Scene { forces: Vec::new(), ..scene.clone() }).expect("it compiles");
        simulation.add_force(Arc::new(OwnGravity)).expect("a force is added");
        simulation
    });
    println!("gas of 1000 balls, 1 s");
    compare("rest, collapse and lasting contact", &gas, |scene| {
        // One rounding below 1: nearly the same motion, but every impact may be the last.
        let mut lossy = scene.clone();
        for body in &mut lossy.bodies {
            body.bounce = 1.0_f64.next_down();
        }
        Simulation::new(&lossy).expect("it compiles")
    });
    println!("one ball thrown for 1000 s");
    compare("field integrator", &load("hard/throw"), |scene| {
        let mut simulation =
            Simulation::new(&Scene { forces: Vec::new(), ..scene.clone() }).expect("it compiles");
        simulation.add_force(Arc::new(OwnGravity)).expect("a force is added");
        simulation
    });
}

#[derive(Debug)]
struct OwnGravity;

impl Force for OwnGravity {
    fn force(&self, on: &Subject<'_>) -> DVec3 {
        on.mass * GRAVITY
    }

    fn potential(&self, on: &Subject<'_>) -> Option<f64> {
        Some(-on.mass * GRAVITY.dot(on.position))
    }
}

/// Runs a scene as its plan has it and as `burdened` makes it.
fn compare(what: &str, scene: &Scene, burdened: impl Fn(&Scene) -> Simulation) {
    let until = if scene.bodies.len() > 1 { 1.0 } else { 1000.0 };
    let (mut ratios, mut lean_walls) = (Vec::new(), Vec::new());
    let mut ends = None;
    for _ in 0..REPEATS {
        let mut lean = Simulation::new(scene).expect("it compiles");
        let mut heavy = burdened(scene);
        let walls = [timed(&mut lean, until), timed(&mut heavy, until)];
        ratios.push(walls[1] / walls[0]);
        lean_walls.push(walls[0]);
        ends = Some((lean, heavy));
    }
    let Some((lean, heavy)) = ends else { return };
    let bodies = scene.bodies.iter().filter(|body| body.is_dynamic()).count();
    let [lean_bytes, heavy_bytes] = [&lean, &heavy].map(|simulation| simulation.motion_bytes() / bodies);
    println!(
        "  without {what}: {:.2e} s; with it {:.2} times as long; {lean_bytes} against {heavy_bytes} bytes of \
         motion per body; {} against {} force evaluations",
        median(&mut lean_walls),
        median(&mut ratios),
        lean.counters().force_evaluations,
        heavy.counters().force_evaluations,
    );
}

fn timed(simulation: &mut Simulation, until: f64) -> f64 {
    let start = Instant::now();
    simulation.begin(until);
    simulation.finish(&mut |_, _| {}).expect("it runs");
    start.elapsed().as_secs_f64()
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn load(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.xml"));
    Document::open(&path).scene().expect("a scene of the repository").clone()
}

fn in_gravity(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let gravity = ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: GRAVITY };
    scene.forces.push(SceneForce::new(1, gravity));
    scene
}
