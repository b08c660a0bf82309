//! Cases of trouble in the file: overlaps at load, contacts without gravity, bodies that leave the map.

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, at_most, file};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, state_of};

pub(super) const OVERLAP: Case = Case {
    number: 22,
    id: "overlap",
    title: "Overlaps and contacts at load, no gravity",
    reference: "approaching pairs part at t = 0, all others are left alone; five warnings",
    peers: "",
    source: file!("hard/overlap"),
    demands: &[
        at_most(0.0, "", "warnings too many or too few"),
        at_most(0.0, "", "wrong or missing impacts"),
        at_most(0.0, "m", "moved, of balls that are still"),
        at_most(1e-12, "", "energy off, relative"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: overlap,
};

fn overlap(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const STILL: [i64; 3] = [6, 7, 9];
    let mut sim = trial.start()?;
    let warnings = (sim.start_warnings().len() as f64 - 5.0).abs();
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let starts = STILL.map(|id| state_of(&sim, id));
    let (mut at_start, mut later) = (0.0, 0.0);
    trial.watch(&mut sim, 5.0, |sim, event| {
        monitor.look(sim, event);
        match event {
            Some(event) if event.time == 0.0 => at_start += 1.0,
            Some(_) => later += 1.0,
            None => {}
        }
        Ok(())
    })?;
    let mut moved = 0.0_f64;
    for (id, start) in STILL.into_iter().zip(starts) {
        moved = moved.max((state_of(&sim, id)?.position - start?.position).length());
    }
    Ok(vec![warnings, (at_start - 2.0_f64).abs() + later, moved, monitor.energy_drift])
}

pub(super) const OVERLAP_RESTING: Case = Case {
    number: 22,
    id: "overlap-resting",
    title: "Bodies sunk into each other at load, under gravity",
    reference: "two warnings; the overlap and the energy never grow",
    peers: "",
    source: file!("hard/overlap-resting"),
    demands: &[
        at_most(0.0, "", "warnings too many or too few"),
        at_most(1e-9, "m", "overlap beyond that at the start"),
        at_most(1e-12, "", "energy gained, relative"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: overlap_resting,
};

fn overlap_resting(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const SUNK: f64 = 0.125;
    let mut sim = trial.start()?;
    let warnings = (sim.start_warnings().len() as f64 - 2.0).abs();
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    trial.watch(&mut sim, 10.0, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    Ok(vec![warnings, (monitor.worst_overlap - SUNK).max(0.0), monitor.energy_gain])
}

pub(super) const LEAVES_MAP: Case = Case {
    number: 22,
    id: "leaves-map",
    title: "Out of the map, to a wall outside and back",
    reference: "straight lines",
    peers: "DynamO hangs when balls leave its cells",
    source: file!("hard/leaves-map"),
    demands: &[at_most(1e-12, "", "position off, relative"), at_most(1e-12, "m", "overlap")],
    budget: SMALL_BUDGET,
    long: false,
    run: leaves_map,
};

fn leaves_map(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let mut off = 0.0_f64;
    trial.watch(&mut sim, 100.0, |sim, event| {
        monitor.look(sim, event);
        let t = sim.time();
        // It turns round where its surface meets the wall at x = 26 m, 22.75 m ahead.
        let way = 5.0 * t;
        let x = if way <= 22.75 { 3.0 + way } else { 3.0 + 45.5 - way };
        for (id, expected) in [(2, DVec3::new(x, 3.0, 3.0)), (3, DVec3::new(3.0, 5.0 + 4.0 * t, 3.0))] {
            off = off.max((state_of(sim, id)?.position - expected).length() / expected.length());
        }
        Ok(())
    })?;
    Ok(vec![off, monitor.worst_overlap])
}
