//! The table, the claims, the CSV file.

use std::fmt::Write as _;
use std::path::Path;

use crate::cases::Case;
use crate::engines::Engine;
use crate::run::{Point, Watch};

/// Rapier's steps per second at which the promise is made.
const PROMISED_AT: f64 = 240.0;

pub fn head() {
    println!(
        "time is processor time of one thread per simulated second, without setting up and the first frames,"
    );
    println!(
        "read at 60 Hz; ratio is that time over PolyScene's; errors are the largest over the run, overlap over"
    );
    println!(
        "the smallest radius; of piles, energy is the highest rise of the total over its lowest, in m g r."
    );
}

pub fn table(case: &Case, points: &[Point]) {
    let balls = case.scene.bodies.iter().filter(|body| body.is_dynamic()).count();
    println!("\n{} ({balls} balls, {} s)", case.name, case.until);
    println!(
        "{:<12} {:<25} {:>7} {:>12} {:>8} {:>10} {:>10} {:>10} {:>10} {:>14}",
        "engine",
        "settings",
        "steps/s",
        "s per s",
        "ratio",
        "position m",
        "final v",
        "energy",
        "overlap/r",
        "impacts"
    );
    let ours = points.first().map_or(f64::NAN, |point| point.cost);
    for point in points {
        println!(
            "{:<12} {:<25} {:>7} {:>12.3e} {:>8.1} {:>10} {:>10} {:>10.1e} {:>10.1e} {:>14}{}",
            point.engine.name(),
            point.engine.settings(),
            point.engine.rate().map_or("any".into(), |rate| format!("{rate:.0}")),
            point.cost,
            point.cost / ours,
            short(point.position_error),
            short(point.velocity_error),
            point.energy_error,
            point.overlap,
            point.impacts.map_or(String::new(), |(got, right)| format!("{got} of {right}")),
            if point.gave_up(case.until) {
                format!("  gave up at {:.3} s", point.reached)
            } else {
                String::new()
            },
        );
    }
}

/// What another program's states came to.
pub fn recorded(case: &Case, watch: &Watch<'_>) {
    println!("{}: energy {:.1e}, overlap/r {:.1e}", case.name, watch.energy_error(case), watch.overlap);
}

fn short(error: Option<f64>) -> String {
    error.map_or("-".into(), |error| format!("{error:.1e}"))
}

/// Prints whether the claims hold, and says whether all of them do.
pub fn claims(points: &[Point]) -> bool {
    println!("\nclaims");
    let mut all_hold = true;
    let mut say = |holds: bool, what: String| {
        println!("{} {what}", if holds { "holds:" } else { "FAILS:" });
        all_hold &= holds;
    };
    // Piles are measured, and nothing is claimed of them.
    let claimed = |point: &&Point| point.engine == Engine::Polyscene && !point.case.starts_with("pile");
    for ours in points.iter().filter(claimed) {
        let peers = || points.iter().filter(|point| point.case == ours.case && point.engine != ours.engine);
        let at_rate = peers().filter(|point| point.engine.rate().is_some_and(|rate| rate == PROMISED_AT));
        let ratio = at_rate.map(|point| point.cost / ours.cost).fold(f64::INFINITY, f64::min);
        if let Some(promised) = ours.promised {
            let what = format!(
                "{}: {ratio:.1} times less time than rapier3d at 1/240 s with its quickest settings (promised {promised})",
                ours.case
            );
            say(ratio >= promised, what);
        }
        let better = peers().filter(|point| point.cost <= ours.cost && point.error() <= ours.error()).count();
        say(better == 0, format!("{}: no rapier point is both faster and at least as accurate", ours.case));
    }
    all_hold
}

pub fn write_csv(path: &Path, points: &[Point]) -> std::io::Result<()> {
    let mut text = String::from(
        "case,engine,settings,steps_per_s,cpu_s_per_s,reached_s,position_error_m,final_velocity_error_m_per_s,\
         energy_error,overlap_radii,impacts,impacts_expected\n",
    );
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:e}"));
    for point in points {
        let (got, right) = point.impacts.unzip();
        let count = |value: Option<u64>| value.map_or(String::new(), |value| value.to_string());
        let _ = writeln!(
            text,
            "\"{}\",{},\"{}\",{},{:e},{},{},{},{:e},{:e},{},{}",
            point.case,
            point.engine.name(),
            point.engine.settings(),
            cell(point.engine.rate()),
            point.cost,
            point.reached,
            cell(point.position_error),
            cell(point.velocity_error),
            point.energy_error,
            point.overlap,
            count(got),
            count(right),
        );
    }
    std::fs::write(path, text)
}
