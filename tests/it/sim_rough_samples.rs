//! Samples that rub: what they are to show, and that nothing is gained.

use glam::DVec3;
use polyscene::scene::Scene;
use polyscene::sim::{BodyRef, ContactState, Event, EventKind, Simulation};

use crate::common::drive::{Promise, Sampling, assert_books, simulation, state_of, states, watch};
use crate::common::load::load;

/// Runs a scene; fails where the books do not hold, or where energy comes from nowhere.
fn run_watched(scene: &Scene, until: f64) -> (Simulation, Vec<Event>) {
    let mut sim = simulation(scene);
    let mut events = Vec::new();
    let promise = Promise::of_steps(&sim, scene);
    let total = |sim: &Simulation| sim.energy().kinetic + sim.energy().potential.expect("gravity alone");
    let mut lowest = total(&sim);
    watch(&mut sim, until, Sampling::Every(1.0 / 60.0), |sim, event| {
        assert_books(sim, 1e-12);
        let now = total(sim);
        assert!(now <= lowest + promise.climb, "t {}: {now} J after {lowest} J", sim.time());
        lowest = lowest.min(now);
        events.extend(event.copied());
    });
    (sim, events)
}

/// Whether the balls with these UserIDs have an impact with each other.
fn meet(sim: &Simulation, events: &[Event], one: i64, other: i64) -> bool {
    let is = |body: BodyRef, id: i64| sim.label(body) == id.to_string();
    events.iter().any(|event| {
        event.kind == EventKind::Impact && event.b.is_some_and(|b| is(event.a, one) && is(b, other))
    })
}

#[test]
fn the_cue_ball_jumps_over_the_ball_in_its_way() {
    let (sim, events) = run_watched(&load("jump-shot.xml"), 15.0);
    assert!(!meet(&sim, &events, 11, 12), "it jumps over it");
    assert!(meet(&sim, &events, 11, 13), "and hits the one behind");
    assert!(meet(&sim, &events, 14, 15), "the other runs into the ball in its way");
    assert!(states(&sim).iter().all(|(_, state)| state.contact == ContactState::Rest), "all rest");
    assert_eq!(sim.counters().steps, 0, "nothing is stepped");
}

#[test]
fn balls_stay_in_the_bowl_and_sink_to_its_bottom() {
    let scene = load("bowl.xml");
    let (sim, events) = run_watched(&scene, 30.0);
    assert!(events.iter().any(|event| event.kind == EventKind::Roll));
    let middle = DVec3::new(1.5, 1.3, 1.5);
    for (_, state) in states(&sim) {
        let off = state.position - middle;
        // The faces are tangent to a sphere of 1 m: corners are a little further.
        assert!(off.length() < 1.05 - 0.06, "{off}");
        assert!(off.y < -0.75, "{off}: near the bottom");
    }
    let spin = state_of(&sim, 46).turn.expect("a scene that rubs").orientation;
    assert!((spin.length() - 1.0).abs() <= 1e-14);
}

#[test]
fn rough_pegs_turn_the_balls_of_the_board() {
    let (sim, _) = run_watched(&load("galton-rough.xml"), 1.0);
    let spinning =
        states(&sim).iter().filter(|(_, state)| state.turn.expect("it rubs").spin.length() > 1.0).count();
    assert!(spinning > 20, "{spinning}");
}
