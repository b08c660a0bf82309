//! A recording with edits goes through its file and comes out as the same run.

#![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

use std::sync::Arc;

use super::RecordingFile;
use crate::record::command::{Of, RunCommand};
use crate::record::inline::InlineRunner;
use crate::record::{Frame, Limits, Rerun, Runner as _};
use crate::scene::{Body, Document, ForceKind, Motion, NodeKey, Shape};
use crate::sim::{Method, SimEdit};

const SCENE: &[u8] = include_bytes!("../../../scenes/thesis-appendix-2.xml");
const DT: f64 = 0.05;

fn runner(document: &Document, method: Method) -> InlineRunner {
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Method(method));
    runner.send(RunCommand::Load(Arc::new(document.scene().unwrap().clone())));
    runner
}

/// Edits of every kind, at the end of a Δt, inside one and right at an event; those of one moment together, or one by one.
fn edited(method: Method, together: bool) -> (Arc<Frame>, RecordingFile) {
    let document = Document::from_bytes(SCENE);
    let scene = document.scene().unwrap().clone();
    let mut runner = runner(&document, method);
    let (ball, wall) = (runner.frame().bodies[0].key, scene.bodies.iter().find(|b| !b.is_dynamic()).unwrap());
    let mut send = |command| {
        runner.send(command);
    };
    send(RunCommand::Step { dt: DT, count: 7 });
    let edits = [SimEdit::Mass(ball, 3.25), SimEdit::Bounce(wall.key, 0.5)];
    edits.chunks(if together { 2 } else { 1 }).for_each(|edits| send(RunCommand::Edit(edits.to_vec())));
    send(RunCommand::NextEvent { dt: DT, of: Of::All });
    let mut force = scene.forces[0].clone();
    force.kind = ForceKind::GravityPlane { position: glam::DVec3::ZERO, acceleration: glam::DVec3::X };
    send(RunCommand::Edit(vec![SimEdit::ChangeForce(Box::new(force))]));
    send(RunCommand::Step { dt: DT, count: 5 });
    send(RunCommand::Seek { dt: DT, time: 1.2345 });
    let new = Body {
        key: NodeKey(9_000_000),
        ..Body::new(77, glam::dvec3(5.0, 9.0, 5.0), Motion::Static, Shape::Sphere { radius: 0.25 })
    };
    send(RunCommand::Edit(vec![SimEdit::AddBody(Box::new(new))]));
    send(RunCommand::Step { dt: DT, count: 20 });
    send(RunCommand::Edit(vec![SimEdit::Remove(NodeKey(9_000_000))]));
    send(RunCommand::Step { dt: 0.02, count: 10 });
    assert_eq!(runner.frame().complaint(), None);
    (runner.frame(), runner.recording("thesis.xml", SCENE).unwrap())
}

#[test]
fn the_same_run_comes_out_of_a_file_with_edits() {
    for method in Method::ALL {
        let (recorded, file) = edited(method, true);
        let file = RecordingFile::read(&file.to_bytes().unwrap()).unwrap();
        let document = file.document().unwrap();
        let mut again = runner(&document, file.method().unwrap());
        for command in file.commands(document.scene().unwrap()).unwrap() {
            again.send(command);
        }
        let frame = again.frame();
        let name = method.name();
        assert_eq!(frame.complaint(), None, "{name}");
        assert_eq!((frame.time, frame.event_count), (recorded.time, recorded.event_count), "{name}");
        let states = |frame: &Frame| {
            frame.bodies.iter().map(|body| (body.position, body.velocity)).collect::<Vec<_>>()
        };
        assert_eq!(states(&frame), states(&recorded), "{name}");
        for checkpoint in &file.checkpoints {
            again.send(RunCommand::Show(checkpoint.at));
            assert_eq!(again.frame().complaint(), None, "{name} at {:?}", checkpoint.at);
            assert_eq!(
                format!("{:016x}", again.hash().unwrap()),
                checkpoint.hash,
                "{name} at {:?}",
                checkpoint.at
            );
        }
        assert!(file.checkpoints.len() > 4, "{name}: {} states", file.checkpoints.len());
    }
}

/// Files of programs that let bodies go on anew after each edit of several are made again so.
#[test]
fn a_file_of_edits_made_one_after_the_other_is_run_as_it_was() {
    let (recorded, file) = edited(Method::Exact, false);
    let mut older: serde_json::Value = serde_json::from_slice(&file.to_bytes().unwrap()).unwrap();
    let made = older["edits"].as_array_mut().unwrap();
    let second = made.remove(1);
    assert_eq!(made[0]["at"], second["at"]);
    made[0]["edits"].as_array_mut().unwrap().push(second["edits"][0].clone());
    for edits in made {
        assert_eq!(edits.as_object_mut().unwrap().remove("at_once"), Some(true.into()));
    }
    let file = RecordingFile::read(older.to_string().as_bytes()).unwrap();
    let mut again = Rerun::of(file, Limits::default(), &mut |_| true).unwrap();
    assert_eq!(again.runner().frame().event_count, recorded.event_count);
    let compared = again.verify(&mut |_| true).unwrap();
    assert!(compared.same > 4, "{compared:?}");
}

/// Two balls that meet after 1800 s in which nothing happens.
const SLOW: &[u8] = br#"<?xml version="1.0" encoding="utf-8"?>
<PolyPhysicsXml Version="1.0">
  <Map><Size X="10" Y="10" Z="10" /><Tiles X="1" Y="1" Z="1" /></Map>
  <Primitives>
    <SoftObject UserID="1"><Translation X="2" Y="5" Z="5" /><Bounce F32="1" /><Sphere><Radius F32="0.5" /></Sphere>
      <Weight F32="1" /><InitialVelocity X="0.001" Y="0" Z="0" /></SoftObject>
    <SoftObject UserID="2"><Translation X="4.8" Y="5" Z="5" /><Bounce F32="1" /><Sphere><Radius F32="0.5" /></Sphere>
      <Weight F32="1" /><InitialVelocity X="0" Y="0" Z="0" /></SoftObject>
  </Primitives>
</PolyPhysicsXml>"#;

/// The way to an event is as long as it was: waiting for it is not given up as waiting for one that may never come is.
#[test]
fn an_edit_at_an_event_after_a_long_quiet_time_is_made_again() {
    let document = Document::from_bytes(SLOW);
    let mut recorded = runner(&document, Method::Exact);
    let dt = 1.0 / 60.0;
    recorded.send(RunCommand::Step { dt, count: 107_900 });
    recorded.send(RunCommand::NextEvent { dt, of: Of::All });
    let ball = recorded.frame().bodies[0].key;
    recorded.send(RunCommand::Edit(vec![SimEdit::Mass(ball, 2.0)]));
    recorded.send(RunCommand::Step { dt, count: 3 });
    // the impact and the edit
    assert_eq!((recorded.frame().complaint(), recorded.frame().event_count), (None, 2));
    let file = recorded.recording("slow.xml", SLOW).unwrap();
    let mut again = runner(&document, Method::Exact);
    for command in file.commands(document.scene().unwrap()).unwrap() {
        again.send(command);
    }
    let (frame, expected) = (again.frame(), recorded.frame());
    assert_eq!((frame.complaint(), frame.time, frame.event_count), (None, expected.time, 2));
    assert_eq!(again.hash(), recorded.hash());
}
