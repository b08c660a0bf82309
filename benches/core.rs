//! Speed of the core: the thesis scene, moving spheres among ever more static ones, elastic gases.
//! Run with `cargo bench --bench core`; each figure is a median of several runs in this one process.

#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a program that prints figures and stops at a surprise"
)]

#[path = "scenes/mod.rs"]
mod scenes;

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use polyscene::scene::Document;
use polyscene::sim::Simulation;
use scenes::{gas, lorentz_gas};

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, MEMORY, count, packing] = arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        return print_memory(count, packing);
    }
    thesis_scene();
    // In a cage the balls meet the same surroundings whatever N is: only the size of the tables differs.
    among_statics("in a cage of 4 m", true);
    // Roaming, they come to places that the processor's cache does not hold.
    among_statics("roaming", false);
    gases();
    if std::env::args().any(|argument| argument == LARGE) {
        large_gases();
    }
}

/// Asks for the gases of up to a million spheres too, which take minutes.
const LARGE: &str = "--large";

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
    println!("\nelastic gas in six walls, medians of {GAS_RUNS} runs");
    println!(
        "{:>8} {:>8} {:>10} {:>12} {:>12} {:>10} {:>10} {:>14}",
        "N", "packing", "impacts", "impacts/s", "ns/impact", "s per s", "residual", "bytes/sphere"
    );
    let gases = [(1000, 0.1, 20.0), (1000, 0.3, 8.0), (10_000, 0.1, 2.0), (10_000, 0.3, 1.0)];
    let mut rates = vec![Vec::new(); gases.len()];
    // The gases take turns, so that a machine that slows down slows all of them.
    for round in 1..=GAS_RUNS {
        for ((count, packing, until), rates) in gases.into_iter().zip(&mut rates) {
            let scene = gas(count, packing);
            let mut simulation = Simulation::new(&scene).expect("it compiles");
            run(&mut simulation, 0.1 * until);
            let impacts = simulation.counters().total_events();
            let start = Instant::now();
            run(&mut simulation, 1.1 * until);
            let wall = start.elapsed().as_secs_f64();
            let impacts = simulation.counters().total_events() - impacts;
            rates.push(impacts as f64 / wall);
            if round == GAS_RUNS {
                let rate = median(rates);
                let bytes = bytes_per_sphere(count, packing).map_or("?".into(), |bytes| bytes.to_string());
                println!(
                    "{count:>8} {packing:>8} {impacts:>10} {rate:>12.0} {:>12.0} {:>10.4} {:>10.1e} {bytes:>14}",
                    1e9 / rate,
                    impacts as f64 / rate / until,
                    simulation.energy().residual.unwrap_or(f64::NAN)
                );
            }
        }
    }
}

const GAS_RUNS: usize = 5;

/// How the impacts per second fall from a thousand spheres to a million.
fn large_gases() {
    println!("\nelastic gas in six walls, ever larger, medians of {LARGE_RUNS} runs");
    println!(
        "{:>8} {:>8} {:>10} {:>12} {:>10} {:>10}",
        "N", "packing", "impacts", "impacts/s", "fall", "compile s"
    );
    // Some impacts of each sphere go before, so that nothing is left of the lattice.
    let sizes = [(1000, 2.0, 40.0), (10_000, 0.8, 2.0), (100_000, 0.4, 0.1), (1_000_000, 0.1, 0.01)];
    for packing in [0.1, 0.3] {
        let mut rates = [const { Vec::new() }; 4];
        for round in 1..=LARGE_RUNS {
            for (index, (count, before, time)) in sizes.into_iter().enumerate() {
                let scene = gas(count, packing);
                let start = Instant::now();
                let mut simulation = Simulation::new(&scene).expect("it compiles");
                let compile = start.elapsed().as_secs_f64();
                run(&mut simulation, before);
                let impacts = simulation.counters().total_events();
                let start = Instant::now();
                run(&mut simulation, before + time);
                let impacts = simulation.counters().total_events() - impacts;
                rates[index].push(impacts as f64 / start.elapsed().as_secs_f64());
                if round == LARGE_RUNS {
                    let rate = median(&mut rates[index]);
                    let fall = median(&mut rates[0]) / rate;
                    println!(
                        "{count:>8} {packing:>8} {impacts:>10} {rate:>12.0} {fall:>10.2} {compile:>10.2}"
                    );
                }
            }
        }
    }
}

const LARGE_RUNS: usize = 3;

fn run(simulation: &mut Simulation, until: f64) {
    simulation.begin(until);
    simulation.finish(&mut |_, _| {}).expect("it runs");
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Growth of the resident memory by a simulation that has run for a while, without code and the scene. In
/// a process of its own, where no memory is left over from before. Known on Linux only.
fn bytes_per_sphere(count: u32, packing: f64) -> Option<u64> {
    let program = std::env::current_exe().ok()?;
    let output =
        Command::new(program).args([MEMORY, &count.to_string(), &packing.to_string()]).output().ok()?;
    let bytes: u64 = String::from_utf8(output.stdout).ok()?.trim().parse().ok()?;
    Some(bytes / u64::from(count))
}

/// Tells this program that it is the process of its own.
const MEMORY: &str = "--memory-of-gas";

fn print_memory(count: &str, packing: &str) {
    let (count, packing) = (count.parse().expect("a number"), packing.parse().expect("a number"));
    let scene = gas(count, packing);
    let before = resident_bytes();
    let mut simulation = Simulation::new(&scene).expect("it compiles");
    run(&mut simulation, 0.2);
    if let (Some(before), Some(after)) = (before, resident_bytes()) {
        println!("{}", after.saturating_sub(before));
    }
}

fn resident_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("RssAnon:"))?;
    let kib: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024 * kib)
}
