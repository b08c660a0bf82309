//! Δt, tiles, file order, looking and snapshots change no bit of events and states.

use glam::{DVec3, dvec3};
use polyscene::scene::Scene;
use polyscene::sim::Progress;
use polyscene::study::Random;

use crate::common::build::{Build, Shaped, ball, empty, thesis};
use crate::common::drive::{
    Run, SAMPLINGS, Sampling, advance, assert_same_bits, finished, run, simulation, states,
};
use crate::common::load::load;
use crate::sim_random::{Contents, random_scene};

const TILES: [[u32; 3]; 3] = [[1; 3], [10; 3], [37; 3]];

/// Runs a scene in every way of sampling × every tiling given, and compares all bits.
fn assert_invariant(scene: &Scene, until: f64, samplings: &[Sampling], what: &str) -> Run {
    let expected = run(scene, until, Sampling::Every(1.0));
    for tiles in TILES {
        for &sampling in samplings {
            let got = run(&scene.clone().tiles(tiles), until, sampling);
            assert_same_bits(&expected, &got, &format!("{what}, {sampling:?}, tiles {tiles:?}"));
        }
    }
    expected
}

#[test]
fn thesis_scene_gives_the_same_bits_for_ten_seconds_in_every_way() {
    let run = assert_invariant(&load("thesis-appendix-2.xml"), 10.0, &SAMPLINGS, "thesis");
    assert!(run.events.len() > 20, "{} events", run.events.len());
}

#[test]
fn thesis_scene_gives_the_same_bits_for_a_minute() {
    let scene = load("thesis-appendix-2.xml");
    let expected = run(&scene, 60.0, Sampling::Every(1.0));
    assert!(expected.events.len() > 200, "{} events", expected.events.len());
    let others = [
        (TILES[0], Sampling::Events),
        (TILES[1], Sampling::Every(1.0 / 60.0)),
        (TILES[1], Sampling::Every(1e-3)),
        (TILES[2], Sampling::Random(5)),
    ];
    for (tiles, sampling) in others {
        let got = run(&scene.clone().tiles(tiles), 60.0, sampling);
        assert_same_bits(&expected, &got, &format!("{sampling:?}, tiles {tiles:?}"));
    }
}

#[test]
fn gas_gives_the_same_bits() {
    let samplings = [Sampling::Every(1.0 / 60.0), Sampling::Random(3), Sampling::Events];
    let run = assert_invariant(&load("gas.xml"), 4.0, &samplings, "gas");
    assert!(run.events.len() > 300, "{} events", run.events.len());
}

#[test]
fn random_scenes_give_the_same_bits() {
    // Balls that lie on balls take many events: the last two kinds are looked at while they fly.
    let kinds = [
        (Contents::Elastic, 3.0),
        (Contents::LossyStatics, 3.0),
        (Contents::Lossy, 0.4),
        (Contents::Everything, 0.2),
    ];
    for (seed, (contents, until)) in (0..6).flat_map(|seed| kinds.map(|kind| (seed, kind))) {
        let scene = random_scene(seed, contents);
        let samplings = [Sampling::Every(1.0 / 60.0), Sampling::Random(seed), Sampling::Events];
        assert_invariant(&scene, until, &samplings, &format!("seed {seed}, {contents:?}"));
    }
}

#[test]
fn every_sample_scene_gives_the_same_bits() {
    for file in ["bounce.xml", "rest.xml", "slide.xml", "cradle.xml", "orbit.xml", "drag.xml", "bullet.xml"] {
        let scene = load(file);
        assert_invariant(
            &scene,
            12.0,
            &[Sampling::Every(1.0 / 60.0), Sampling::Random(1), Sampling::Events],
            file,
        );
    }
}

#[test]
fn order_of_the_file_does_not_matter() {
    // Sums of as many forces are rounded by their order.
    let pulled = thesis().attractor(dvec3(1.0, 2.0, 3.0), 0.7).air(0.013).gravity(-1.0 / 3.0);
    let others = [load("thesis-appendix-2.xml"), random_scene(4, Contents::LossyStatics), load("cradle.xml")];
    for scene in others.into_iter().chain([pulled]) {
        let expected = run(&scene, 5.0, Sampling::Every(0.1));
        for seed in 0..4 {
            let mut random = Random::new(seed);
            let mut permuted = scene.clone();
            random.shuffle(permuted.bodies.as_mut_slice());
            random.shuffle(&mut permuted.forces);
            assert_same_bits(&expected, &run(&permuted, 5.0, Sampling::Every(0.1)), &format!("order {seed}"));
        }
    }
}

#[test]
fn a_step_may_end_exactly_at_an_event() {
    let scene = thesis();
    let expected = run(&scene, 8.0, Sampling::Every(1.0));
    let mut sim = simulation(&scene);
    let mut events = Vec::new();
    for event in &expected.events {
        // An event at the end of a step belongs to that step.
        events.extend(advance(&mut sim, event.time, Sampling::Every(1.0)));
        assert_eq!(events.last().map(|last| last.time), Some(event.time));
    }
    events.extend(advance(&mut sim, 8.0, Sampling::Every(1.0)));
    assert_same_bits(&expected, &finished(&sim, events), "sampled at its own events");
}

#[test]
fn a_step_may_be_gone_through_by_hand() {
    let scene = thesis();
    let expected = run(&scene, 6.0, Sampling::Every(1.0));
    let mut sim = simulation(&scene);
    let mut events = Vec::new();
    for step in 1..=6 {
        sim.begin(f64::from(step));
        // Half by hand, the rest at once; the end of the step is not reached before `finish`.
        for _ in 0..2 {
            let Some(event) = sim.next_event().expect("a run without faults") else { break };
            assert_eq!(sim.time(), event.time);
            events.push(event);
        }
        sim.finish(&mut |sim, event| {
            assert_eq!(sim.time(), event.time);
            events.push(*event);
        })
        .expect("a run without faults");
        assert_eq!(sim.time(), f64::from(step));
    }
    assert_same_bits(&expected, &finished(&sim, events), "by hand");
}

#[test]
fn a_step_may_be_given_up_for_another() {
    let scene = thesis();
    let expected = run(&scene, 6.0, Sampling::Every(1.0));
    let mut sim = simulation(&scene);
    let mut events = Vec::new();
    for step in 1..=12 {
        sim.begin(f64::from(step) * 2.0);
        events.extend(sim.next_event().expect("a run without faults"));
        // Back to now, which changes nothing, and on by a little.
        sim.begin(0.0);
        assert_eq!(sim.next_event().expect("a run without faults"), None);
        let little = (sim.time() + 0.01).min(6.0);
        events.extend(advance(&mut sim, little, Sampling::Every(1.0)));
        if sim.time() >= 5.0 {
            break;
        }
    }
    events.extend(advance(&mut sim, 6.0, Sampling::Every(1.0)));
    assert_same_bits(&expected, &finished(&sim, events), "with steps given up");
}

#[test]
fn reading_after_the_last_event_gives_the_state_at_that_time() {
    let scene = thesis();
    let mut sim = simulation(&scene);
    sim.begin(10.0);
    while sim.next_event().expect("a run without faults").is_some() {}
    let residual = sim.energy().residual.expect("both forces have potentials");
    assert!(residual.abs() <= 1e-10, "t {}: residual {residual:e}", sim.time());
    let expected = run(&scene, sim.time(), Sampling::Every(1.0));
    for ((_, left), (_, right)) in states(&sim).iter().zip(&expected.states) {
        assert!((left.position - right.position).length() <= 1e-12, "{left:?} {right:?}");
        assert!((left.velocity - right.velocity).length() <= 1e-12, "{left:?} {right:?}");
    }
}

#[test]
fn a_snapshot_goes_back_to_the_same_bits() {
    for scene in [thesis(), load("rest.xml"), load("drag.xml"), random_scene(9, Contents::LossyStatics)] {
        let mut sim = simulation(&scene);
        advance(&mut sim, 1.1, Sampling::Every(0.1));
        let (snapshot, hash) = (sim.snapshot(), sim.hash());
        let events = advance(&mut sim, 3.0, Sampling::Every(0.5));
        let first = finished(&sim, events);
        for sampling in [Sampling::Every(1.0 / 60.0), Sampling::Events] {
            sim.restore(&snapshot);
            assert_eq!((sim.time(), sim.hash()), (1.1, hash));
            let events = advance(&mut sim, 3.0, sampling);
            assert_same_bits(&first, &finished(&sim, events), "after a restore");
        }
    }
}

#[test]
fn hash_tells_states_apart() {
    let scene = thesis();
    let mut hashes = vec![simulation(&scene).hash()];
    let mut sim = simulation(&scene);
    for step in 1..=20 {
        advance(&mut sim, f64::from(step) * 0.1, Sampling::Every(1.0));
        hashes.push(sim.hash());
    }
    let mut nudged = scene.clone();
    nudged.bodies[10].position += DVec3::X * 1e-15;
    hashes.push(simulation(&nudged).hash());
    hashes.sort_unstable();
    hashes.dedup();
    assert_eq!(hashes.len(), 22, "equal hashes of different states");
    assert_eq!(simulation(&scene).hash(), simulation(&scene).hash());
}

/// Symptom: two states that differ in how balls are turned had one hash. Expected: it tells apart what a scene that rubs
/// shows, and only that. Cause: it had spins, but no orientations.
#[test]
fn hash_tells_orientations_apart_where_bodies_turn() {
    let hash = |friction: f64, angle: f64| {
        let one = ball(1, DVec3::splat(5.0), DVec3::X).friction(friction);
        let other = ball(2, DVec3::splat(2.0), DVec3::ZERO).friction(friction);
        let mut scene = empty().body(one).body(other);
        scene.bodies[0].rotation = DVec3::Y * angle;
        run(&scene, 0.5, Sampling::Events).hash
    };
    assert_ne!(hash(0.5, 0.0), hash(0.5, 0.1));
    assert_eq!(hash(0.0, 0.0), hash(0.0, 0.1), "what does not rub has no orientation");
}

#[test]
fn bits_are_those_of_every_platform() {
    // A golden value last, after all that says why the bits are right: it only tells that they changed.
    let run = run(&load("thesis-appendix-2.xml"), 10.0, Sampling::Every(1.0));
    assert_eq!((run.events.len(), run.hash), GOLDEN);
}

/// Events and hash of the thesis scene at 10 s. Re-record only with a reason in the commit.
const GOLDEN: (usize, u64) = (30, 13258730865114391192);

#[test]
fn a_pause_between_predictions_shows_what_a_step_to_that_time_shows() {
    // Paused after every single prediction, also where one makes an event.
    let scene = thesis();
    let mut sim = simulation(&scene);
    sim.begin(3.0);
    let mut pauses = 0;
    loop {
        match sim.work(1).expect("a run without faults") {
            Progress::Done => break,
            Progress::Event(_) | Progress::Working => pauses += 1,
        }
        if pauses % 40 == 0 {
            let expected = run(&scene, sim.time(), Sampling::Events);
            for ((_, left), (_, right)) in states(&sim).iter().zip(&expected.states) {
                assert!((left.position - right.position).length() <= 1e-12, "{left:?} {right:?}");
            }
        }
    }
    assert!(pauses > 100, "{pauses}");
}
