//! Selection, inspector fields, problems, new objects, the clipboard and typed numbers.

use std::sync::Arc;

use glam::DVec3;
use polyscene::editor::{
    Action, Addition, BODY_FIELDS, Drag, FORCE_FIELDS, Fix, Gesture, Outcome, Place, ProblemSource, Request,
    SAMPLES, SCENE_FIELDS, SessionCommand, Shared, Typed, parse_angle, parse_number, shared,
};
use polyscene::scene::{BodyChange, Diagnostic, Document, Edit, ForceChange, Severity, Shape};
use polyscene::view::Pull;

use super::editor_support::{Bench, BodyNumbers, SCENE};

#[test]
fn selection_keeps_the_order_and_each_thing_once() {
    let mut bench = Bench::open();
    let (seven, eight) = (bench.key(7), bench.key(8));
    bench.act(Action::Select(vec![seven, eight, seven]));
    assert_eq!(bench.session.selection().keys(), [seven, eight]);
    assert_eq!(bench.session.selection().primary(), Some(eight));
    bench.act(Action::ToggleSelected(seven));
    assert_eq!(bench.session.selection().keys(), [eight]);
    bench.act(Action::AddToSelection(vec![seven, eight]));
    assert_eq!(bench.session.selection().keys(), [eight, seven]);
    bench.act(Action::SelectPlace(Place::Map));
    assert!(bench.session.selection().is_empty());
    assert_eq!(bench.session.selection().place(), Some(Place::Map));
    bench.act(Action::ToggleSelected(seven));
    assert_eq!(bench.session.selection().place(), None);
    bench.run(SessionCommand::SelectNone);
    assert!(bench.session.selection().is_empty());
}

#[test]
fn select_all_leaves_out_what_is_hidden() {
    let mut bench = Bench::open();
    bench.act(Action::Select(vec![bench.key(7)]));
    bench.run(SessionCommand::Hide);
    assert!(bench.session.selection().is_empty(), "what cannot be seen is not selected");
    bench.run(SessionCommand::SelectAll);
    assert_eq!(bench.session.selection().len(), 3);
    bench.run(SessionCommand::ShowAll);
    assert!(!bench.body(7).hidden);
}

#[test]
fn several_values_are_the_same_or_mixed() {
    assert_eq!(shared([None, None]), Shared::None);
    assert_eq!(shared([Some(2.0), None, Some(2.0)]), Shared::Same(2.0));
    let mixed = Shared::Mixed { smallest: -1.0, largest: 5.0 };
    assert_eq!(shared([Some(2.0), Some(5.0), Some(-1.0), Some(2.0)]), mixed);
}

#[test]
fn every_field_reads_back_what_it_sets_and_leaves_the_rest() {
    for sample in SAMPLES {
        let document = Document::from_bytes(sample.bytes);
        let scene = document.scene().unwrap();
        for (body, field) in scene.bodies.iter().take(8).flat_map(|b| BODY_FIELDS.iter().map(move |f| (b, f)))
        {
            for axis in 0..field.axes.len() {
                let Some(before) = field.value(body, axis) else { continue };
                let value = (before + 0.25).clamp(field.range.0, field.range.1);
                let change = field.change(body, axis, value).unwrap();
                let edited = document.apply(&Edit::Body { key: body.key, change }).unwrap().document;
                let after =
                    edited.scene().unwrap().bodies.iter().find(|b| b.key == body.key).unwrap().clone();
                assert_eq!(field.value(&after, axis), Some(value), "{}", field.accessible_name(axis));
                let back = field.change(&after, axis, before).unwrap();
                let restored = edited.apply(&Edit::Body { key: body.key, change: back }).unwrap().document;
                assert_eq!(restored.scene(), document.scene(), "{}", field.accessible_name(axis));
            }
        }
    }
}

#[test]
fn forces_and_the_map_have_fields_too() {
    let mut bench = Bench::open();
    bench.run(SessionCommand::Add(Addition::GravityPoint));
    bench.run(SessionCommand::Add(Addition::Drag));
    let scene = bench.session.scene().unwrap();
    let numbers: Vec<usize> = scene
        .forces
        .iter()
        .map(|force| FORCE_FIELDS.iter().filter_map(|f| (f.get)(force).map(|_| f.axes.len())).sum())
        .collect();
    assert_eq!(numbers, [6, 4, 1], "uniform gravity, point gravity, drag");
    let tiles = SCENE_FIELDS.iter().find(|field| field.label == "Tiles").unwrap();
    assert_eq!(tiles.change(scene, 1, 4.0), Some(Edit::MapTiles([10, 4, 10])));
    let size = SCENE_FIELDS.iter().find(|field| field.label == "Size").unwrap();
    assert_eq!(size.change(scene, 2, 8.0), Some(Edit::MapSize(DVec3::new(10.0, 10.0, 8.0))));
}

#[test]
fn one_edit_changes_a_number_of_several_bodies_and_skips_those_without_it() {
    let mut bench = Bench::open();
    bench.run(SessionCommand::SelectAll);
    let mass = BODY_FIELDS.iter().find(|field| field.label == "Mass").unwrap();
    let edit = mass
        .edit(bench.session.scene().unwrap(), bench.session.selection().keys(), 0, &Typed::Value(6.0))
        .unwrap();
    assert_eq!(bench.edit(edit), Outcome::Done);
    assert_eq!((bench.body(7).mass(), bench.body(8).mass()), (Some(6.0), Some(6.0)));
    assert_eq!(bench.session.undo_label(), Some("Change mass of 2 objects"));
    // one component changes, the others stay apart
    let position = BODY_FIELDS.iter().find(|field| field.label == "Position").unwrap();
    let edit = position
        .edit(bench.session.scene().unwrap(), &[bench.key(7), bench.key(8)], 1, &Typed::Value(9.0))
        .unwrap();
    bench.edit(edit);
    assert_eq!(bench.body(7).position, DVec3::new(3.0, 9.0, 3.0));
    assert_eq!(bench.body(8).position, DVec3::new(7.0, 9.0, 3.0));
    bench.run(SessionCommand::Undo);
    bench.run(SessionCommand::Undo);
    assert_eq!(bench.bytes(), SCENE);
}

#[test]
fn a_drag_moves_the_selection_but_not_what_is_locked() {
    let mut bench = Bench::open();
    bench.act(Action::Select(vec![bench.key(8)]));
    bench.run(SessionCommand::Lock);
    bench.run(SessionCommand::SelectAll);
    let drag = Drag::of_selection(&bench.session, Gesture(1)).unwrap();
    for step in 1..=5 {
        bench.act(drag.pull(&Pull::Move(DVec3::new(0.5 * f64::from(step), 0.0, 0.0)), DVec3::ZERO));
    }
    bench.act(Action::EndGesture);
    assert_eq!(bench.body(7).position, DVec3::new(5.5, 3.0, 3.0));
    assert_eq!(bench.body(8).position, DVec3::new(7.0, 3.0, 3.0));
    assert_eq!(bench.session.undo_label(), Some("Edit 3 objects"), "two bodies and the gravity's symbol");
    bench.run(SessionCommand::Delete);
    assert_eq!(bench.session.scene().unwrap().bodies.len(), 1);
    assert!(bench.notices().contains("1 locked"));
    bench.act(Action::Select(vec![bench.key(8)]));
    assert!(Drag::of_selection(&bench.session, Gesture(2)).is_none());
    assert!(matches!(bench.run(SessionCommand::Delete), Outcome::Refused(_)));
    bench.run(SessionCommand::UnlockAll);
    assert_eq!(bench.run(SessionCommand::Delete), Outcome::Done);
}

#[test]
fn new_spheres_touch_nothing_and_lie_in_the_map() {
    for sample in [None, Some(0), Some(9)] {
        let mut bench = Bench::new();
        if let Some(index) = sample {
            bench.run(SessionCommand::OpenSample(index));
        }
        for command in
            [SessionCommand::Add(Addition::SphereDynamic), SessionCommand::Add(Addition::SphereStatic)]
                .repeat(5)
        {
            assert_eq!(bench.run(command), Outcome::Done);
            let scene = bench.session.scene().unwrap();
            let key = bench.session.selection().primary().unwrap();
            let new = scene.bodies.iter().find(|body| body.key == key).unwrap();
            let Shape::Sphere { radius } = new.shape else { panic!("{:?}", new.shape) };
            assert_eq!(new.is_dynamic(), command == SessionCommand::Add(Addition::SphereDynamic));
            assert!(new.position.cmpge(DVec3::splat(radius)).all(), "{}", new.position);
            assert!((new.position + radius).cmple(scene.map.size).all(), "{}", new.position);
            for other in scene.bodies.iter().filter(|body| body.key != key) {
                if let Shape::Sphere { radius: other_radius } = other.shape {
                    assert!(new.position.distance(other.position) > radius + other_radius);
                }
            }
        }
    }
}

#[test]
fn every_add_command_adds_one_selected_object_without_problems() {
    for command in [
        SessionCommand::Add(Addition::SphereDynamic),
        SessionCommand::Add(Addition::SphereStatic),
        SessionCommand::Add(Addition::Plane),
        SessionCommand::Add(Addition::GravityPlane),
        SessionCommand::Add(Addition::GravityPoint),
        SessionCommand::Add(Addition::Drag),
    ] {
        let mut bench = Bench::new();
        assert_eq!(bench.run(command), Outcome::Done);
        let scene = bench.session.scene().unwrap();
        assert_eq!(scene.bodies.len() + scene.forces.len(), 1, "{command:?}");
        assert_eq!(bench.session.selection().len(), 1);
        let warns = command == SessionCommand::Add(Addition::Drag);
        assert!(warns || bench.session.problems().is_empty(), "{:?}", bench.session.problems());
        assert_eq!(bench.session.document().reasons_for_1_1().is_empty(), !warns);
    }
}

#[test]
fn copies_lie_beside_their_originals_and_are_selected() {
    let mut bench = Bench::open();
    bench.act(Action::Select(vec![bench.key(7), bench.key(8)]));
    let before = bench.session.selection().clone();
    assert_eq!(bench.run(SessionCommand::Duplicate), Outcome::Done);
    let scene = bench.session.scene().unwrap();
    assert_eq!(scene.bodies.len(), 5);
    assert_eq!(bench.session.selection().len(), 2);
    assert!(bench.session.selection().keys().iter().all(|key| !before.contains(*key)));
    assert!(scene.bodies.iter().all(|body| !body.label.contains('#')), "copies have their own ids");
    let copies = scene.bodies.iter().filter(|body| bench.session.selection().contains(body.key));
    for copy in copies {
        let others = scene.bodies.iter().filter(|body| body.is_dynamic() && body.key != copy.key);
        assert!(others.into_iter().all(|other| other.position.distance(copy.position) > 1.0));
    }
}

#[test]
fn cut_and_paste_carry_bodies_and_forces_as_xml() {
    let mut bench = Bench::open();
    bench.act(Action::Select(vec![bench.key(8), bench.force(1).key]));
    assert_eq!(bench.run(SessionCommand::Cut), Outcome::Done);
    let requests = bench.session.take_requests();
    let [Request::SetClipboard(text)] = &requests[..] else { panic!("{requests:?}") };
    assert!(text.contains("PolyPhysicsXml") && text.contains("UserID=\"8\""), "{text}");
    assert_eq!(bench.session.scene().unwrap().bodies.len(), 2);
    assert_eq!(bench.act(Action::Paste(text.clone())), Outcome::Done);
    assert_eq!(bench.body(8).velocity(), Some(DVec3::X));
    assert_eq!(bench.body(8).mass(), Some(2.0));
    assert_eq!(bench.session.scene().unwrap().forces.len(), 1);
    assert_eq!(bench.session.undo_label(), Some("Paste 2 objects"));
    // once more: the second lies beside the first, under an id of its own
    bench.act(Action::Paste(text.clone()));
    let scene = bench.session.scene().unwrap();
    assert_eq!(scene.bodies.len(), 4);
    assert_ne!(scene.bodies[2].position, scene.bodies[3].position);
    assert_ne!(scene.bodies[2].id, scene.bodies[3].id);
    for text in ["", "hello", "<PolyPhysicsXml"] {
        assert!(matches!(bench.act(Action::Paste(text.into())), Outcome::Refused(_)), "{text}");
    }
}

#[test]
fn a_repeated_id_is_a_problem_with_its_fix() {
    let mut bench = Bench::open();
    bench.change(8, BodyChange::Id(7));
    let problems = bench.session.problems();
    let [problem] = &problems[..] else { panic!("{problems:?}") };
    assert_eq!(problem.severity, Severity::Warning);
    let Some(Fix::Repair(repair)) = problem.fix else { panic!("{problem:?}") };
    bench.act(Action::Repair(repair));
    assert!(bench.session.problems().is_empty());
    assert!(matches!(bench.run(SessionCommand::MakeIdsUnique), Outcome::Refused(_)));
}

#[test]
fn problems_of_the_simulation_have_the_place_in_the_file() {
    let mut bench = Bench::open();
    let key = bench.key(8);
    let overlap = Diagnostic {
        severity: Severity::Warning,
        position: None,
        path: String::new(),
        message: "overlaps 7 by 0.1 m at the start".into(),
        hint: "move one of them".into(),
        key: Some(key),
    };
    bench.show(|frame| frame.problems = Arc::new(vec![overlap]));
    let problems = bench.session.problems();
    let [problem] = &problems[..] else { panic!("{problems:?}") };
    assert_eq!((problem.source, problem.key), (ProblemSource::Simulation, Some(key)));
    assert_eq!(problem.position.map(|(line, _)| line), Some(11), "{problem:?}");
    assert!(problem.path.contains("SoftObject"), "{problem:?}");
}

#[test]
fn a_fault_is_a_problem_and_a_message() {
    let mut bench = Bench::open();
    bench.step();
    bench.show(|frame| {
        frame.state = polyscene::record::RunState::Faulted;
        frame.fault = Some("at t = 1 s: the velocity is not finite".into());
    });
    assert!(bench.notices().contains("not finite"));
    assert!(matches!(&bench.session.problems()[..], [p] if p.source == ProblemSource::Run));
    assert!(matches!(bench.run(SessionCommand::StepForward), Outcome::Refused(_)));
    assert_eq!(bench.run(SessionCommand::StepBack), Outcome::Done);
    assert_eq!(bench.run(SessionCommand::Reset), Outcome::Done);
}

#[test]
fn numbers_are_read_as_people_write_them() {
    for (text, value) in [
        ("0.01", 0.01),
        ("0,01", 0.01),
        (" 1/60 ", 1.0 / 60.0),
        ("1e-3", 1e-3),
        ("-2", -2.0),
        ("2*(3 - 1)", 4.0),
    ] {
        assert_eq!(parse_number(text), Some(value), "{text}");
    }
    let degrees = [("30deg", 30.0), ("-90°", -90.0), ("pi/6", 30.0), ("-π", -180.0)];
    for (text, value) in degrees {
        assert!((parse_angle(text).unwrap().to_degrees() - value).abs() < 1e-12, "{text}");
    }
    assert_eq!(parse_number(&"-(".repeat(100_000)), None);
    for text in [
        "", "abc", "inf", "NaN", "1/0", "1.2.3", "1.234,5", "1e400", "1e", "2*", "(1", "30°", "0x10", "1 000",
    ] {
        assert_eq!(parse_number(text), None, "{text}");
    }
}

#[test]
fn a_step_that_makes_no_sense_is_refused_and_the_old_one_stays() {
    let mut bench = Bench::open();
    bench.act(Action::SetDt("1/50".into()));
    for text in ["0", "-1", "soon", "1e99"] {
        assert!(matches!(bench.act(Action::SetDt(text.into())), Outcome::Refused(_)), "{text}");
        assert_eq!((bench.session.playback().dt(), bench.session.playback().dt_text()), (0.02, "1/50"));
    }
}

#[test]
fn the_speed_stays_within_bounds() {
    let mut bench = Bench::open();
    for _ in 0..30 {
        bench.run(SessionCommand::Faster);
    }
    assert_eq!(bench.session.playback().speed(), 1024.0);
    for _ in 0..60 {
        bench.run(SessionCommand::Slower);
    }
    assert_eq!(bench.session.playback().speed(), 1.0 / 1024.0);
    bench.act(Action::SetSpeed(f64::NAN));
    assert_eq!(bench.session.playback().speed(), 1.0 / 1024.0);
}

#[test]
fn a_force_keeps_its_kind_when_a_number_of_it_changes() {
    let bench = Bench::open();
    let acceleration = FORCE_FIELDS.iter().find(|field| field.label == "Acceleration").unwrap();
    let Some(ForceChange::Kind(kind)) = acceleration.change(bench.force(1), 0, 2.0) else { panic!() };
    let expected = polyscene::scene::ForceKind::GravityPlane {
        position: DVec3::splat(5.0),
        acceleration: DVec3::new(2.0, -9.8, 0.0),
    };
    assert_eq!(kind, expected);
}
