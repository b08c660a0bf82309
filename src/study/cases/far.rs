//! The same scene far from the origin, where numbers lie farther apart.

use glam::DVec3;

use super::case::{Case, SMALL_BUDGET, Source, at_most, file, reported, scene_of};
use super::trial::{Stop, Trial, states};
use crate::scene::{ForceKind, Scene};
use crate::sim::EventKind;

pub(super) const FAR: Case = Case {
    number: 21,
    id: "far",
    title: "The same scene 1e5 m from the origin, 4 s",
    reference: "the scene at the origin",
    peers: "",
    source: file!("hard/far"),
    demands: &[
        at_most(0.0, "", "events that differ in kind or order"),
        at_most(1.2, "", "exponent with which the error grows with the distance"),
        reported("", "positions off, in spacings of numbers at 1e5 m"),
        reported("s", "event times off"),
    ],
    budget: SMALL_BUDGET,
    long: false,
    run: far,
};

const UNTIL: f64 = 4.0;
const DISTANCE: f64 = 1e5;
const NEAR: Source = file!("hard/near");

/// What a run came to: what happened to whom, when, and the positions at some times.
struct Seen {
    events: Vec<(EventKind, String, String)>,
    times: Vec<f64>,
    positions: Vec<DVec3>,
}

fn far(trial: &Trial) -> Result<Vec<f64>, Stop> {
    let near_scene = scene_of(NEAR)?;
    let near = see(trial, near_scene.clone())?;
    let far = see(trial, trial.scene.clone())?;
    let both = near.events.len().max(far.events.len());
    let same = near.events.iter().zip(&far.events).take_while(|(near, far)| near == far).count();
    let times = near.times.iter().zip(&far.times).take(same).map(|(near, far)| (near - far).abs());
    let times_off = times.fold(0.0, f64::max);
    // Powers of two keep the scene's own numbers exact.
    let (low, high) = (128.0, 131_072.0);
    let [at_low, at_high] = [low, high].map(|by| see(trial, shifted(&near_scene, by)));
    let exponent = libm::log(off(&near, &at_high?, high) / off(&near, &at_low?, low)) / libm::log(high / low);
    let spacing = DISTANCE.next_up() - DISTANCE;
    Ok(vec![(both - same) as f64, exponent, off(&near, &far, DISTANCE) / spacing, times_off])
}

fn see(trial: &Trial, scene: Scene) -> Result<Seen, Stop> {
    let own = Trial { scene, dt: trial.dt, budget: trial.budget };
    let mut sim = own.start()?;
    let mut seen = Seen { events: Vec::new(), times: Vec::new(), positions: Vec::new() };
    own.watch(&mut sim, UNTIL, |sim, event| {
        match event {
            Some(event) => {
                let names = [Some(event.a), event.b].map(|b| b.map_or("", |body| sim.label(body)).to_owned());
                let [a, b] = names;
                seen.events.push((event.kind, a, b));
                seen.times.push(event.time);
            }
            None => seen.positions.extend(states(sim).iter().map(|state| state.position)),
        }
        Ok(())
    })?;
    Ok(seen)
}

/// The largest distance of a ball from where its twin at the origin is, m.
fn off(near: &Seen, far: &Seen, by: f64) -> f64 {
    let pairs = near.positions.iter().zip(&far.positions);
    pairs.map(|(near, far)| (*far - DVec3::X * by - *near).length()).fold(0.0, f64::max)
}

fn shifted(scene: &Scene, by: f64) -> Scene {
    let mut scene = scene.clone();
    scene.map.size.x += by;
    for body in &mut scene.bodies {
        body.position.x += by;
    }
    for force in &mut scene.forces {
        if let ForceKind::GravityPoint { position, .. } = &mut force.kind {
            position.x += by;
        }
    }
    scene
}
