//! Snapping, round lengths and short numbers.

use glam::dvec3;
use polyscene::view::{Camera, Viewport, number, snap, snap_step, with_unit};

#[test]
fn snapping_gives_the_numbers_a_person_would_type() {
    assert_eq!(snap(dvec3(0.26, -1.449, 7.0), 0.1), dvec3(0.3, -1.4, 7.0));
    assert_eq!(snap(dvec3(1.3, 2.6, -3.9), 0.5), dvec3(1.5, 2.5, -4.0));
    assert_eq!(snap(dvec3(7.4, 12.6, -2.6), 5.0), dvec3(5.0, 15.0, -5.0));
    let free = dvec3(0.123, 4.567, 8.9);
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(snap(free, step), free);
    }
}

#[test]
fn the_snapping_step_suits_the_magnification() {
    let viewport = Viewport::new(600.0, 400.0, 1.0);
    for height in [1e-3, 0.7, 10.0, 5e4] {
        let camera = Camera { height, ..Camera::default() };
        let step = snap_step(&camera, viewport);
        let points = step / camera.world_per_pixel(viewport.height);
        assert!((4.0..=12.5).contains(&points), "{height}: {step} is {points} points");
    }
}

#[test]
fn lengths_have_the_unit_that_keeps_them_short() {
    let cases = [(1.0, "1 m"), (0.2, "20 cm"), (0.005, "5 mm"), (5e3, "5 km"), (2e-6, "2 µm"), (0.0, "0 µm")];
    for (metres, text) in cases {
        assert_eq!(with_unit(metres), text);
    }
    assert_eq!(number(-0.0001, 2), "0");
    assert_eq!(number(1.5, 3), "1.5");
    assert_eq!(number(100.0, 3), "100");
}
