//! Balls that come to rest on balls.

use glam::DVec3;

use super::case::{Case, Demand, SMALL_BUDGET, at_most, file, reported};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, states};

const DEMANDS: &[Demand] = &[
    at_most(1e-8, "m", "places of rest off"),
    at_most(1e-9, "m", "moved in the next 5 s"),
    at_most(1e-8, "m", "overlap"),
    at_most(1e-12, "", "energy gained, relative"),
    reported("", "events"),
];

pub(super) const STACK_2: Case = Case {
    number: 15,
    id: "stack-2",
    title: "Two balls come to rest on each other, e = 0.5",
    reference: "statics",
    peers: "",
    source: file!("hard/stack-2"),
    demands: DEMANDS,
    budget: SMALL_BUDGET,
    long: false,
    run: |trial| stands(trial, |k, _| DVec3::new(2.0, 0.5 + k as f64, 2.0)),
};

pub(super) const STACK_3: Case = Case {
    id: "stack-3",
    title: "Three balls come to rest on each other, e = 0",
    source: file!("hard/stack-3"),
    ..STACK_2
};

pub(super) const PYRAMID_4: Case = Case {
    id: "pyramid-4",
    title: "A ball comes to rest on three in a pit, e = 0",
    source: file!("hard/pyramid-4"),
    run: |trial| stands(trial, pyramid_of_4),
    ..STACK_2
};

pub(super) const PYRAMID_4_BOUNCY: Case = Case {
    id: "pyramid-4-bouncy",
    title: "A ball comes to rest on three in a pit, e = 0.5",
    source: file!("hard/pyramid-4-bouncy"),
    ..PYRAMID_4
};

pub(super) const PYRAMID_6: Case = Case {
    id: "pyramid-6",
    title: "Flat pyramid of six between walls, e = 0",
    source: file!("hard/pyramid-6"),
    budget: 30_000,
    run: |trial| stands(trial, pyramid_of_6),
    ..STACK_2
};

/// The lowest three stay where they start, the fourth lies √(2/3) above them.
fn pyramid_of_4(index: usize, start: DVec3) -> DVec3 {
    if index < 3 { start } else { DVec3::new(3.0, 0.5 + (2.0_f64 / 3.0).sqrt(), 3.0) }
}

/// Rows of three, two and one, each √¾ above the one below.
fn pyramid_of_6(index: usize, start: DVec3) -> DVec3 {
    let row = if index < 3 {
        0.0
    } else if index < 5 {
        1.0
    } else {
        2.0
    };
    DVec3::new(start.x, 0.5 + row * 0.75_f64.sqrt(), start.z)
}

/// Runs for 15 s; by then all must lie still where `place` says, given a ball's number and start.
fn stands(trial: &Trial, place: impl Fn(usize, DVec3) -> DVec3) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let starts: Vec<DVec3> = states(&sim).iter().map(|state| state.position).collect();
    trial.watch(&mut sim, 15.0, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let lying = states(&sim);
    trial.watch(&mut sim, 20.0, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let off = lying.iter().zip(starts).enumerate();
    let off = off.map(|(k, (state, start))| (state.position - place(k, start)).length()).fold(0.0, f64::max);
    let moved =
        states(&sim).into_iter().zip(&lying).map(|(now, then)| (now.position - then.position).length());
    let moved = moved.fold(0.0, f64::max);
    let events = sim.counters().total_events() as f64;
    Ok(vec![off, moved, monitor.worst_overlap, monitor.energy_gain, events])
}
