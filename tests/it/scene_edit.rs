//! An edit changes exactly the bytes it must, and the old document stays what it was.

use glam::DVec3;
use polyscene::scene::{
    Body, BodyChange, Document, Edit, EditError, Force, ForceChange, ForceKind, Motion, NodeKey, NumberStyle,
    Scene, Shape, SimParams, Viewpoint,
};

use crate::scene_read::{BALL, FORCES, WALL, problems, read, scene_with};

pub fn text(document: &Document) -> String {
    String::from_utf8(document.to_bytes()).unwrap()
}

fn plain() -> String {
    scene_with(FORCES, &format!("{BALL}{WALL}"))
}

fn scene(document: &Document) -> &Scene {
    document.scene().unwrap()
}

fn apply(document: &Document, edit: &Edit) -> Document {
    let before = document.to_bytes();
    let edited = document.apply(edit).unwrap().document;
    assert_eq!(document.to_bytes(), before, "the old document has changed");
    let again = Document::from_bytes(&edited.to_bytes());
    assert!(same_meaning(&edited, &again), "{edited:?}\nread again: {again:?}");
    edited
}

/// Whether two documents mean the same, keys and places apart.
pub fn same_meaning(a: &Document, b: &Document) -> bool {
    let without_keys = |document: &Document| {
        document.scene().cloned().map(|mut scene| {
            scene.bodies.iter_mut().for_each(|body| body.key = NodeKey(0));
            scene.forces.iter_mut().for_each(|force| force.key = NodeKey(0));
            scene
        })
    };
    let messages = |document: &Document| {
        document.diagnostics().iter().map(|diagnostic| diagnostic.message.clone()).collect::<Vec<_>>()
    };
    let sorted = |document: &Document| {
        let mut messages = messages(document);
        messages.sort();
        messages
    };
    without_keys(a) == without_keys(b) && sorted(a) == sorted(b)
}

/// Applies an edit to a body of the plain scene and compares the whole text.
#[allow(clippy::needless_pass_by_value, reason = "the calls read like a table")]
fn check_body(index: usize, change: BodyChange, from: &str, to: &str) {
    let (before, document) = (plain(), read(&plain()));
    assert_eq!(before.matches(from).count(), 1, "{from} is not unique");
    let key = scene(&document).bodies[index].key;
    let edited = apply(&document, &Edit::Body { key, change: change.clone() });
    assert_eq!(text(&edited), before.replace(from, to), "{change:?}");
    assert_eq!(scene(&edited).bodies[index].key, key);
}

#[test]
fn a_number_that_changes_is_the_only_thing_that_changes() {
    let x = |x| BodyChange::Position(DVec3::new(x, 3.0, 6.0));
    check_body(0, x(5.25), "X=\"5\" Y=\"3\" Z=\"6\"", "X=\"5,25\" Y=\"3\" Z=\"6\"");
    check_body(0, x(1e-7), "X=\"5\" Y=\"3\" Z=\"6\"", "X=\"1e-7\" Y=\"3\" Z=\"6\"");
    check_body(0, BodyChange::Bounce(0.75), "\"0,5\"", "\"0,75\"");
    check_body(0, BodyChange::Mass(3.5), "<Weight F32=\"2\" />", "<Weight F32=\"3,5\" />");
    check_body(0, BodyChange::Velocity(DVec3::new(-3.0, 0.0, -4.0)), "\"-2,25\"", "\"0\"");
    check_body(0, BodyChange::Shape(Shape::Sphere { radius: 1.5 }), "Radius F32=\"1\"", "Radius F32=\"1,5\"");
    check_body(1, BodyChange::Rotation(DVec3::new(0.0, 1.0, 0.0)), "\"-1,570796\"", "\"1\"");
    check_body(1, BodyChange::Id(7), "\"32285\"", "\"7\"");
    check_body(
        1,
        BodyChange::Shape(Shape::Plane { half_x: 5.0, half_y: 4.0 }),
        "HalfSideY F32=\"2,5\"",
        "HalfSideY F32=\"4\"",
    );
}

#[test]
fn setting_what_is_there_changes_nothing() {
    let spelled = plain().replace("Y=\"-2,25\"", "Y=' -2.250E0 '").replace("F32=\"0,5\"", "F32=\"&#53;E-1\"");
    let document = read(&spelled);
    let ball = scene(&document).bodies[0].clone();
    let Motion::Dynamic { mass, velocity } = ball.motion else { panic!("a dynamic ball") };
    let changes = vec![
        BodyChange::Velocity(velocity),
        BodyChange::Mass(mass),
        BodyChange::Bounce(ball.bounce),
        BodyChange::Position(ball.position),
        BodyChange::Shape(ball.shape.clone()),
        BodyChange::Id(ball.id),
        BodyChange::Name(None),
        BodyChange::Hidden(false),
        BodyChange::Material(None),
    ];
    let edits = changes.into_iter().map(|change| Edit::Body { key: ball.key, change }).collect();
    assert_eq!(text(&apply(&document, &Edit::All(edits))), spelled);
    let rest = [
        Edit::TimeSpeed(1.0),
        Edit::Params(SimParams::default()),
        Edit::MapSize(DVec3::splat(10.0)),
        Edit::MapTiles([10; 3]),
        Edit::MakeIdsUnique,
        Edit::Delete { keys: vec![] },
    ];
    assert_eq!(text(&apply(&document, &Edit::All(rest.to_vec()))), spelled);
}

#[test]
fn a_number_keeps_its_spaces_and_its_own_decimal_sign() {
    let spelled = plain().replace("Y=\"-2,25\"", "Y=' -2.25 '");
    let document = read(&spelled);
    let key = scene(&document).bodies[0].key;
    let change = BodyChange::Velocity(DVec3::new(-3.0, -7.5, -4.0));
    let edited = apply(&document, &Edit::Body { key, change });
    assert_eq!(text(&edited), spelled.replace("' -2.25 '", "' -7.5 '"));
}

#[test]
fn an_absent_element_is_added_in_its_place_when_it_is_needed() {
    let without = plain().replace("      <Weight F32=\"2\" />\n", "");
    let document = read(&without);
    let key = scene(&document).bodies[0].key;
    assert_eq!(text(&apply(&document, &Edit::Body { key, change: BodyChange::Mass(1.0) })), without);
    assert_eq!(text(&apply(&document, &Edit::Body { key, change: BodyChange::Mass(2.0) })), plain());
}

#[test]
fn the_map_and_the_settings_are_edited_in_place() {
    let document = read(&plain());
    let size = apply(&document, &Edit::MapSize(DVec3::new(10.0, 20.5, 10.0)));
    let expected = plain().replacen("Y=\"10\"", "Y=\"20,5\"", 1);
    assert_eq!(text(&size), expected);
    let tiles = apply(&document, &Edit::MapTiles([10, 10, 65536]));
    assert_eq!(text(&tiles), plain().replace("10\" Z=\"10\" />\n  </Map>", "10\" Z=\"65536\" />\n  </Map>"));
    let speed = apply(&document, &Edit::TimeSpeed(0.1));
    assert_eq!(text(&speed), plain().replace("TimeSpeed F32=\"1\"", "TimeSpeed F32=\"0,1\""));
}

#[test]
fn solver_settings_come_and_go_and_move_the_version_along() {
    let document = read(&plain());
    let changed = SimParams { rest_height: 0.001, ..SimParams::default() };
    let edited = apply(&document, &Edit::Params(changed));
    let solver = "    </Forces>\n    <Solver RestHeight=\"0,001\" />\n";
    assert_eq!(text(&edited), plain().replace("    </Forces>\n", solver).replace("\"1.0\"", "\"1.1\""));
    assert_eq!(scene(&edited).params, changed);
    assert_eq!(edited.reasons_for_1_1(), ["Solver"]);
    assert_eq!(problems(&edited), "");
    assert_eq!(text(&apply(&edited, &Edit::Params(SimParams::default()))), plain());
}

#[test]
fn cosmetics_live_in_one_instruction_and_leave_no_trace() {
    let mut document = read(&plain());
    let key = scene(&document).bodies[0].key;
    let open = "<SoftObject UserID=\"5853\">\n";
    let steps = [
        (BodyChange::Name(Some("A \"b\" & <c>?>".into())), "name=\"A &quot;b&quot; &amp; &lt;c&gt;?&gt;\""),
        (BodyChange::Color(Some([255, 0, 16])), "color=\"#ff0010\""),
        (BodyChange::Hidden(true), "hidden=\"1\""),
        (BodyChange::Locked(true), "locked=\"1\""),
    ];
    let mut attributes = String::new();
    for (change, attribute) in steps {
        document = apply(&document, &Edit::Body { key, change });
        attributes += &format!(" {attribute}");
        let expected = format!("{open}      <?polyscene{attributes}?>\n");
        assert_eq!(text(&document), plain().replace(open, &expected));
    }
    let ball = &scene(&document).bodies[0];
    assert_eq!(ball.display_name(), "A \"b\" & <c>?>");
    assert_eq!((ball.color, ball.hidden, ball.locked), (Some([255, 0, 16]), true, true));
    assert_eq!(document.reasons_for_1_1(), Vec::<String>::new());
    for change in [
        BodyChange::Color(None),
        BodyChange::Name(None),
        BodyChange::Locked(false),
        BodyChange::Hidden(false),
    ] {
        document = apply(&document, &Edit::Body { key, change });
    }
    assert_eq!(text(&document), plain());
}

#[test]
fn material_is_new_physics_and_its_last_use_takes_the_version_back() {
    let document = read(&plain());
    let key = scene(&document).bodies[1].key;
    let set = |material: Option<&str>| Edit::Body {
        key,
        change: BodyChange::Material(material.map(str::to_owned)),
    };
    let iron = apply(&document, &set(Some("iron & \"steel\"")));
    let wall = WALL.replace(
        "<Bounce F32=\"1\" />\n",
        "<Bounce F32=\"1\" />\n      <Material Text=\"iron &amp; &quot;steel&quot;\" />\n",
    );
    assert_eq!(text(&iron), scene_with(FORCES, &format!("{BALL}{wall}")).replace("\"1.0\"", "\"1.1\""));
    assert_eq!(scene(&iron).bodies[1].material.as_deref(), Some("iron & \"steel\""));
    assert_eq!(text(&apply(&iron, &set(None))), plain());
}

#[test]
fn another_shape_takes_the_place_of_the_old_one() {
    let document = read(&plain());
    let key = scene(&document).bodies[1].key;
    let edited =
        apply(&document, &Edit::Body { key, change: BodyChange::Shape(Shape::Sphere { radius: 0.5 }) });
    let start = WALL.find("<Plane>").unwrap();
    let end = WALL.find("</Plane>").unwrap() + "</Plane>".len();
    let sphere = "<Sphere>\n        <Radius F32=\"0,5\" />\n      </Sphere>";
    let wall = [&WALL[..start], sphere, &WALL[end..]].concat();
    assert_eq!(text(&edited), scene_with(FORCES, &format!("{BALL}{wall}")));
}

fn new_ball(id: i64) -> Body {
    Body {
        key: NodeKey::default(),
        id,
        label: String::new().into(),
        name: Some("New".into()),
        color: None,
        group: None,
        hidden: false,
        locked: false,
        position: DVec3::new(1.0, 2.5, 3.0),
        rotation: DVec3::ZERO,
        bounce: 1.0,
        roughness: polyscene::scene::Roughness::default(),
        spin: DVec3::ZERO,
        material: None,
        motion: Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO },
        shape: Shape::Sphere { radius: 0.5 },
    }
}

const NEW_BALL: &str = r#"    <SoftObject UserID="32286">
      <?polyscene name="New"?>
      <Translation X="1" Y="2,5" Z="3" />
      <Rotation X="0" Y="0" Z="0" />
      <Bounce F32="1" />
      <Weight F32="1" />
      <InitialVelocity X="0" Y="0" Z="0" />
      <Sphere>
        <Radius F32="0,5" />
      </Sphere>
    </SoftObject>
"#;

#[test]
fn a_new_body_comes_last_and_looks_like_its_siblings() {
    let document = read(&plain());
    let edited = document.apply(&Edit::AddBody(Box::new(new_ball(5853)))).unwrap();
    let expected = scene_with(FORCES, &format!("{BALL}{WALL}{NEW_BALL}"));
    assert_eq!(text(&edited.document), expected);
    let added = scene(&edited.document).bodies.last().unwrap();
    assert_eq!(edited.added, [added.key]);
    assert_eq!((added.id, added.label.as_str()), (32286, "32286"));
    assert_eq!(edited.document.place_of(added.key).0, None);
    let deleted = apply(&edited.document, &Edit::Delete { keys: edited.added });
    assert_eq!(text(&deleted), plain());
}

#[test]
fn a_new_body_copies_quotes_line_ends_tabs_and_the_decimal_sign() {
    let restyled = |text: String| {
        text.replace('"', "'")
            .replace(" />", "/>")
            .replace("  ", "\t")
            .replace('\n', "\r\n")
            .replace(',', ".")
    };
    let document = read(&restyled(plain()));
    let edited = apply(&document, &Edit::AddBody(Box::new(new_ball(32286))));
    assert_eq!(text(&edited), restyled(scene_with(FORCES, &format!("{BALL}{WALL}{NEW_BALL}"))));
}

#[test]
fn a_scene_on_one_line_stays_on_one_line() {
    let flat = |text: String| text.lines().map(str::trim_start).collect::<String>();
    let document = read(&flat(plain()));
    let edited = apply(&document, &Edit::AddBody(Box::new(new_ball(32286))));
    assert_eq!(text(&edited), flat(scene_with(FORCES, &format!("{BALL}{WALL}{NEW_BALL}"))));
}

#[test]
fn empty_and_missing_sections_are_opened() {
    let empty = scene_with("", "").replace("<Primitives>\n  </Primitives>", "<Primitives />");
    let edited = apply(&read(&empty), &Edit::AddBody(Box::new(new_ball(32286))));
    assert_eq!(text(&edited), scene_with("", NEW_BALL));
    let start = empty.find("  <Simulation>").unwrap();
    let bare = [&empty[..start], "</PolyPhysicsXml>\n"].concat();
    let edited = apply(&read(&bare), &Edit::AddBody(Box::new(new_ball(32286))));
    let end = format!("  <Primitives>\n{NEW_BALL}  </Primitives>\n</PolyPhysicsXml>\n");
    assert_eq!(text(&edited), [&empty[..start], &end].concat());
    let drag = Force {
        key: NodeKey::default(),
        id: 1,
        label: String::new().into(),
        name: None,
        group: None,
        hidden: false,
        locked: false,
        kind: ForceKind::Drag { density: 1.276 },
    };
    let edited = apply(&read(&bare), &Edit::AddForce(Box::new(drag)));
    let end = "  <Simulation>\n    <Forces>\n      <SpaceAverse UserID=\"1\">\n        <Density F32=\"1,276\" />\n      \
               </SpaceAverse>\n    </Forces>\n  </Simulation>\n</PolyPhysicsXml>\n";
    assert_eq!(text(&edited), [&empty[..start], end].concat().replace("\"1.0\"", "\"1.1\""));
    assert_eq!(problems(&edited), "");
}

#[test]
fn forces_are_edited_added_and_deleted() {
    let document = read(&plain());
    let key = scene(&document).forces[0].key;
    let position = DVec3::new(6.0, 0.0, 3.0);
    let kind = ForceKind::GravityPlane { position, acceleration: DVec3::new(0.0, -1.6, 0.0) };
    let edited = apply(&document, &Edit::Force { key, change: ForceChange::Kind(kind) });
    assert_eq!(text(&edited), plain().replace("-9,8", "-1,6"));
    let drag = ForceChange::Kind(ForceKind::Drag { density: 1.0 });
    assert!(matches!(document.apply(&Edit::Force { key, change: drag }), Err(EditError::Invalid(_))));
    let named = apply(&document, &Edit::Force { key, change: ForceChange::Name(Some("Down".into())) });
    assert_eq!(scene(&named).forces[0].name.as_deref(), Some("Down"));
    let new = Force {
        kind: ForceKind::GravityPoint { position, intensity: -0.5 },
        ..scene(&document).forces[0].clone()
    };
    let edited = document.apply(&Edit::AddForce(Box::new(new))).unwrap();
    assert_eq!(scene(&edited.document).forces[2].id, 9319);
    assert_eq!(text(&apply(&edited.document, &Edit::Delete { keys: edited.added })), plain());
}

#[test]
fn deleting_leaves_nothing_odd_and_spares_other_comments() {
    let commented =
        BALL.replace("    <SoftObject", "    <!-- the ball -->\n    <SoftObject").trim_end().to_owned()
            + " <!-- it goes too -->\n";
    let document = read(&scene_with(FORCES, &format!("{commented}{WALL}")));
    let keys = vec![scene(&document).bodies[0].key];
    let edited = apply(&document, &Edit::Delete { keys: keys.clone() });
    assert_eq!(text(&edited), scene_with(FORCES, &format!("    <!-- the ball -->\n{WALL}")));
    assert_eq!(edited.apply(&Edit::Delete { keys }).unwrap_err(), EditError::Gone);
    let all = scene(&document).bodies.iter().map(|body| body.key).collect();
    let edited = apply(&read(&plain()), &Edit::Delete { keys: all_keys(&read(&plain())) });
    assert_eq!(text(&edited), scene_with("    <Forces>\n    </Forces>\n", ""));
    apply(&document, &Edit::Delete { keys: all });
}

fn all_keys(document: &Document) -> Vec<NodeKey> {
    let scene = scene(document);
    scene.bodies.iter().map(|body| body.key).chain(scene.forces.iter().map(|force| force.key)).collect()
}

#[test]
fn a_duplicate_keeps_comments_and_unknown_parts_and_has_an_id_of_its_own() {
    let odd = BALL.replace("<Bounce", "<!-- odd --><Unknown a='1'>text</Unknown>\n      <Bounce");
    let document = read(&scene_with(FORCES, &format!("{odd}{WALL}")));
    let keys = scene(&document).bodies.iter().map(|body| body.key).collect::<Vec<_>>();
    let edit = Edit::Duplicate { keys: keys.clone(), offset: DVec3::new(0.5, 0.0, 0.0) };
    let edited = document.apply(&edit).unwrap();
    let ball = odd.replace("5853", "32286").replace("X=\"5\" Y=\"3\"", "X=\"5,5\" Y=\"3\"");
    let wall = WALL.replace("32285", "32287").replace("X=\"10\"", "X=\"10,5\"");
    assert_eq!(text(&edited.document), scene_with(FORCES, &format!("{odd}{WALL}{ball}{wall}")));
    let bodies = &scene(&edited.document).bodies;
    assert_eq!([bodies[0].key, bodies[1].key], keys[..]);
    assert_eq!(edited.added, [bodies[2].key, bodies[3].key]);
    assert_eq!(text(&apply(&edited.document, &Edit::Delete { keys: edited.added })), text(&document));
}

#[test]
fn repeated_ids_are_made_unique() {
    let document = read(&scene_with("", &format!("{BALL}{WALL}{BALL}{BALL}")));
    let edited = apply(&document, &Edit::MakeIdsUnique);
    let ids = scene(&edited).bodies.iter().map(|body| body.id).collect::<Vec<_>>();
    assert_eq!(ids, [5853, 32285, 32286, 32287]);
    assert_eq!(problems(&edited), "");
}

#[test]
fn keys_are_never_given_twice_also_after_undo() {
    let document = read(&plain());
    let add = Edit::AddBody(Box::new(new_ball(1)));
    let first = document.apply(&add).unwrap();
    let second = document.apply(&add).unwrap();
    assert_ne!(first.added, second.added);
    let gone = Edit::Body { key: first.added[0], change: BodyChange::Mass(2.0) };
    assert_eq!(second.document.apply(&gone).unwrap_err(), EditError::Gone);
    let again = read(&plain());
    assert_eq!(all_keys(&document), all_keys(&again));
}

#[test]
fn refused_edits_say_why() {
    let document = read(&plain());
    let (ball, wall) = (scene(&document).bodies[0].key, scene(&document).bodies[1].key);
    let body = |key, change| Edit::Body { key, change };
    let nan = DVec3::new(0.0, f64::NAN, 0.0);
    let dynamic_plane = BodyChange::Shape(Shape::Plane { half_x: 1.0, half_y: 1.0 });
    let cases = [
        (body(ball, BodyChange::Position(nan)), "the position y must be a finite number; NaN was given"),
        (body(ball, BodyChange::Mass(0.0)), "the mass must be greater than 0; 0 was given"),
        (body(ball, BodyChange::Bounce(-0.5)), "the bounce must not be negative; -0.5 was given"),
        (body(wall, BodyChange::Mass(1.0)), "a static body has no mass and no velocity"),
        (body(ball, dynamic_plane), "a plane cannot be a dynamic body; make it a sphere, or the body static"),
        (body(ball, BodyChange::Name(Some("\u{1}".into()))), "the character U+0001 cannot be stored"),
        (Edit::MapTiles([0, 1, 1]), "the number of tiles on an axis must be a whole number from 1 to 65536"),
        (Edit::MapSize(DVec3::ZERO), "the map's size x must be greater than 0; 0 was given"),
        (
            Edit::Params(SimParams { rest_height: 2.0, ..SimParams::default() }),
            "Rest height must lie between 0.0 and 0.1; 2 was given",
        ),
        (
            Edit::AddBody(Box::new(Body { bounce: f64::INFINITY, ..new_ball(1) })),
            "the bounce must be a finite number; inf was given",
        ),
    ];
    for (edit, message) in cases {
        let refused = document.apply(&edit).unwrap_err();
        assert_eq!(refused, EditError::Invalid(message.into()), "{edit:?}");
    }
    assert_eq!(document.apply(&body(NodeKey(u64::MAX), BodyChange::Mass(1.0))).unwrap_err(), EditError::Gone);
    assert!(matches!(read("<a").apply(&Edit::TimeSpeed(1.0)), Err(EditError::Invalid(_))));
}

#[test]
fn a_bad_body_is_repaired_by_edits() {
    let bad = BALL.replace("Radius F32=\"1\"", "Radius F32=\"0\"").replace("X=\"5\" Y", "X=\"five\" Y");
    let document = read(&scene_with("", &format!("{bad}{WALL}")));
    assert!(document.has_errors());
    let key = scene(&document).bodies[0].key;
    let position = BodyChange::Position(DVec3::new(5.0, 3.0, 6.0));
    let shape = BodyChange::Shape(Shape::Sphere { radius: 1.0 });
    let edits = [position, shape].map(|change| Edit::Body { key, change }).to_vec();
    let repaired = apply(&document, &Edit::All(edits));
    assert_eq!(text(&repaired), scene_with("", &format!("{BALL}{WALL}")));
    assert_eq!(problems(&repaired), "");
}

#[test]
fn a_new_document_grows_neatly() {
    let document = Document::new(NumberStyle::Point);
    let edited = apply(&document, &Edit::AddBody(Box::new(new_ball(32286))));
    let expected =
        text(&document).replace("<Primitives>\n", &format!("<Primitives>\n{}", NEW_BALL.replace(',', ".")));
    assert_eq!(text(&edited), expected);
}

#[test]
fn viewpoints_are_kept_in_an_instruction_that_others_skip() {
    let viewpoint = |name: &str, perspective| Viewpoint {
        name: name.to_owned(),
        perspective,
        target: DVec3::new(1.5, -2.0, 0.1),
        yaw: 0.6,
        pitch: -0.25,
        height: 3.0,
    };
    let document = read(&plain());
    let (near, far) = (viewpoint("Kick-off <1>", true), viewpoint("top", false));
    let edited = document.apply(&Edit::Viewpoints(vec![near.clone(), far.clone()])).unwrap();
    assert!(edited.touched.cosmetics && edited.touched.keys.is_empty() && !edited.touched.settings);
    let again = Document::from_bytes(&edited.document.to_bytes());
    assert_eq!(again.viewpoints(), [near, far]);
    assert_eq!(problems(&again), problems(&document));
    assert_eq!(again.scene().unwrap().bodies.len(), scene(&document).bodies.len());
    let none = again.apply(&Edit::Viewpoints(Vec::new())).unwrap().document;
    assert_eq!(text(&none), text(&document), "the instruction goes with the last of them");
    assert_eq!(read(&plain()).viewpoints(), []);
}

#[test]
fn an_edit_says_what_it_touched() {
    let document = read(&plain());
    let keys: Vec<NodeKey> = scene(&document).bodies.iter().map(|body| body.key).collect();
    let touched = |edit: &Edit| document.apply(edit).unwrap().touched;
    let moved = |key| Edit::Body { key, change: BodyChange::Position(DVec3::splat(0.25)) };
    assert_eq!(touched(&moved(keys[0])).keys.into_iter().collect::<Vec<_>>(), [keys[0]]);
    let both = touched(&Edit::All(vec![moved(keys[0]), Edit::Delete { keys: vec![keys[1]] }]));
    assert_eq!(both.keys.into_iter().collect::<Vec<_>>(), keys);
    assert!(touched(&Edit::TimeSpeed(3.0)).settings);
    let added = document.apply(&Edit::Duplicate { keys: keys.clone(), offset: DVec3::ONE }).unwrap();
    assert_eq!(added.touched.keys.into_iter().collect::<Vec<_>>(), added.added);
    let same = Edit::Body { key: keys[0], change: BodyChange::Position(scene(&document).bodies[0].position) };
    assert!(touched(&same).is_empty());
}
