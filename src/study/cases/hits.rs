//! Cases of single impacts: bouncing, coming to rest, bullets, grazing passes.

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, at_most, file};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, state_of};
use crate::sim::{BodyRef, Event, EventKind, Simulation};
use crate::study::closed_form::{Bounces, touch_beyond_edge};

/// The ball of `bounce.xml` and `rest.xml` falls 4.5 m before it first touches the floor.
fn bounces(restitution: f64) -> Bounces {
    Bounces::dropped(4.5, 9.8, restitution)
}

pub(super) const ELASTIC_BOUNCE: Case = Case {
    number: 2,
    id: "bounce",
    title: "Elastic bounce, 20 s",
    reference: "impacts at (2k+1) √(2h/g)",
    peers: "apex off 0.19 m, penetration up to 0.13 m, impacts off 8-25 ms (time-stepping, Δt 1/60); energy 1e-15 DynamO",
    source: file!("bounce"),
    demands: &[
        at_most(0.0, "", "impacts too many or too few"),
        at_most(1e-11, "s", "impact time off"),
        at_most(1e-12, "", "energy off, relative"),
        at_most(1e-12, "m", "overlap"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: elastic_bounce,
};

fn elastic_bounce(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const UNTIL: f64 = 20.0;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let (bounces, mut count, mut off) = (bounces(1.0), 0, 0.0_f64);
    trial.watch(&mut sim, UNTIL, |sim, event| {
        monitor.look(sim, event);
        if let Some(event) = event {
            off = off.max((event.time - bounces.impact_time(count)).abs());
            count += 1;
        }
        Ok(())
    })?;
    let wrong = (f64::from(count) - bounces.elastic_count(UNTIL)).abs();
    Ok(vec![wrong, off, monitor.energy_drift, monitor.worst_overlap])
}

pub(super) const LOSSY_BOUNCE: Case = Case {
    number: 3,
    id: "rest",
    title: "Bounce with e = 0.8 to rest, then 1000 s",
    reference: "geometric series, rest at t₁(1+e)/(1−e)",
    peers: "rest 0.63 s early (rapier, Δt 1/60; 0.03 s at 1/4000), 0.5 s early (Jolt, any Δt); never finishes (DynamO)",
    source: file!("rest"),
    demands: &[
        at_most(1e-9, "s", "impact time off"),
        at_most(1e-6, "s", "rest time off"),
        at_most(0.0, "m", "moved while at rest"),
        at_most(1e-9, "m", "overlap"),
        at_most(1e-11, "", "energy residual"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: lossy_bounce,
};

fn lossy_bounce(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let bounces = bounces(0.8);
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let mut count = 0;
    let (mut off, mut rest_off, mut residual) = (0.0_f64, f64::NAN, 0.0_f64);
    trial.watch(&mut sim, 10.0, |sim, event| {
        monitor.look(sim, event);
        residual = residual.max(sim.energy().residual.unwrap_or(f64::NAN).abs());
        match event {
            Some(event) if event.kind == EventKind::Impact => {
                off = off.max((event.time - bounces.impact_time(count)).abs());
                count += 1;
            }
            Some(event) if event.kind == EventKind::Rest => {
                rest_off = (event.time - bounces.end()).abs();
            }
            _ => {}
        }
        Ok(())
    })?;
    let lying = state_of(&sim, 2)?;
    let steps = Trial { scene: trial.scene.clone(), dt: 100.0 * trial.dt, budget: trial.budget };
    steps.watch(&mut sim, 1010.0, |sim, event| {
        monitor.look(sim, event);
        Ok(())
    })?;
    let moved = (state_of(&sim, 2)?.position - lying.position).length();
    Ok(vec![off, rest_off, moved, monitor.worst_overlap, residual])
}

pub(super) const BULLETS: Case = Case {
    number: 6,
    id: "bullets",
    title: "Bullets of r = 5 cm at 1000 m/s: face, edges, corner, 45° to 0.5°",
    reference: "the distance of a line from a rectangle",
    peers: "none pass, but they stop up to 16 m, a step of travel, off (Jolt, Δt 1/60); tunnel (f32 engines)",
    source: file!("hard/bullets"),
    demands: &[
        at_most(0.0, "", "wrong or missing hits"),
        at_most(1e-12, "m", "contact off, across the surface"),
        at_most(1e-12, "", "velocity after it off, relative"),
        at_most(1e-12, "m", "overlap"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: bullets,
};

/// UserID of the bullet, its offset beyond the half sides in y and z, and the angle of its plate, radians from
/// the path (a right angle for those whose plate stands across).
const BULLET_PATHS: [(i64, [f64; 2], f64); 8] = [
    (10, [0.0, 0.0], 90.0),
    (11, [0.03, 0.0], 90.0),
    (12, [0.03, 0.02], 90.0),
    (13, [0.0499, 0.0], 90.0),
    (15, [0.0, 0.0], 45.0),
    (16, [0.0, 0.0], 10.0),
    (17, [0.0, 0.0], 1.0),
    (18, [0.0, 0.0], 0.5),
];

fn bullets(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const RADIUS: f64 = 0.05;
    const SPEED: f64 = 1000.0;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let (mut found, mut wrong, mut off, mut turned_off) = (0, 0.0, 0.0_f64, 0.0_f64);
    trial.watch(&mut sim, 0.02, |sim, event| {
        monitor.look(sim, event);
        let Some(event) = event else { return Ok(()) };
        let hit = BULLET_PATHS.iter().find(|(id, ..)| is(sim, event, *id));
        let Some(&(id, [dy, dz], degrees)) = hit else {
            wrong += 1.0;
            return Ok(());
        };
        found += 1;
        let (sin, cos) = libm::sincos(degrees.to_radians());
        // How far before the plate's middle the centre is when they touch, and the normal from plate to ball.
        let (before, normal) = if degrees < 90.0 {
            (RADIUS / sin, DVec3::new(-sin, 0.0, -cos))
        } else {
            touch_beyond_edge(RADIUS, [dy, dz])
        };
        let x = 10.0 - before;
        off = off.max((SPEED * event.time - (x - 1.0)).abs() * normal.x.abs());
        let expected = DVec3::X * SPEED - 2.0 * SPEED * normal.x * normal;
        turned_off = turned_off.max((state_of(sim, id)?.velocity - expected).length() / SPEED);
        Ok(())
    })?;
    let missing = BULLET_PATHS.len() as f64 - f64::from(found);
    Ok(vec![wrong + missing.abs(), off, turned_off, monitor.worst_overlap])
}

/// Whether the dynamic body of an event has this UserID.
fn is(sim: &Simulation, event: &Event, id: i64) -> bool {
    let label = id.to_string();
    [Some(event.a), event.b]
        .into_iter()
        .flatten()
        .any(|body| matches!(body, BodyRef::Dynamic(_)) && sim.label(body) == label)
}

pub(super) const GRAZING: Case = Case {
    number: 12,
    id: "grazing",
    title: "Grazing a sphere, an edge, a corner and a moving ball at r(1 ± 1e-9)",
    reference: "geometry: four hit, four miss",
    peers: "",
    source: file!("hard/grazing"),
    demands: &[
        at_most(0.0, "", "hits taken for misses, or misses for hits"),
        at_most(1e-12, "m", "overlap"),
        at_most(1e-12, "", "energy off, relative"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: grazing,
};

fn grazing(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const MUST_HIT: [i64; 4] = [7, 9, 11, 14];
    const MUST_MISS: [i64; 4] = [8, 10, 12, 16];
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let mut hits = Vec::new();
    trial.watch(&mut sim, 1.0, |sim, event| {
        monitor.look(sim, event);
        let both = MUST_HIT.iter().chain(&MUST_MISS);
        hits.extend(event.and_then(|event| both.copied().find(|&id| is(sim, event, id))));
        Ok(())
    })?;
    let missed = MUST_HIT.iter().filter(|id| !hits.contains(id)).count();
    let wrong = hits.iter().filter(|id| !MUST_HIT.contains(id)).count();
    Ok(vec![(missed + wrong) as f64, monitor.worst_overlap, monitor.energy_drift])
}
