//! What the reader makes of a file.

use glam::DVec3;
use polyscene::scene::{Document, ForceKind, Motion, Shape, SimParams};

/// A scene of format 1.0 around the given simulation and bodies.
pub fn scene_with(simulation: &str, bodies: &str) -> String {
    format!(
        "<PolyPhysicsXml Version=\"1.0\">\n  <Map>\n    <Size X=\"10\" Y=\"10\" Z=\"10\" />\n    \
         <Tiles X=\"10\" Y=\"10\" Z=\"10\" />\n  </Map>\n  <Simulation>\n    <TimeSpeed F32=\"1\" />\n\
         {simulation}  </Simulation>\n  <Primitives>\n{bodies}  </Primitives>\n</PolyPhysicsXml>\n"
    )
}

pub const BALL: &str = r#"    <SoftObject UserID="5853">
      <Translation X="5" Y="3" Z="6" />
      <Rotation X="0" Y="0" Z="0" />
      <Bounce F32="0,5" />
      <Weight F32="2" />
      <InitialVelocity X="-3" Y="-2,25" Z="-4" />
      <Sphere>
        <Radius F32="1" />
      </Sphere>
    </SoftObject>
"#;

pub const WALL: &str = r#"    <HardObject UserID="32285">
      <Translation X="10" Y="5" Z="5" />
      <Rotation X="0" Y="-1,570796" Z="0" />
      <Bounce F32="1" />
      <Plane>
        <HalfSideX F32="5" />
        <HalfSideY F32="2,5" />
      </Plane>
    </HardObject>
"#;

pub const FORCES: &str = r#"    <Forces>
      <GravityPlane UserID="9318">
        <Translation X="6" Y="0" Z="3" />
        <Gravity X="0" Y="-9,8" Z="0" />
      </GravityPlane>
      <GravityPoint UserID="7045">
        <Translation X="5" Y="5" Z="5" />
        <Gravity F32="8" />
      </GravityPoint>
    </Forces>
"#;

pub fn read(text: &str) -> Document {
    Document::from_bytes(text.as_bytes())
}

/// The problems, one per line.
pub fn problems(document: &Document) -> String {
    document.diagnostics().iter().map(|diagnostic| format!("{diagnostic}\n")).collect()
}

#[test]
fn a_plain_scene_is_read_in_full() {
    let document = read(&scene_with(FORCES, &format!("{BALL}{WALL}")));
    assert_eq!(problems(&document), "");
    let scene = document.scene().unwrap();
    assert_eq!((scene.map.size, scene.map.tiles), (DVec3::splat(10.0), [10; 3]));
    assert_eq!((scene.time_speed, scene.params), (1.0, SimParams::default()));
    let kinds = scene.forces.iter().map(|force| force.kind).collect::<Vec<_>>();
    let position = DVec3::new(6.0, 0.0, 3.0);
    let plane = ForceKind::GravityPlane { position, acceleration: DVec3::new(0.0, -9.8, 0.0) };
    let point = ForceKind::GravityPoint { position: DVec3::splat(5.0), intensity: 8.0 };
    assert_eq!(kinds, [plane, point]);
    let [ball, wall] = scene.bodies.as_slice() else { panic!("two bodies") };
    assert_eq!((ball.id, ball.label.as_str(), ball.bounce), (5853, "5853", 0.5));
    assert_eq!(ball.motion, Motion::Dynamic { mass: 2.0, velocity: DVec3::new(-3.0, -2.25, -4.0) });
    assert_eq!(ball.shape, Shape::Sphere { radius: 1.0 });
    assert_eq!((wall.motion, wall.rotation), (Motion::Static, DVec3::new(0.0, -1.570796, 0.0)));
    assert_eq!(wall.shape, Shape::Plane { half_x: 5.0, half_y: 2.5 });
}

#[test]
fn what_is_absent_takes_its_default() {
    let ball =
        r#"<SoftObject><Translation X="1" Y="2" Z="3"/><Sphere><Radius F32="1"/></Sphere></SoftObject>"#;
    let map = r#"<Map><Size X="1" Y="2" Z="3"/><Tiles X="1" Y="2" Z="3"/></Map>"#;
    let document =
        read(&format!("<PolyPhysicsXml Version='1.0'>{map}<Primitives>{ball}</Primitives></PolyPhysicsXml>"));
    assert!(!document.has_errors(), "{}", problems(&document));
    let scene = document.scene().unwrap();
    assert_eq!((scene.time_speed, scene.forces.len()), (1.0, 0));
    let ball = &scene.bodies[0];
    assert_eq!((ball.id, ball.label.as_str()), (1, "1"));
    assert_eq!((ball.rotation, ball.bounce, &ball.name), (DVec3::ZERO, 1.0, &None));
    assert_eq!(ball.motion, Motion::Dynamic { mass: 1.0, velocity: DVec3::ZERO });
}

#[test]
fn a_repeated_id_gets_a_label_of_its_own_and_a_warning() {
    let document = read(&scene_with("", &format!("{BALL}{BALL}{BALL}")));
    let labels = document.scene().unwrap().bodies.iter().map(|body| body.label.clone());
    assert_eq!(labels.collect::<Vec<_>>(), ["5853", "5853#2", "5853#3"]);
    assert_eq!(document.diagnostics().len(), 2);
    assert!(!document.has_errors());
    assert!(problems(&document).contains("/PolyPhysicsXml/Primitives/SoftObject[5853#2]"));
}

#[test]
fn a_body_with_errors_stays_in_the_scene_to_be_repaired() {
    let bad = BALL.replace("Radius F32=\"1\"", "Radius F32=\"0\"").replace("\"0,5\"", "\"x\"");
    let document = read(&scene_with("", &format!("{bad}{WALL}")));
    assert!(document.has_errors());
    let scene = document.scene().unwrap();
    assert_eq!(scene.bodies.len(), 2);
    assert_eq!(scene.bodies[0].shape, Shape::Unbuilt { element: "Sphere".into() });
    assert_eq!(document.diagnostics().len(), 2);
    assert!(document.diagnostics().iter().all(|diagnostic| diagnostic.key == Some(scene.bodies[0].key)));
}

#[test]
fn names_and_colors_come_from_the_processing_instruction() {
    let pi = r##"<?polyscene name="Left &amp; right" color="#0aFF10" hidden="1" future="x"?>"##;
    let document = read(&scene_with("", &BALL.replace("<Rotation", &format!("{pi}<Rotation"))));
    assert_eq!(problems(&document), "");
    let ball = &document.scene().unwrap().bodies[0];
    assert_eq!(ball.display_name(), "Left & right");
    assert_eq!((ball.color, ball.hidden, ball.locked), (Some([10, 255, 16]), true, false));
    assert_eq!(document.reasons_for_1_1(), Vec::<String>::new());
}

#[test]
fn places_and_paths_lead_to_the_element() {
    let document = read(&scene_with(FORCES, &format!("{BALL}{WALL}")));
    let scene = document.scene().unwrap();
    let wall = "/PolyPhysicsXml/Primitives/HardObject[32285]".to_owned();
    assert_eq!(document.place_of(scene.bodies[1].key), (Some((30, 5)), wall));
    let point = "/PolyPhysicsXml/Simulation/Forces/GravityPoint[7045]".to_owned();
    assert_eq!(document.place_of(scene.forces[1].key), (Some((13, 7)), point));
}

#[test]
fn a_new_document_is_sound_in_either_number_style() {
    use polyscene::scene::NumberStyle;
    for (style, speed) in [(NumberStyle::Comma, "\"1,0\""), (NumberStyle::Point, "\"1.0\"")] {
        let document = Document::new(style);
        assert_eq!(problems(&document), "");
        let scene = document.scene().unwrap();
        assert_eq!((scene.map.size, scene.map.tiles), (DVec3::splat(10.0), [10; 3]));
        let bytes = document.to_bytes();
        assert!(String::from_utf8(bytes).unwrap().contains(speed));
    }
}
