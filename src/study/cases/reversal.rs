//! Time reversal: a gas is run forward, its velocities are turned round, and it must come back to its start
//! as near as the growth of rounding errors allows.

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, at_most, file, reported};
use super::trial::{Stop, Trial, states};
use crate::scene::{Motion, Scene};
use crate::sim::BodyState;
use crate::study::Random;

pub(super) const REVERSAL: Case = Case {
    number: 20,
    id: "reversal",
    title: "Time reversal of a gas of 100",
    reference: "the start; the error of the return grows as a disturbance does, e^λT",
    peers: "",
    source: file!("gas"),
    demands: &[
        at_most(0.2, "", "slope of ln(error of the return) off λ, relative"),
        reported("1/s", "λ, of a disturbance"),
        reported("m", "error of the return at λT = 18"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: reversal,
};

/// Gases of slightly different starts, over which logarithms are averaged.
const GASES: u64 = 4;
/// Times of reversal, s.
const TIMES: [f64; 9] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
/// Of a disturbance at the start, m.
const DISTURBANCE: f64 = 1e-13;
/// Errors above this no longer grow as small ones do, m.
const LINEAR: f64 = 1e-4;

fn reversal(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut growth = vec![Vec::new(); TIMES.len()];
    let mut returns = vec![Vec::new(); TIMES.len()];
    for gas in 0..GASES {
        let mut random = Random::new(gas);
        let scene = disturbed(&trial.scene, 1e-2, &mut random);
        let twin = disturbed(&scene, DISTURBANCE, &mut random);
        let (forth, twins) = (run(trial, &scene, &TIMES)?, run(trial, &twin, &TIMES)?);
        let starts: Vec<DVec3> = balls(&scene);
        for (k, &time) in TIMES.iter().enumerate() {
            growth[k].push(distance(&forth[k], &positions(&twins[k])));
            let back = run(trial, &reversed(&scene, &forth[k]), &[time])?;
            returns[k].extend(back.first().map(|back| distance(back, &starts)));
        }
    }
    let lambda = slope(&growth);
    let returning = slope(&returns);
    let within = TIMES.iter().zip(&returns).filter(|(time, _)| lambda * **time < 18.0);
    let worst = within.flat_map(|(_, errors)| errors.iter().copied()).fold(0.0, f64::max);
    Ok(vec![(returning / lambda - 1.0).abs(), lambda, worst])
}

/// The states at some times.
fn run(trial: &Trial, scene: &Scene, times: &[f64]) -> Result<Vec<Vec<BodyState>>, Stop> {
    let own = Trial { scene: scene.clone(), dt: trial.dt, budget: trial.budget };
    let mut sim = own.start()?;
    let mut found = Vec::new();
    for &time in times {
        own.events(&mut sim, time)?;
        found.push(states(&sim));
    }
    Ok(found)
}

/// The scene with its balls moved by up to `by` along each axis.
fn disturbed(scene: &Scene, by: f64, random: &mut Random) -> Scene {
    let mut scene = scene.clone();
    for body in scene.bodies.iter_mut().filter(|body| body.is_dynamic()) {
        body.position += DVec3::new(random.range(-by, by), random.range(-by, by), random.range(-by, by));
    }
    scene
}

/// The scene that begins where another ended, with the velocities turned round. The bodies of the file
/// stand in UserID order.
fn reversed(scene: &Scene, ends: &[BodyState]) -> Scene {
    let mut scene = scene.clone();
    for (body, end) in scene.bodies.iter_mut().filter(|body| body.is_dynamic()).zip(ends) {
        body.position = end.position;
        if let Motion::Dynamic { velocity, .. } = &mut body.motion {
            *velocity = -end.velocity;
        }
    }
    scene
}

fn balls(scene: &Scene) -> Vec<DVec3> {
    scene.bodies.iter().filter(|body| body.is_dynamic()).map(|body| body.position).collect()
}

fn positions(states: &[BodyState]) -> Vec<DVec3> {
    states.iter().map(|state| state.position).collect()
}

/// Root of the mean square of the balls' distances, m.
fn distance(states: &[BodyState], others: &[DVec3]) -> f64 {
    let squares: f64 =
        states.iter().zip(others).map(|(s, other)| (s.position - other).length_squared()).sum();
    (squares / states.len() as f64).sqrt()
}

/// Slope of the mean logarithm over the times at which all errors are still small, by least squares.
fn slope(errors: &[Vec<f64>]) -> f64 {
    let small = TIMES.iter().zip(errors).filter(|(_, errors)| errors.iter().all(|error| *error < LINEAR));
    let points: Vec<(f64, f64)> = small
        .map(|(&time, errors)| {
            let sum: f64 = errors.iter().map(|error| libm::log(error.max(f64::MIN_POSITIVE))).sum();
            (time, sum / errors.len() as f64)
        })
        .collect();
    let count = points.len() as f64;
    let mean =
        points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0 / count, sum.1 + point.1 / count));
    let products: f64 = points.iter().map(|point| (point.0 - mean.0) * (point.1 - mean.1)).sum();
    let squares: f64 = points.iter().map(|point| (point.0 - mean.0) * (point.0 - mean.0)).sum();
    products / squares
}
