//! Picking against brute force, in the order of depth; what is hidden or see-through is passed over.

use glam::{DVec2, DVec3, dvec2, dvec3};
use polyscene::scene::{Body, Motion, NodeKey, Scene, Shape, rotation_matrix};
use polyscene::view::{Camera, Projection, Ray, ViewInput, Viewport, pick, pick_outline, pick_rect};
use proptest::prelude::{Strategy, proptest};

use crate::view_scenes::{ball, body, closed_box, empty, frame, furnished_box, plate};

fn viewport() -> Viewport {
    Viewport::new(800.0, 600.0, 1.0)
}

fn front_camera() -> Camera {
    Camera { yaw: 0.0, pitch: 0.0, projection: Projection::Orthographic, ..Camera::default() }
}

fn keys(input: &ViewInput<'_>, ndc: DVec2) -> Vec<u64> {
    pick(input, ndc).into_iter().map(|hit| hit.key.0).collect()
}

/// First hit of a sphere by its distance from the line. (The schoolbook quadratic squares a distance of 16 km and
/// has no digits left for a sphere that is only grazed.)
fn brute_sphere(ray: &Ray, center: DVec3, radius: f64) -> Option<f64> {
    let offset = ray.origin - center;
    let half_chord_squared = radius * radius - ray.direction.cross(offset).length_squared();
    (half_chord_squared >= 0.0)
        .then(|| -ray.direction.dot(offset) - half_chord_squared.sqrt())
        .filter(|t| *t > 0.0)
}

/// How far off a hit may be, m: 1e-6, and for a sphere that is grazed what rounding of the way to it, moved
/// across by that much, does to the chord, √(2rδ).
fn allowed(scene: &Scene, key: u64, distance: f64) -> f64 {
    let radius = scene.bodies.iter().find(|body| body.key.0 == key).map_or(0.0, |body| match body.shape {
        Shape::Sphere { radius } => radius,
        _ => 0.0,
    });
    1e-6_f64.max((2.0 * radius * 8.0 * f64::EPSILON * distance).sqrt())
}

/// A rectangle as two triangles (Möller and Trumbore 1997).
fn brute_plate(ray: &Ray, plate: &Body, half: [f64; 2]) -> Option<f64> {
    let r = rotation_matrix(plate.rotation);
    let (x, y) = (r.x_axis * half[0], r.y_axis * half[1]);
    let [a, b, c, d] = [-x - y, x - y, x + y, y - x].map(|corner| plate.position + corner);
    [[a, b, c], [a, c, d]].into_iter().find_map(|[a, b, c]| {
        let (e1, e2) = (b - a, c - a);
        let p = ray.direction.cross(e2);
        let inverse = 1.0 / e1.dot(p);
        let u = (ray.origin - a).dot(p) * inverse;
        let q = (ray.origin - a).cross(e1);
        let v = ray.direction.dot(q) * inverse;
        let t = e2.dot(q) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    })
}

fn random_scene() -> impl Strategy<Value = Scene> {
    let point = || (0.5..9.5, 0.5..9.5, 0.5..9.5).prop_map(|(x, y, z)| dvec3(x, y, z));
    let angles = || (-3.0..3.0, -3.0..3.0, -3.0..3.0).prop_map(|(x, y, z)| dvec3(x, y, z));
    let one = (point(), angles(), 0.3..2.0_f64, 0.3..2.0_f64, proptest::bool::ANY);
    proptest::collection::vec(one, 1..40).prop_map(|specs| {
        let mut scene = empty();
        for (i, (position, rotation, a, b, round)) in specs.into_iter().enumerate() {
            let key = i as u64 + 1;
            scene.bodies.push(if round {
                ball(key, position, a)
            } else {
                plate(key, position, rotation, [a, b])
            });
        }
        // Far corners: then no plate has the whole scene on one side. None looks smaller than four points, for that is
        // picked as if it were as large (seen: a ball of 0.1 m in the far corner, in one of five thousand scenes).
        scene.bodies.push(ball(90, DVec3::ZERO, 0.3));
        scene.bodies.push(ball(91, DVec3::splat(10.0), 0.3));
        scene
    })
}

proptest! {
    #[test]
    fn picks_what_brute_force_finds(
        scene in random_scene(),
        (yaw, pitch) in (-3.0..3.0_f64, -1.5..1.5_f64),
        (x, y) in (-0.5..0.5_f64, -0.5..0.5_f64),
        perspective in proptest::bool::ANY,
    ) {
        let projection = if perspective { Projection::Perspective } else { Projection::Orthographic };
        let camera = Camera { projection, yaw, pitch, ..Camera::default() };
        let input = ViewInput::new(&scene, camera, viewport());
        let ndc = dvec2(x, y);
        let ray = camera.ray(ndc, viewport().aspect());
        let mut expected: Vec<(f64, u64)> = scene
            .bodies
            .iter()
            .filter(|body| !polyscene::view::is_see_through(&input, body.key))
            .filter_map(|body| Some((match body.shape {
                Shape::Sphere { radius } => brute_sphere(&ray, body.position, radius)?,
                Shape::Plane { half_x, half_y } => brute_plate(&ray, body, [half_x, half_y])?,
                Shape::Unbuilt { .. } => return None,
            }, body.key.0)))
            .collect();
        expected.sort_by(|a, b| a.0.total_cmp(&b.0));
        let hits = pick(&input, ndc);
        let found: Vec<u64> = hits.iter().map(|hit| hit.key.0).collect();
        assert_eq!(found, expected.iter().map(|(_, key)| *key).collect::<Vec<_>>());
        for (hit, (distance, key)) in hits.iter().zip(&expected) {
            let off = (hit.distance - distance).abs();
            assert!(off <= allowed(&scene, *key, *distance), "{} against {distance}", hit.distance);
            assert!(hit.point.distance(ray.at(hit.distance)) < 1e-9);
        }
    }
}

#[test]
fn clicks_can_go_through_what_lies_behind() {
    let mut scene = empty();
    for (key, z) in [(1, 2.0), (2, 8.0), (3, 5.0)] {
        scene.bodies.push(ball(key, dvec3(5.0, 5.0, z), 0.5));
    }
    let input = ViewInput::new(&scene, front_camera(), viewport());
    assert_eq!(keys(&input, DVec2::ZERO), [2, 3, 1]);
    assert_eq!(keys(&input, dvec2(0.5, 0.5)), [0; 0]);
}

#[test]
fn hidden_bodies_are_passed_over() {
    let mut scene = empty();
    scene.bodies.push(Body { hidden: true, ..ball(1, dvec3(5.0, 5.0, 8.0), 0.5) });
    scene.bodies.push(ball(2, dvec3(5.0, 5.0, 5.0), 0.5));
    let input = ViewInput::new(&scene, front_camera(), viewport());
    assert_eq!(keys(&input, DVec2::ZERO), [2]);
    assert_eq!(pick_rect(&input, DVec2::NEG_ONE, DVec2::ONE, true), [NodeKey(2)]);
}

#[test]
fn the_front_wall_of_a_closed_box_is_passed_over() {
    let scene = closed_box();
    // Wall 3 is at z = 10, before the eye; wall 5 at z = 0.
    let input = ViewInput::new(&scene, front_camera(), viewport());
    assert_eq!(keys(&input, DVec2::ZERO), [5]);
}

#[test]
fn bodies_are_picked_where_the_simulation_has_them() {
    let (scene, frame) = (furnished_box(), frame());
    let mut input = ViewInput::new(&scene, front_camera(), viewport());
    input.frame = Some(&frame);
    let seen = input.camera.project(dvec3(4.0, 1.5, 6.0), viewport().aspect()).unwrap();
    assert_eq!(keys(&input, seen.truncate())[0], 21);
    input.frame = None;
    assert_ne!(keys(&input, seen.truncate())[0], 21);
}

#[test]
fn marks_of_forces_come_before_bodies() {
    let scene = furnished_box();
    let input = ViewInput::new(&scene, front_camera(), viewport());
    assert_eq!(keys(&input, DVec2::ZERO)[0], scene.forces[1].key.0, "the attractor in the middle");
}

#[test]
fn a_speck_can_be_hit() {
    let mut scene = empty();
    scene.bodies.push(ball(1, DVec3::splat(5.0), 1e-6));
    let input = ViewInput::new(&scene, front_camera(), viewport());
    assert_eq!(keys(&input, dvec2(0.004, 0.0)), [1]);
}

/// What looks smaller than four points is picked as if it were as large, at any distance.
#[test]
fn a_speck_is_as_large_as_four_points_in_perspective_too() {
    let camera = Camera { projection: Projection::Perspective, ..Camera::default() };
    for at in [DVec3::splat(5.0), DVec3::ZERO, dvec3(9.0, 2.0, 8.0), DVec3::splat(10.0)] {
        let mut scene = empty();
        scene.bodies.push(ball(1, at, 1e-6));
        let input = ViewInput::new(&scene, camera, viewport());
        let seen = camera.project(at, viewport().aspect()).unwrap().truncate();
        // 800×600 points are 2×2 in these coordinates; off the axis a sphere looks a little wider.
        for (points, expected) in [(0.0, &[1][..]), (3.7, &[1]), (4.6, &[])] {
            for off in [dvec2(points / 400.0, 0.0), dvec2(0.0, -points / 300.0)] {
                assert_eq!(keys(&input, seen + off), expected, "{points} points off {at}");
            }
        }
    }
}

#[test]
fn a_rectangle_takes_what_has_its_centre_in_it() {
    let mut scene = empty();
    for (key, x) in [(1, 2.0), (2, 5.0), (3, 8.0)] {
        scene.bodies.push(ball(key, dvec3(x, 5.0, 5.0), 1.0));
    }
    scene.bodies.push(body(4, dvec3(5.0, 9.9, 5.0), Motion::Static, Shape::Sphere { radius: 1.0 }));
    let input = ViewInput::new(&scene, front_camera(), viewport());
    let at = |x: f64, y: f64| input.camera.project(dvec3(x, y, 5.0), viewport().aspect()).unwrap().truncate();
    assert_eq!(pick_rect(&input, at(1.0, 4.0), at(6.0, 6.0), true), [NodeKey(1), NodeKey(2)]);
    assert_eq!(pick_rect(&input, at(6.0, 6.0), at(1.0, 4.0), true), [NodeKey(1), NodeKey(2)]);
}

proptest! {
    /// Symptom: a rectangle over 10 000 bodies that should not select through took two seconds. Expected: what is first
    /// under its own centre is selected, as a click there would. Cause: every body was asked about every other.
    #[test]
    fn a_rectangle_in_sight_takes_what_a_click_on_its_centre_takes(scene in random_scene(), yaw in -3.0..3.0, pitch in -1.5..1.5) {
        for projection in [Projection::Perspective, Projection::Orthographic] {
            let camera = Camera { yaw, pitch, projection, ..Camera::default() };
            let input = ViewInput::new(&scene, camera, viewport());
            let first = |body: &Body| {
                let at = input.camera.project(body.position, viewport().aspect())?.truncate();
                (at.abs().max_element() <= 1.0 && pick(&input, at).first()?.key == body.key).then_some(body.key)
            };
            let expected: Vec<NodeKey> = scene.bodies.iter().filter_map(first).collect();
            assert_eq!(pick_rect(&input, DVec2::NEG_ONE, DVec2::ONE, false), expected);
        }
    }
}

#[test]
fn an_outline_takes_what_it_winds_around_and_in_sight_alone_if_asked() {
    let mut scene = empty();
    scene.bodies.push(ball(1, dvec3(2.0, 5.0, 5.0), 0.5));
    scene.bodies.push(ball(2, dvec3(5.0, 5.0, 5.0), 0.5));
    scene.bodies.push(ball(3, dvec3(5.1, 5.0, 2.0), 0.5));
    let input = ViewInput::new(&scene, front_camera(), viewport());
    let at = |(x, y)| input.camera.project(dvec3(x, y, 5.0), viewport().aspect()).unwrap().truncate();
    // a U whose arms go around 1 and 2, with nothing between them
    let u = [(1.0, 8.0), (1.0, 2.0), (6.0, 2.0), (6.0, 8.0), (4.0, 8.0), (4.0, 3.0), (3.0, 3.0), (3.0, 8.0)];
    let outline = u.map(at);
    let keys = [1, 2, 3].map(NodeKey);
    assert_eq!(pick_outline(&input, &outline, true), keys);
    assert_eq!(pick_outline(&input, &outline, false), keys[..2], "3 is behind 2");
    let arm = [(3.0, 8.0), (3.0, 3.0), (4.0, 3.0), (4.0, 8.0)].map(at);
    assert_eq!(pick_outline(&input, &arm, true), []);
    assert_eq!(pick_outline(&input, &[], true), []);
}

#[test]
fn picking_is_exact_far_from_the_origin() {
    let shift = dvec3(1e5, -1e5, 1e5);
    let mut scene = empty();
    // Two balls of a millimetre, side by side.
    scene.bodies.push(ball(1, shift, 1e-3));
    scene.bodies.push(ball(2, shift + dvec3(2.1e-3, 0.0, 0.0), 1e-3));
    let camera = Camera { target: shift, height: 0.02, ..front_camera() };
    let input = ViewInput::new(&scene, camera, viewport());
    let at = |x: f64| camera.project(shift + dvec3(x, 0.0, 0.0), viewport().aspect()).unwrap().truncate();
    assert_eq!(keys(&input, at(0.99e-3)), [1]);
    assert_eq!(keys(&input, at(1.05e-3)), [0; 0]);
    assert_eq!(keys(&input, at(1.11e-3)), [2]);
}
