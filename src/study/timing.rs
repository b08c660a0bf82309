//! How long runs take, alone and in turn.

use std::time::{Duration, Instant};

use super::measure::PREDICTIONS;
use super::{Candidate, Control, Limits, RunFigures};
use crate::scene::Scene;
use crate::sim::{Progress, Simulation};

/// Shorter runs are repeated until so much time is filled: a clock's tick and a cold cache weigh too much.
const FILLED: Duration = Duration::from_millis(3);

/// Wall time per simulated second of one run without anyone looking on; `None` when cancelled.
pub(super) fn time_run(
    candidate: &Candidate,
    start: &Simulation,
    point: &RunFigures,
    limits: &Limits,
    control: &Control,
) -> Option<f64> {
    let (dt, _) = candidate.stride(limits.sample_dt);
    let deadline = Instant::now() + Duration::from_secs_f64(limits.run_limit.min(1e9));
    let (mut wall, mut simulated) = (Duration::ZERO, 0.0);
    while wall < FILLED || simulated <= 0.0 {
        let mut sim = start.clone();
        let started = Instant::now();
        run_through(&mut sim, dt, point.reached, limits, (deadline, control));
        wall += started.elapsed();
        simulated += sim.time();
        if control.is_cancelled() {
            return None;
        }
        if sim.time() <= 0.0 {
            break;
        }
    }
    (simulated > 0.0).then(|| wall.as_secs_f64() / simulated)
}

fn run_through(
    sim: &mut Simulation,
    dt: f64,
    until: f64,
    limits: &Limits,
    (deadline, control): (Instant, &Control),
) {
    for step in 1..=limits.last_step(dt) {
        let time = step as f64 * dt;
        if time > until * (1.0 + 1e-12) {
            return;
        }
        sim.begin(time);
        loop {
            match sim.work(PREDICTIONS) {
                Ok(Progress::Event(_)) => {}
                Ok(Progress::Working) => {
                    if control.is_cancelled() || Instant::now() > deadline {
                        return;
                    }
                }
                Ok(Progress::Done) => break,
                Err(_) => return,
            }
        }
        // A look at the clock costs as much as a short Δt.
        if step % 256 == 0 && (control.is_cancelled() || Instant::now() > deadline) {
            return;
        }
    }
}

/// The median and the range of all timings of each point.
pub(super) fn summarise(timings: &mut [f64], point: &mut RunFigures) {
    timings.sort_by(f64::total_cmp);
    let middle = timings.len() / 2;
    point.wall_per_s = match timings.len() {
        0 => None,
        even if even % 2 == 0 => Some((timings[middle - 1] + timings[middle]) / 2.0),
        _ => Some(timings[middle]),
    };
    point.wall_range = timings.first().zip(timings.last()).map(|(first, last)| [*first, *last]);
}

/// The simulation to time, at its start; `None` for a scene that cannot be simulated.
pub(super) fn starting(candidate: &Candidate, scene: &Scene) -> Option<Simulation> {
    candidate.start(scene).ok()
}
