//! Stepped groups: heaps come to rest, wake, gain nothing, and depend on nothing but the scene.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{DVec3, dvec3};
use polyscene::scene::{self, ForceKind, NodeKey, Scene};
use polyscene::sim::{BodyRef, ContactState, Event, EventKind, Force, SimEdit, Simulation, Subject};
use polyscene::study::Random;

use crate::common::build::{Build, Shaped, ball, empty, plate};
use crate::common::contact_scenes::{ContactScene, scaled};
use crate::common::drive::{Sampling, advance, assert_same_bits, run, simulation, watch};
use crate::common::heaps::{BOX, GRAVITY, Heap, RADIUS};
use crate::common::load::load;

/// Looks between events, s.
const LOOK: Sampling = Sampling::Every(1.0 / 128.0);

/// Runs on until a time, looking often: nothing overlaps, leaves or gains; gives the events.
fn watched(heap: &Heap, sim: &mut Simulation, scene: &Scene, until: f64) -> Vec<Event> {
    // Of a ball of 1 kg.
    let most = 1e-2 * -GRAVITY * RADIUS * heap.heaviest;
    let (mut events, mut lowest) = (Vec::new(), f64::INFINITY);
    watch(sim, until, LOOK, |sim, event| {
        events.extend(event);
        let overlap = heap.overlap(sim, scene);
        assert!(overlap <= 1e-3, "t {}: overlap {overlap:e} of a radius", sim.time());
        let escape = heap.escape(sim);
        assert!(escape <= 0.0, "t {}: {escape:e} m out of the box", sim.time());
        let energy = sim.energy();
        let total = energy.total.expect("gravity has a potential");
        lowest = lowest.min(total);
        assert!(total - lowest <= most, "t {}: up by {:e} J", sim.time(), total - lowest);
        let residual = energy.residual.expect("all work is known");
        assert!(residual.abs() <= 1e-11, "t {}: residual {residual:e}", sim.time());
    });
    assert!(sim.momentum().residual <= 1e-11, "momentum {:e}", sim.momentum().residual);
    events
}

fn count(events: &[Event], kind: EventKind) -> usize {
    events.iter().filter(|event| event.kind == kind).count()
}

fn count_of(sim: &Simulation, state: ContactState) -> usize {
    let bodies = sim.dynamic_bodies().filter_map(|body| sim.state(body));
    bodies.filter(|body| body.contact == state).count()
}

/// Without friction a ball may glide slowly over the floor for some time, or heaps balance where they can't stay: so
/// motion must be next to nothing soon, and all must lie still in the end.
#[test]
fn small_heaps_come_to_rest() {
    for balls in [5, 8, 12, 27] {
        for (restitution, seed) in [(0.2, 1), (0.5, 2), (0.8, 3)] {
            let heap = Heap::of(balls, restitution, seed);
            let scene = heap.scene();
            let mut sim = simulation(&scene);
            watched(&heap, &mut sim, &scene, 5.0);
            let kinetic = sim.energy().kinetic;
            assert!(
                kinetic <= 1e-3 * balls as f64 * -GRAVITY * RADIUS,
                "of {balls}, seed {seed}: {kinetic:e} J"
            );
            watched(&heap, &mut sim, &scene, 10.0);
            let resting = count_of(&sim, ContactState::Rest);
            assert_eq!(resting, balls, "of {balls} balls of {restitution}, seed {seed}");
        }
    }
}

#[test]
fn a_heap_at_rest_presses_on_its_floor_with_its_weight() {
    let heap = Heap::of(27, 0.2, 1);
    let scene = heap.scene();
    let mut sim = simulation(&scene);
    watched(&heap, &mut sim, &scene, 10.0);
    assert!(sim.stepped().is_none(), "it has come to rest");
    let forces = sim.contact_forces(usize::MAX);
    let on_statics = forces.iter().filter(|contact| matches!(contact.b, BodyRef::Static(_)));
    let down: f64 = on_statics.map(|contact| -contact.force * contact.normal.y).sum();
    let weight: f64 = sim.dynamic_bodies().filter_map(|body| sim.mass(body)).sum::<f64>() * -GRAVITY;
    assert!((down - weight).abs() <= 0.05 * weight, "{down} N for a weight of {weight} N");
    let strongest = forces.iter().map(|contact| contact.force).fold(0.0, f64::max);
    assert_eq!(sim.contact_forces(1).iter().map(|contact| contact.force).collect::<Vec<_>>(), [strongest]);
}

#[test]
fn what_is_stepped_is_told_with_its_forces_and_since_when() {
    let heap = Heap::of(27, 0.2, 1);
    let scene = heap.scene();
    let mut sim = simulation(&scene);
    assert!(sim.stepped().is_none() && sim.contact_forces(9).is_empty());
    let events = advance(&mut sim, 0.25, LOOK);
    let first = events.iter().find(|event| event.kind == EventKind::Dense).expect("it is stepped by now");
    let stepped = sim.stepped().expect("it is not at rest yet");
    assert_eq!(stepped.count, count_of(&sim, ContactState::Stepped));
    assert!(stepped.since >= first.time && stepped.since < sim.time());
    for contact in sim.contact_forces(usize::MAX) {
        assert!(contact.force > 0.0 && (contact.normal.length() - 1.0).abs() < 1e-12);
        let state = sim.state(contact.a).expect("the first is dynamic");
        let off = (contact.point - state.position).length() - RADIUS;
        assert!(off.abs() < 1e-9, "{off} m off the surface");
    }
}

#[test]
fn heaps_of_balls_of_many_sizes_and_masses_hold() {
    let heap = Heap { smallest: 1.0 / 3.0, heaviest: 1000.0, ..Heap::of(40, 0.2, 5) };
    let scene = heap.scene();
    let mut sim = simulation(&scene);
    let events = watched(&heap, &mut sim, &scene, 2.0);
    assert!(count(&events, EventKind::Dense) > 0);
}

/// Symptom: balls from 10 g to 10 t in a box played at a third of real time. Expected: the work of a step does not grow with
/// the ratio of masses. Cause: sweeps take some M/m rounds there, and steps were halved in vain (measured until 2 s: 3.6
/// million sweeps and 5500 halvings, and 0.32 million and 600 since such contacts are solved at once).
#[test]
fn balls_a_million_times_heavier_than_others_are_not_swept_for_ever() {
    let scene = load("masses.xml");
    let mut sim = simulation(&scene);
    advance(&mut sim, 2.0, LOOK);
    let counters = sim.counters();
    assert!(counters.steps > 1000, "{counters:?}");
    assert!(counters.sweeps < 1_000_000 && counters.halvings < 2000, "{counters:?}");
    assert!(sim.energy().residual.expect("all work is known").abs() <= 1e-11);
}

/// Symptom: thirty balls on a floor, an attractor a metre above them, played at twice real time where they play at sixteen times
/// now. Expected: steps are as long as what drives the bodies wants it where they are. Cause: every step was as short as one
/// between bodies that touch at the attractor's centre.
#[test]
fn an_attractor_that_nobody_is_near_shortens_no_steps() {
    let steps_of = |scene: &Scene| {
        let mut sim = simulation(scene);
        advance(&mut sim, 1.0, LOOK);
        let energy = sim.energy().residual.expect("all work is known");
        assert!(energy.abs() <= 1e-6, "residual {energy:e}");
        sim.counters().steps as f64
    };
    let heap = Heap::of(27, 0.2, 1);
    let alone = steps_of(&heap.scene());
    // A quarter of gravity at the floor, and 256 times it at two radii.
    let below = dvec3(2.2, 1.0 - 64.0 * RADIUS, 2.2);
    let beside_one = steps_of(&heap.scene().attractor(below, -GRAVITY * 1024.0 * RADIUS * RADIUS));
    assert!(alone > 100.0 && beside_one <= 3.0 * alone, "{beside_one} steps, and {alone} without it");
}

/// Symptom: a residual of 1e-6 in the angular momentum of a heap that rubs, beside an attractor. Cause: what the pull changed by
/// from step to step was not in the books.
#[test]
fn a_heap_that_rubs_beside_an_attractor_keeps_its_books_of_angular_momentum() {
    let heap = Heap::of(27, 0.2, 1);
    let beside = dvec3(2.2, 1.0 - 8.0 * RADIUS, 2.2);
    let mut scene = heap.scene().attractor(beside, -0.25 * GRAVITY * 64.0 * RADIUS * RADIUS);
    scene.bodies = scene.bodies.into_iter().map(|body| body.friction(0.3)).collect();
    let mut sim = simulation(&scene);
    advance(&mut sim, 1.0, LOOK);
    assert!(sim.counters().steps > 100);
    let angular = sim.angular_momentum().expect("a scene that rubs").residual;
    assert!(angular <= 1e-13, "residual {angular:e}");
}

#[test]
fn a_column_in_single_file_holds() {
    let heap = Heap { width: 2.4 * RADIUS, ..Heap::of(30, 0.2, 6) };
    let scene = heap.scene();
    let mut sim = simulation(&scene);
    watched(&heap, &mut sim, &scene, 2.0);
    assert!(sim.counters().steps > 0);
}

#[test]
fn stepped_groups_are_the_same_bits_for_every_dt_tiling_and_file_order() {
    let scene = Heap::of(40, 0.3, 7).scene();
    let until = 1.5;
    let expected = run(&scene, until, Sampling::Every(1.0 / 60.0));
    assert!(expected.events.iter().any(|event| event.kind == EventKind::Dense));
    for sampling in [Sampling::Every(1.0), Sampling::Every(1e-3), Sampling::Random(3), Sampling::Events] {
        assert_same_bits(&expected, &run(&scene, until, sampling), &format!("{sampling:?}"));
    }
    for tiles in [1, 10, 37] {
        let other = scene.clone().tiles([tiles; 3]);
        assert_same_bits(
            &expected,
            &run(&other, until, Sampling::Every(1.0 / 60.0)),
            &format!("{tiles} tiles"),
        );
    }
    let mut shuffled = scene.clone();
    Random::new(1).shuffle(shuffled.bodies.as_mut_slice());
    assert_same_bits(&expected, &run(&shuffled, until, Sampling::Every(1.0 / 60.0)), "another order");
}

#[test]
fn stepped_groups_scale() {
    let scene = Heap::of(12, 0.3, 8).scene();
    let expected = run(&scene, 1.5, Sampling::Every(1.0 / 60.0));
    let length = 1024.0;
    let whole = ContactScene { what: "a heap".into(), scene, until: 1.5, most_events: u64::MAX };
    // Lengths by 4⁵, times by 2⁵: gravity stays.
    let scaled = scaled(&whole, length, 32.0).scene;
    let got = run(&scaled, 48.0, Sampling::Every(32.0 / 60.0));
    assert_eq!(expected.events.len(), got.events.len());
    for (one, other) in expected.events.iter().zip(&got.events) {
        assert_eq!((one.kind, 32.0 * one.time, one.a), (other.kind, other.time, other.a));
    }
    for ((_, one), (_, other)) in expected.states.iter().zip(&got.states) {
        assert_eq!(length * one.position, other.position);
    }
}

/// A spring to a place that is nothing at the start and swings.
#[derive(Debug)]
struct Swing {
    middle: DVec3,
    /// N/m.
    stiffness: f64,
    /// rad/s.
    frequency: f64,
}

impl Force for Swing {
    fn force(&self, on: &Subject<'_>) -> DVec3 {
        self.stiffness * (self.frequency * on.time).sin() * (self.middle - on.position)
    }

    fn potential(&self, _: &Subject<'_>) -> Option<f64> {
        None
    }
}

/// Nothing but 1/1024 m and 1 s could tell how long a step is of bodies that lie still under a force that is nothing yet.
#[test]
fn steps_under_a_force_that_is_nothing_at_first_scale() {
    let middle = DVec3::splat(5.0);
    let corner = |k: i64, bit: i64| if k & (1 << bit) == 0 { -1.0 } else { 1.0 + 0.1 * k as f64 };
    let balls = (0..8_i64)
        .map(|k| ball(k + 1, middle + dvec3(corner(k, 0), corner(k, 1), corner(k, 2)), DVec3::ZERO));
    let scene = balls.fold(empty(), |scene, ball| scene.body(ball.bounce(0.3)));
    let whole = ContactScene { what: "eight balls".into(), scene, until: 2.5, most_events: u64::MAX };
    let swung = |length: f64, time: f64| {
        let mut sim = simulation(&scaled(&whole, length, time).scene);
        let (stiffness, frequency) = (8.0 / (time * time), 1.0 / time);
        sim.add_force(Arc::new(Swing { middle: length * middle, stiffness, frequency }))
            .expect("a sound force");
        assert_eq!(sim.plan().group_step, 0.0, "nothing tells how long a step is");
        let mut was_stepped = false;
        watch(&mut sim, 2.5 * time, Sampling::Every(time / 8.0), |sim, _| {
            was_stepped |= sim.stepped().is_some();
        });
        assert!(was_stepped, "they meet too often for events");
        sim
    };
    let plain = swung(1.0, 1.0);
    let step = plain.plan().group_step;
    assert!((1e-4..0.1).contains(&step), "{step}");
    let other = swung(1024.0, 32.0);
    assert_eq!(32.0 * step, other.plan().group_step);
    for body in plain.dynamic_bodies() {
        let [one, other] = [&plain, &other].map(|sim| sim.state(body).expect("a body").position);
        assert!((1024.0 * one - other).length() <= 1e-9 * other.length(), "{one} {other}");
    }
}

#[test]
fn steps_found_from_motion_follow_the_fastest() {
    let still = empty().body(ball(1, DVec3::splat(5.0), DVec3::ZERO).bounce(0.5));
    let mut sim = simulation(&still.ball(2, dvec3(8.0, 5.0, 5.0), DVec3::ZERO));
    assert_eq!(sim.plan().group_step, 0.0);
    // 0.02 · 0.5 m/v, as a power of two.
    for (id, speed, expected) in [(3, 1.0, 1.0 / 128.0), (4, 16.0, 1.0 / 2048.0), (5, 2.0, 1.0 / 2048.0)] {
        let added = ball(id, dvec3(1.0, 2.0 * id as f64 - 5.0, 1.0), -speed * DVec3::X);
        sim.apply(&SimEdit::AddBody(Box::new(added))).expect("a sound body");
        assert_eq!(sim.plan().group_step, expected, "{speed} m/s");
    }
}

/// Seen: under 1e-9 m/s² steps came from that alone, and balls at 5 cm/s passed a quarter of their radius in one and overlapped
/// by a fifth. Right: where most fly faster than a fall through the map makes them, the step is the one without forces.
#[test]
fn steps_in_weak_gravity_follow_the_fastest() {
    for (gravity, speed, expected) in
        [(1e-9, 1.0, 1.0 / 128.0), (9.8, 1.0, 1.0 / 512.0), (9.8, 100.0, 1.0 / 16384.0)]
    {
        let balls = empty().gravity(-gravity).body(ball(1, DVec3::splat(5.0), DVec3::ZERO).bounce(0.5));
        let thrown = |id: i64| ball(id, dvec3(1.0, 2.0 * id as f64, 1.0), speed * DVec3::X).bounce(0.5);
        let sim = simulation(&balls.body(thrown(2)).body(thrown(3)));
        assert_eq!(sim.plan().group_step, expected, "{gravity} m/s², {speed} m/s");
    }
}

/// Seen: steps grew with the smallest ball that was left, and what they might leave unsolved did not.
#[test]
fn a_heap_without_its_smallest_ball_goes_on_as_if_that_had_never_been() {
    let heap = Heap::of(12, 0.3, 8);
    let tiny = ball(100, dvec3(7.0, 1.0, 7.0), DVec3::ZERO).radius(0.01 * RADIUS);
    let mut sim = simulation(&heap.scene().body(tiny));
    let mut other = simulation(&heap.scene());
    assert!(sim.plan().group_step < other.plan().group_step);
    sim.apply(&SimEdit::Remove(NodeKey(100))).expect("it is there");
    assert_eq!(sim.plan().group_step, other.plan().group_step);
    for sim in [&mut sim, &mut other] {
        let mut was_stepped = false;
        watch(sim, 1.0, LOOK, |sim, _| was_stepped |= sim.stepped().is_some());
        assert!(was_stepped);
    }
    let places = |sim: &Simulation| {
        let bodies = sim.dynamic_bodies().filter_map(|body| sim.state(body));
        bodies.map(|state| state.position).collect::<Vec<_>>()
    };
    assert_eq!(places(&sim), places(&other));
}

/// A heap that has come to rest.
fn frozen(balls: usize) -> (Heap, Scene, Simulation) {
    let heap = Heap::of(balls, 0.2, 9);
    let scene = heap.scene();
    let mut sim = simulation(&scene);
    watched(&heap, &mut sim, &scene, 5.0);
    assert_eq!(count_of(&sim, ContactState::Rest), balls);
    (heap, scene, sim)
}

#[test]
fn a_ball_dropped_on_a_frozen_heap_wakes_it() {
    let (heap, mut scene, mut sim) = frozen(30);
    let middle = 2.0 + 0.5 * heap.width();
    let mut ball = ball(99, dvec3(middle, 6.0, middle), DVec3::ZERO).radius(RADIUS).bounce(0.5);
    ball.key = NodeKey(777_777);
    scene = scene.body(ball.clone());
    sim.apply(&SimEdit::AddBody(Box::new(ball))).expect("it is added");
    let events = watched(&heap, &mut sim, &scene, 10.0);
    assert!(count(&events, EventKind::Dense) >= 1);
    assert!(count(&events, EventKind::GroupRest) >= 1);
    assert_eq!(count_of(&sim, ContactState::Rest), 31);
}

#[test]
fn a_frozen_heap_falls_apart_when_a_wall_is_taken_away() {
    let (_, scene, mut sim) = frozen(30);
    let wall = scene.bodies.iter().find(|body| body.id == BOX[1]).expect("there is a wall");
    let leftmost = |sim: &Simulation| {
        let states = sim.dynamic_bodies().filter_map(|body| sim.state(body));
        states.map(|state| state.position.x).fold(f64::INFINITY, f64::min)
    };
    let before = leftmost(&sim);
    sim.apply(&SimEdit::Remove(wall.key)).expect("it is removed");
    sim.begin(6.0);
    sim.finish(&mut |_, _| {}).expect("it goes on");
    assert!(leftmost(&sim) < before - RADIUS);
    assert!(sim.energy().residual.is_some_and(|residual| residual.abs() <= 1e-11));
}

#[test]
fn a_frozen_heap_wakes_when_gravity_changes_and_rests_again() {
    let (heap, scene, mut sim) = frozen(27);
    let mut force = scene.forces[0].clone();
    let gravity = |acceleration: DVec3| ForceKind::GravityPlane { position: DVec3::ZERO, acceleration };
    force.kind = gravity(DVec3::ZERO);
    sim.apply(&SimEdit::ChangeForce(Box::new(force.clone()))).expect("it changes");
    watched(&heap, &mut sim, &scene, 6.0);
    force.kind = gravity(dvec3(0.5, GRAVITY, 0.0));
    sim.apply(&SimEdit::ChangeForce(Box::new(force))).expect("it changes");
    watched(&heap, &mut sim, &scene, 12.0);
    assert_eq!(count_of(&sim, ContactState::Rest), 27);
}

/// A ball of a heap removed in one go with a force that lets a rubbing ball enter steps at once: it is in no tile and pushes nobody.
#[test]
fn who_is_removed_from_a_heap_is_in_no_list_any_more() {
    let mut scene = Heap::of(27, 0.3, 3).scene();
    let floor = plate(20_000, dvec3(6.0, 1.0, 6.0), dvec3(-FRAC_PI_2, 0.0, 0.0), 0.5, 0.5).bounce(0.0);
    let lone = ball(20_001, dvec3(6.0, 1.0 + RADIUS, 6.0), dvec3(0.3, 0.0, 0.0)).radius(RADIUS).bounce(0.0);
    scene = scene.body(floor).body(lone);
    for body in &mut scene.bodies {
        (body.roughness.friction, body.roughness.rolling) = (0.5, 1e-3);
    }
    let gone = scene.bodies.iter().find(|body| body.id == 1).expect("a ball").key;
    let mut sim = simulation(&scene);
    advance(&mut sim, 0.6, Sampling::Every(0.1));
    let body = sim.find(gone).expect("it is there");
    let is_pushed = |sim: &Simulation| {
        sim.contact_forces(usize::MAX).iter().any(|contact| contact.a == body || contact.b == body)
    };
    assert!(sim.stepped().is_some() && is_pushed(&sim));
    let air = scene::Force::new(5, ForceKind::Drag { density: 1e-3 });
    let edits = [SimEdit::Remove(gone), SimEdit::AddForce(Box::new(air))];
    assert!(sim.apply_all(&edits).iter().all(Result::is_ok));
    let is_in_tiles = |sim: &Simulation| sim.candidate_sets().iter().any(|set| set.dynamic.contains(&body));
    assert!(!is_in_tiles(&sim), "it is in tiles again");
    watch(&mut sim, 1.0, LOOK, |sim, _| assert!(!is_pushed(sim), "t {}", sim.time()));
}

/// Gravity that turns over from downwards to the side, from a time on.
#[derive(Debug)]
struct Turning {
    from: f64,
}

impl Force for Turning {
    fn force(&self, on: &Subject<'_>) -> DVec3 {
        let turned = (on.time - self.from).clamp(0.0, 1.0);
        -GRAVITY * on.mass * dvec3(turned * turned, turned * turned - 1.0, 0.0)
    }

    fn potential(&self, _: &Subject<'_>) -> Option<f64> {
        None
    }
}

/// What lies still under a force that depends on time falls to the side when that does.
#[test]
fn a_heap_under_a_force_of_time_does_not_rest_for_ever() {
    let heap = Heap { width: 0.6, ..Heap::of(12, 0.2, 1) };
    let mut scene = heap.scene();
    scene.forces.clear();
    let mut sim = simulation(&scene);
    // Long after it would have been left lying.
    sim.add_force(Arc::new(Turning { from: 12.0 })).expect("a sound force");
    advance(&mut sim, 12.0, Sampling::Every(0.5));
    assert!(sim.energy().kinetic <= 1e-6, "{:?}", sim.energy());
    let middle = |sim: &Simulation| {
        let states = sim.dynamic_bodies().filter_map(|body| sim.state(body));
        states.map(|state| state.position.x).sum::<f64>() / heap.balls as f64
    };
    let before = middle(&sim);
    advance(&mut sim, 14.0, Sampling::Every(0.5));
    assert!(middle(&sim) > before + RADIUS, "from {before} to {} m", middle(&sim));
}

/// A floor put through a falling heap is met with the restitution of what meets it, and not given back as if nothing was lost.
#[test]
fn a_floor_put_through_a_falling_heap_takes_energy() {
    let heap = Heap::of(27, 0.25, 3);
    let scene = heap.scene();
    let floor = scene.bodies.iter().find(|body| body.id == BOX[0]).cloned().expect("a floor");
    let mut sim = simulation(&scene);
    advance(&mut sim, 1.0, Sampling::Every(0.25));
    assert!(sim.stepped().is_some(), "they lie and are stepped");
    sim.apply(&SimEdit::Remove(floor.key)).expect("it is there");
    // Half a radius: those that lay on the floor are half through.
    advance(&mut sim, 1.0 + (RADIUS / -GRAVITY).sqrt(), Sampling::Every(0.25));
    let lowest = |sim: &Simulation| {
        let bodies = sim.dynamic_bodies().filter_map(|body| Some((body, sim.state(body)?)));
        bodies.min_by(|(_, a), (_, b)| a.position.y.total_cmp(&b.position.y)).expect("a ball")
    };
    let (body, before) = lowest(&sim);
    sim.apply(&SimEdit::AddBody(Box::new(floor))).expect("it is gone");
    let after = sim.state(body).expect("it is there");
    assert!(before.velocity.y < -0.5, "{before:?}");
    assert!((0.0..=0.3 * -before.velocity.y).contains(&after.velocity.y), "{before:?} {after:?}");
}
