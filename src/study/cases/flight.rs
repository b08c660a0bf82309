//! Cases of motion between events: a throw, and a fall through air.

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, at_most, file};
use super::trial::{Stop, Trial, state_of};
use crate::scene::Motion;
use crate::study::closed_form::{self, FallInAir};

pub(super) const THROW: Case = Case {
    number: 1,
    id: "throw",
    title: "Ballistic throw, 1000 samples",
    reference: "x₀ + v₀t + ½gt²",
    peers: "position off after 2 s at Δt 1/60: 0.04 m rapier, 0.16 m Jolt and MuJoCo (Euler); 2e-14 m MuJoCo RK4",
    source: file!("hard/throw"),
    demands: &[at_most(1e-12, "", "position off, relative"), at_most(1e-12, "", "velocity off, relative")],
    budget: SMALL_BUDGET,
    long: false,
    run: throw,
};

fn throw(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let gravity = DVec3::new(0.0, -9.8, 0.0);
    let (start, thrown) = match trial.scene.bodies.as_slice() {
        [body] => match body.motion {
            Motion::Dynamic { velocity, .. } => (body.position, velocity),
            Motion::Static => return Err(Stop::NoBody(1)),
        },
        _ => return Err(Stop::NoBody(1)),
    };
    let mut sim = trial.start()?;
    let mut off = [0.0_f64; 2];
    for sample in 1..=1000 {
        let t = f64::from(sample) * trial.dt;
        sim.begin(t);
        sim.finish(&mut |_, _| {})?;
        let state = state_of(&sim, 1)?;
        let (position, velocity) = closed_form::throw(start, thrown, gravity, t);
        off[0] = off[0].max((state.position - position).length() / position.length());
        off[1] = off[1].max((state.velocity - velocity).length() / velocity.length());
    }
    Ok(off.to_vec())
}

pub(super) const DRAG: Case = Case {
    number: 11,
    id: "drag",
    title: "Fall with drag to terminal speed",
    reference: "v = v∞ tanh(gt/v∞), fallen v∞²/g ln cosh(gt/v∞)",
    peers: "",
    source: file!("drag"),
    demands: &[at_most(1e-8, "", "speed off, relative"), at_most(1e-8, "", "way fallen off, relative")],
    budget: SMALL_BUDGET,
    long: false,
    run: drag,
};

fn drag(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let mut sim = trial.start()?;
    let mut off = [0.0_f64; 2];
    // The heavy ball is on the floor at 3.8 s, the light one at 9.1 s.
    for (until, ids) in [(3.5, &[2, 3][..]), (8.5, &[2][..])] {
        trial.watch(&mut sim, until, |sim, _| {
            let t = sim.time();
            for &id in ids {
                let state = state_of(sim, id)?;
                let mass = if id == 2 { 0.05 } else { 2.0 };
                let fall = FallInAir::new(9.8, mass, 0.1, 1.276);
                off[0] = off[0].max((-state.velocity.y / fall.speed(t) - 1.0).abs());
                off[1] = off[1].max(((60.0 - state.position.y) / fall.fallen(t) - 1.0).abs());
            }
            Ok(())
        })?;
    }
    Ok(off.to_vec())
}
