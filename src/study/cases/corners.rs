//! Cases of several walls met in one instant: corners, and wedges of other angles.

use glam::DVec3;

use super::case::{Case, Demand, SMALL_BUDGET, at_most, file};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, states};
use crate::scene::Motion;

const DEMANDS: &[Demand] = &[
    at_most(1e-12, "", "velocity off, relative"),
    at_most(1e-12, "", "energy off, relative"),
    at_most(1e-12, "m", "overlap"),
];

pub(super) const TWO: Case = Case {
    number: 13,
    id: "corner-two",
    title: "Into a corner of two walls at once",
    reference: "straight back",
    peers: "",
    source: file!("hard/corner-two"),
    demands: DEMANDS,
    budget: SMALL_BUDGET,
    long: false,
    run: straight_back,
};

pub(super) const THREE: Case = Case {
    id: "corner-three",
    title: "Into a corner of three walls at once",
    source: file!("hard/corner-three"),
    ..TWO
};

pub(super) const ANGLES: Case = Case {
    id: "corner-angles",
    title: "Into wedges of 40°, 75° and 140° at once",
    reference: "straight back, by symmetry and energy",
    source: file!("hard/corner-angles"),
    ..TWO
};

fn straight_back(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut balls: Vec<_> = trial.scene.bodies.iter().filter(|body| body.is_dynamic()).collect();
    balls.sort_by_key(|body| body.id);
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    trial.watch(&mut sim, 4.0, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let off = states(&sim)
        .iter()
        .zip(balls)
        .map(|(state, ball)| {
            let start =
                if let Motion::Dynamic { velocity, .. } = ball.motion { velocity } else { DVec3::ZERO };
            (state.velocity + start).length() / start.length()
        })
        .fold(0.0, f64::max);
    Ok(vec![off, monitor.energy_drift, monitor.worst_overlap])
}
