//! Tile crossings of the recorded motion, against positions looked up one after the other.

use std::sync::Arc;

use polyscene::record::{InlineRunner, RunCommand, Runner as _};
use polyscene::scene::{Document, NodeKey};

/// Places looked up in one Δt: more than a body has crossings.
const PLACES: u32 = 20_000;

/// What is crossed, by body and axis, in a Δt of a run: found by the recording, and by looking.
fn check(scene: &[u8], dt: f64, before: u32) -> usize {
    let document = Document::from_bytes(scene);
    let scene = Arc::new(document.scene().expect("a scene").clone());
    let keys: Arc<[NodeKey]> =
        scene.bodies.iter().filter(|body| body.is_dynamic()).map(|body| body.key).collect();
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(scene.clone()));
    runner.send(RunCommand::Step { dt, count: before + 1 });
    let asks_nothing = runner.frame();
    assert!(asks_nothing.crossings.is_empty() && asks_nothing.tiling.occupied.is_empty(), "nobody asked");
    runner.send(RunCommand::Crossings(keys));
    runner.send(RunCommand::Tiles(true));
    assert!(!runner.frame().tiling.occupied.is_empty());
    runner.send(RunCommand::ShareMotion(true));
    let frame = runner.frame();
    let motion = frame.motion.as_ref().expect("the motion");
    let (from, to) = frame.step.expect("a Δt");
    let tile = scene.map.size / glam::DVec3::from_array(scene.map.tiles.map(f64::from));
    for (nth, (_, key)) in motion.bodies().enumerate() {
        for axis in 0..3 {
            let at = |time: f64| {
                let place = motion.state(nth, time).expect("recorded").position[axis] / tile[axis];
                place.floor().clamp(0.0, f64::from(scene.map.tiles[axis] - 1)) as u32
            };
            let times = (0..=PLACES).map(|place| from + (to - from) * f64::from(place) / f64::from(PLACES));
            let times: Vec<f64> = times.collect();
            let looked: Vec<([u32; 2], [f64; 2])> = times
                .windows(2)
                .map(|pair| ([at(pair[0]), at(pair[1])], [pair[0], pair[1]]))
                .filter(|([left, entered], _)| left != entered)
                .collect();
            let found: Vec<_> =
                frame.crossings.iter().filter(|found| (found.key, found.axis) == (key, axis)).collect();
            assert_eq!(found.len(), looked.len(), "axis {axis} of {key:?}");
            for (found, (tiles, [after, before])) in found.iter().zip(&looked) {
                assert_eq!(found.tiles, *tiles);
                // A body may be on a face right when it was looked at.
                let rounding = 1e-12 * (1.0 + to);
                let within = after - rounding..=before + rounding;
                assert!(within.contains(&found.time), "{} in {after} to {before}", found.time);
                let off = motion.state(nth, found.time).expect("recorded").position[axis]
                    - tile[axis] * f64::from(tiles[0].max(tiles[1]));
                assert!(off.abs() <= 1e-9 * tile[axis], "{off} m from the face");
            }
        }
    }
    frame.crossings.len()
}

#[test]
fn parabolas_cross_where_their_places_say() {
    let gas = check(include_bytes!("../../scenes/gas.xml"), 0.5, 1);
    let thrown = check(include_bytes!("../../scenes/thesis-appendix-2.xml"), 1.0, 0);
    assert!(gas > 10 && thrown > 0, "{gas} and {thrown} crossings");
}

#[test]
fn integrated_ways_cross_where_their_places_say() {
    let orbit = check(include_bytes!("../../scenes/orbit.xml"), 2.0, 2);
    let drag = check(include_bytes!("../../scenes/drag.xml"), 1.0, 0);
    assert!(orbit + drag > 0, "{orbit} and {drag} crossings");
}
