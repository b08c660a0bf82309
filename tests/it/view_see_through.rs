//! Which walls of a closed box are glass, from everywhere.

use glam::{DVec3, dvec3};
use polyscene::scene::{NodeKey, Scene};
use polyscene::view::{AxisView, Camera, Projection, ViewInput, Viewport, is_see_through};

use crate::view_scenes::{ball, closed_box, empty, furnished_box, plate};

/// Keys of the plates that are glass.
fn glass(scene: &Scene, camera: Camera) -> Vec<u64> {
    let input = ViewInput::new(scene, camera, Viewport::new(800.0, 600.0, 1.0));
    scene
        .bodies
        .iter()
        .map(|body| body.key)
        .filter(|key| is_see_through(&input, *key))
        .map(|key| key.0)
        .collect()
}

fn axis(view: AxisView) -> Camera {
    let mut camera = Camera { projection: Projection::Orthographic, ..Camera::default() };
    camera.set_axis(view);
    camera
}

#[test]
fn an_axis_view_looks_through_one_wall() {
    let cases = [
        (AxisView::Front, 3),
        (AxisView::Back, 5),
        (AxisView::Right, 1),
        (AxisView::Left, 2),
        (AxisView::Top, 6),
        (AxisView::Bottom, 4),
    ];
    for (view, wall) in cases {
        assert_eq!(glass(&closed_box(), axis(view)), [wall], "{view:?}");
        assert_eq!(glass(&furnished_box(), axis(view)), [wall], "{view:?}: plates inside stay solid");
    }
}

#[test]
fn an_oblique_view_looks_through_the_three_near_walls() {
    // From the front, the right and above.
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let camera = Camera { projection, height: 20.0, ..Camera::default() };
        assert_eq!(glass(&furnished_box(), camera), [1, 3, 6], "{projection:?}");
    }
}

#[test]
fn from_everywhere_the_middle_is_seen_and_three_walls_stand_behind_it() {
    let scene = closed_box();
    for i in 0..200 {
        let (yaw, pitch) = (0.13 + 0.61 * f64::from(i), 1.4 * (0.37 * f64::from(i)).sin());
        let camera =
            Camera { yaw, pitch, height: 20.0, projection: Projection::Orthographic, ..Camera::default() };
        let near = scene
            .bodies
            .iter()
            .filter(|wall| (wall.position - DVec3::splat(5.0)).dot(camera.backward()) > 1e-3)
            .map(|wall| wall.key.0);
        assert_eq!(glass(&scene, camera), near.collect::<Vec<_>>(), "yaw {yaw}, pitch {pitch}");
    }
}

#[test]
fn inside_the_box_all_walls_are_solid() {
    let camera = Camera { height: 2.0, ..Camera::default() };
    assert!((camera.eye() - DVec3::splat(5.0)).abs().max_element() < 5.0);
    assert_eq!(glass(&furnished_box(), camera), [0; 0]);
}

#[test]
fn a_box_inside_a_larger_map_is_seen_into() {
    let mut scene = furnished_box();
    scene.map.size = DVec3::splat(40.0);
    assert_eq!(glass(&scene, axis(AxisView::Top)), [6]);
}

#[test]
fn a_ball_outside_the_box_changes_nothing() {
    let mut scene = furnished_box();
    scene.bodies.push(ball(99, dvec3(5.0, 30.0, 5.0), 1.0));
    assert_eq!(glass(&scene, axis(AxisView::Top)), [6], "the map still lies below the wall");
}

#[test]
fn a_tilted_box_is_seen_into() {
    // The corner of a turned box: two plates at right angles, neither along an axis, and a ball between.
    let mut scene = empty();
    let turn = 0.5;
    let side = |key, angle: f64| {
        let normal = dvec3(angle.sin(), 0.0, angle.cos());
        plate(key, dvec3(5.0, 5.0, 5.0) - normal * 2.0, dvec3(0.0, angle, 0.0), [2.0, 2.0])
    };
    scene.bodies.push(side(1, turn));
    scene.bodies.push(side(2, turn + std::f64::consts::FRAC_PI_2));
    scene.bodies.push(ball(3, dvec3(5.0, 5.0, 5.0), 0.5));
    let from = |yaw| Camera { yaw, pitch: 0.0, projection: Projection::Orthographic, ..Camera::default() };
    assert_eq!(glass(&scene, from(turn)), [0; 0]);
    assert_eq!(glass(&scene, from(turn + std::f64::consts::PI)), [1]);
}

#[test]
fn a_small_plate_before_the_scene_stays_solid() {
    let mut scene = empty();
    scene.bodies.push(plate(1, dvec3(5.0, 5.0, 8.0), DVec3::ZERO, [0.5, 0.5]));
    scene.bodies.push(ball(2, dvec3(2.0, 5.0, 4.0), 1.0));
    scene.bodies.push(ball(3, dvec3(8.0, 5.0, 2.0), 1.0));
    assert_eq!(glass(&scene, axis(AxisView::Front)), [0; 0]);
    // The same plate as a piece of the map's front is a wall.
    scene.bodies[0].position.z = 10.0;
    assert_eq!(glass(&scene, axis(AxisView::Front)), [1]);
}

#[test]
fn only_plates_are_walls() {
    let mut scene = empty();
    scene.bodies.push(ball(1, dvec3(5.0, 12.0, 5.0), 1.0));
    scene.bodies.push(ball(2, dvec3(5.0, 5.0, 5.0), 1.0));
    assert_eq!(glass(&scene, axis(AxisView::Top)), [0; 0]);
    let input = ViewInput::new(&scene, axis(AxisView::Top), Viewport::new(800.0, 600.0, 1.0));
    assert!(!is_see_through(&input, NodeKey(77)), "there is no such body");
}

/// Balls jump out of a box and fall for ever: the box is seen into all the same.
#[test]
fn balls_that_have_left_change_nothing() {
    let mut scene = empty();
    scene.map.size = DVec3::splat(40.0);
    for (key, z) in [(1, 12.0), (2, 8.0)] {
        scene.bodies.push(plate(key, dvec3(10.0, 10.0, z), DVec3::ZERO, [2.0, 2.0]));
    }
    for k in 0..17_u32 {
        scene.bodies.push(ball(10 + u64::from(k), dvec3(8.5 + 0.2 * f64::from(k), 9.0, 10.0), 0.1));
    }
    assert_eq!(glass(&scene, axis(AxisView::Front)), [1]);
    for k in 0..3_u64 {
        scene.bodies.push(ball(50 + k, dvec3(10.0, -1000.0, 14.0), 0.1));
    }
    assert_eq!(glass(&scene, axis(AxisView::Front)), [1]);
    assert_eq!(glass(&scene, axis(AxisView::Back)), [2]);
}
