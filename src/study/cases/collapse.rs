//! Inelastic collapse: infinitely many impacts in a finite time.

use super::case::{Case, SMALL_BUDGET, at_most, file, reported};
use super::monitor::Monitor;
use super::trial::{Stop, Trial};
use crate::sim::EventKind;

pub(super) const COLLAPSE: Case = Case {
    number: 15,
    id: "collapse",
    title: "Inelastic collapse of three balls between walls, e = 0.05",
    reference: "a finite number of events, reported as a collapse",
    peers: "event-driven codes without a rule for it never get past that time",
    source: file!("hard/collapse"),
    demands: &[
        at_most(0.0, "", "collapses not reported"),
        at_most(1e-12, "", "energy gained, relative"),
        at_most(1e-9, "m", "overlap"),
        reported("", "events"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: collapse,
};

fn collapse(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let mut reported = 0;
    trial.watch(&mut sim, 30.0, |sim, event| {
        monitor.look(sim, event);
        reported += u32::from(event.is_some_and(|event| event.kind == EventKind::Collapse));
        Ok(())
    })?;
    let events = sim.counters().total_events() as f64;
    Ok(vec![if reported > 0 { 0.0 } else { 1.0 }, monitor.energy_gain, monitor.worst_overlap, events])
}
