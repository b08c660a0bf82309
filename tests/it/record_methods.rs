//! Runners with the methods that step by Δt: going back comes out at the same bits, at the Δt of then.

use std::sync::Arc;

use polyscene::record::{Frame, InlineRunner, Of, RunCommand, Runner as _};
use polyscene::scene::{ForceKind, Scene};
use polyscene::sim::{Method, SimEdit, Simulation};

use crate::common::load::load;

const DT: f64 = 1.0 / 60.0;

const STEPPING: [Method; 2] = [Method::Thesis, Method::Fixed];

fn thesis() -> Scene {
    load("thesis-appendix-2.xml")
}

fn runner(method: Method) -> InlineRunner {
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(thesis())));
    runner.send(RunCommand::Method(method));
    runner
}

fn bits(frame: &Frame) -> (u64, u64, Vec<[u64; 6]>) {
    let bodies = frame.bodies.iter().map(|body| {
        let (x, v) = (body.position.to_array(), body.velocity.to_array());
        [x[0], x[1], x[2], v[0], v[1], v[2]].map(f64::to_bits)
    });
    (frame.time.to_bits(), frame.event_count, bodies.collect())
}

fn step(runner: &mut InlineRunner, dt: f64, count: u32) -> Arc<Frame> {
    runner.send(RunCommand::Step { dt, count });
    runner.frame()
}

/// An edit that everything afterwards depends on.
fn lift() -> SimEdit {
    let mut force = thesis().forces[0].clone();
    force.kind = ForceKind::GravityPlane { position: glam::DVec3::ZERO, acceleration: glam::DVec3::Y };
    SimEdit::ChangeForce(Box::new(force))
}

#[test]
fn another_method_starts_again_and_stays() {
    let mut runner = runner(Method::Exact);
    step(&mut runner, 0.1, 20);
    runner.send(RunCommand::Method(Method::Exact));
    assert_eq!(runner.frame().dt_index, 20, "the same method is no news");
    for method in STEPPING {
        step(&mut runner, 0.1, 20);
        runner.send(RunCommand::Method(method));
        assert_eq!((runner.frame().method, runner.frame().time), (method, 0.0));
        runner.send(RunCommand::Unload);
        runner.send(RunCommand::Load(Arc::new(thesis())));
        let frame = step(&mut runner, 0.05, 60);
        let mut simulation = Simulation::with_method(&thesis(), method).unwrap();
        for tick in 1..=60 {
            simulation.begin(f64::from(tick) * 0.05);
            simulation.finish(&mut |_, _| {}).unwrap();
        }
        let state = simulation.state(simulation.dynamic_bodies().next().unwrap()).unwrap();
        assert_eq!(frame.bodies[0].position, state.position, "{method:?}");
    }
}

#[test]
fn steps_of_several_lengths_are_gone_back_through() {
    for method in STEPPING {
        let mut runner = runner(method);
        let mut seen = vec![bits(&runner.frame())];
        for (nth, dt) in [0.05, 1.0 / 60.0, 0.013].into_iter().enumerate() {
            for _ in 0..100 + nth {
                seen.push(bits(&step(&mut runner, dt, 1)));
            }
        }
        for expected in seen.iter().rev().skip(1) {
            runner.send(RunCommand::StepBack);
            assert_eq!(bits(&runner.frame()), *expected, "{method:?}");
        }
    }
}

#[test]
fn every_event_is_come_back_to_inside_its_step() {
    for method in STEPPING {
        let mut runner = runner(method);
        let mut seen = Vec::new();
        for _ in 0..20 {
            runner.send(RunCommand::NextEvent { dt: 0.1, of: Of::All });
            seen.push(bits(&runner.frame()));
        }
        for expected in seen.iter().rev().skip(1) {
            runner.send(RunCommand::EventBack { of: Of::All });
            let frame = runner.frame();
            assert_eq!(bits(&frame), *expected, "{method:?}");
            assert!(frame.open_step.is_some_and(|(start, end)| start <= frame.time && frame.time <= end));
        }
        for expected in &seen[1..] {
            runner.send(RunCommand::NextEvent { dt: 0.1, of: Of::All });
            assert_eq!(bits(&runner.frame()), *expected, "{method:?}");
        }
    }
}

#[test]
fn edits_inside_a_step_are_replayed() {
    for method in STEPPING {
        let mut runner = runner(method);
        step(&mut runner, 0.1, 5);
        runner.send(RunCommand::NextEvent { dt: 0.1, of: Of::All });
        assert!(runner.frame().open_step.is_some());
        runner.send(RunCommand::Edit(vec![lift()]));
        assert_eq!(runner.frame().complaint(), None);
        runner.send(RunCommand::FinishStep);
        let after = bits(&step(&mut runner, 0.1, 30));
        for _ in 0..25 {
            runner.send(RunCommand::StepBack);
        }
        assert_eq!(bits(&step(&mut runner, 0.1, 25)), after, "{method:?}: from behind the edit");
        for _ in 0..35 {
            runner.send(RunCommand::StepBack);
        }
        let index = runner.frame().dt_index;
        assert_eq!(bits(&step(&mut runner, 0.1, 38 - index as u32)), after, "{method:?}: across the edit");
    }
}

#[test]
fn another_step_length_after_going_back_makes_another_future_and_says_so() {
    for method in STEPPING {
        let mut runner = runner(method);
        step(&mut runner, 0.1, 10);
        runner.send(RunCommand::Edit(vec![lift()]));
        step(&mut runner, 0.1, 5);
        for _ in 0..10 {
            runner.send(RunCommand::StepBack);
        }
        let frame = step(&mut runner, 0.07, 20);
        let said = frame.message.as_deref().unwrap_or_default();
        assert!(said.contains("1 edit"), "{said}");
        let here = bits(&frame);
        step(&mut runner, 0.07, 3);
        for _ in 0..3 {
            runner.send(RunCommand::StepBack);
        }
        assert_eq!(bits(&runner.frame()), here, "{method:?}");
    }
}

/// Symptom: after the oldest was dropped, what is kept was gone on from with another state. Cause: with the motion went the ends
/// of the Δt that older keyframes are followed by, and the first step after one was as long as all those together.
#[test]
fn what_is_kept_can_be_gone_on_from_where_the_oldest_is_dropped() {
    for method in STEPPING {
        let mut whole = gas(method);
        whole.send(RunCommand::Step { dt: DT, count: 1500 });
        let bytes = whole.frame().recorded.bytes;
        let mut small = gas(method);
        small.send(RunCommand::Budget(bytes / 3));
        small.send(RunCommand::Step { dt: DT, count: 1500 });
        let recorded = small.frame().recorded.clone();
        assert!(recorded.from > 0.0, "{method:?}: something is dropped");
        let middle = DT * (0.5 * (recorded.from + recorded.to) / DT).round();
        for runner in [&mut whole, &mut small] {
            runner.send(RunCommand::Seek { dt: DT, time: middle });
            // Another Δt makes another future.
            runner.send(RunCommand::Step { dt: 0.5 * DT, count: 20 });
        }
        let (whole, small) = (whole.frame(), small.frame());
        assert_eq!(small.fault, None, "{method:?}");
        assert_eq!(bits(&small), bits(&whole), "{method:?}");
    }
}

fn gas(method: Method) -> InlineRunner {
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(load("gas.xml"))));
    runner.send(RunCommand::Method(method));
    runner
}
