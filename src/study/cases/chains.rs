//! Cases of chains of impacts: Newton's cradles, and the collisions that count the digits of π.

use glam::DVec3;

use super::case::{Case, Demand, SMALL_BUDGET, at_most, file};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, states};
use crate::sim::EventKind;
use crate::study::closed_form::{self, pi_collisions};

const CRADLE: Case = Case {
    number: 4,
    id: "",
    title: "",
    reference: "as many leave as came in, with their speed",
    peers: "",
    source: file!("cradle"),
    demands: &[
        at_most(1e-12, "m/s", "velocities off"),
        at_most(1e-12, "", "energy off, relative"),
        at_most(1e-12, "m", "overlap"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: |trial| cradle(trial, 1),
};

pub(super) const CRADLE_1: Case = Case {
    id: "cradle-1",
    title: "Newton's cradle of five, one incoming",
    peers: "no time-stepping engine gives (0, 0, 0, 0, 1); DynamO does",
    ..CRADLE
};

pub(super) const CRADLE_2: Case = Case {
    id: "cradle-2",
    title: "Newton's cradle of five, two incoming",
    source: file!("hard/cradle-2"),
    run: |trial| cradle(trial, 2),
    ..CRADLE
};

pub(super) const CRADLE_3: Case = Case {
    id: "cradle-3",
    title: "Newton's cradle of five, three incoming",
    source: file!("hard/cradle-3"),
    run: |trial| cradle(trial, 3),
    ..CRADLE
};

fn cradle(trial: &Trial, incoming: usize) -> Result<Vec<f64>, Stop> {
    const SPEED: f64 = 2.0;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    // The first ball of the row is touched at 0.75 s or later, the wall behind the row at 2.5 s or later.
    trial.watch(&mut sim, 2.25, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let balls = states(&sim);
    let expected = closed_form::cradle(balls.len(), incoming, DVec3::X * SPEED);
    let off = balls.iter().zip(expected).map(|(state, expected)| (state.velocity - expected).length());
    Ok(vec![off.fold(0.0, f64::max), monitor.energy_drift, monitor.worst_overlap])
}

const PI_DEMANDS: &[Demand] = &[
    at_most(0.0, "", "collisions too many or too few"),
    at_most(1e-10, "", "energy off, relative"),
    // the light ball flies up to 10 km/s, 4e-12 m between two representable times
    at_most(1e-11, "m", "overlap"),
];

const PI: Case = Case {
    number: 7,
    id: "",
    title: "",
    reference: "the first k+1 digits of π (Galperin 2003)",
    peers: "",
    source: file!("counting-pi"),
    demands: PI_DEMANDS,
    budget: SMALL_BUDGET,
    long: false,
    run: |trial| counting_pi(trial, 2),
};

pub(super) const PI_1: Case = Case {
    id: "pi-1",
    title: "Counting π, masses 1 : 100",
    source: file!("hard/counting-pi-1"),
    run: |trial| counting_pi(trial, 1),
    ..PI
};

pub(super) const PI_2: Case = Case { id: "pi-2", title: "Counting π, masses 1 : 100²", ..PI };

pub(super) const PI_3: Case = Case {
    id: "pi-3",
    title: "Counting π, masses 1 : 100³",
    source: file!("hard/counting-pi-3"),
    run: |trial| counting_pi(trial, 3),
    ..PI
};

pub(super) const PI_4: Case = Case {
    id: "pi-4",
    title: "Counting π, masses 1 : 100⁴",
    source: file!("hard/counting-pi-4"),
    run: |trial| counting_pi(trial, 4),
    ..PI
};

fn counting_pi(trial: &Trial, k: u32) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let mut count = 0_u64;
    // The last collision of the four scenes comes at 7.7 s.
    trial.watch(&mut sim, 12.0, |sim, event| {
        monitor.look(sim, event);
        count += u64::from(event.is_some_and(|event| event.kind == EventKind::Impact));
        Ok(())
    })?;
    Ok(vec![count.abs_diff(pi_collisions(k)) as f64, monitor.energy_drift, monitor.worst_overlap])
}
