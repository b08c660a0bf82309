//! What an event cancelled, against all pairs of bodies looked at in closed form.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use glam::{DVec3, dvec3};
use polyscene::random::Random;
use polyscene::record::{Cancelled, Frame, InlineRunner, Of, RunCommand, Runner as _};
use polyscene::scene::{Document, NodeKey, Scene, Shape};
use polyscene::sim::{Method, SimEdit};

use crate::common::build::{Build as _, ball, empty, static_ball};

const DT: f64 = 0.25;

fn loaded(scene: &Scene) -> InlineRunner {
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(scene.clone())));
    runner.send(RunCommand::Cancelled(true));
    runner
}

fn next_event(runner: &mut InlineRunner) -> Arc<Frame> {
    runner.send(RunCommand::NextEvent { dt: DT, of: Of::All });
    runner.frame()
}

fn cancelled(frame: &Frame) -> &Cancelled {
    let cancelled = frame.cancelled.as_deref().expect("what was cancelled");
    assert_eq!(cancelled.event, frame.event_count);
    cancelled
}

/// Ball 1 would meet 2 after 3 s, had 3 not come across.
fn crossing() -> Scene {
    empty()
        .ball(1, dvec3(1.0, 5.0, 5.0), DVec3::X)
        .ball(2, dvec3(5.0, 5.0, 5.0), DVec3::ZERO)
        .ball(3, dvec3(2.5, 8.0, 5.0), dvec3(0.0, -4.0 / 3.0, 0.0))
        .tiles([1; 3])
}

#[test]
fn what_would_have_met_is_told_with_its_time() {
    let mut runner = loaded(&crossing());
    assert!(runner.frame().cancelled.is_none(), "no event yet");
    let frame = next_event(&mut runner);
    let found = cancelled(&frame);
    assert_eq!(found.problem, None);
    let [impact] = found.impacts.as_slice() else { panic!("{found:?}") };
    assert_eq!((impact.keys, impact.labels.clone()), ([NodeKey(1), NodeKey(2)], ["1".into(), "2".into()]));
    assert!((impact.time - 3.0).abs() < 1e-12, "{}", impact.time);
    runner.send(RunCommand::StepBack);
    assert!(runner.frame().cancelled.is_none(), "not at an event");
    runner.send(RunCommand::GoTo { event: 1 });
    assert_eq!(runner.frame().cancelled, frame.cancelled, "the same when it is gone back to");
    runner.send(RunCommand::Cancelled(false));
    assert!(runner.frame().cancelled.is_none(), "nobody asks");
}

#[test]
fn edits_on_the_way_count() {
    let mut runner = loaded(&crossing());
    runner.send(RunCommand::Step { dt: DT, count: 1 });
    let stone = static_ball(4, dvec3(3.75, 5.0, 5.0), 0.5);
    runner.send(RunCommand::Edit(vec![SimEdit::AddBody(Box::new(stone))]));
    let edit = next_event(&mut runner);
    assert!(cancelled(&edit).impacts.is_empty(), "a stone in the way has met nothing yet");
    let frame = next_event(&mut runner);
    let times: Vec<(NodeKey, f64)> =
        cancelled(&frame).impacts.iter().map(|impact| (impact.keys[1], impact.time)).collect();
    let [(NodeKey(4), first), (NodeKey(2), second)] = times.as_slice() else { panic!("{times:?}") };
    assert!((first - 1.75).abs() < 1e-12 && (second - 3.0).abs() < 1e-12, "{times:?}");
}

/// Symptom: what an edit cancelled that was made at an event counted as cancelled by that event, and the edit as cancelling nothing.
#[test]
fn an_edit_made_at_an_event_cancels_for_itself() {
    let scene = crossing().ball(4, dvec3(1.0, 1.0, 1.0), DVec3::X).ball(5, dvec3(8.0, 1.0, 1.0), DVec3::ZERO);
    let mut runner = loaded(&scene);
    let of_event = next_event(&mut runner).cancelled.clone();
    runner.send(RunCommand::Edit(vec![SimEdit::Remove(NodeKey(5))]));
    let edit = next_event(&mut runner);
    for _ in 0..2 {
        runner.send(RunCommand::GoTo { event: 1 });
        assert_eq!(runner.frame().cancelled, of_event);
        runner.send(RunCommand::GoTo { event: edit.event_count });
        let frame = runner.frame();
        let [impact] = cancelled(&frame).impacts.as_slice() else { panic!("{:?}", frame.cancelled) };
        assert_eq!((impact.keys, impact.now), ([NodeKey(4), NodeKey(5)], None));
        assert!((impact.time - 6.0).abs() < 1e-12, "{}", impact.time);
    }
}

/// An edit begins the ways of all bodies anew, and what was predicted of them is the same but for rounding and what integrating
/// leaves.
#[test]
fn what_is_predicted_anew_for_the_same_time_is_not_cancelled() {
    for density in [0.0, 0.3] {
        let mut scene = empty().air(density);
        scene.map.size = DVec3::splat(1000.0);
        let mut scene = scene.tiles([1; 3]);
        for row in 0..20 {
            let (y, z) = (900.0 + 4.0 * f64::from(row % 4), 900.0 + 4.0 * f64::from(row / 4));
            let speed = 0.02 + 0.4 * f64::from(row);
            let id = i64::from(2 * row) + 1;
            scene = scene.ball(id, dvec3(900.0, y, z), dvec3(speed, 0.0, 0.0)).ball(
                id + 1,
                dvec3(901.0 + 0.3 * speed, y, z),
                DVec3::ZERO,
            );
        }
        let mut runner = loaded(&scene);
        runner.send(RunCommand::Step { dt: 0.1, count: 1 });
        let stone = static_ball(1000, DVec3::splat(5.0), 0.5);
        runner.send(RunCommand::Edit(vec![SimEdit::AddBody(Box::new(stone))]));
        let frame = next_event(&mut runner);
        assert_eq!(frame.ledger.get(1).expect("the edit").a_key, NodeKey(1000));
        assert_eq!(cancelled(&frame).impacts, [], "in air of {density} kg/m³");
    }
}

#[test]
fn methods_without_predictions_say_so() {
    let mut runner = loaded(&crossing());
    runner.send(RunCommand::Method(Method::Fixed));
    let frame = next_event(&mut runner);
    assert_eq!(frame.event_count, 1);
    let problem = cancelled(&frame).problem.as_deref().expect("a reason");
    assert!(problem.contains("predict nothing"), "{problem}");
}

type Meetings = BTreeMap<(NodeKey, NodeKey), f64>;

/// When the pairs of a frame's balls meet on straight ways, from |Δx + Δv τ| = r + r.
fn meetings(frame: &Frame, radius: &BTreeMap<NodeKey, f64>) -> Meetings {
    let mut found = Meetings::new();
    for (nth, a) in frame.bodies.iter().enumerate() {
        for b in &frame.bodies.as_slice()[nth + 1..] {
            let (x, v) = (b.position - a.position, b.velocity - a.velocity);
            let reach = radius[&a.key] + radius[&b.key];
            let (half, root) = (x.dot(v), x.dot(v).powi(2) - v.dot(v) * (x.dot(x) - reach * reach));
            if half < 0.0 && root > 0.0 {
                let tau = (x.dot(x) - reach * reach) / (-half + root.sqrt());
                found.insert((a.key.min(b.key), a.key.max(b.key)), frame.time + tau);
            }
        }
    }
    found
}

#[test]
fn of_a_gas_it_is_what_no_pair_of_straight_ways_gives_any_more() {
    let mut random = Random::new(7);
    let mut scene = empty().walls(100).tiles([1; 3]);
    for id in 0..18 {
        let place = dvec3(f64::from(id % 3), f64::from(id / 3 % 3), f64::from(id / 9)) * 3.0 + 1.5;
        let mut velocity = || random.range(-2.0, 2.0);
        let ball = ball(i64::from(id) + 1, place, dvec3(velocity(), velocity(), velocity()));
        let radius = random.range(0.8, 1.4);
        scene.bodies.push(polyscene::scene::Body { shape: Shape::Sphere { radius }, ..ball });
    }
    let radius: BTreeMap<NodeKey, f64> = scene
        .bodies
        .iter()
        .filter_map(|body| match body.shape {
            Shape::Sphere { radius } => Some((body.key, radius)),
            _ => None,
        })
        .collect();
    let mut runner = loaded(&scene);
    let mut before = meetings(&runner.frame(), &radius);
    let (mut told, mut events) = (0, 0);
    while events < 200 {
        let frame = next_event(&mut runner);
        events += 1;
        let after = meetings(&frame, &radius);
        let row = frame.ledger.get(frame.event_count).expect("the row");
        let met =
            (row.a_key.min(row.b_key.unwrap_or_default()), row.a_key.max(row.b_key.unwrap_or_default()));
        let expected: Meetings = before
            .iter()
            .filter(|(pair, time)| {
                let now = after.get(pair);
                **pair != met && now.is_none_or(|now| (now - **time).abs() > 1e-9)
            })
            .map(|(pair, time)| (*pair, *time))
            .collect();
        let found: Meetings = cancelled(&frame)
            .impacts
            .iter()
            .filter(|impact| impact.keys.iter().all(|key| radius.contains_key(key)))
            .map(|impact| {
                ((impact.keys[0].min(impact.keys[1]), impact.keys[0].max(impact.keys[1])), impact.time)
            })
            .collect();
        assert_eq!(
            found.keys().collect::<Vec<_>>(),
            expected.keys().collect::<Vec<_>>(),
            "event {}",
            frame.event_count
        );
        for (pair, time) in &found {
            assert!((time - expected[pair]).abs() < 1e-9, "{pair:?}: {time} is not {}", expected[pair]);
        }
        told += found.len();
        before = after;
    }
    assert!(told > events / 2, "{told} cancelled by {events} events");
}

/// Heaps, fields, friction, edges, capture: the way back to an event is the one that was recorded, whatever lies on it.
#[test]
fn the_events_of_all_samples_are_come_to_again() {
    let folders = ["scenes", "scenes/hard"].map(|folder| Path::new(env!("CARGO_MANIFEST_DIR")).join(folder));
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).expect("the folder").flatten());
    let mut looked_at = 0;
    for path in
        files.map(|file| file.path()).filter(|path| path.extension().is_some_and(|kind| kind == "xml"))
    {
        let document = Document::open(&path);
        let Some(scene) = document.scene().filter(|scene| scene.bodies.len() < 150) else { continue };
        let mut runner = loaded(scene);
        runner.send(RunCommand::Step { dt: DT, count: 4 });
        for _ in 0..6 {
            let frame = next_event(&mut runner);
            if frame.fault.is_some() || frame.at_impact.is_empty() {
                break;
            }
            let found = cancelled(&frame);
            assert_eq!(found.problem, None, "{}: event {}", path.display(), frame.event_count);
            looked_at += 1;
        }
    }
    assert!(looked_at > 100, "{looked_at} events");
}
