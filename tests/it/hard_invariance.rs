//! Every scene of the repository gives the same bits for every Δt, tiling, way of stepping and file order.

use polyscene::editor::SAMPLES;
use polyscene::scene::{Document, Scene};
use polyscene::study::Random;

use crate::common::build::Build;
use crate::common::drive::{Run, SAMPLINGS, Sampling, assert_same_bits, run};

const TILES: [[u32; 3]; 3] = [[1; 3], [10; 3], [37; 3]];

/// How long a scene is looked at, s: so long that it shows its difficulty, and the test stays short.
/// Those not named get 4 s.
const SPANS: &[(&str, f64)] = &[
    ("bin", 0.2),
    ("bullet", 0.02),
    ("bullets", 0.02),
    ("counting-pi-3", 5.0),
    ("counting-pi-4", 4.045),
    ("galton", 0.5),
    ("galton-rough", 0.5),
    ("gas-1000", 0.2),
    ("grazing", 1.0),
    ("heap-in-space", 0.3),
    ("hopper", 0.6),
    ("masses", 0.2),
    ("orbit", 12.0),
    ("rest", 10.0),
    ("cradle", 6.0),
    ("pyramid-4-bouncy", 2.0),
    ("pyramid-6", 0.15),
    ("pyramid-hit", 0.1),
    ("pour-1000", 0.05),
    ("pour-5000", 0.01),
];

fn span(id: &str) -> f64 {
    SPANS.iter().find(|(name, _)| *name == id).map_or(4.0, |(_, span)| *span)
}

/// All scenes whose place in the table leaves this rest, so that the tests share the work.
fn scenes(part: usize) -> impl Iterator<Item = (&'static str, Scene)> {
    SAMPLES.iter().enumerate().filter(move |(index, _)| index % PARTS == part).map(|(_, sample)| {
        let document = Document::from_bytes(sample.bytes);
        (sample.id, document.scene().unwrap_or_else(|| panic!("{} has no scene", sample.id)).clone())
    })
}

const PARTS: usize = 4;

fn assert_invariant(part: usize) {
    for (id, scene) in scenes(part) {
        let until = span(id);
        let expected = run(&scene, until, Sampling::Every(1.0));
        for tiles in TILES {
            for sampling in SAMPLINGS {
                let got = run(&scene.clone().tiles(tiles), until, sampling);
                assert_same_bits(&expected, &got, &format!("{id}, {sampling:?}, tiles {tiles:?}"));
            }
        }
        assert_permutable(id, &scene, until, &expected);
    }
}

/// Bodies and forces of the file in another order: the labels tell who is who.
fn assert_permutable(id: &str, scene: &Scene, until: f64, expected: &Run) {
    let mut ids: Vec<i64> = scene.bodies.iter().map(|body| body.id).collect();
    ids.sort_unstable();
    if ids.windows(2).any(|pair| pair[0] == pair[1]) {
        return;
    }
    for seed in 0..2 {
        let mut permuted = scene.clone();
        let mut random = Random::new(seed);
        random.shuffle(permuted.bodies.as_mut_slice());
        random.shuffle(&mut permuted.forces);
        let got = run(&permuted, until, Sampling::Every(0.1));
        assert_same_bits(expected, &got, &format!("{id}, order {seed}"));
    }
}

#[test]
fn scenes_give_the_same_bits_in_every_way_1() {
    assert_invariant(0);
}

#[test]
fn scenes_give_the_same_bits_in_every_way_2() {
    assert_invariant(1);
}

#[test]
fn scenes_give_the_same_bits_in_every_way_3() {
    assert_invariant(2);
}

#[test]
fn scenes_give_the_same_bits_in_every_way_4() {
    assert_invariant(3);
}

#[test]
fn spans_name_scenes() {
    for (id, _) in SPANS {
        assert!(SAMPLES.iter().any(|sample| sample.id == *id), "no scene {id}");
    }
}
