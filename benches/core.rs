//! Speed of the core: the thesis scene, moving spheres among ever more static ones, elastic gases.
//! Run with `cargo bench --bench core`; each figure is a median of several runs in this one process.

#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a program that prints figures and stops at a surprise"
)]

use std::path::Path;
use std::time::Instant;

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, Document, Map, Motion, NodeKey, Scene, Shape, SimParams};
use polyscene::sim::Simulation;

fn main() {
    thesis_scene();
    // In a cage the balls meet the same surroundings whatever N is: only the size of the tables differs.
    among_statics("in a cage of 4 m", true);
    // Roaming, they come to places that the processor's cache does not hold.
    among_statics("roaming", false);
    gases();
}

fn thesis_scene() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/thesis-appendix-2.xml");
    let document = Document::open(&path);
    let scene = document.scene().expect("the thesis scene loads");
    let mut times = Vec::new();
    for _ in 0..9 {
        let mut simulation = Simulation::new(scene).expect("it compiles");
        let start = Instant::now();
        run(&mut simulation, 60.0);
        times.push(start.elapsed().as_secs_f64());
    }
    println!("thesis scene, 60 s: {:.2} ms", 1e3 * median(&mut times));
}

/// Ten balls fly among N static spheres, one in each tile: the step must not cost more for more of them.
fn among_statics(where_to: &str, caged: bool) {
    println!("\n10 moving spheres among N static ones, {where_to}, steps of 0.1 s");
    println!("{:>8} {:>12} {:>12} {:>14} {:>8}", "N", "compile ms", "first us", "median step us", "ratio");
    let counts = [100_u32, 1000, 10_000, 100_000];
    // The sizes take turns, so that a machine that slows down slows all of them.
    let mut rounds: Vec<Vec<f64>> = vec![Vec::new(); counts.len()];
    for round in 0..5 {
        for (index, count) in counts.into_iter().enumerate() {
            let scene = lorentz_gas(count, caged);
            let start = Instant::now();
            let mut simulation = Simulation::new(&scene).expect("it compiles");
            let compile = start.elapsed().as_secs_f64();
            let mut steps = Vec::new();
            for step in 1..=1000 {
                let start = Instant::now();
                run(&mut simulation, f64::from(step) * 0.1);
                steps.push(start.elapsed().as_secs_f64());
            }
            let first = steps[0];
            rounds[index].push(median(&mut steps));
            if round == 4 {
                let step = median(&mut rounds[index]);
                let ratio = step / median(&mut rounds[0]);
                println!(
                    "{count:>8} {:>12.2} {:>12.1} {:>14.2} {ratio:>8.2}",
                    1e3 * compile,
                    1e6 * first,
                    1e6 * step
                );
            }
        }
    }
}

fn gases() {
    println!("\nelastic gas in six walls");
    println!(
        "{:>8} {:>8} {:>10} {:>14} {:>12} {:>10}",
        "N", "packing", "impacts", "impacts/s", "s per s", "residual"
    );
    for (count, packing, until) in
        [(1000, 0.1, 4.0), (1000, 0.3, 1.0), (10_000, 0.1, 1.0), (10_000, 0.3, 0.25)]
    {
        let scene = gas(count, packing);
        let mut rates = Vec::new();
        let mut last = (0, 0.0, 0.0);
        for _ in 0..3 {
            let mut simulation = Simulation::new(&scene).expect("it compiles");
            run(&mut simulation, 0.1 * until);
            let before = simulation.counters().total_events();
            let start = Instant::now();
            run(&mut simulation, 1.1 * until);
            let wall = start.elapsed().as_secs_f64();
            let impacts = simulation.counters().total_events() - before;
            rates.push(impacts as f64 / wall);
            last = (impacts, wall / until, simulation.energy().residual.unwrap_or(f64::NAN));
        }
        let (impacts, cost, residual) = last;
        println!(
            "{count:>8} {packing:>8} {impacts:>10} {:>14.0} {cost:>12.4} {residual:>10.1e}",
            median(&mut rates)
        );
    }
}

fn run(simulation: &mut Simulation, until: f64) {
    simulation.begin(until);
    simulation.finish(&mut |_, _| {}).expect("it runs");
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Static spheres of r = 0.3 m on a 1 m lattice, one to a tile, in a box with walls; ten balls near its
/// middle, shut in there or not.
fn lorentz_gas(count: u32, caged: bool) -> Scene {
    let side = (1..).find(|side: &u32| side * side * side >= count).unwrap_or(1);
    let size = f64::from(side);
    let middle = DVec3::splat((size / 2.0).floor());
    let mut bodies = if caged { walls(middle - 2.0, 4.0) } else { walls(DVec3::ZERO, size) };
    for index in 0..count {
        let [x, y, z] = [index % side, index / side % side, index / (side * side)].map(f64::from);
        let position = dvec3(x, y, z) + 0.5;
        bodies.push(body(10_000 + i64::from(index), position, Motion::Static, 0.3));
    }
    let mut random = Random(42);
    for index in 0..10 {
        // Lattice corners have room for a ball.
        let corner =
            middle + dvec3(f64::from(index % 3) - 1.0, f64::from(index / 3 % 3) - 1.0, f64::from(index / 9));
        let velocity = 5.0 * random.direction();
        bodies.push(body(100 + i64::from(index), corner, Motion::Dynamic { mass: 1.0, velocity }, 0.1));
    }
    scene(size, side, bodies)
}

/// N equal spheres at a packing fraction in a box of 10 m, on a lattice with random velocities of 1 m/s.
fn gas(count: u32, packing: f64) -> Scene {
    let size = 10.0_f64;
    let side = (1..).find(|side: &u32| side * side * side >= count).unwrap_or(1);
    let volume = packing * size * size * size / f64::from(count);
    let radius = libm::cbrt(0.75 * volume / std::f64::consts::PI);
    let mut bodies = walls(DVec3::ZERO, size);
    let mut random = Random(7);
    for index in 0..count {
        let cell = [index % side, index / side % side, index / (side * side)].map(|i| f64::from(i) + 0.5);
        let position = DVec3::from_array(cell) * (size / f64::from(side));
        let velocity = random.direction();
        bodies.push(body(100 + i64::from(index), position, Motion::Dynamic { mass: 1.0, velocity }, radius));
    }
    scene(size, side, bodies)
}

fn scene(size: f64, tiles: u32, bodies: Vec<Body>) -> Scene {
    Scene {
        map: Map { size: DVec3::splat(size), tiles: [tiles; 3] },
        time_speed: 1.0,
        params: SimParams::default(),
        forces: Vec::new(),
        bodies,
    }
}

fn body(id: i64, position: DVec3, motion: Motion, radius: f64) -> Body {
    Body {
        key: NodeKey(id.unsigned_abs()),
        id,
        label: id.to_string(),
        name: None,
        color: None,
        hidden: false,
        locked: false,
        position,
        rotation: DVec3::ZERO,
        bounce: 1.0,
        material: None,
        motion,
        shape: Shape::Sphere { radius },
    }
}

fn walls(corner: DVec3, size: f64) -> Vec<Body> {
    let (half, right_angle) = (0.5 * size, std::f64::consts::FRAC_PI_2);
    let places = [
        (dvec3(0.0, half, half), dvec3(0.0, right_angle, 0.0)),
        (dvec3(size, half, half), dvec3(0.0, right_angle, 0.0)),
        (dvec3(half, 0.0, half), dvec3(right_angle, 0.0, 0.0)),
        (dvec3(half, size, half), dvec3(right_angle, 0.0, 0.0)),
        (dvec3(half, half, 0.0), DVec3::ZERO),
        (dvec3(half, half, size), DVec3::ZERO),
    ];
    (1..)
        .zip(places)
        .map(|(id, (position, rotation))| Body {
            rotation,
            shape: Shape::Plane { half_x: half, half_y: half },
            ..body(id, corner + position, Motion::Static, 1.0)
        })
        .collect()
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from_array(std::array::from_fn(|_| 2.0 * self.unit() - 1.0));
            if v.length_squared() <= 1.0 && v.length_squared() > 0.01 {
                return v.normalize();
            }
        }
    }
}
