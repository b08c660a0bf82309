//! Pictures drawn in software without a window: silhouettes against their areas, depth order, caching.

use std::f64::consts::PI;

use glam::{DVec3, dvec3};
use image::RgbaImage;
use polyscene::render::{Offscreen, PixelRect, Quality, Renderer, Showing, Tile, render_picture};
use polyscene::scene::{Body, Scene};
use polyscene::view::{
    Camera, OVERLAYS, OverlaySet, Projection, Theme, VIEWS, ViewInput, Viewport, build_draw_list,
    scene_bounds,
};

use crate::view_scenes::{ball, closed_box, empty, frame, furnished_box, plate};

const SIDE: f64 = 400.0;

fn red(body: Body) -> Body {
    Body { color: Some([220, 30, 30]), ..body }
}

fn green(body: Body) -> Body {
    Body { color: Some([30, 200, 30]), ..body }
}

fn picture(scene: &Scene, camera: Camera) -> RgbaImage {
    let input = ViewInput {
        overlays: OverlaySet::NONE,
        ..ViewInput::new(scene, camera, Viewport::new(SIDE, SIDE, 1.0))
    };
    Offscreen::new().unwrap().render(&build_draw_list(&input)).unwrap()
}

/// Pixels of a reddish (channel 0) or greenish (channel 1) colour. Furniture is left out.
fn area(picture: &RgbaImage, channel: usize) -> f64 {
    let corner = |x: u32, y: u32| y > 300 && !(100..=250).contains(&x);
    let strong = |p: &image::Rgba<u8>| f64::from(p.0[channel]) > 1.6 * f64::from(p.0[1 - channel]);
    picture.enumerate_pixels().filter(|(x, y, p)| !corner(*x, *y) && strong(p)).count() as f64
}

/// How far the edge of a round area lies from where it should, pixels. Half covered pixels count or not.
fn edge_error(found: f64, expected: f64) -> f64 {
    ((found / PI).sqrt() - (expected / PI).sqrt()).abs()
}

fn ortho() -> Camera {
    Camera { projection: Projection::Orthographic, height: 10.0, ..Camera::default() }
}

#[test]
fn an_orthographic_sphere_covers_its_disc() {
    let mut scene = empty();
    scene.bodies.push(red(ball(1, dvec3(5.0, 5.5, 5.0), 2.0)));
    let expected = PI * (2.0 * SIDE / 10.0_f64).powi(2);
    let found = area(&picture(&scene, ortho()), 0);
    assert!(edge_error(found, expected) < 0.4, "{found} pixels, {expected} expected");
}

/// The silhouette of a sphere is the cut of a cone of half angle α = asin(r/D), whose axis is θ off the
/// view's, with the picture plane: an ellipse with the half axes a = (tan(θ+α) − tan(θ−α)) / 2 and
/// b = a √(1 − sin²θ / cos²α).
#[test]
fn a_perspective_sphere_covers_its_ellipse() {
    let camera = Camera { height: 8.0, ..Camera::default() };
    for (aside, radius) in [(0.0, 1.0), (2.2, 1.0), (2.0, 1.6)] {
        let mut scene = empty();
        scene.bodies.push(red(ball(1, camera.target + camera.up() * aside, radius)));
        let distance = camera.distance().hypot(aside);
        let (alpha, theta) = ((radius / distance).asin(), aside.atan2(camera.distance()));
        let a = 0.5 * ((theta + alpha).tan() - (theta - alpha).tan());
        let b = a * (1.0 - (theta.sin() / alpha.cos()).powi(2)).sqrt();
        let pixels_per_tangent = camera.distance() / camera.world_per_pixel(SIDE);
        let expected = PI * a * b * pixels_per_tangent.powi(2);
        let found = area(&picture(&scene, camera), 0);
        assert!(edge_error(found, expected) < 0.4, "{aside}: {found} pixels, {expected} expected");
    }
}

#[test]
fn the_nearer_ball_hides_the_other() {
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let camera = Camera { projection, ..ortho() };
        let place = |nearer: f64| camera.target + camera.backward() * nearer;
        for (red_at, green_at, visible, hidden) in [(2.0, -2.0, 0, 1), (-2.0, 2.0, 1, 0)] {
            let mut scene = empty();
            scene.bodies.push(red(ball(1, place(red_at), 1.0)));
            scene.bodies.push(green(ball(2, place(green_at), 1.0)));
            let picture = picture(&scene, camera);
            assert!(area(&picture, visible) > 1000.0, "{projection:?}");
            assert_eq!(area(&picture, hidden), 0.0, "{projection:?}: it shines through");
        }
    }
}

#[test]
fn balls_that_touch_meet_in_a_straight_seam() {
    // Seen across the line of centres, each of two overlapping balls covers one half.
    let camera = ortho();
    let mut scene = empty();
    scene.bodies.push(red(ball(1, camera.target - camera.right(), 1.5)));
    scene.bodies.push(green(ball(2, camera.target + camera.right(), 1.5)));
    let picture = picture(&scene, camera);
    let (left, right) = (area(&picture, 0), area(&picture, 1));
    assert!((left / right - 1.0).abs() < 0.02, "{left} and {right}");
    for (x, y, pixel) in picture.enumerate_pixels() {
        let is_red = f64::from(pixel.0[0]) > 1.6 * f64::from(pixel.0[1]);
        assert!(!(is_red && (202..300).contains(&x) && (150..250).contains(&y)), "red at {x} {y}");
    }
}

#[test]
fn a_plate_cuts_a_ball_in_half() {
    let camera = Camera { yaw: 0.0, pitch: 0.0, ..ortho() };
    let mut scene = empty();
    scene.bodies.push(red(ball(1, camera.target, 2.0)));
    // Through the middle, facing the view; a ball on either side keeps it from being a wall.
    scene.bodies.push(green(plate(2, camera.target + dvec3(2.5, 0.0, 0.0), DVec3::ZERO, [2.5, 2.5])));
    scene.bodies.push(ball(3, dvec3(0.1, 0.1, 0.0), 0.01));
    scene.bodies.push(ball(4, dvec3(0.1, 0.1, 10.0), 0.01));
    let found = area(&picture(&scene, camera), 0);
    // The front half of the ball stands out of the plate: all of its disc is seen.
    let disc = PI * (2.0 * SIDE / 10.0_f64).powi(2);
    assert!((found / disc - 1.0).abs() < 0.01, "{found} of {disc}");
    scene.bodies[1].position.z += 1.0;
    let found = area(&picture(&scene, camera), 0);
    // One metre nearer, the plate leaves the left half and a cap of radius √3 on the right.
    let expected = 0.5 * disc * (1.0 + 3.0 / 4.0);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} of {expected}");
}

#[test]
fn the_inside_of_a_closed_box_is_seen_in_every_view() {
    let mut scene = closed_box();
    scene.bodies.push(red(ball(7, DVec3::splat(5.0), 2.0)));
    for view in &VIEWS {
        let input = ViewInput::new(&scene, Camera::default(), Viewport::new(SIDE, SIDE, 1.0));
        let camera = view.camera(scene_bounds(&input, None), 1.0);
        assert!(area(&picture(&scene, camera), 0) > 4000.0, "{}: the ball is hidden", view.id);
    }
}

#[test]
fn far_from_the_origin_the_picture_is_the_same() {
    let near = furnished_box();
    let mut far = near.clone();
    let shift = dvec3(1e5, -1e5, 1e5);
    far.bodies.iter_mut().for_each(|body| body.position += shift);
    far.forces.clear();
    let near = Scene { forces: Vec::new(), ..near };
    let camera = Camera { height: 6.0, ..Camera::default() };
    let a = picture(&near, camera);
    let b = picture(&far, Camera { target: camera.target + shift, ..camera });
    let different = a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count();
    assert!(different < 20, "{different} pixels differ");
}

#[test]
fn a_millimetre_and_a_hundred_kilometres_look_alike() {
    let unit = picture(&scaled(1.0), scaled_camera(1.0));
    for scale in [1e-4, 1e4] {
        let other = picture(&scaled(scale), scaled_camera(scale));
        let different =
            unit.enumerate_pixels().filter(|(x, y, p)| *y < 330 && *p != other.get_pixel(*x, *y)).count();
        assert!(different < 400, "{scale}: {different} pixels differ");
    }
}

fn scaled(scale: f64) -> Scene {
    let mut scene = furnished_box();
    scene.forces.clear();
    scene.map.size *= scale;
    for body in &mut scene.bodies {
        body.position *= scale;
        body.shape = match body.shape {
            polyscene::scene::Shape::Sphere { radius } => {
                polyscene::scene::Shape::Sphere { radius: radius * scale }
            }
            polyscene::scene::Shape::Plane { half_x, half_y } => {
                polyscene::scene::Shape::Plane { half_x: half_x * scale, half_y: half_y * scale }
            }
            ref other @ polyscene::scene::Shape::Unbuilt { .. } => other.clone(),
        };
    }
    scene
}

fn scaled_camera(scale: f64) -> Camera {
    let camera = Camera::default();
    Camera { target: camera.target * scale, height: camera.height * scale, ..camera }
}

#[test]
fn everything_at_once_draws_in_both_themes_and_with_labels() {
    let (scene, frame) = (furnished_box(), frame());
    let mut offscreen = Offscreen::new().unwrap();
    for theme in [Theme::Dark, Theme::Light] {
        let tiles: Vec<Tile> = VIEWS
            .iter()
            .zip([[0, 0], [402, 0], [0, 302], [402, 302]])
            .map(|(view, [x, y])| {
                let mut input = ViewInput::new(&scene, Camera::default(), Viewport::new(400.0, 300.0, 1.0));
                input.camera = view.camera(scene_bounds(&input, None), 4.0 / 3.0);
                input.theme = theme;
                input.frame = Some(&frame);
                input.highlighted = Some(&frame.events[0]);
                input.overlays = OverlaySet::from_ids(OVERLAYS.iter().map(|overlay| overlay.id));
                Tile { list: build_draw_list(&input), x, y }
            })
            .collect();
        let picture = render_picture(&mut offscreen, [802, 602], [1, 2, 3, 255], &tiles).unwrap();
        assert_eq!(picture.get_pixel(401, 301).0, [1, 2, 3, 255], "the gap between the views");
        assert!(picture.pixels().all(|pixel| pixel.0[3] == 255), "pictures are opaque");
        let mut bare = tiles.clone();
        bare.iter_mut().for_each(|tile| tile.list.labels.clear());
        let bare = render_picture(&mut offscreen, [802, 602], [1, 2, 3, 255], &bare).unwrap();
        let inked = picture.pixels().zip(bare.pixels()).filter(|(a, b)| a != b).count();
        assert!(inked > 2000, "labels change only {inked} pixels");
    }
}

#[test]
fn a_view_is_drawn_again_only_when_its_list_changed() {
    let full = |rect, clip| Showing { rect, clip, quality: Quality::Full };
    let mut offscreen = Offscreen::new().unwrap();
    let mut renderer = Renderer::new(offscreen.gl().clone()).unwrap();
    offscreen.bind_window([300, 200]).unwrap();
    let scene = furnished_box();
    let mut list =
        build_draw_list(&ViewInput::new(&scene, Camera::default(), Viewport::new(200.0, 100.0, 1.0)));
    list.revision = 5;
    let rect = PixelRect { x: 10, y: 10, width: 200, height: 100 };
    assert!(renderer.paint(0, &list, full(rect, rect)).unwrap());
    let window = offscreen.read_window().unwrap();
    assert_eq!(window.get_pixel(9, 150).0, [0; 4], "left of the view");
    assert_eq!(window.get_pixel(10, 189).0[3], 255, "its bottom left corner");
    assert_eq!(window.get_pixel(210, 150).0, [0; 4], "right of the view");
    assert!(!renderer.paint(0, &list, full(rect, rect)).unwrap(), "nothing changed");
    assert!(renderer.paint(1, &list, full(rect, rect)).unwrap(), "another view");
    list.revision = 6;
    assert!(renderer.paint(0, &list, full(rect, rect)).unwrap(), "another list");
    let larger = PixelRect { width: 210, ..rect };
    assert!(renderer.paint(0, &list, full(larger, larger)).unwrap(), "another size");
    let elsewhere = PixelRect { x: 500, ..rect };
    assert!(!renderer.paint(2, &list, full(rect, elsewhere)).unwrap(), "out of sight");
    list.revision = 0;
    assert!(renderer.paint(0, &list, full(larger, larger)).unwrap());
    assert!(renderer.paint(0, &list, full(larger, larger)).unwrap(), "0 is never kept");
}

#[test]
fn a_draft_looks_like_the_picture_and_makes_way_for_it() {
    let mut offscreen = Offscreen::new().unwrap();
    let mut renderer = Renderer::new(offscreen.gl().clone()).unwrap();
    let size = [301, 201];
    offscreen.bind_window(size).unwrap();
    let scene = furnished_box();
    let mut list =
        build_draw_list(&ViewInput::new(&scene, Camera::default(), Viewport::new(301.0, 201.0, 1.0)));
    list.revision = 5;
    let rect = PixelRect { x: 0, y: 0, width: 301, height: 201 };
    let mut paint = |quality| renderer.paint(0, &list, Showing { rect, clip: rect, quality }).unwrap();
    assert!(paint(Quality::Draft));
    assert!(!paint(Quality::Draft), "nothing changed");
    let draft = offscreen.read_window().unwrap();
    assert!(paint(Quality::Full), "a draft will not do");
    let full = offscreen.read_window().unwrap();
    assert!(!paint(Quality::Draft), "what is there is better");
    let channels = draft.as_raw().iter().zip(full.as_raw());
    let off: u64 = channels.map(|(draft, full)| u64::from(draft.abs_diff(*full))).sum();
    assert!(off > 0, "a draft is coarser");
    assert!(off / (draft.as_raw().len() as u64) < 4, "and shows the same at the same place");
}

/// Small balls of a draft are points, which are cut off by their middle and have a largest size.
#[test]
fn balls_of_a_draft_hide_each_other_and_are_cut_off_by_the_border_as_in_full() {
    let scene = Scene {
        bodies: [
            green(ball(1, dvec3(5.0, 5.0, 2.0), 0.5)),
            red(ball(2, dvec3(5.2, 5.0, 8.0), 0.5)),
            green(ball(3, dvec3(0.1, 5.0, 5.0), 0.6)),
            red(ball(4, dvec3(-0.2, 8.0, 5.0), 0.6)),
            green(ball(5, dvec3(5.0, 1.0, 5.0), 2.0)),
        ]
        .into(),
        ..empty()
    };
    let camera = Camera { target: DVec3::splat(5.0), yaw: 0.0, pitch: 0.0, ..ortho() };
    let input = ViewInput {
        overlays: OverlaySet::NONE,
        ..ViewInput::new(&scene, camera, Viewport::new(SIDE, SIDE, 1.0))
    };
    let mut list = build_draw_list(&input);
    list.revision = 7;
    let mut offscreen = Offscreen::new().unwrap();
    let mut renderer = Renderer::new(offscreen.gl().clone()).unwrap();
    offscreen.bind_window([SIDE as u32; 2]).unwrap();
    let rect = PixelRect { x: 0, y: 0, width: SIDE as i32, height: SIDE as i32 };
    let [draft, full] = [Quality::Draft, Quality::Full].map(|quality| {
        renderer.paint(0, &list, Showing { rect, clip: rect, quality }).unwrap();
        offscreen.read_window().unwrap()
    });
    for channel in [0, 1] {
        let (draft, full) = (area(&draft, channel), area(&full, channel));
        assert!(full > 1000.0 && (draft / full - 1.0).abs() < 0.08, "{channel}: {draft} and {full} pixels");
    }
}

#[test]
fn a_picture_too_large_for_the_driver_is_an_error() {
    let scene = empty();
    let list =
        build_draw_list(&ViewInput::new(&scene, Camera::default(), Viewport::new(60_000.0, 10.0, 1.0)));
    assert!(Offscreen::new().unwrap().render(&list).is_err());
}

#[test]
fn a_hundred_thousand_statics_draw() {
    let mut scene = empty();
    scene.map.size = DVec3::splat(1000.0);
    for i in 0..100_000_u64 {
        let place = dvec3((i % 100) as f64, ((i / 100) % 100) as f64, (i / 10_000) as f64) * 10.0;
        scene.bodies.push(match i % 2 {
            0 => plate(i, place, dvec3(0.3, 0.2, i as f64), [2.0, 2.0]),
            _ => Body { motion: polyscene::scene::Motion::Static, ..ball(i, place, 2.0) },
        });
    }
    let camera = Camera { target: DVec3::splat(500.0), height: 1500.0, ..Camera::default() };
    let picture = picture(&scene, camera);
    let background = *picture.get_pixel(2, 2);
    let drawn = picture.pixels().filter(|pixel| pixel.0[0].abs_diff(background.0[0]) > 25).count();
    assert!(drawn > 20_000, "{drawn} pixels");
}
