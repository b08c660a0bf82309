//! Cases of lasting contact: a jam, a slide in a groove, the end of a plate.

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, at_most, file, reported};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, state_of};
use crate::sim::EventKind;

pub(super) const WEDGE: Case = Case {
    number: 14,
    id: "wedge-jam",
    title: "Jam between planes that converge at 60°, e = 0.5",
    reference: "statics: r/sin 30° above the line where they meet, at rest",
    peers: "",
    source: file!("hard/wedge-jam"),
    demands: &[
        at_most(1e-9, "m", "place of rest off"),
        at_most(0.0, "m", "moved in the next 100 s"),
        at_most(1e-9, "m", "overlap"),
        at_most(1e-12, "", "energy gained, relative"),
        reported("", "events"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: wedge,
};

fn wedge(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const BALL: i64 = 3;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    trial.watch(&mut sim, 20.0, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let lying = state_of(&sim, BALL)?.position;
    trial.watch(&mut sim, 120.0, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let moved = (state_of(&sim, BALL)?.position - lying).length();
    let off = (lying - DVec3::new(4.0, 1.5, 3.0)).length();
    Ok(vec![off, moved, monitor.worst_overlap, monitor.energy_gain, sim.counters().total_events() as f64])
}

pub(super) const GROOVE: Case = Case {
    number: 14,
    id: "v-groove",
    title: "Fall into a V-groove and slide along it",
    reference: "z = 2 + t²",
    peers: "",
    source: file!("hard/v-groove"),
    demands: &[
        at_most(1e-9, "", "way along the groove off, relative"),
        at_most(1e-9, "m", "place across the groove off"),
        at_most(1e-9, "m", "overlap"),
        at_most(1e-12, "", "energy gained, relative"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: groove,
};

fn groove(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const BALL: i64 = 3;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let mut off = 0.0_f64;
    trial.watch(&mut sim, 5.0, |sim, event| {
        monitor.look(sim, event);
        let (t, z) = (sim.time(), state_of(sim, BALL)?.position.z);
        off = off.max((z - (2.0 + t * t)).abs() / (2.0 + t * t));
        Ok(())
    })?;
    let end = state_of(&sim, BALL)?.position;
    let across = DVec3::new(end.x - 4.0, end.y - (0.5 + 0.5 * std::f64::consts::SQRT_2), 0.0);
    Ok(vec![off, across.length(), monitor.worst_overlap, monitor.energy_gain])
}

pub(super) const EDGE: Case = Case {
    number: 14,
    id: "plate-edge",
    title: "Slide over a plate's edge at 1 m/s",
    reference: "leaves the edge at cos θ = (2 + v²/gr)/3",
    peers: "",
    source: file!("hard/plate-edge"),
    demands: &[
        at_most(1e-8, "", "cos of the angle of leaving off"),
        at_most(1e-8, "m/s", "speed along x off"),
        at_most(1e-10, "", "energy off, relative"),
        at_most(1e-9, "m", "overlap"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: edge,
};

fn edge(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    // v² = v₀² + 2gr(1 − cos θ) on the edge, and it leaves when v² = gr cos θ.
    let cos = (2.0 + 1.0 / 4.9) / 3.0;
    let mut angle_off = f64::NAN;
    trial.watch(&mut sim, 5.0, |sim, event| {
        monitor.look(sim, event);
        if let Some(event) = event.filter(|event| event.kind == EventKind::LiftOff) {
            angle_off = (event.normal.y.abs() - cos).abs();
        }
        Ok(())
    })?;
    let speed = (4.9 * cos).sqrt() * cos;
    let speed_off = (state_of(&sim, 2)?.velocity.x - speed).abs();
    Ok(vec![angle_off, speed_off, monitor.energy_drift, monitor.worst_overlap])
}
