//! Cases of point gravity: Kepler ellipses, the fall into the centre, an attractor that is switched.

use std::f64::consts::PI;

use glam::DVec3;

use super::case::{Case, Demand, SMALL_BUDGET, at_most, file, reported};
use super::monitor::Monitor;
use super::trial::{Stop, Trial, state_of};
use crate::scene::{ForceKind, Motion, Scene};
use crate::sim::{EventKind, SimEdit};
use crate::study::closed_form::{Ellipse, Plunge};
use crate::study::reference::{Reference, ReferenceSettings};

const DEMANDS: &[Demand] = &[
    at_most(1e-9, "", "energy off, relative"),
    at_most(1e-6, "", "position off, in semi-axes"),
    reported("", "force evaluations per orbit"),
];

/// The attractor of all three scenes.
const CENTER: DVec3 = DVec3::splat(5.0);

pub(super) const ELLIPSE: Case = Case {
    number: 9,
    id: "kepler",
    title: "Kepler ellipse, e = 0.6, 100 orbits",
    reference: "Kepler's equation",
    peers: "energy 7e-3, phase 3.7 rad off (symplectic Euler, Δt 1/60); energy 2.7e-8 MuJoCo RK4 at 1/240, 5e-14 at 1/4000",
    source: file!("orbit"),
    demands: DEMANDS,
    budget: SMALL_BUDGET,
    long: false,
    run: |trial| {
        ellipse(trial, Ellipse { axis: 2.5, eccentricity: 0.6, intensity: 10.0, phase: 0.0 }, 1.0, 100.0)
    },
};

pub(super) const COMET: Case = Case {
    id: "comet",
    title: "Kepler ellipse, e = 0.99, 10 orbits",
    peers: "",
    source: file!("hard/kepler-comet"),
    run: |trial| {
        ellipse(trial, Ellipse { axis: 2.0, eccentricity: 0.99, intensity: 10.0, phase: PI }, -1.0, 10.0)
    },
    ..ELLIPSE
};

/// An orbit in the xz plane around the attractor, which begins with a velocity along z; its periapsis lies
/// `towards` +x or −x.
fn ellipse(trial: &Trial, orbit: Ellipse, towards: f64, rounds: f64) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let id = moving_id(&trial.scene)?;
    let mut off = 0.0_f64;
    trial.watch(&mut sim, rounds * orbit.period(), |sim, event| {
        monitor.look(sim, event);
        let [along, across] = orbit.offset(sim.time());
        let expected = CENTER + DVec3::new(towards * along, 0.0, -across);
        off = off.max((state_of(sim, id)?.position - expected).length() / orbit.axis);
        Ok(())
    })?;
    Ok(vec![monitor.energy_drift, off, sim.counters().force_evaluations as f64 / rounds])
}

fn moving_id(scene: &Scene) -> Result<i64, Stop> {
    scene.bodies.iter().find(|body| body.is_dynamic()).map(|body| body.id).ok_or(Stop::NoBody(0))
}

pub(super) const PLUNGE: Case = Case {
    number: 10,
    id: "plunge",
    title: "Dead-centre plunge from rest, 20 s",
    reference: "the limit of thin ellipses",
    peers: "",
    source: file!("hard/plunge"),
    demands: &[
        at_most(0.0, "", "passes too many or too few"),
        at_most(1e-6, "s", "time of a pass off"),
        at_most(1e-6, "", "position off, in semi-axes"),
        at_most(1e-9, "", "energy off, relative"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: plunge,
};

fn plunge(trial: &Trial) -> Result<Vec<f64>, Stop> {
    const PLUNGE: Plunge = Plunge { distance: 2.0, intensity: 10.0 };
    const UNTIL: f64 = 20.0;
    let mut sim = trial.start()?;
    let mut monitor = Monitor::new(&trial.scene, &sim)?;
    let (mut passes, mut time_off, mut off) = (0, 0.0_f64, 0.0_f64);
    trial.watch(&mut sim, UNTIL, |sim, event| {
        if let Some(event) = event {
            if event.kind == EventKind::SingularPass {
                time_off = time_off.max((event.time - PLUNGE.pass_time(passes)).abs());
                passes += 1;
            }
            return Ok(());
        }
        monitor.look(sim, None);
        let expected = CENTER + DVec3::X * PLUNGE.offset(sim.time());
        off = off.max((state_of(sim, moving_id(&trial.scene)?)?.position - expected).length());
        Ok(())
    })?;
    let wrong = (f64::from(passes) - PLUNGE.pass_count(UNTIL)).abs();
    Ok(vec![wrong, time_off, off / (0.5 * PLUNGE.distance), monitor.energy_drift])
}

pub(super) const SWITCHED: Case = Case {
    number: 10,
    id: "switched",
    title: "Attractor switched to −G and back while running",
    reference: "another integrator, restarted at each switch",
    peers: "",
    source: file!("hard/kepler-comet"),
    demands: &[
        at_most(1e-9, "m", "position off"),
        at_most(1e-9, "", "energy residual, with the work of edits"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: switched,
};

fn switched(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut scene = trial.scene.clone();
    let (mut off, mut residual) = (0.0_f64, 0.0_f64);
    // Near the first periapsis the comet is 1 m off the centre at 1.8 s: there the pull becomes a push.
    for (duration, intensity) in [(1.8, -10.0), (0.25, 10.0), (1.0, -2.5), (1.0, 10.0), (2.0, 10.0)] {
        let mut reference =
            Reference::new(&scene, ReferenceSettings::check()).map_err(|error| unexpected(&error))?;
        reference.impacts(duration).map_err(|error| unexpected(&error))?;
        let until = sim.time() + duration;
        trial.watch(&mut sim, until, |sim, _| {
            residual = residual.max(sim.energy().residual.unwrap_or(f64::NAN).abs());
            Ok(())
        })?;
        for body in &mut scene.bodies {
            let Some(ball) = reference.ball(body.id) else { continue };
            off = off.max((state_of(&sim, body.id)?.position - ball.position.value).length());
            body.position = ball.position.value;
            if let Motion::Dynamic { velocity, .. } = &mut body.motion {
                *velocity = ball.velocity.value;
            }
        }
        for force in &mut scene.forces {
            if let ForceKind::GravityPoint { intensity: own, .. } = &mut force.kind {
                *own = intensity;
            }
            sim.apply(&SimEdit::ChangeForce(Box::new(force.clone()))).map_err(|error| unexpected(&error))?;
        }
    }
    Ok(vec![off, residual])
}

fn unexpected(error: &impl std::fmt::Debug) -> Stop {
    Stop::Unexpected(format!("{error:?}"))
}
