//! Troubles of a scene as one designs it, and what puts them right.

use glam::{DVec3, dvec3};
use polyscene::design::{Repair, Repaired, TroubleKind, repair, repair_all, troubles};
use polyscene::scene::{Body, Document, Edit, Motion, NumberStyle, Scene, Shape};
use polyscene::sim::Simulation;

fn ball(id: i64, at: DVec3, radius: f64, mass: f64) -> Edit {
    let motion = Motion::Dynamic { mass, velocity: DVec3::ZERO };
    Edit::AddBody(Box::new(Body::new(id, at, motion, Shape::Sphere { radius })))
}

fn floor(id: i64, y: f64) -> Edit {
    let shape = Shape::Plane { half_x: 5.0, half_y: 5.0 };
    let rotation = dvec3(-std::f64::consts::FRAC_PI_2, 0.0, 0.0);
    let body = Body::new(id, dvec3(5.0, y, 5.0), Motion::Static, shape);
    Edit::AddBody(Box::new(Body { rotation, ..body }))
}

fn made(edits: Vec<Edit>) -> Document {
    Document::new(NumberStyle::Point).apply(&Edit::All(edits)).unwrap().document
}

fn scene(document: &Document) -> &Scene {
    document.scene().unwrap()
}

fn kinds(document: &Document) -> Vec<TroubleKind> {
    troubles(scene(document)).into_iter().map(|trouble| trouble.kind).collect()
}

fn repaired(document: &Document, how: Repair) -> Document {
    let plan = repair(scene(document), how).expect("something to repair");
    document.apply(&Edit::All(plan.edits)).unwrap().document
}

#[test]
fn the_scenes_that_come_with_the_program_have_no_trouble() {
    for folder in ["scenes", "scenes/hard"] {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        for file in std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            if file.extension().is_some_and(|extension| extension == "xml") {
                let mut found = troubles(Document::open(&file).scene().unwrap());
                // hard cases are about overlaps and masses far apart
                if folder.ends_with("hard") {
                    found.retain(|trouble| {
                        !matches!(trouble.kind, TroubleKind::Overlap | TroubleKind::Masses)
                    });
                }
                assert_eq!(found, [], "{}", file.display());
            }
        }
    }
}

#[test]
fn two_that_overlap_part_along_the_shortest_way() {
    let document = made(vec![
        ball(1, dvec3(5.0, 5.0, 5.0), 0.5, 1.0),
        ball(2, dvec3(5.6, 5.8, 5.0), 0.75, 1.0),
        floor(3, 0.0),
    ]);
    let found = troubles(scene(&document));
    let [trouble] = &found[..] else { panic!("{found:?}") };
    assert_eq!(trouble.message, "1 and 2 overlap by 0.25 m");
    let parted = repaired(&document, trouble.repair.unwrap());
    let [a, b] = [0, 1].map(|nth| scene(&parted).bodies[nth].position);
    assert!((a.distance(b) - 1.25).abs() < 1e-12);
    assert!((b - a).normalize().distance(dvec3(0.6, 0.8, 0.0)) < 1e-12);
    assert_eq!(troubles(scene(&parted)), []);
}

/// What is static or locked stays.
#[test]
fn a_ball_in_the_floor_comes_out_on_its_side() {
    for (y, expected) in [(0.25, 0.5), (-0.25, -0.5)] {
        let document = made(vec![floor(1, 0.0), ball(2, dvec3(5.0, y, 5.0), 0.5, 1.0)]);
        // Symptom: two lists of problems named the two in two orders.
        let trouble = &troubles(scene(&document))[0];
        let simulation = Simulation::new(scene(&document)).unwrap();
        let warning = &simulation.start_warnings()[0].message;
        assert!(
            trouble.message.starts_with("2 and 1 overlap") && warning.contains("2 and 1 overlap"),
            "{warning}"
        );
        let parted = repaired(&document, Repair::PushAllApart);
        assert_eq!(scene(&parted).bodies[1].position.y, expected);
        assert_eq!(scene(&parted).bodies[0], scene(&document).bodies[0]);
    }
}

#[test]
fn a_crowd_is_pushed_apart_and_stays_in_its_room() {
    let mut edits = vec![floor(1, 0.0)];
    edits.extend((0..27).map(|nth| {
        let cell = dvec3((nth % 3).into(), (nth / 9).into(), (nth / 3 % 3).into());
        ball(nth as i64 + 2, dvec3(5.0, 0.4, 5.0) + cell * 0.8, 0.5, 1.0)
    }));
    let document = made(edits);
    assert!(kinds(&document).len() > 20);
    let parted = repaired(&document, Repair::PushAllApart);
    assert_eq!(troubles(scene(&parted)), []);
    assert!(scene(&parted).bodies.as_slice()[1..].iter().all(|ball| ball.position.y > 0.49));
}

#[test]
fn the_map_grows_by_whole_tiles_over_all_that_moves() {
    let far = made(vec![ball(1, dvec3(12.5, 5.0, 5.0), 0.5, 1.0)]);
    assert_eq!(kinds(&far), [TroubleKind::Outside]);
    let grown = repaired(&far, Repair::GrowMap);
    assert_eq!(scene(&grown).map.size, dvec3(13.0, 10.0, 10.0));
    assert_eq!(scene(&grown).map.tiles, [13, 10, 10]);
    assert_eq!(scene(&grown).bodies[0].position.x, 12.5);

    let below = made(vec![ball(1, dvec3(5.0, -2.2, 5.0), 0.5, 1.0), floor(2, 0.0)]);
    let grown = repaired(&below, Repair::GrowMap);
    assert_eq!(scene(&grown).map.size, dvec3(10.0, 13.0, 10.0));
    assert_eq!(scene(&grown).bodies[1].position.y, 3.0, "all moves up together");
    assert_eq!(troubles(scene(&grown)), []);
    let endless = made(vec![ball(1, dvec3(1e15, 5.0, 5.0), 0.5, 1.0)]);
    assert_eq!(repair(scene(&endless), Repair::GrowMap), None);
}

#[test]
fn tiles_that_are_too_many_too_fine_or_too_coarse_are_fitted() {
    let balls: Vec<Edit> = (0..1000)
        .map(|nth: i64| {
            let cell = [nth % 10, nth / 10 % 10, nth / 100].map(|at| at as f64 + 0.5);
            ball(nth + 1, DVec3::from_array(cell), 0.2, 1.0)
        })
        .collect();
    for tiles in [[200, 400, 200], [150, 150, 150], [1, 1, 1]] {
        let mut edits = balls.clone();
        edits.push(Edit::MapTiles(tiles));
        let document = made(edits);
        assert_eq!(kinds(&document), [TroubleKind::Tiles], "{tiles:?}");
        let fitted = repaired(&document, Repair::FitTiles);
        assert_eq!(troubles(scene(&fitted)), [], "{tiles:?}");
        assert_eq!(scene(&fitted).map.tiles, [17, 17, 17]);
    }
    let empty = made(vec![Edit::MapTiles([200, 400, 200])]);
    assert_eq!(kinds(&empty), [TroubleKind::Tiles]);
}

#[test]
fn masses_that_differ_too_much_are_told() {
    let document = made(vec![
        ball(1, DVec3::splat(2.0), 0.5, 1e-3),
        ball(2, DVec3::splat(5.0), 0.5, 2e4),
        ball(3, DVec3::splat(8.0), 0.5, 1.0),
    ]);
    let found = troubles(scene(&document));
    let [trouble] = &found[..] else { panic!("{found:?}") };
    assert_eq!(trouble.message, "2 has 2.00e7 times the mass of 1");
    assert_eq!(trouble.repair, None);
}

#[test]
fn all_is_put_right_at_once_and_said() {
    let document = made(vec![
        ball(1, dvec3(5.0, 5.0, 5.0), 0.5, 1.0),
        ball(2, dvec3(5.5, 5.0, 5.0), 0.5, 1.0),
        ball(3, dvec3(30.0, 5.0, 5.0), 0.5, 1.0),
        Edit::MapTiles([300, 300, 300]),
    ]);
    let text = String::from_utf8(document.to_bytes()).unwrap().replace("UserID=\"3\"", "UserID=\"2\"");
    let document = Document::from_bytes(text.as_bytes());
    let Repaired { document: repaired, done, .. } = repair_all(&document).unwrap();
    assert_eq!(
        done,
        [
            "gave new UserIDs to what repeated one",
            "pushed overlapping bodies apart",
            "enlarged the map to hold all moving bodies",
            "fitted the tiles to the balls",
        ]
    );
    assert_eq!(troubles(scene(&repaired)), []);
    assert!(repaired.diagnostics().is_empty());
    let Repaired { document: again, done, touched } = repair_all(&repaired).unwrap();
    assert!(touched.is_empty());
    assert!(done.is_empty());
    assert_eq!(again.to_bytes(), repaired.to_bytes());
}

#[test]
fn many_troubles_are_listed_up_to_a_limit_and_counted() {
    let document = made((0..300).map(|nth| ball(nth + 1, DVec3::splat(5.0), 0.5, 1.0)).collect());
    let found = troubles(scene(&document));
    let overlaps = found.iter().filter(|trouble| trouble.kind == TroubleKind::Overlap);
    assert_eq!(overlaps.count(), 201);
    assert!(found.iter().any(|trouble| trouble.message == "and 44650 more pairs overlap"));
}

/// Symptom: two thousand balls in one place kept the window waiting for most of a minute.
#[test]
fn pushing_a_crowd_apart_ends_soon_and_says_what_is_left() {
    let balls = (1..=2000_i64).map(|id| ball(id, dvec3(5.0 + 1e-4 * id as f64, 5.0, 5.0), 0.5, 1.0));
    let document = made(balls.collect());
    let started = std::time::Instant::now();
    let plan = repair(scene(&document), Repair::PushAllApart).expect("something to push");
    assert!(started.elapsed().as_secs_f64() < 20.0, "{:?}", started.elapsed());
    assert!(plan.remark.is_some_and(|remark| remark.contains("push them apart again")));
}

/// The end of a heap as a start: two balls overlap by a part of what a heap keeps, two by more.
#[test]
fn what_a_heap_keeps_of_overlap_is_no_trouble_to_scene_or_simulation() {
    for (overlap, is_listed) in [(0.9e-3, false), (1.1e-3, true)] {
        for radius in [2e-7, 0.2] {
            let second = dvec3(0.5, 0.5 + 2.0 * radius - overlap * radius, 0.5);
            let document = made(vec![ball(1, DVec3::splat(0.5), radius, 1.0), ball(2, second, radius, 1.0)]);
            let is_overlap = |kind: &TroubleKind| *kind == TroubleKind::Overlap;
            assert_eq!(kinds(&document).iter().any(is_overlap), is_listed, "{overlap} of {radius} m");
            let sim = Simulation::new(scene(&document)).expect("a sound scene");
            let warned = sim.start_warnings().iter().any(|warning| warning.message.contains(" overlap by "));
            assert_eq!(warned, is_listed, "{overlap} of {radius} m");
        }
    }
}

/// A ball that no room is left for, and two that may not be moved.
#[test]
fn pushing_apart_tells_how_many_are_left_as_the_list_does() {
    let mut edits = vec![ball(1, DVec3::splat(5.0), 0.5, 1.0)];
    for (id, z) in [(2, 4.7), (3, 5.3)] {
        let shape = Shape::Plane { half_x: 3.0, half_y: 3.0 };
        edits.push(Edit::AddBody(Box::new(Body::new(id, dvec3(5.0, 5.0, z), Motion::Static, shape))));
    }
    for (id, x) in [(4, 8.0), (5, 8.4)] {
        let motion = Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO };
        let body = Body::new(id, dvec3(x, 8.0, 8.0), motion, Shape::Sphere { radius: 0.5 });
        edits.push(Edit::AddBody(Box::new(Body { locked: true, ..body })));
    }
    let Repaired { document, done, .. } = repair_all(&made(edits)).unwrap();
    let left = kinds(&document).iter().filter(|kind| **kind == TroubleKind::Overlap).count();
    assert_eq!(left, 2);
    assert!(done.iter().any(|line| line.contains("(2 pairs still overlap")), "{done:?}");
}
