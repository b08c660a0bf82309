//! The thesis's own scene: against the reference, and its invariants over a minute.

use polyscene::sim::EventKind;
use polyscene::study::{OverlapMonitor, Random};

use crate::common::build::thesis;
use crate::common::drive::{Sampling, run, simulation, watch};
use crate::common::load::load;
use crate::common::reference::reference;

/// UserIDs of the six walls.
const WALLS: [i64; 6] = [32285, 8365, 11797, 8855, 6334, 30612];

#[test]
fn scene_file_says_what_the_thesis_says() {
    let (file, transcript) = (load("thesis-appendix-2.xml"), thesis());
    assert_eq!((file.map, file.time_speed), (transcript.map, transcript.time_speed));
    assert_eq!((file.forces.len(), file.bodies.len()), (2, 13));
    for (left, right) in file.forces.iter().zip(&transcript.forces) {
        assert_eq!((left.id, &left.kind), (right.id, &right.kind));
    }
    for (left, right) in file.bodies.iter().zip(&transcript.bodies) {
        assert_eq!((left.id, left.bounce, left.motion), (right.id, right.bounce, right.motion));
        assert_eq!(
            (left.position, left.rotation, &left.shape),
            (right.position, right.rotation, &right.shape)
        );
    }
}

#[test]
fn first_thirty_events_agree_with_the_reference() {
    let scene = load("thesis-appendix-2.xml");
    let (sim, mut reference) = (simulation(&scene), reference(&scene));
    let expected: Vec<_> = (0..30).map_while(|_| reference.next_impact(60.0).ok().flatten()).collect();
    for dt in [1.0, 1.0 / 60.0] {
        let events = run(&scene, 11.0, Sampling::Every(dt)).events;
        assert!(events.len() >= 30 && expected.len() == 30, "only {} events", events.len());
        for (event, impact) in events.iter().zip(&expected) {
            assert_eq!(event.kind, EventKind::Impact, "{event:?}");
            let b = event.b.expect("an impact has two bodies");
            let labels = [sim.label(event.a), sim.label(b)];
            assert_eq!(labels, [impact.a.to_string(), impact.b.to_string()], "{event:?} {impact:?}");
            let time = (event.time - impact.time).abs();
            assert!(time <= 1e-8, "{time:e} s off: {event:?} {impact:?}");
            let point = (event.point - impact.point).length();
            assert!(point <= 1e-7, "{point:e} m off: {event:?} {impact:?}");
            let normal = (event.normal - impact.normal).length();
            assert!(normal <= 1e-7, "{normal:e} off: {event:?} {impact:?}");
            let impulse = (event.impulse - impact.impulse).abs();
            assert!(impulse <= 1e-6, "{impulse:e} N·s off: {event:?} {impact:?}");
        }
    }
}

#[test]
fn minute_keeps_every_invariant() {
    let scene = load("thesis-appendix-2.xml");
    let monitor = OverlapMonitor::in_id_order(&scene);
    let mut sim = simulation(&scene);
    let total = sim.energy().total.expect("both forces have potentials");
    assert!((total - 47.0107).abs() <= 5e-5, "E₀ = {total} J");
    let (mut events, mut samples) = ([0; 2], 0);
    // Random sample times are random places between the events.
    watch(&mut sim, 60.0, Sampling::Random(11), |sim, event| {
        match event {
            Some(event) => events[usize::from(event.b.is_some_and(|b| sim.state(b).is_some()))] += 1,
            None => samples += 1,
        }
        let t = sim.time();
        let overlap = monitor.worst_now(sim);
        assert!(overlap <= 1e-9, "t {t}: overlap {overlap:e} m");
        let escape = monitor.worst_escape(sim, &WALLS);
        assert!(escape <= 1e-9, "t {t}: {escape:e} m through a wall");
        let energy = sim.energy();
        let drift = (energy.total.expect("both forces have potentials") - total) / total;
        assert!(drift.abs() <= 1e-10, "t {t}: energy drift {drift:e}");
        let residual = energy.residual.expect("both forces have potentials");
        assert!(residual.abs() <= 1e-10, "t {t}: residual {residual:e}");
        assert!(sim.momentum().residual <= 1e-10, "t {t}: momentum {:e}", sim.momentum().residual);
    });
    assert!((200..320).contains(&events.iter().sum()), "{events:?} events");
    assert!(samples > 300, "{samples} samples");
}

#[test]
fn core_reports_the_overlap_the_monitor_sees() {
    let scene = load("thesis-appendix-2.xml");
    let monitor = OverlapMonitor::in_id_order(&scene);
    let mut sim = simulation(&scene);
    let mut random = Random::new(3);
    for _ in 0..50 {
        let target = sim.time() + random.range(0.0, 0.4);
        sim.begin(target);
        sim.finish(&mut |_, _| ()).expect("a run without faults");
        let (own, seen) = (sim.worst_overlap(), monitor.worst_now(&sim));
        assert!((own - seen).abs() <= 1e-14, "t {}: {own:e} and {seen:e}", sim.time());
    }
}
