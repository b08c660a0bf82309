//! What recording costs, and how long a seek takes: a gas of 1000 spheres for 10⁵ events.
//! Run with `cargo bench --bench record`; runs with and without recording take turns in this one process.

#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a program that prints figures and stops at a surprise"
)]

#[path = "scenes/mod.rs"]
#[allow(dead_code, reason = "other benches use the rest of it")]
mod scenes;

use std::sync::Arc;
use std::time::{Duration, Instant};

use polyscene::record::{Frame, InlineRunner, RunCommand, Runner as _, ThreadRunner};
use polyscene::scene::Scene;
use polyscene::sim::Simulation;

const EVENTS: u64 = 100_000;
const DT: f64 = 0.01;

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
    for _ in 0..9 {
        let mut simulation = Simulation::new(scene).expect("it compiles");
        let start = Instant::now();
        for step in 1..=steps {
            simulation.begin(f64::from(step) * DT);
            simulation.finish(&mut |_, _| {}).expect("no fault");
        }
        bare.push(start.elapsed().as_secs_f64());
        let mut runner = InlineRunner::new();
        runner.send(RunCommand::Load(scene.clone()));
        let start = Instant::now();
        runner.send(RunCommand::Step { dt: DT, count: steps });
        recorded.push(start.elapsed().as_secs_f64());
        let frame = runner.frame();
        assert_eq!(frame.fault, None);
        bytes = frame.recorded.bytes;
    }
    // The least of several: whatever else the machine does only adds to a time.
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let (bare, recorded) = (least(&bare), least(&recorded));
    println!("gas of 1000, {EVENTS} events: {:.0} ms, recorded {:.0} ms", 1e3 * bare, 1e3 * recorded);
    println!(
        "recording costs {:.1} %, and takes {:.0} MiB",
        100.0 * (recorded / bare - 1.0),
        bytes as f64 / 1048576.0
    );
}

fn seeking(scene: &Arc<Scene>, until: f64) {
    let mut thread = ThreadRunner::new(|| {}).expect("a thread");
    thread.send(RunCommand::Load(scene.clone()));
    let all = thread.send(RunCommand::Step { dt: DT, count: (until / DT).round() as u32 });
    wait(&thread, all, true);
    let (mut shown, mut settled) = (Vec::new(), Vec::new());
    // Spread without a pattern: multiples of the golden ratio.
    for nth in 1..=100 {
        let time = until * (0.618_033_988_75 * f64::from(nth)).fract();
        let start = Instant::now();
        let seek = thread.send(RunCommand::Seek { dt: DT, time });
        let frame = wait(&thread, seek, false);
        assert_eq!(frame.time, time);
        shown.push(start.elapsed().as_secs_f64());
        wait(&thread, seek, true);
        settled.push(start.elapsed().as_secs_f64());
    }
    let worst = |times: &[f64]| times.iter().copied().fold(0.0, f64::max);
    println!(
        "a seek is shown after {:.2} ms (at most {:.2})",
        1e3 * median(&mut shown.clone()),
        1e3 * worst(&shown)
    );
    println!(
        "and can be gone on from after {:.1} ms (at most {:.1})",
        1e3 * median(&mut settled.clone()),
        1e3 * worst(&settled)
    );
}

/// The first frame that knows of a command, or in which it is done.
fn wait(thread: &ThreadRunner, command: u64, done: bool) -> Arc<Frame> {
    loop {
        let frame = thread.frame();
        let is_done = frame.is_settled && frame.state == polyscene::record::RunState::Paused;
        if frame.command >= command && (is_done || !done) {
            return frame;
        }
        std::thread::sleep(Duration::from_micros(50));
    }
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
