//! Moving through a recorded run: to times and events, backwards, over a range, to goals; the memory it may take; what an
//! edit in the past replaces and how it is brought back; the ways of bodies.

use std::sync::Arc;

use glam::DVec3;
use polyscene::record::{
    EventRow, Frame, Goal, InlineRunner, Of, PathSpan, RunCommand, RunState, Runner as _,
};
use polyscene::scene::{Body, NodeKey};
use polyscene::sim::{ContactState, SimEdit};

use crate::common::build::Build as _;
use crate::common::load::load;

const DT: f64 = 1.0 / 60.0;

fn loaded(name: &str) -> InlineRunner {
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(load(name))));
    runner
}

fn after(runner: &mut InlineRunner, command: RunCommand) -> Arc<Frame> {
    runner.send(command);
    let frame = runner.frame();
    assert_eq!(frame.complaint(), None);
    frame
}

fn step(runner: &mut InlineRunner, count: u32) -> Arc<Frame> {
    after(runner, RunCommand::Step { dt: DT, count })
}

fn seek(runner: &mut InlineRunner, time: f64) -> Arc<Frame> {
    after(runner, RunCommand::Seek { dt: DT, time })
}

/// What must be the same to the bit when the same moment is reached again.
fn bits(frame: &Frame) -> (u64, u64, Vec<[u64; 6]>) {
    let bodies = frame.bodies.iter().map(|body| {
        let (x, v) = (body.position.to_array(), body.velocity.to_array());
        [x[0], x[1], x[2], v[0], v[1], v[2]].map(f64::to_bits)
    });
    (frame.time.to_bits(), frame.event_count, bodies.collect())
}

#[test]
fn any_time_is_reached_with_the_same_bits_from_anywhere() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let times: Vec<f64> = (0..40).map(|nth| 0.137 * f64::from(nth)).collect();
    let forwards: Vec<_> = times.iter().map(|time| bits(&seek(&mut runner, *time))).collect();
    step(&mut runner, 60);
    for (time, expected) in times.iter().zip(&forwards).rev() {
        assert_eq!(bits(&seek(&mut runner, *time)), *expected, "back at {time}");
    }
    let mut other = loaded("thesis-appendix-2.xml");
    step(&mut other, 400);
    for (time, expected) in times.iter().zip(&forwards) {
        assert_eq!(bits(&seek(&mut other, *time)), *expected, "in another recording at {time}");
    }
}

#[test]
fn seeking_beyond_the_end_runs_on_and_stays_inside_the_step() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let frame = seek(&mut runner, 1.234);
    assert_eq!(frame.time, 1.234);
    let (start, end) = frame.open_step.expect("inside a Δt");
    assert!(start < 1.234 && 1.234 < end && (end - start - DT).abs() < 1e-12);
    let whole = after(&mut runner, RunCommand::FinishStep);
    let mut plain = loaded("thesis-appendix-2.xml");
    assert_eq!(bits(&whole), bits(&step(&mut plain, whole.dt_index as u32)));
    for time in [f64::NAN, f64::INFINITY] {
        runner.send(RunCommand::Seek { dt: DT, time });
        assert_eq!(runner.frame().message.as_deref(), Some("that is not a time"));
    }
}

#[test]
fn playing_backwards_shows_what_playing_forwards_showed() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let mut shown = vec![bits(&runner.frame())];
    for _ in 0..100 {
        shown.push(bits(&step(&mut runner, 1)));
    }
    runner.send(RunCommand::Play { dt: DT, speed: -1.0, range: None });
    let mut back = Vec::new();
    while runner.frame().state == RunState::Playing && back.len() < 200 {
        runner.tick(DT * 1.0001);
        back.push(bits(&runner.frame()));
    }
    back.dedup();
    shown.pop();
    shown.reverse();
    assert_eq!(back, shown);
    assert_eq!((runner.frame().state, runner.frame().time), (RunState::Paused, 0.0));
}

#[test]
fn slow_playing_goes_through_the_step_and_a_range_is_repeated() {
    let mut runner = loaded("thesis-appendix-2.xml");
    runner.send(RunCommand::Play { dt: 0.25, speed: 0.1, range: None });
    let mut times = Vec::new();
    for _ in 0..60 {
        runner.tick(1.0 / 60.0);
        times.push(runner.frame().time);
    }
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
    assert!((times[59] - 0.1).abs() < 0.005, "{}", times[59]);
    runner.send(RunCommand::Play { dt: 0.25, speed: 1.0, range: Some((0.5, 1.0)) });
    let mut most: f64 = 0.0;
    for _ in 0..40 {
        runner.tick(0.25);
        most = most.max(runner.frame().time);
    }
    assert!(most <= 1.0 && runner.frame().state == RunState::Playing, "at most {most} s");
}

#[test]
fn events_of_a_body_and_of_a_pair_are_gone_to() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let all = step(&mut runner, 600);
    let row = all.ledger.at(3).expect("some events").clone();
    let (a, b) = (row.a_key, row.b_key.expect("an impact"));
    let concerns = |row: &EventRow, key| row.a_key == key || row.b_key == Some(key);
    let of_body: Vec<u64> =
        all.ledger.iter_from(0).filter(|row| concerns(row, a)).map(|row| row.event.seq).collect();
    let of_pair: Vec<u64> = all
        .ledger
        .iter_from(0)
        .filter(|row| concerns(row, a) && concerns(row, b))
        .map(|row| row.event.seq)
        .collect();
    for (of, wanted) in [(Of::Body(a), &of_body), (Of::Pair(a, b), &of_pair)] {
        seek(&mut runner, 0.0);
        for number in wanted {
            assert_eq!(after(&mut runner, RunCommand::NextEvent { dt: DT, of }).event_count, *number);
        }
        for number in wanted.iter().rev().skip(1) {
            assert_eq!(after(&mut runner, RunCommand::EventBack { of }).event_count, *number);
        }
    }
    // A run that knows nothing yet finds the same.
    let mut fresh = loaded("thesis-appendix-2.xml");
    let first = after(&mut fresh, RunCommand::NextEvent { dt: DT, of: Of::Pair(a, b) });
    assert_eq!(first.event_count, of_pair[0]);
}

#[test]
fn running_ends_at_its_goal() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let until = |goal| RunCommand::RunUntil { dt: DT, goal };
    assert_eq!(after(&mut runner, until(Goal::Events(7))).event_count, 7);
    assert_eq!(after(&mut runner, until(Goal::Events(5))).event_count, 12);
    assert_eq!(after(&mut runner, until(Goal::Time(9.125))).time, 9.125);
    let mut runner = loaded("bin.xml");
    let rest = after(&mut runner, until(Goal::Rest));
    assert!(
        rest.time > 0.5 && rest.bodies.iter().all(|body| body.contact == ContactState::Rest),
        "{}",
        rest.time
    );
    let again = seek(&mut runner, 0.0);
    assert_eq!((again.time, again.event_count), (0.0, 0));
    let looked_up = after(&mut runner, until(Goal::Rest));
    assert_eq!(bits(&looked_up), bits(&rest));
}

/// Symptom: a run until rest of what never rests, or for one more event where none comes, went on for ever. Expected: it is
/// given up, and says why. Cause: only "next event" counted the Δt in which nothing came nearer.
#[test]
fn a_goal_that_is_never_reached_is_given_up() {
    for (scene, goal, message) in [
        ("cradle.xml", Goal::Rest, "no rest within"),
        ("rest.xml", Goal::Events(1_000_000), "no event: nothing moves"),
    ] {
        let mut runner = loaded(scene);
        runner.send(RunCommand::RunUntil { dt: DT, goal });
        let frame = runner.frame();
        let said = frame.message.as_deref().unwrap_or_default();
        assert!(said.contains(message), "{scene}: {said}");
        assert_eq!(frame.state, RunState::Paused, "{scene}");
        // and it can be gone on from
        assert!(step(&mut runner, 1).time > frame.time, "{scene}");
    }
}

/// Symptom: the next event after the last one was looked for through half an hour of model time, and shown was what is then.
#[test]
fn no_next_event_leaves_what_is_shown() {
    let mut runner = loaded("rest.xml");
    let rest = after(&mut runner, RunCommand::RunUntil { dt: DT, goal: Goal::Rest });
    let then = step(&mut runner, 3);
    runner.send(RunCommand::NextEvent { dt: DT, of: Of::All });
    let found = runner.frame();
    assert!(then.time > rest.time);
    assert_eq!((found.time, bits(&found)), (then.time, bits(&then)));
    assert!(step(&mut runner, 1).time > then.time, "it can be gone on from");
}

#[test]
fn what_an_edit_in_the_past_replaces_can_be_brought_back() {
    let mut runner = loaded("thesis-appendix-2.xml");
    let end = step(&mut runner, 200);
    seek(&mut runner, 1.5);
    let key = end.bodies[0].key;
    let edited = after(&mut runner, RunCommand::Edit(vec![SimEdit::Mass(key, 9.0)]));
    assert_eq!((edited.recorded.to, edited.recorded.can_bring_back), (1.5, true));
    let other = step(&mut runner, 150);
    assert!(other.time > 2.0);
    let back = after(&mut runner, RunCommand::BringBack);
    assert_eq!((back.time, back.recorded.to, back.recorded.can_bring_back), (1.5, end.time, false));
    assert!(back.recorded.edits.is_empty());
    assert_eq!(bits(&seek(&mut runner, end.time)), bits(&end));
    assert_eq!(runner.frame().ledger.len(), end.ledger.len());
    let on = step(&mut runner, 100);
    let mut plain = loaded("thesis-appendix-2.xml");
    assert_eq!(bits(&on), bits(&step(&mut plain, 300)));
}

#[test]
fn a_small_memory_drops_the_oldest_and_says_so() {
    let whole = step(&mut loaded("gas.xml"), 3000).recorded.bytes;
    let mut runner = loaded("gas.xml");
    runner.send(RunCommand::Budget(whole / 3));
    let end = step(&mut runner, 3000);
    let recorded = &end.recorded;
    assert!(recorded.bytes < recorded.budget + whole / 8, "{} of {}", recorded.bytes, recorded.budget);
    assert!(recorded.from > 0.0 && end.ledger.first() > 1, "from {} s", recorded.from);
    let early = seek(&mut runner, 0.0);
    assert_eq!(early.time, recorded.from, "the first time that is kept");
    assert_eq!(bits(&seek(&mut runner, end.time)), bits(&end));
    let mut plain = loaded("gas.xml");
    let middle = 0.5 * (recorded.from + recorded.to);
    assert_eq!(bits(&seek(&mut runner, middle)), bits(&seek(&mut plain, middle)));
}

/// Symptom: one Δt of many events took any amount of memory, and every edit a copy of the scene for ever. Expected: what a run
/// takes stays near its budget inside a Δt too, and what is kept is as true as before.
#[test]
fn the_budget_holds_inside_a_step_and_with_many_edits() {
    let whole = step(&mut loaded("gas.xml"), 3000).recorded.clone();
    let one_step = RunCommand::Step { dt: whole.to, count: 1 };
    let mut runner = loaded("gas.xml");
    runner.send(RunCommand::Budget(whole.bytes / 4));
    let end = after(&mut runner, one_step);
    assert!(end.recorded.bytes < whole.bytes / 4 + whole.bytes / 8, "{} bytes", end.recorded.bytes);
    let mut plain = loaded("gas.xml");
    let middle = 0.5 * (end.recorded.from + end.recorded.to);
    assert!(end.recorded.from > 0.0);
    // Rows are dropped many at once: of some that are left, what was then is no longer known.
    let oldest = end.ledger.at(0).unwrap().event;
    assert!(oldest.time < end.recorded.from);
    runner.send(RunCommand::GoTo { event: oldest.seq });
    let refused = runner.frame();
    assert!(refused.time == end.time && refused.message.is_some());
    let back = after(&mut runner, RunCommand::EventBack { of: Of::All });
    assert!(back.time < end.time && back.message.is_none());
    assert_eq!(bits(&seek(&mut runner, middle)), bits(&seek(&mut plain, middle)));

    let budget = 1 << 20;
    let [mut small, mut large] = [budget, 1 << 30].map(|bytes| {
        let mut runner = loaded("gas.xml");
        runner.send(RunCommand::Budget(bytes));
        for nth in 0..100 {
            let key = step(&mut runner, 2).bodies[0].key;
            runner.send(RunCommand::Edit(vec![SimEdit::Mass(key, 1.0 + f64::from(nth))]));
        }
        runner
    });
    let (kept, all) = (small.frame().recorded.clone(), large.frame().recorded.clone());
    assert!(all.bytes > 4 * budget, "of {} bytes too many", all.bytes);
    assert!(kept.bytes < budget + budget / 4, "{} bytes of {budget}", kept.bytes);
    assert!(kept.from > 0.0 && kept.edits.len() == 100);
    for part in [0.0, 0.3, 1.0] {
        let time = kept.from + part * (kept.to - kept.from);
        assert_eq!(bits(&seek(&mut small, time)), bits(&seek(&mut large, time)));
    }
    // A smaller budget drops what is shown: the first that is kept is shown instead.
    seek(&mut small, kept.from);
    let less = after(&mut small, RunCommand::Budget(budget / 2));
    assert!(less.recorded.from > kept.from && less.time == less.recorded.from, "{} s", less.time);
}

/// A ball that falls from 5 m: its way is the parabola itself, at any distance from the pictures.
#[test]
fn ways_lie_on_the_motion_itself() {
    let mut runner = loaded("bounce.xml");
    runner.send(RunCommand::Step { dt: 1.0, count: 3 });
    runner.send(RunCommand::Paths(Some(PathSpan { past: 0.5, future: 0.4 })));
    let frame = seek(&mut runner, 0.5);
    let path = &frame.paths[0];
    let (first, now) = (path.past[0], *path.past.last().unwrap());
    assert!((first.y - 5.0).abs() < 1e-12 && (now.y - (5.0 - 4.9 * 0.25)).abs() < 1e-12);
    assert!((path.future.last().unwrap().y - (5.0 - 4.9 * 0.81)).abs() < 1e-12);
    assert_eq!(path.future.first(), Some(&now));
    runner.send(RunCommand::Paths(None));
    assert!(runner.frame().paths.is_empty());
}

#[test]
fn at_an_event_its_bodies_come_and_leave() {
    let mut runner = loaded("bounce.xml");
    let frame = after(&mut runner, RunCommand::NextEvent { dt: 1.5, of: Of::All });
    let speed = (2.0 * 9.8 * 4.5_f64).sqrt();
    let [ball] = frame.at_impact.as_slice() else { panic!("one body: {:?}", frame.at_impact) };
    assert!(
        (ball.before + speed * DVec3::Y).length() < 1e-9 && (ball.after - speed * DVec3::Y).length() < 1e-9
    );
    assert_eq!((ball.at_start.y, ball.at_end), (5.0, None));
    after(&mut runner, RunCommand::FinishStep);
    assert!(runner.frame().at_impact.is_empty());
    let again = after(&mut runner, RunCommand::EventBack { of: Of::All });
    assert!(again.at_impact[0].at_end.is_some(), "the end of the Δt is known now");
}

/// What is handed out of the recording has the bits of the run, with how bodies are turned, and stays as it was.
#[test]
fn recorded_motion_is_looked_up_with_the_bits_of_the_run() {
    for scene in ["thesis-appendix-2.xml", "billiards.xml"] {
        let mut runner = loaded(scene);
        let mut shown = Vec::new();
        for _ in 0..90 {
            let frame = step(&mut runner, 1);
            let states = frame.bodies.iter().map(|body| (body.position, body.velocity, body.turn));
            shown.push((frame.time, states.collect::<Vec<_>>()));
        }
        let motion = after(&mut runner, RunCommand::ShareMotion(true)).motion.clone().expect("the motion");
        step(&mut runner, 10);
        assert!(Arc::ptr_eq(&motion, runner.frame().motion.as_ref().expect("the same")));
        assert_eq!(motion.span(), (0.0, shown.last().expect("a time").0));
        for (time, states) in &shown {
            for (nth, state) in states.iter().enumerate() {
                let found = motion.state(nth, *time).expect("it is recorded");
                assert_eq!(
                    (found.position, found.velocity, found.turn),
                    *state,
                    "{scene}: {nth} at {time} s"
                );
            }
        }
        assert!(motion.state(0, motion.span().1 + 1.0).is_none());
        assert!(after(&mut runner, RunCommand::ShareMotion(false)).motion.is_none());
    }
}

/// Symptom: once the memory had dropped where an edit was made, bringing back what it replaced left a recording that begins after
/// its end. Expected: it can no longer be brought back, and that is said. Cause: what was replaced outlived what it continues.
#[test]
fn what_continues_a_dropped_past_is_not_brought_back() {
    let whole = step(&mut loaded("gas.xml"), 3000).recorded.bytes;
    let mut runner = loaded("gas.xml");
    runner.send(RunCommand::Budget(whole / 3));
    let early = step(&mut runner, 60);
    seek(&mut runner, 0.5 * early.time);
    let key = early.bodies[0].key;
    let edited = after(&mut runner, RunCommand::Edit(vec![SimEdit::Mass(key, 9.0)]));
    assert!(edited.recorded.can_bring_back);
    let end = step(&mut runner, 3000);
    assert!(end.recorded.from > edited.time, "from {} s", end.recorded.from);
    assert!(!end.recorded.can_bring_back);
    runner.send(RunCommand::BringBack);
    let frame = runner.frame();
    assert!(frame.message.is_some());
    assert_eq!((bits(&frame), &frame.recorded), (bits(&end), &end.recorded));
}

/// What has fallen out of the scene never rests: running to rest ends when nothing will happen any more.
#[test]
fn running_to_rest_ends_where_something_flies_for_ever() {
    let mut scene = load("rest.xml");
    let ball = scene.bodies.iter().find(|body| body.is_dynamic()).cloned().expect("a ball");
    scene = scene.body(Body { key: NodeKey(9_000_001), id: 9_001, position: DVec3::splat(-50.0), ..ball });
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Load(Arc::new(scene)));
    runner.send(RunCommand::RunUntil { dt: DT, goal: Goal::Rest });
    let frame = runner.frame();
    assert!((8.0..10.0).contains(&frame.time), "t {}", frame.time);
    assert!(
        frame.message.as_ref().is_some_and(|message| message.contains("flies on")),
        "{:?}",
        frame.message
    );
}
