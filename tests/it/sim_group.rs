//! Several contacts at one instant: corners, trains of balls, a billiard break, jams.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec3, dvec3};
use polyscene::scene::Scene;
use polyscene::study::Random;
use polyscene::study::closed_form::cradle;

use crate::common::build::{Build, Shaped, ball, empty, plate};
use crate::common::drive::{Sampling, advance, assert_same_bits, run, simulation, state_of, states};

#[test]
fn corner_of_two_and_three_walls_sends_a_ball_straight_back() {
    // All walls are touched at the same instant, each turns its own component round.
    for velocity in
        [dvec3(-1.0, -1.0, 0.0), dvec3(-2.0, -2.0, -2.0), dvec3(3.0, 3.0, 3.0), dvec3(-1.5, -1.5, 0.25)]
    {
        let mut sim = simulation(&empty().walls(1).ball(10, DVec3::splat(5.0), velocity));
        advance(&mut sim, 4.5 / velocity.abs().max_element() + 0.1, Sampling::Every(0.7));
        let turned = velocity * dvec3(-1.0, -1.0, if velocity.z.abs() < 1.0 { 1.0 } else { -1.0 });
        let found = state_of(&sim, 10).velocity;
        assert!((found - turned).length() <= 1e-12, "{velocity}: {found}");
    }
}

#[test]
fn corner_of_any_angle_keeps_energy_and_mirror_symmetry() {
    // Falling into a V along its plane of symmetry, a ball comes back along it.
    for tilt in [0.2, 0.5, 0.7, 1.0, 1.3] {
        let side = |id: i64, sign: f64| {
            let rotation = dvec3(-FRAC_PI_2, sign * tilt, 0.0);
            plate(id, dvec3(5.0, 0.0, 5.0), rotation, 30.0, 30.0)
        };
        let scene = empty().body(side(1, 1.0)).body(side(2, -1.0)).ball(
            3,
            dvec3(5.0, 8.0, 5.0),
            dvec3(0.0, -2.0, 0.0),
        );
        let mut sim = simulation(&scene);
        advance(&mut sim, 5.0, Sampling::Every(0.3));
        let velocity = state_of(&sim, 3).velocity;
        assert!((velocity - dvec3(0.0, 2.0, 0.0)).length() <= 1e-12, "tilt {tilt}: {velocity}");
    }
}

#[test]
fn as_many_balls_leave_a_cradle_as_came_in() {
    for incoming in [2, 3] {
        let along = DVec3::X;
        let scene = (0..incoming)
            .fold(empty(), |scene, k| scene.ball(1 + k, dvec3(k as f64 - 4.0, 5.0, 5.0), along * 2.0));
        let scene =
            (0..5).fold(scene, |scene, k| scene.ball(10 + k, dvec3(2.0 + k as f64, 5.0, 5.0), DVec3::ZERO));
        for dt in [1.0, 1.0 / 60.0] {
            let run = run(&scene, 4.0, Sampling::Every(dt));
            let expected = cradle(run.states.len(), incoming as usize, along * 2.0);
            for (k, ((_, state), expected)) in run.states.iter().zip(expected).enumerate() {
                assert!(
                    (state.velocity - expected).length() <= 1e-12,
                    "{incoming} in, ball {k}: {}",
                    state.velocity
                );
            }
        }
    }
}

/// A rack of 15 touching balls in a triangle in the xz plane, symmetric about x, and a cue ball.
fn billiard(ids: &[i64; 16]) -> Scene {
    let row_distance = 0.75_f64.sqrt();
    let mut scene = empty().ball(ids[0], dvec3(-3.0, 5.0, 0.0), dvec3(6.0, 0.0, 0.0));
    let mut next = 1;
    for row in 0..5 {
        for place in 0..=row {
            let across = f64::from(place) - f64::from(row) / 2.0;
            scene = scene.ball(ids[next], dvec3(f64::from(row) * row_distance, 5.0, across), DVec3::ZERO);
            next += 1;
        }
    }
    scene
}

#[test]
fn billiard_break_keeps_mirror_symmetry_energy_and_momentum() {
    // Contact is at t = 1/3 s.
    let ids: [i64; 16] = std::array::from_fn(|k| k as i64 + 1);
    for (time, tolerance) in [(1.0 / 3.0 + 1e-9, 1e-12), (1.0 / 3.0 + 0.1, 1e-9)] {
        let mut sim = simulation(&billiard(&ids));
        advance(&mut sim, time, Sampling::Every(1.0));
        let found: Vec<_> = states(&sim).iter().map(|(_, state)| state.velocity).collect();
        let mut next = 1;
        for row in 0..5 {
            for place in 0..=row {
                let (v, mirror) = (found[next + place], found[next + row - place]);
                let off = (v - mirror * dvec3(1.0, 1.0, -1.0)).length();
                assert!(off <= tolerance * 6.0, "t {time}, row {row}, place {place}: {v} and {mirror}");
            }
            next += row + 1;
        }
        let energy: f64 = found.iter().map(|v| v.length_squared() / 2.0).sum();
        assert!((energy / 18.0 - 1.0).abs() <= 1e-12, "t {time}: energy {energy}");
        let momentum: DVec3 = found.iter().sum();
        assert!((momentum - dvec3(6.0, 0.0, 0.0)).length() <= 1e-12, "t {time}: momentum {momentum}");
    }
}

#[test]
fn billiard_break_does_not_depend_on_the_order_of_the_file() {
    let ids: [i64; 16] = std::array::from_fn(|k| k as i64 + 1);
    let expected = run(&billiard(&ids), 1.0, Sampling::Every(0.1));
    let mut random = Random::new(5);
    for _ in 0..5 {
        let mut scene = billiard(&ids);
        random.shuffle(scene.bodies.as_mut_slice());
        assert_same_bits(&expected, &run(&scene, 1.0, Sampling::Every(0.1)), "another order");
    }
}

#[test]
fn a_ball_in_a_gap_of_its_own_size_is_thrown_to_and_fro_no_more() {
    // It touches both walls: each impact would be followed by the next at the same time, for ever.
    for e in [0.3, 0.7, 1.0] {
        let wall = |id: i64, x: f64| plate(id, dvec3(x, 5.0, 5.0), dvec3(0.0, FRAC_PI_2, 0.0), 3.0, 3.0);
        let scene = empty().body(wall(1, 5.0)).body(wall(2, 6.0));
        let scene = scene.body(ball(3, dvec3(5.5, 5.0, 5.0), dvec3(2.0, 0.0, 0.5)).bounce(e));
        let run = run(&scene, 3.0, Sampling::Every(0.1));
        assert!(run.events.len() <= 4, "e {e}: {} events", run.events.len());
        let state = run.states[0].1;
        assert!((state.velocity - dvec3(0.0, 0.0, 0.5)).length() <= 1e-12, "e {e}: {state:?}");
    }
}

#[test]
fn a_slow_neighbour_within_the_contact_distance_is_hit_with_the_other() {
    let mut scene = empty()
        .ball(1, dvec3(2.0, 5.0, 5.0), dvec3(2.0, 0.0, 0.0))
        .ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO)
        .ball(3, dvec3(6.0005, 5.0, 5.0), dvec3(0.0, 1e-4, 0.0));
    scene.params.contact_distance = 2e-3;
    let events = run(&scene, 1.2, Sampling::Every(0.1)).events;
    assert_eq!(events.len(), 2, "{events:?}");
    assert_eq!((events[0].group, events[0].time), (events[1].group, events[1].time), "{events:?}");
}

#[test]
fn touching_neighbours_are_found_across_the_border_of_tiles() {
    // Half a contact distance apart on both sides of x = 5, where tiles of 1 m meet and one tile does not.
    let scene = |tiles: u32| {
        let mut scene = empty()
            .tiles([tiles; 3])
            .ball(1, dvec3(2.0, 5.0, 5.0), dvec3(2.0, 0.0, 0.0))
            .ball(2, dvec3(4.49975, 5.0, 5.0), DVec3::ZERO)
            .ball(3, dvec3(5.50025, 5.0, 5.0), DVec3::ZERO);
        scene.params.contact_distance = 2e-3;
        scene
    };
    let [one, ten] = [1, 10].map(|tiles| run(&scene(tiles), 1.5, Sampling::Every(0.1)));
    assert_eq!(one.events[0].time, one.events[1].time, "{:?}", one.events);
    assert_same_bits(&one, &ten, "in more tiles");
}

#[test]
fn elastic_contacts_stay_elastic_beside_a_floor_without_bounce() {
    // A ball falls on one of two that stand on a floor: whether the floor has a Bounce of 0 or next to it must
    // not matter to the balls.
    let scene = |floor: f64| {
        let mut scene = empty().floor(9, 4.0);
        scene.bodies[0].bounce = floor;
        scene.ball(1, dvec3(5.0, 0.5, 5.0), DVec3::ZERO).ball(2, dvec3(6.0, 0.5, 5.0), DVec3::ZERO).ball(
            3,
            dvec3(5.5, 3.0, 5.0),
            dvec3(0.0, -2.0, 0.0),
        )
    };
    let [none, little] = [0.0, 1e-9].map(|floor| run(&scene(floor), 2.0, Sampling::Every(0.1)));
    for ((_, left), (_, right)) in none.states.iter().zip(&little.states) {
        assert!((left.velocity - right.velocity).length() <= 1e-6, "{left:?} {right:?}");
    }
}

#[test]
fn simultaneous_impacts_apart_from_each_other_are_all_told() {
    // Three pairs and a wall, all at t = 1: four rows at one time, in the order of the UserIDs.
    let scene = (0..3).fold(empty().plate(90, dvec3(20.0, 0.0, 0.0), DVec3::ZERO, 1.0, 1.0), |scene, k| {
        let z = 3.0 * k as f64;
        scene.ball(2 * k + 1, dvec3(0.0, 0.0, z), DVec3::X).ball(2 * k + 2, dvec3(3.0, 0.0, z), -DVec3::X)
    });
    let scene = scene.body(ball(50, dvec3(20.0, 0.0, 1.5), -DVec3::Z).mass(2.0));
    let events = run(&scene, 2.0, Sampling::Every(0.7)).events;
    assert_eq!(events.len(), 4, "{events:?}");
    assert!(events.iter().all(|event| event.time == 1.0), "{events:?}");
    let labels: Vec<_> = {
        let sim = simulation(&scene);
        events.iter().map(|event| sim.label(event.a).to_owned()).collect()
    };
    assert_eq!(labels, ["1", "3", "5", "50"]);
}

#[test]
fn rows_of_a_group_know_their_place_however_one_looks() {
    // Symptom: a row said "6/6", and "7/7" after the next look. Expected: "6/7" at once. Cause: what had been handed
    // out of a group was counted, not what there is.
    for sampling in [Sampling::Events, Sampling::Every(0.1)] {
        let ids: [i64; 16] = std::array::from_fn(|k| k as i64 + 1);
        let events = run(&billiard(&ids), 0.34, sampling).events;
        let group: Vec<_> = events.iter().filter(|event| event.group == events[0].group).collect();
        assert!(group.len() > 3, "{events:?}");
        for (nth, event) in (1..).zip(&group) {
            assert_eq!(event.row_in_group, [nth, group.len() as u32], "{event:?}");
        }
    }
}
