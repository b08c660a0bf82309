//! The billiard break: a rack of touching balls that is its own mirror image.

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, at_most, file};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, states};
use crate::scene::{Body, Scene};
use crate::sim::{BodyState, Simulation};
use crate::study::Random;

pub(super) const BILLIARD: Case = Case {
    number: 5,
    id: "billiard",
    title: "Billiard break, rack of 15",
    reference: "mirror symmetry, energy, momentum; a permuted file gives the same bits",
    peers: "symmetry or energy, never both (time-stepping); energy 1e-15 and no symmetry at all (DynamO)",
    source: file!("hard/billiard-break"),
    demands: &[
        at_most(1e-12, "", "asymmetry after the first group, relative"),
        at_most(1e-12, "", "energy off after it, relative"),
        at_most(1e-12, "", "momentum off after it, relative"),
        at_most(1e-9, "", "asymmetry until 0.1 s later, relative"),
        at_most(1e-9, "", "energy off until then, relative"),
        at_most(1e-12, "m", "overlap"),
        at_most(0.0, "", "balls that differ in a permuted file"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: billiard,
};

const RADIUS: f64 = 0.03125;
const SPEED: f64 = 6.0;
/// The plane z = 0.75 m is the mirror.
const MIRROR: f64 = 0.75;

fn billiard(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let pairs = mirror_pairs(&trial.scene)?;
    // From x = 0.75 to 2 m less two radii.
    let touch = (1.25 - 2.0 * RADIUS) / SPEED;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let momentum = sim.momentum().value;
    trial.watch(&mut sim, touch + 1e-9, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let at_group = asymmetry(&sim, &pairs);
    let energy_at_group = monitor.energy_drift;
    let momentum_off = (sim.momentum().value - momentum).length() / momentum.length();
    let mut later = 0.0_f64;
    trial.watch(&mut sim, touch + 0.1, |sim, event| {
        monitor.look(sim, event);
        // Between the mirror images of one impact the rest of its group is still to be reported.
        if event.is_none() {
            later = later.max(asymmetry(sim, &pairs));
        }
        Ok(())
    })?;
    let differing = permuted_differences(trial, &states(&sim), touch + 0.1)?;
    Ok(vec![
        at_group,
        energy_at_group,
        momentum_off,
        later,
        monitor.energy_drift,
        monitor.worst_overlap,
        differing,
    ])
}

fn balls(scene: &Scene) -> Vec<&Body> {
    let mut balls: Vec<&Body> = scene.bodies.iter().filter(|body| body.is_dynamic()).collect();
    balls.sort_by_key(|body| body.id);
    balls
}

/// For each ball, in UserID order, the index of its mirror image.
fn mirror_pairs(scene: &Scene) -> Result<Vec<usize>, Stop> {
    let balls = balls(scene);
    let image = |position: DVec3| DVec3::new(position.x, position.y, 2.0 * MIRROR - position.z);
    let found =
        balls.iter().map(|ball| balls.iter().position(|other| other.position == image(ball.position)));
    let found: Option<Vec<usize>> = found.collect();
    found.ok_or_else(|| Stop::Unexpected("the scene is not its own mirror image".into()))
}

/// The largest difference of a ball from its mirror image, in radii and in the cue ball's speed.
fn asymmetry(sim: &Simulation, pairs: &[usize]) -> f64 {
    let states = states(sim);
    let off = states.iter().zip(pairs).map(|(own, &other)| {
        let image = states[other];
        let place =
            own.position - DVec3::new(image.position.x, image.position.y, 2.0 * MIRROR - image.position.z);
        let speed = own.velocity - image.velocity * DVec3::new(1.0, 1.0, -1.0);
        (place.length() / RADIUS).max(speed.length() / SPEED)
    });
    off.fold(0.0, f64::max)
}

/// How many balls are elsewhere when the bodies of the file stand in another order.
fn permuted_differences(trial: &Trial, expected: &[BodyState], until: f64) -> Result<f64, Stop> {
    let mut scene = trial.scene.clone();
    let mut random = Random::new(5);
    for last in (1..scene.bodies.len()).rev() {
        scene.bodies.as_mut_slice().swap(last, random.below(last + 1));
    }
    let permuted = Trial { scene, dt: trial.dt, budget: trial.budget };
    let mut sim = permuted.start()?;
    permuted.events(&mut sim, until)?;
    let bits = |state: &BodyState| [state.position, state.velocity].map(|v| v.to_array().map(f64::to_bits));
    let got = states(&sim);
    Ok(got.iter().zip(expected).filter(|(got, expected)| bits(got) != bits(expected)).count() as f64)
}
