//! Bodies and forces changed while a simulation runs, at stamped times.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{DQuat, DVec3, dvec3};
use polyscene::scene::{Force, ForceKind, NodeKey, Roughness, Scene};
use polyscene::sim::{EventKind, SimEdit, Simulation, Subject};

use crate::common::build::{Build, Shaped, ball, empty, plate, static_ball, thesis};
use crate::common::drive::{
    Run, SAMPLINGS, Sampling, advance, assert_same_bits, finished, impacts, run, simulation, state_of,
};

/// Runs a scene with edits at stamped times, in any way of sampling between them.
fn run_edited(scene: &Scene, until: f64, sampling: Sampling, edits: &[(f64, SimEdit)]) -> (Simulation, Run) {
    let mut sim = simulation(scene);
    let mut events = Vec::new();
    for (time, edit) in edits {
        events.extend(advance(&mut sim, *time, sampling));
        sim.apply(edit).unwrap_or_else(|err| panic!("{edit:?}: {err}"));
    }
    events.extend(advance(&mut sim, until, sampling));
    let run = finished(&sim, events);
    (sim, run)
}

fn uniform(acceleration_y: f64) -> ForceKind {
    ForceKind::GravityPlane { position: DVec3::ZERO, acceleration: dvec3(0.0, acceleration_y, 0.0) }
}

fn wall_at(x: f64) -> polyscene::scene::Body {
    plate(1, dvec3(x, 5.0, 5.0), dvec3(0.0, FRAC_PI_2, 0.0), 2.0, 2.0)
}

#[test]
fn added_body_is_met() {
    let scene = empty().ball(1, dvec3(2.0, 5.0, 5.0), DVec3::X);
    let added = SimEdit::AddBody(Box::new(ball(2, dvec3(8.0, 5.0, 5.0), -DVec3::X)));
    let (sim, run) = run_edited(&scene, 5.0, Sampling::Every(0.3), &[(1.0, added)]);
    // At t = 1 the first is at 3: 4 m between surfaces, closing with 2 m/s.
    let hits = impacts(&run.events);
    assert_eq!(hits.len(), 1, "{:?}", run.events);
    assert!((hits[0].time - 3.0).abs() <= 1e-14, "{:?}", hits[0]);
    assert_eq!(sim.dynamic_count(), 2);
    assert!((state_of(&sim, 2).velocity - DVec3::X).length() <= 1e-15);
}

#[test]
fn removed_bodies_are_met_no_more() {
    let scene = empty().body(wall_at(9.0)).ball(2, dvec3(2.0, 5.0, 5.0), DVec3::X).ball(
        3,
        dvec3(6.0, 5.0, 5.0),
        DVec3::ZERO,
    );
    let edits = [(1.0, SimEdit::Remove(NodeKey(3))), (4.0, SimEdit::Remove(NodeKey(1)))];
    let (sim, run) = run_edited(&scene, 20.0, Sampling::Every(0.7), &edits);
    assert_eq!(impacts(&run.events).len(), 0, "{:?}", run.events);
    assert_eq!((sim.dynamic_count(), sim.static_count()), (1, 0));
    assert!((state_of(&sim, 2).position - dvec3(22.0, 5.0, 5.0)).length() <= 1e-13);
    assert_eq!(sim.find(NodeKey(3)), None);
}

#[test]
fn body_that_lay_on_a_removed_one_falls() {
    let resting = ball(2, dvec3(5.0, 4.5, 5.0), DVec3::ZERO).bounce(0.5);
    let shelf = plate(1, dvec3(5.0, 4.0, 5.0), dvec3(-FRAC_PI_2, 0.0, 0.0), 1.0, 1.0);
    let scene = empty().gravity(-9.8).body(shelf).body(resting);
    let (sim, _) = run_edited(&scene, 3.0, Sampling::Every(0.1), &[(2.0, SimEdit::Remove(NodeKey(1)))]);
    assert!((state_of(&sim, 2).position.y - (4.5 - 4.9)).abs() <= 1e-8, "{:?}", state_of(&sim, 2));
}

#[test]
fn changed_forces_act_from_their_time_on() {
    let scene = empty().gravity(-9.8).ball(1, DVec3::splat(5.0), DVec3::ZERO);
    let edits = [
        (1.0, SimEdit::ChangeForce(Box::new(Force::new(1, uniform(4.9))))),
        (2.0, SimEdit::AddForce(Box::new(Force::new(2, uniform(2.1))))),
        (3.0, SimEdit::Remove(Force::new(1, uniform(0.0)).key)),
        (4.0, SimEdit::Remove(Force::new(2, uniform(0.0)).key)),
    ];
    for sampling in [Sampling::Every(1.0), Sampling::Every(1.0 / 60.0), Sampling::Random(1)] {
        let (sim, run) = run_edited(&scene, 6.0, sampling, &edits);
        // v: −9.8, −4.9, 2.1, 4.2 and then constant.
        let y = 5.0 - 4.9 - 7.35 - 1.4 + 3.15 + 2.0 * 4.2;
        let state = state_of(&sim, 1);
        assert!((state.position.y - y).abs() <= 1e-12, "{sampling:?}: {state:?}, expected {y}");
        assert!((state.velocity.y - 4.2).abs() <= 1e-13, "{sampling:?}: {state:?}");
        assert!(run.events.iter().all(|event| event.kind == EventKind::Edit), "{:?}", run.events);
    }
}

#[test]
fn attractor_may_be_switched_on_and_off() {
    // With the pull off, the body goes on straight.
    let scene = empty().ball(1, dvec3(9.0, 5.0, 5.0), DVec3::Z);
    let pull = Force::new(1, ForceKind::GravityPoint { position: DVec3::splat(5.0), intensity: 4.0 });
    let edits = [(1.0, SimEdit::AddForce(Box::new(pull.clone()))), (1.0, SimEdit::Remove(pull.key))];
    let (sim, _) = run_edited(&scene, 3.0, Sampling::Every(0.25), &edits);
    assert!((state_of(&sim, 1).position - dvec3(9.0, 5.0, 8.0)).length() <= 1e-13);

    let (mut sim, _) = run_edited(&scene, 1.0, Sampling::Every(0.25), &[]);
    sim.apply(&SimEdit::AddForce(Box::new(pull.clone()))).expect("a new force");
    let before = sim.energy().total.expect("an attractor has a potential");
    advance(&mut sim, 5.0, Sampling::Every(0.25));
    let after = sim.energy().total.expect("an attractor has a potential");
    assert!((after / before - 1.0).abs() <= 1e-11, "energy {before} and {after}");
    sim.apply(&SimEdit::Remove(pull.key)).expect("it is there");
    let parted = state_of(&sim, 1);
    advance(&mut sim, 7.0, Sampling::Every(0.25));
    let expected = parted.position + parted.velocity * 2.0;
    assert!((state_of(&sim, 1).position - expected).length() <= 1e-12);
}

/// Forces are summed up by their UserIDs, whenever they were added.
#[test]
fn forces_that_come_and_go_add_up_to_the_same_bits() {
    let scene = thesis().attractor(dvec3(1.0, 2.0, 3.0), 0.7).gravity(-1.0 / 3.0).gravity(0.1);
    let [first, .., last] = scene.forces.as_slice() else { panic!("forces") };
    let [a, b] = [first, last].map(|force| {
        let mut sim = simulation(&scene);
        let mut events = advance(&mut sim, 1.0, Sampling::Every(0.25));
        let again = [SimEdit::Remove(force.key), SimEdit::AddForce(Box::new(force.clone()))];
        assert!(sim.apply_all(&again).iter().all(Result::is_ok));
        events.extend(advance(&mut sim, 4.0, Sampling::Every(0.25)));
        finished(&sim, events)
    });
    assert_same_bits(&a, &b, "the first or the last force added again");
}

#[test]
fn moved_static_is_met_at_its_new_place() {
    let scene = empty().body(wall_at(6.0)).ball(2, dvec3(2.0, 5.0, 5.0), DVec3::X);
    let moved = SimEdit::ChangeStatic(Box::new(wall_at(8.0)));
    let (_, run) = run_edited(&scene, 9.0, Sampling::Every(0.4), &[(2.0, moved)]);
    let hits = impacts(&run.events);
    assert_eq!(hits.len(), 1, "{:?}", run.events);
    assert!((hits[0].time - 5.5).abs() <= 1e-14, "{:?}", hits[0]);
}

#[test]
fn mass_and_bounce_count_from_their_time_on() {
    let scene =
        empty().ball(1, dvec3(2.0, 5.0, 5.0), DVec3::X * 2.0).ball(2, dvec3(6.0, 5.0, 5.0), DVec3::ZERO);
    let edits = [(0.5, SimEdit::Mass(NodeKey(1), 3.0)), (0.5, SimEdit::Bounce(NodeKey(2), 0.5))];
    let (sim, run) = run_edited(&scene, 2.0, Sampling::Every(0.4), &edits);
    // J = (1+e) μ Δv = 1.5 · 0.75 · 2.
    let hits = impacts(&run.events);
    assert!((hits[0].impulse - 2.25).abs() <= 1e-13, "{:?}", run.events);
    assert!((state_of(&sim, 1).velocity.x - 1.25).abs() <= 1e-13);
    assert!((state_of(&sim, 2).velocity.x - 2.25).abs() <= 1e-13);
}

#[test]
fn residual_leaves_out_the_work_of_edits() {
    let scene =
        empty().gravity(-9.8).floor(1, 3.0).body(ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO).bounce(0.9));
    let mut sim = simulation(&scene);
    let edits = [
        SimEdit::Mass(NodeKey(2), 5.0),
        SimEdit::ChangeForce(Box::new(Force::new(1, uniform(-4.0)))),
        SimEdit::AddBody(Box::new(ball(3, dvec3(3.0, 3.0, 5.0), DVec3::X))),
        SimEdit::AddForce(Box::new(Force::new(7, ForceKind::Drag { density: 3.0 }))),
        SimEdit::Remove(NodeKey(2)),
    ];
    for (k, edit) in edits.iter().enumerate() {
        sim.apply(edit).unwrap_or_else(|err| panic!("{edit:?}: {err}"));
        advance(&mut sim, 1.5 * (k + 1) as f64, Sampling::Every(0.2));
        let residual = sim.energy().residual.expect("built-in forces have a balance");
        assert!(residual.abs() <= 1e-10, "after {edit:?}: {residual:e}");
    }
}

#[test]
fn refused_edits_change_nothing() {
    let mut sim = simulation(&thesis());
    advance(&mut sim, 1.0, Sampling::Every(0.5));
    let before = sim.hash();
    let bad = [
        SimEdit::Remove(NodeKey(424_242)),
        SimEdit::Mass(NodeKey(5853), 0.0),
        SimEdit::Mass(NodeKey(5853), f64::NAN),
        SimEdit::Mass(NodeKey(8855), 2.0),
        SimEdit::Bounce(NodeKey(5853), -1.0),
        SimEdit::AddBody(Box::new(ball(5853, DVec3::ONE, DVec3::ZERO))),
        SimEdit::AddBody(Box::new(ball(99, DVec3::ONE, dvec3(f64::INFINITY, 0.0, 0.0)))),
        SimEdit::ChangeForce(Box::new(Force::new(424_242, uniform(1.0)))),
        SimEdit::ChangeStatic(Box::new(plate(424_242, DVec3::ONE, DVec3::ZERO, 1.0, 1.0))),
    ];
    for edit in &bad {
        assert!(sim.apply(edit).is_err(), "{edit:?} was taken");
        assert_eq!(sim.hash(), before, "{edit:?}");
    }
}

#[test]
fn the_same_edits_give_the_same_bits() {
    let scene = thesis();
    let edits = [
        (0.5, SimEdit::AddBody(Box::new(ball(77, dvec3(2.0, 8.0, 7.0), dvec3(1.0, 0.0, 2.0)).bounce(0.8)))),
        (
            1.25,
            SimEdit::ChangeForce(Box::new(Force::new(
                7045,
                ForceKind::GravityPoint { position: DVec3::splat(5.0), intensity: -3.0 },
            ))),
        ),
        (
            2.0,
            SimEdit::ChangeStatic(Box::new(plate(
                28100,
                dvec3(5.0, 3.0, 3.0),
                dvec3(0.3, 0.5, 0.0),
                1.0,
                1.5,
            ))),
        ),
        (3.0, SimEdit::Remove(NodeKey(8945))),
        (3.0, SimEdit::Bounce(NodeKey(5853), 0.9)),
        (4.0, SimEdit::AddForce(Box::new(Force::new(3, ForceKind::Drag { density: 1.3 })))),
        (5.0, SimEdit::Mass(NodeKey(15921), 4.0)),
    ];
    let (_, expected) = run_edited(&scene, 8.0, Sampling::Every(1.0), &edits);
    assert!(impacts(&expected.events).len() > 10, "{} events", expected.events.len());
    for tiles in [1, 10, 37] {
        for sampling in SAMPLINGS {
            let (_, got) = run_edited(&scene.clone().tiles([tiles; 3]), 8.0, sampling, &edits);
            assert_same_bits(&expected, &got, &format!("{sampling:?}, {tiles}³ tiles"));
        }
    }
}

/// An edit of nothing is none: bodies do not go on anew, which would round once more.
#[test]
fn nothing_to_change_changes_no_bit() {
    let (scene, sampling) = (thesis(), Sampling::Every(0.25));
    let mut sim = simulation(&scene);
    let mut events = advance(&mut sim, 1.7, sampling);
    assert!(sim.apply_all(&[]).is_empty());
    let absent: Arc<dyn polyscene::sim::Force> = Arc::new(Nothing);
    assert_eq!(sim.remove_force(&absent), Ok(false));
    events.extend(advance(&mut sim, 4.0, sampling));
    assert_same_bits(&run(&scene, 4.0, sampling), &finished(&sim, events), "edits of nothing");
}

#[derive(Debug)]
struct Nothing;

impl polyscene::sim::Force for Nothing {
    fn force(&self, _: &Subject<'_>) -> DVec3 {
        DVec3::ZERO
    }

    fn potential(&self, _: &Subject<'_>) -> Option<f64> {
        Some(0.0)
    }
}

/// A body added while it runs begins to turn when it comes, also where only a later edit lets bodies rub.
#[test]
fn an_added_body_turns_from_when_it_comes() {
    for is_rough in [true, false] {
        let lying = ball(1, dvec3(2.0, 5.0, 5.0), DVec3::ZERO).friction(if is_rough { 0.5 } else { 0.0 });
        let mut sim = simulation(&empty().body(lying));
        advance(&mut sim, 3.0, Sampling::Every(1.0));
        let added = ball(2, dvec3(8.0, 5.0, 5.0), DVec3::ZERO).spin(DVec3::Z).friction(0.5);
        sim.apply(&SimEdit::AddBody(Box::new(added))).expect("a sound body");
        advance(&mut sim, 4.0, Sampling::Every(1.0));
        let rough = Roughness { friction: 0.5, ..Roughness::default() };
        sim.apply(&SimEdit::Roughness(NodeKey(1), rough)).expect("it is there");
        advance(&mut sim, 4.5, Sampling::Every(1.0));
        let turn = state_of(&sim, 2).turn.expect("bodies rub now");
        let expected = DQuat::from_rotation_z(1.5);
        assert!(turn.orientation.angle_between(expected) <= 1e-7, "{turn:?}");
    }
}

/// The same edits at one time in two copies of a run, in one of them one by one.
fn edited_in_both_ways(scene: &Scene, at: f64, until: f64, edits: &[SimEdit]) -> [(Simulation, Run); 2] {
    let mut start = simulation(scene);
    let before = advance(&mut start, at, Sampling::Every(0.1));
    [true, false].map(|together| {
        let (mut sim, mut events) = (start.clone(), before.clone());
        if together {
            assert!(sim.apply_all(edits).iter().all(Result::is_ok));
        } else {
            edits.iter().for_each(|edit| sim.apply(edit).unwrap_or_else(|err| panic!("{edit:?}: {err}")));
        }
        events.extend(advance(&mut sim, until, Sampling::Every(0.1)));
        let run = finished(&sim, events);
        (sim, run)
    })
}

#[test]
fn edits_made_together_have_the_bits_of_one_after_the_other_and_begin_bodies_anew_once() {
    let rough = Roughness { friction: 0.4, ..Roughness::default() };
    let edits = |bodies: &[(i64, f64)]| {
        let masses = bodies.iter().map(|(id, mass)| SimEdit::Mass(NodeKey(*id as u64), *mass));
        masses.collect::<Vec<_>>()
    };
    let mut rolling = (0..6).fold(empty().gravity(-9.8).floor(1, 3.0), |scene, nth| {
        scene.body(ball(10 + nth, dvec3(3.0 + nth as f64, 1.6, 5.0), dvec3(0.3, 0.0, 0.1)).bounce(0.5))
    });
    rolling.bodies.iter_mut().for_each(|body| body.roughness = rough);
    let falling = (0..6).fold(empty().gravity(-9.8).floor(1, 3.0), |scene, nth| {
        scene.body(
            ball(10 + nth, dvec3(2.0 + nth as f64, 4.0, 5.0), dvec3(0.5 - nth as f64, 1.0, 0.0)).bounce(0.9),
        )
    });
    for scene in [falling, rolling] {
        let masses = edits(&[(10, 2.0), (12, 3.0), (13, 0.5)]);
        let more =
            SimEdit::AddBody(Box::new(ball(77, dvec3(2.0, 8.0, 7.0), dvec3(1.0, 0.0, 2.0)).bounce(0.8)));
        let wind = SimEdit::AddForce(Box::new(Force::new(3, uniform(0.5))));
        let edits: Vec<SimEdit> = masses.into_iter().chain([more, wind]).collect();
        let [(once, together), (_, apart)] = edited_in_both_ways(&scene, 1.0, 4.0, &edits);
        assert_same_bits(&apart, &together, "together");
        let rows = once.counters().events[EventKind::Edit as usize];
        assert_eq!(rows, edits.len() as u64);
    }
    // In a field every beginning rounds the velocity.
    let [once, apart] = edited_in_both_ways(&thesis(), 1.0, 1.0, &edits(&[(5853, 2.0), (8945, 3.0)]));
    for ((_, a), (_, b)) in once.1.states.iter().zip(&apart.1.states) {
        assert!((a.velocity - b.velocity).length() <= 1e-14 && a.position == b.position);
    }
    let begun = |(sim, _): &(Simulation, Run)| sim.counters().segments;
    assert_eq!(begun(&apart) - begun(&once), once.0.dynamic_count() as u64);
}

#[test]
fn of_edits_made_together_those_refused_change_nothing() {
    let edits = [SimEdit::Mass(NodeKey(5853), 2.0), SimEdit::Mass(NodeKey(8945), -1.0)];
    let [mut both, mut one] = [(); 2].map(|()| simulation(&thesis()));
    assert_eq!(both.apply_all(&edits).iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false]);
    one.apply(&edits[0]).unwrap_or_else(|err| panic!("{err}"));
    for sim in [&mut both, &mut one] {
        advance(sim, 5.0, Sampling::Every(0.5));
    }
    assert_eq!(both.hash(), one.hash());
    let before = simulation(&thesis());
    let mut after = before.clone();
    assert!(after.apply_all(&edits[1..]).iter().all(Result::is_err));
    assert_eq!((after.hash(), after.counters()), (before.hash(), before.counters()));
}

/// Hundreds of static spheres, each over thousands of tiles, in one edit: the tiles become coarser then as they would have
/// at the start, and what moves goes on as among those that were there from the start.
#[test]
fn many_static_bodies_added_together_coarsen_the_tiles_and_are_met() {
    let falls = |id: i64| ball(id, dvec3(2.0 + id as f64, 9.0, 5.0), DVec3::ZERO).radius(0.25);
    let scene = empty().tiles([160; 3]).gravity(-9.8).body(falls(1)).body(falls(2));
    let pebbles = (0..400_i64)
        .map(|k| static_ball(10 + k, dvec3((k % 20) as f64 * 0.5, 1.0, (k / 20) as f64 * 0.5), 1.0));
    let edits: Vec<SimEdit> = pebbles.clone().map(|body| SimEdit::AddBody(Box::new(body))).collect();
    let mut sim = simulation(&scene);
    let fine = sim.tiling(1).tiles;
    assert!(sim.apply_all(&edits).iter().all(Result::is_ok));
    assert_eq!((fine, sim.tiling(1).tiles), ([160; 3], [40; 3]));
    let events = advance(&mut sim, 3.0, Sampling::Every(0.1));
    let from_start = pebbles.fold(scene, Build::body);
    let mut other = simulation(&from_start);
    let expected = advance(&mut other, 3.0, Sampling::Every(0.1));
    let told = |events: &[polyscene::sim::Event]| -> Vec<_> {
        impacts(events)
            .iter()
            .map(|hit| (hit.time.to_bits(), hit.point.to_array().map(f64::to_bits)))
            .collect()
    };
    assert!(told(&expected).len() >= 2);
    assert_eq!(told(&events), told(&expected));
    assert_eq!(state_of(&sim, 2).position, state_of(&other, 2).position);
    // And all of them taken away at once.
    let gone: Vec<SimEdit> = (0..400).map(|k| SimEdit::Remove(NodeKey(10 + k))).collect();
    assert!(sim.apply_all(&gone).iter().all(Result::is_ok));
    assert_eq!((sim.static_count(), sim.find(NodeKey(10)), sim.find(NodeKey(2)).is_some()), (0, None, true));
}
