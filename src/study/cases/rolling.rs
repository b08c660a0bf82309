//! Cases of friction: balls that roll, slide and turn their slip on an incline, and a break on a cloth.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, Source, at_most, file, reported};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, state_of};
use crate::scene::{Body, Force, ForceKind, Map, Motion, Roughness, Scene, Shape, SimParams};
use crate::sim::{BodyRef, ContactState, Event, EventKind, Simulation};

const GRAVITY: f64 = 9.81;
/// 20°.
const ANGLE: f64 = 0.349_065_850_398_865_9;
const RADIUS: f64 = 0.1;
const MIDDLE: DVec3 = DVec3::new(30.0, 15.0, 10.0);

/// Downhill, and from the face.
fn directions() -> (DVec3, DVec3) {
    let (sin, cos) = libm::sincos(ANGLE);
    (DVec3::new(cos, -sin, 0.0), DVec3::new(sin, cos, 0.0))
}

/// An incline with friction 1 and balls of these frictions, with velocities downhill and along it, m/s.
fn incline(balls: &[(f64, [f64; 2])]) -> Scene {
    let (downhill, normal) = directions();
    let plate = Shape::Plane { half_x: 30.0, half_y: 10.0 };
    let rough = |friction: f64| Roughness { friction, ..Roughness::default() };
    let mut bodies = vec![Body {
        rotation: DVec3::new(-FRAC_PI_2, ANGLE, 0.0),
        roughness: rough(1.0),
        ..Body::new(1, MIDDLE, Motion::Static, plate)
    }];
    for (id, (friction, [down, along])) in (2..).zip(balls) {
        let velocity = *down * downhill + *along * DVec3::Z;
        let motion = Motion::Dynamic { mass: 1.0, velocity };
        let place = start(id);
        bodies.push(Body {
            bounce: 0.5,
            roughness: rough(friction * friction),
            ..Body::new(id, place + RADIUS * normal, motion, Shape::Sphere { radius: RADIUS })
        });
    }
    let acceleration = DVec3::new(0.0, -GRAVITY, 0.0);
    let gravity = Force::new(1, ForceKind::GravityPlane { position: MIDDLE, acceleration });
    let map = Map { size: DVec3::new(60.0, 30.0, 20.0), tiles: [12, 6, 4] };
    Scene { map, time_speed: 1.0, params: SimParams::default(), forces: vec![gravity], bodies: bodies.into() }
}

/// Where a ball touches the incline at the start.
fn start(id: i64) -> DVec3 {
    MIDDLE - 20.0 * directions().0 + (id as f64 - 4.0) * DVec3::Z
}

/// Whether an event is that a ball ceases to slip.
fn begins_to_roll(sim: &Simulation, event: &Event, id: i64) -> bool {
    let label = id.to_string();
    let is_its = |body: BodyRef| sim.label(body) == label;
    event.kind == EventKind::Roll && (is_its(event.a) || event.b.is_some_and(is_its))
}

/// The worst residuals of a run: energy, momentum, angular momentum.
fn residuals(sim: &Simulation, worst: &mut [f64; 3]) {
    let angular = sim.angular_momentum().map_or(f64::NAN, |angular| angular.residual);
    let now = [sim.energy().residual.unwrap_or(f64::NAN).abs(), sim.momentum().residual, angular];
    worst.iter_mut().zip(now).for_each(|(worst, now)| *worst = worst.max(now));
}

pub(super) const INCLINE: Case = Case {
    number: 16,
    id: "incline",
    title: "Balls on an incline of 20°: one rolls, one slides, one slides and rolls, 5 s",
    reference: "5/7 g sin θ; g (sin θ − μ cos θ); |s₀|/(7/2 μ g cos θ − g sin θ)",
    peers: "",
    source: Source::Built(|| incline(&[(0.3, [0.0; 2]), (0.05, [0.0; 2]), (0.3, [1.0, 0.0])])),
    demands: &[
        at_most(1e-9, "", "place of the ball that rolls off, relative"),
        at_most(1e-9, "", "place of the ball that slides off, relative"),
        at_most(1e-9, "", "time from slide to roll off, relative"),
        at_most(1e-12, "", "energy residual"),
        at_most(1e-13, "", "momentum residual"),
        at_most(1e-13, "", "angular momentum residual"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: on_incline,
};

fn on_incline(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let (sin, cos) = libm::sincos(ANGLE);
    let mut sim = trial.start()?;
    let (mut worst, mut rolls) = ([0.0; 3], f64::NAN);
    trial.watch(&mut sim, 5.0, |sim, event| {
        residuals(sim, &mut worst);
        if let Some(event) = event.filter(|event| begins_to_roll(sim, event, 4)) {
            rolls = event.time;
        }
        Ok(())
    })?;
    let (downhill, normal) = directions();
    let off = |id: i64, acceleration: f64| -> Result<f64, Stop> {
        let way = 0.5 * acceleration * 25.0;
        let expected = start(id) + RADIUS * normal + way * downhill;
        Ok((state_of(&sim, id)?.position - expected).length() / way)
    };
    let expected = 1.0 / (3.5 * 0.3 * GRAVITY * cos - GRAVITY * sin);
    Ok(vec![
        off(2, 5.0 / 7.0 * GRAVITY * sin)?,
        off(3, GRAVITY * (sin - 0.05 * cos))?,
        (rolls / expected - 1.0).abs(),
        worst[0],
        worst[1],
        worst[2],
    ])
}

pub(super) const SLIP_TURNS: Case = Case {
    number: 16,
    id: "slip-turns",
    title: "Slip across the fall line of that incline, which turns until the ball rolls",
    reference: "|s| = C tan^κ(φ/2)/sin φ, κ = 7 μ/(2 tan θ), and the time at which it is 0",
    peers: "",
    source: Source::Built(|| incline(&[(0.3, [1.0, 0.7]), (0.3, [-1.0, 0.2]), (0.15, [0.0, 1.0])])),
    demands: &[
        at_most(1e-9, "", "time from slide to roll off, relative"),
        at_most(1e-9, "m/s", "velocity afterwards off"),
        at_most(1e-12, "", "energy residual"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: slip_turns,
};

fn slip_turns(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const UNTIL: f64 = 2.0;
    let balls = [(0.3, [1.0, 0.7]), (0.3, [-1.0, 0.2]), (0.15, [0.0, 1.0])];
    let (sin, cos) = libm::sincos(ANGLE);
    let mut sim = trial.start()?;
    let (mut worst, mut rolls) = ([0.0; 3], [f64::NAN; 3]);
    trial.watch(&mut sim, UNTIL, |sim, event| {
        residuals(sim, &mut worst);
        for (id, at) in (2..).zip(&mut rolls) {
            if let Some(event) = event.filter(|event| begins_to_roll(sim, event, id)) {
                *at = event.time;
            }
        }
        Ok(())
    })?;
    let (downhill, _) = directions();
    let (mut of_time, mut of_velocity) = (0.0_f64, 0.0_f64);
    for ((id, (friction, [down, along])), rolls) in (2..).zip(balls).zip(rolls) {
        let (drive, against) = (GRAVITY * sin, 3.5 * friction * GRAVITY * cos);
        let (speed, angle) = (libm::hypot(down, along), libm::atan2(along, down));
        let (u, kappa) = (libm::tan(0.5 * angle), against / drive);
        let scale = speed * libm::sin(angle) / (2.0 * drive);
        let expected = scale * (1.0 / (u * (kappa - 1.0)) + u / (kappa + 1.0));
        of_time = of_time.max((rolls / expected - 1.0).abs());
        // v = v₀ + (s − s₀) 2/7 + 5/7 a_t t with s = 0 once it rolls, and a_t downhill.
        let v = 5.0 / 7.0 * ((down + drive * UNTIL) * downhill + along * DVec3::Z);
        of_velocity = of_velocity.max((state_of(&sim, id)?.velocity - v).length());
    }
    Ok(vec![of_time, of_velocity, worst[0]])
}

pub(super) const BREAK_ON_CLOTH: Case = Case {
    number: 16,
    id: "break-on-cloth",
    title: "Break of 15 balls on a cloth with cushions, 30 s",
    reference: "invariants; every ball rests",
    peers: "",
    source: file!("break-on-cloth"),
    demands: &[
        at_most(0.0, "", "balls that do not rest"),
        at_most(1e-12, "", "energy residual"),
        at_most(1e-13, "", "momentum residual"),
        at_most(1e-13, "", "angular momentum residual"),
        at_most(1e-12, "m", "overlap"),
        reported("s", "the last ball rests at"),
    ],
    budget: 1_000_000,
    long: false,
    run: break_on_cloth,
};

fn break_on_cloth(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let (mut worst, mut last) = ([0.0; 3], 0.0);
    trial.watch(&mut sim, 30.0, |sim, event| {
        monitor.look(sim, event);
        residuals(sim, &mut worst);
        if let Some(event) = event.filter(|event| event.kind == EventKind::Rest) {
            last = event.time;
        }
        Ok(())
    })?;
    let moving =
        super::trial::states(&sim).iter().filter(|state| state.contact != ContactState::Rest).count();
    Ok(vec![moving as f64, worst[0], worst[1], worst[2], monitor.worst_overlap, last])
}
