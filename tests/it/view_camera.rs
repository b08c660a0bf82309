//! Cameras: rays against projections, framing, zoom to the cursor, the six axis views.

use glam::{DVec2, DVec3, dvec2, dvec3};
use polyscene::view::{AxisView, Bounds, Camera, Projection};

const ASPECT: f64 = 1.6;

/// Cameras of both kinds, looking all ways, at scenes from a millimetre to 100 km.
fn cameras() -> Vec<Camera> {
    let mut cameras = Vec::new();
    for projection in [Projection::Perspective, Projection::Orthographic] {
        for (yaw, pitch) in [(0.0, 0.0), (0.6, 0.4), (-2.5, -1.2), (1.0, std::f64::consts::FRAC_PI_2)] {
            for (height, target) in [(1e-3, 1.0), (12.0, 5.0), (1e5, 1e5)] {
                let target = dvec3(target, -target, 0.3 * target);
                cameras.push(Camera { projection, target, yaw, pitch, height });
            }
        }
    }
    cameras
}

#[test]
fn what_a_ray_passes_is_seen_where_the_ray_starts() {
    for camera in cameras() {
        for ndc in [dvec2(0.0, 0.0), dvec2(0.7, -0.4), dvec2(-1.0, 1.0)] {
            let ray = camera.ray(ndc, ASPECT);
            assert!((ray.direction.length() - 1.0).abs() < 1e-14);
            for depth in [0.1, 1.0, 40.0] {
                let along = (camera.eye() - ray.origin).dot(-camera.backward()) + depth * camera.distance();
                let point = ray.at(along / ray.direction.dot(-camera.backward()));
                let seen = camera.project(point, ASPECT).unwrap();
                // 1e5 m has steps of 1.5e-11 m, of which a 1 mm view shows 1.5e-8.
                assert!(seen.truncate().distance(ndc) < 1e-7, "{camera:?} {ndc} {seen}");
                assert!((seen.z / (depth * camera.distance()) - 1.0).abs() < 1e-6, "{camera:?} {seen}");
            }
        }
    }
}

#[test]
fn matrices_agree_with_project() {
    for camera in cameras() {
        let origin = camera.target + dvec3(0.1, -0.2, 0.3) * camera.height;
        let matrix = camera.projection_matrix(ASPECT) * camera.view_matrix(origin);
        for offset in [dvec3(0.0, 0.0, 0.0), dvec3(0.3, 0.1, -0.2), dvec3(-0.5, 0.25, 0.4)] {
            let point = camera.target + offset * camera.height;
            let clip = matrix.project_point3(point - origin);
            let seen = camera.project(point, ASPECT).unwrap();
            assert!((clip.truncate() - seen.truncate()).length() < 1e-7, "{camera:?} {clip} {seen}");
            assert!((-1.0..1.0).contains(&clip.z), "{camera:?} {clip}");
        }
    }
}

#[test]
fn depths_stay_apart_in_24_bits_at_every_size() {
    for camera in cameras() {
        let matrix = camera.projection_matrix(ASPECT);
        let step = |depth: f64| {
            let clip = matrix.project_point3(dvec3(0.0, 0.0, -depth));
            ((0.5 * clip.z + 0.5) * f64::from(1 << 24)) as i64
        };
        for over_distance in [0.5, 1.0, 5.0] {
            let depth = over_distance * camera.distance();
            assert!(step(depth) < step(depth * 1.001), "{camera:?} at {over_distance}");
        }
    }
}

#[test]
fn what_is_behind_the_eye_is_not_seen() {
    let camera = Camera::default();
    assert!(camera.project(camera.eye() + camera.backward(), ASPECT).is_none());
    assert!(camera.project(camera.target, ASPECT).is_some());
}

#[test]
fn axis_views_look_as_in_a_drawing() {
    let cases = [
        (AxisView::Front, DVec3::X, DVec3::Y),
        (AxisView::Back, -DVec3::X, DVec3::Y),
        (AxisView::Right, -DVec3::Z, DVec3::Y),
        (AxisView::Left, DVec3::Z, DVec3::Y),
        (AxisView::Top, DVec3::X, -DVec3::Z),
        (AxisView::Bottom, DVec3::X, DVec3::Z),
    ];
    for (view, right, up) in cases {
        let mut camera = Camera::default();
        camera.set_axis(view);
        assert!(camera.right().distance(right) < 1e-15, "{view:?}");
        assert!(camera.up().distance(up) < 1e-15, "{view:?}");
        assert_eq!(camera.axis_view(), Some(view));
        camera.orbit(0.01, 0.0);
        assert_eq!(camera.axis_view(), None);
    }
}

#[test]
fn framing_shows_all_and_wastes_little() {
    let boxes = [(DVec3::ZERO, dvec3(10.0, 10.0, 10.0)), (dvec3(-3e4, 0.0, 5.0), dvec3(7e4, 1.0, 2e3))];
    for (min, max) in boxes {
        for mut camera in cameras() {
            camera.frame(Bounds { min, max }, ASPECT);
            let corners = Bounds { min, max }.corners().map(|corner| camera.project(corner, ASPECT).unwrap());
            let most = corners.iter().map(|at| at.x.abs().max(at.y.abs())).fold(0.0, f64::max);
            assert!(most <= 1.0, "{camera:?} cuts a corner off: {most}");
            assert!(most > 0.6, "{camera:?} shows it too small: {most}");
        }
    }
}

#[test]
fn framing_a_point_gives_a_usable_camera() {
    let mut camera = Camera::default();
    camera.frame(Bounds::of_point(DVec3::ONE), ASPECT);
    assert_eq!(camera, camera.usable());
    assert_eq!(camera.target, DVec3::ONE);
}

#[test]
fn zooming_keeps_what_is_under_the_cursor() {
    for mut camera in cameras() {
        let ndc = dvec2(0.6, -0.7);
        let place = |camera: &Camera| {
            let ray = camera.ray(ndc, ASPECT);
            let slope = ray.direction.dot(camera.backward());
            ray.at((camera.target - ray.origin).dot(camera.backward()) / slope)
        };
        let before = place(&camera);
        let height = camera.height;
        camera.zoom_to_cursor(ndc, ASPECT, 1.7);
        assert!((camera.height * 1.7 - height).abs() < 1e-12 * height);
        assert!(place(&camera).distance(before) < 1e-9 * height.max(1.0), "{camera:?}");
    }
    let mut camera = Camera::default();
    camera.zoom_to_cursor(DVec2::ZERO, ASPECT, f64::NAN);
    camera.zoom_to_cursor(DVec2::ZERO, ASPECT, 0.0);
    assert_eq!(camera, Camera::default());
    for _ in 0..2000 {
        camera.zoom_to_cursor(DVec2::ONE, ASPECT, 2.0);
    }
    assert_eq!(camera, camera.usable());
}

#[test]
fn panning_moves_the_scene_with_the_pointer() {
    for mut camera in cameras() {
        let grabbed = camera.target;
        camera.pan(dvec2(80.0, 30.0), 500.0);
        let seen = camera.project(grabbed, ASPECT).unwrap();
        let points = dvec2(0.5 * seen.x * ASPECT * 500.0, -0.5 * seen.y * 500.0);
        assert!(points.distance(dvec2(80.0, 30.0)) < 1e-3, "{camera:?}: {points}");
    }
}

#[test]
fn orbiting_keeps_target_and_distance_and_stops_at_the_poles() {
    let mut camera = Camera::default();
    let (target, distance) = (camera.target, camera.distance());
    for _ in 0..1000 {
        camera.orbit(0.37, 0.11);
        assert!((camera.eye().distance(target) / distance - 1.0).abs() < 1e-12);
        assert!(camera.up().y >= -1e-12, "upside down: {camera:?}");
    }
    assert_eq!(camera.pitch, std::f64::consts::FRAC_PI_2);
}

#[test]
fn clipping_keeps_exactly_what_is_seen() {
    for camera in cameras() {
        let span = camera.right() * 1e9 + camera.up() * 3e8;
        let (from, to) = camera.clip_segment(camera.target - span, camera.target + span, ASPECT).unwrap();
        for end in [from, to] {
            let seen = camera.project(end, ASPECT).unwrap();
            assert!(seen.x.abs() > 1.0 || seen.y.abs() > 1.0, "cut inside the view: {seen}");
            assert!(seen.x.abs() < 1.5 && seen.y.abs() < 1.5, "left far outside: {seen}");
        }
        let aside = camera.up() * camera.height * 2.0;
        let across = camera.right() * camera.height;
        let gone =
            camera.clip_segment(camera.target + aside - across, camera.target + aside + across, ASPECT);
        assert!(gone.is_none(), "{camera:?}");
    }
}

#[test]
fn an_eye_stands_where_it_is_put_and_turns_without_leaving() {
    let cases = [(1e-3, DVec3::splat(2.0)), (0.5, dvec3(-7.0, 3.0, 1e3)), (20.0, DVec3::ZERO)];
    for (near, eye) in cases {
        for camera in cameras() {
            let mut camera = camera;
            camera.stand_at(eye, near);
            let off = 1e-13 * (camera.distance() + eye.length());
            assert!(camera.eye().distance(eye) <= off, "{camera:?}");
            assert!(
                (camera.near() / near - 1.0).abs() < 1e-12 && camera.projection == Projection::Perspective
            );
            camera.turn_head(0.4, 0.2);
            assert!(camera.eye().distance(eye) <= 4.0 * off, "{camera:?}");
            let (ahead, up) = (-camera.backward(), DVec3::Y);
            camera.fly(0.0, 2.0, 3.0);
            assert!(camera.eye().distance(eye + 3.0 * ahead + 2.0 * up) <= 8.0 * off, "{camera:?}");
        }
    }
}

#[test]
fn a_look_along_a_direction_has_it_in_the_middle() {
    for direction in
        [dvec3(1.0, 0.0, 0.0), dvec3(-3e-7, 4e-7, 1e-7), dvec3(2.0, -5e5, 3.0), DVec3::Y, -DVec3::Y]
    {
        for camera in cameras() {
            let [yaw, pitch] = camera.angles_along(direction).unwrap();
            let turned = Camera { yaw, pitch, ..camera };
            assert!((turned.backward() + direction.normalize()).length() < 1e-15, "{direction} {turned:?}");
            if direction.x == 0.0 {
                assert_eq!(yaw, camera.yaw, "up and down have no yaw");
            }
        }
    }
    assert_eq!(Camera::default().angles_along(DVec3::ZERO), None);
}
