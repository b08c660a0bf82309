//! What recording costs, and how long a seek takes: a gas of 1000 spheres for 10⁵ events.
//! Run with `cargo bench --bench record`; runs with and without recording take turns in this one process, and what a thread waits
//! for a processor is no time of theirs. Each seek is the quickest of several to its place.

#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a program that prints figures and stops at a surprise"
)]

#[path = "scenes/mod.rs"]
#[allow(dead_code, reason = "other benches use the rest of it")]
mod scenes;

#[path = "clock/mod.rs"]
mod clock;

use std::sync::Arc;

use clock::Clock;
use polyscene::record::{InlineRunner, RunCommand, Runner as _};
use polyscene::scene::Scene;
use polyscene::sim::Simulation;

const EVENTS: u64 = 100_000;
const DT: f64 = 0.01;
/// Pairs of runs with and without recording.
const ROUNDS: usize = 15;
/// Places in the recording that are gone to, and how often to each.
const PLACES: usize = 100;
const SEEKS: usize = 5;

fn main() {
    let scene = Arc::new(scenes::gas(1000, 0.1));
    let until = time_of(&scene, EVENTS);
    recording(&scene, until);
    seeking(&scene, until);
}

/// When so many events have happened, rounded up to a Δt.
fn time_of(scene: &Scene, events: u64) -> f64 {
    let mut simulation = Simulation::new(scene).expect("it compiles");
    let mut steps = 0_u32;
    while simulation.counters().total_events() < events {
        steps += 1;
        simulation.begin(f64::from(steps) * DT);
        simulation.finish(&mut |_, _| {}).expect("no fault");
    }
    f64::from(steps) * DT
}

fn recording(scene: &Arc<Scene>, until: f64) {
    let steps = (until / DT).round() as u32;
    let (mut bare, mut recorded) = (Vec::new(), Vec::new());
    let mut bytes = 0;
    for _ in 0..ROUNDS {
        let mut simulation = Simulation::new(scene).expect("it compiles");
        let clock = Clock::start();
        for step in 1..=steps {
            simulation.begin(f64::from(step) * DT);
            simulation.finish(&mut |_, _| {}).expect("no fault");
        }
        bare.push(clock.elapsed());
        let mut runner = InlineRunner::new();
        runner.send(RunCommand::Load(scene.clone()));
        let clock = Clock::start();
        runner.send(RunCommand::Step { dt: DT, count: steps });
        recorded.push(clock.elapsed());
        let frame = runner.frame();
        assert_eq!(frame.fault, None);
        bytes = frame.recorded.bytes;
    }
    let mut ratios: Vec<f64> = bare.iter().zip(&recorded).map(|(bare, recorded)| recorded / bare).collect();
    let (bare, recorded) = (least(&bare), least(&recorded));
    println!("gas of 1000, {EVENTS} events: {:.0} ms, recorded {:.0} ms", 1e3 * bare, 1e3 * recorded);
    println!(
        "recording costs {:.1} % (median of {ROUNDS} pairs: {:.1} %), and takes {:.0} MiB",
        100.0 * (recorded / bare - 1.0),
        100.0 * (median(&mut ratios) - 1.0),
        bytes as f64 / 1048576.0
    );
}

/// Carried out on this thread: how quickly another one wakes up for a command is up to the system.
fn seeking(scene: &Arc<Scene>, until: f64) {
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(scene.clone()));
    runner.send(RunCommand::Step { dt: DT, count: (until / DT).round() as u32 });
    evaluating(&mut runner, until);
    let (mut shown, mut settled) = ([f64::INFINITY; PLACES], [f64::INFINITY; PLACES]);
    for _ in 0..SEEKS {
        for (nth, time) in times(until).enumerate() {
            let seek = RunCommand::Seek { dt: DT, time };
            let clock = Clock::start();
            runner.send_while(seek.clone(), &mut |_| false);
            shown[nth] = shown[nth].min(clock.elapsed());
            assert_eq!((runner.frame().time, runner.frame().is_settled), (time, false));
            runner.send(seek);
            settled[nth] = settled[nth].min(clock.elapsed());
            assert_eq!((runner.frame().time, runner.frame().is_settled), (time, true));
        }
    }
    println!("a seek is shown after {}", shares(&mut shown));
    println!("and can be gone on from after {}", shares(&mut settled));
}

/// What the states of all bodies take to be looked up.
fn evaluating(runner: &mut InlineRunner, until: f64) {
    runner.send(RunCommand::ShareMotion(true));
    let motion = runner.frame().motion.clone().expect("it was asked for");
    let mut evaluated = [f64::INFINITY; PLACES];
    for _ in 0..SEEKS {
        for (nth, time) in times(until).enumerate() {
            let clock = Clock::start();
            let states = (0..motion.bodies().len()).filter_map(|body| motion.state(body, time));
            let sum: f64 = states.map(|state| state.position.x).sum();
            evaluated[nth] = evaluated[nth].min(clock.elapsed());
            assert!(sum > 0.0);
        }
    }
    runner.send(RunCommand::ShareMotion(false));
    println!("all states at a time are evaluated in {}", shares(&mut evaluated));
}

/// Spread without a pattern: multiples of the golden ratio.
fn times(until: f64) -> impl Iterator<Item = f64> {
    (1..=PLACES as u32).map(move |nth| until * (0.618_033_988_75 * f64::from(nth)).fract())
}

/// The least of several: whatever else the machine does only adds to a time.
fn least(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn shares(times: &mut [f64]) -> String {
    let middle = median(times);
    format!("{:.2} ms (at most {:.2})", 1e3 * middle, 1e3 * times[times.len() - 1])
}
