//! Scenes of other programs: files in the shape of those programs' own examples, what is said about them, what cannot be,
//! and that what both can say comes back from a round trip.

use glam::DVec3;
use polyscene::export::{FORMATS, Verdict};
use polyscene::import::{Imported, import, source_of};
use polyscene::scene::{Body, Document, ForceKind, Motion, Scene, Shape, rotation_matrix};

/// In the shape of MuJoCo's tutorials: a plane, balls on free joints, defaults in classes, degrees.
const MJCF: &str = include_str!("../../scenes/foreign/balls.mjcf.xml");

/// In the shape of Gazebo's examples: a sun, a ground plane, a falling sphere, a box.
const SDF: &str = include_str!("../../scenes/foreign/ball.sdf");

fn imported(text: &str) -> Imported {
    import(&Document::from_bytes(text.as_bytes()), false)
}

fn scene_of(imported: &Imported) -> &Scene {
    let document = imported.document.as_ref().unwrap_or_else(|| panic!("{:?}", imported.problems));
    assert!(!document.has_errors(), "{:?}", document.diagnostics());
    document.scene().expect("a scene")
}

fn body<'a>(scene: &'a Scene, name: &str) -> &'a Body {
    scene.bodies.iter().find(|body| body.name.as_deref() == Some(name)).expect("a body of that name")
}

fn gravity(scene: &Scene) -> DVec3 {
    scene
        .forces
        .iter()
        .find_map(|force| match force.kind {
            ForceKind::GravityPlane { acceleration, .. } => Some(acceleration),
            _ => None,
        })
        .expect("gravity")
}

fn lines(imported: &Imported) -> String {
    imported.report.lines.iter().map(|line| format!("{line}\n")).collect()
}

#[test]
fn a_scene_of_mujoco_comes_with_its_places_masses_and_start() {
    let imported = imported(MJCF);
    let scene = scene_of(&imported);
    assert_eq!(gravity(scene), DVec3::new(0.0, -9.81, 0.0));
    // Moved as a whole into the map.
    let shift = body(scene, "two").position - DVec3::new(0.0, 6.0, 0.0);
    let one = body(scene, "one");
    assert!((one.position - shift - DVec3::new(-1.0, 3.0, -2.0)).length() < 1e-12, "{one:?}");
    assert_eq!(one.motion, Motion::Dynamic { mass: 2.0, velocity: DVec3::new(1.0, 3.0, -2.0) });
    assert_eq!((one.shape.clone(), one.color), (Shape::Sphere { radius: 0.2 }, Some([255, 0, 0])));
    let two = body(scene, "two");
    assert_eq!(two.spin, DVec3::new(4.0, 0.0, 0.0));
    // Without friction is one; the floor meets two with the larger of both.
    let frictions = ["one", "two", "floor"].map(|name| body(scene, name).roughness.friction);
    assert_eq!(frictions, [0.0, 1.0, 1.0]);
    let Motion::Dynamic { mass, .. } = two.motion else { panic!() };
    assert!((mass - 500.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.001).abs() < 1e-12);
    let post = body(scene, "post");
    assert_eq!(post.color, Some([0, 255, 0]));
    assert!((post.position - shift - DVec3::new(2.0, 1.0, 0.0)).length() < 1e-12 && !post.is_dynamic());
    // ζ = 40/(2·100) gives e = exp(−0.2/√0.96·(π − atan(0.4√0.96/0.92))), for each pair.
    let root = 0.96_f64.sqrt();
    let e = (-0.2 / root * (std::f64::consts::PI - (0.4 * root).atan2(0.92))).exp();
    assert!(
        (one.bounce * one.bounce - e).abs() < 1e-8
            && (one.bounce * body(scene, "floor").bounce - e).abs() < 1e-8
    );
    // The ramp is its six faces, of which the upper one leans by 30°.
    let top = body(scene, "ramp +z");
    let up = rotation_matrix(top.rotation).z_axis;
    assert!((up - DVec3::new(0.5, 0.75_f64.sqrt(), 0.0)).length() < 1e-12, "{up}");
    assert!((top.position - shift - (DVec3::Y + 0.25 * up)).length() < 1e-12);
    assert_eq!(top.shape, Shape::Plane { half_x: 1.0, half_y: 0.5 });
    assert_eq!(scene.bodies.iter().filter(|body| body.group.as_deref() == Some("ramp")).count(), 6);
    let said = lines(&imported);
    for line in [
        "kept: box that stands still",
        "approximated: plane without end",
        "dropped: geom that touches nothing",
        "14:54: approximated: friction of a geom",
        "approximated: the scene is moved",
        "not needed: <sensor>",
    ] {
        assert!(said.contains(line), "{line} in\n{said}");
    }
    assert!(imported.report.lines.is_sorted_by_key(|line| line.verdict), "losses last");
}

#[test]
fn a_world_of_gazebo_comes_with_its_surfaces() {
    let imported = imported(SDF);
    let scene = scene_of(&imported);
    assert_eq!(gravity(scene), DVec3::new(0.0, -9.8, 0.0));
    let ball = body(scene, "ball");
    let floor = body(scene, "ground_plane");
    // Turned by a quarter, the collision's offset points along y.
    assert!((ball.position - floor.position - DVec3::new(1.0, 3.0, -2.5)).length() < 1e-12, "{ball:?}");
    assert_eq!((ball.bounce, ball.color), (0.8, Some([255, 128, 0])));
    assert_eq!(ball.motion, Motion::Dynamic { mass: 5.0, velocity: DVec3::ZERO });
    assert_eq!((floor.bounce, floor.roughness.friction, ball.roughness.friction), (0.0, 1.0, 1.0));
    let side = body(scene, "crate +x");
    assert!((side.position - floor.position - DVec3::new(-2.5, 0.5, 0.0)).length() < 1e-12 && side.hidden);
    let said = lines(&imported);
    assert!(
        said.contains("not needed: <include>") && said.contains("approximated: 2 × friction of a surface"),
        "{said}"
    );
}

#[test]
fn what_cannot_be_is_an_error_with_its_line_or_left_out() {
    let ball = r#"<freejoint/><geom size=".2"/>"#;
    let cases = [
        (MJCF, ball_with(r#"<freejoint/><geom type="capsule" size=".2 .1"/>"#), "a geom of type capsule"),
        (MJCF, ball_with(r#"<freejoint/><geom type="box" size=".2 .1 .1"/>"#), "a moving box"),
        (MJCF, ball_with(r#"<joint type="hinge"/><geom size=".2"/>"#), "a joint that is not free"),
        (MJCF, ball_with(&format!("{ball}<geom size='.1'/>")), "a second geom of a moving body"),
        (
            MJCF,
            ball_with(&format!("{ball}<body><geom size='.1'/></body>")),
            "a body that is part of a moving body",
        ),
        (
            SDF,
            SDF.replace("<sphere><radius>0.25</radius></sphere></geometry>\n", "<cylinder/></geometry>\n"),
            "a moving cylinder",
        ),
        (SDF, SDF.replace("<gravity>0 0 -9.8</gravity>", "<actor/>"), "<actor>"),
        (SDF, SDF.replace("model://sun", "model://cessna"), "<include>"),
        (SDF, SDF.replace("<pose>1 2 3", "<pose relative_to='crate'>1 2 3"), "a pose relative to a frame"),
    ];
    for (original, text, what) in cases {
        assert_ne!(original, text, "{what}");
        let refused = imported(&text);
        assert!(refused.document.is_none(), "{what}");
        let [problem] = &refused.problems[..] else { panic!("{what}: {:?}", refused.problems) };
        assert!(problem.message == format!("{what} cannot be imported"), "{problem}");
        assert!(problem.position.is_some_and(|(line, _)| line > 1) && !problem.hint.is_empty(), "{problem}");
        let rest = import(&Document::from_bytes(text.as_bytes()), true);
        let dropped =
            |line: &&polyscene::import::ImportLine| line.verdict == Verdict::Dropped && line.what == what;
        assert!(
            rest.document.is_some() && rest.report.lines.iter().any(|line| dropped(&line)),
            "{what}: {rest:?}"
        );
    }
}

fn ball_with(inside: &str) -> String {
    let at = MJCF.find("<worldbody>").expect("a world") + "<worldbody>".len();
    let without_key = MJCF.find("<keyframe>").zip(MJCF.find("<sensor>")).expect("a keyframe");
    format!(
        "{}\n<body pos='0 1 9'>{inside}</body>{}{}",
        &MJCF[..at],
        &MJCF[at..without_key.0],
        &MJCF[without_key.1..]
    )
}

#[test]
fn wrong_numbers_are_errors_where_they_stand() {
    for (wrong, right, message) in [
        ("pos=\"-1 2\"", "pos=\"-1 2 3\"", "pos “-1 2” of <body> is not 3 numbers"),
        ("pos=\"-1 2 nan\"", "pos=\"-1 2 3\"", "pos “-1 2 nan” of <body> is not 3 numbers"),
        ("mass=\"-2\"", "mass=\"2\"", "mass -2 of <geom> is not greater than 0"),
        ("qvel=\"1", "qvel=\"1 1", "the keyframe has not 7 places and 6 speeds for each of 2 moving bodies"),
    ] {
        let refused = imported(
            &MJCF
                .replace(right, wrong)
                .replace("qvel=\"1 2", if wrong.starts_with("qvel") { "qvel=\"2" } else { "qvel=\"1 2" }),
        );
        let said: Vec<_> = refused.problems.iter().map(|problem| problem.message.as_str()).collect();
        assert_eq!(said, [message], "{wrong}");
        assert!(refused.problems[0].position.is_some() && refused.document.is_none());
    }
    for (text, message) in [
        ("<urdf/>", "the root element <urdf> is none that can be imported"),
        ("<mujoco>", "<mujoco> is never closed"),
        ("", "there is no root element"),
    ] {
        let refused = imported(text);
        assert!(refused.document.is_none() && !refused.problems.is_empty(), "{text}");
        assert!(
            message.contains("root") || refused.problems[0].message.contains(message),
            "{:?}",
            refused.problems
        );
    }
    assert!(source_of(&Document::from_bytes(b"<PolyPhysicsXml/>")).is_none());
}

/// A scene of which MJCF and SDF can say nearly all.
const BOTH: &str = r##"<PolyPhysicsXml Version="1.1">
  <Map><Size X="10" Y="5" Z="4" /><Tiles X="10" Y="5" Z="4" /></Map>
  <Simulation><TimeSpeed F32="0.5" /><Forces>
    <GravityPlane UserID="1"><Translation X="5" Y="4" Z="2" /><Gravity X="1" Y="-9" Z="2" /></GravityPlane>
    <SpaceAverse UserID="2"><Density F32="1.5" /></SpaceAverse>
  </Forces></Simulation>
  <Primitives>
    <SoftObject UserID="17"><?polyscene name="red ball" color="#ff0000"?>
      <Translation X="1.5" Y="2" Z="3" /><Rotation X="0.3" Y="-0.5" Z="1" /><Bounce F32="0.9" />
      <Friction F32="0.3" /><RollingFriction F32="0.02" /><Weight F32="2" /><InitialAngularVelocity X="5" Y="-6" Z="7" /><InitialVelocity X="1" Y="-2" Z="3" />
      <Sphere><Radius F32="0.25" /></Sphere></SoftObject>
    <SoftObject UserID="5"><Translation X="4" Y="2" Z="1" /><Bounce F32="0.8" /><Friction F32="0.6" /><RollingFriction F32="0.01" /><Sphere><Radius F32="0.5" /></Sphere></SoftObject>
    <HardObject UserID="9"><?polyscene hidden="1"?><Translation X="3" Y="1" Z="1" /><Bounce F32="0.4" /><Sphere><Radius F32="0.125" /></Sphere></HardObject>
    <HardObject UserID="8"><?polyscene name="floor"?><Translation X="5" Y="0" Z="2" /><Rotation X="-1.5707963267948966" Y="0" Z="0" />
      <Bounce F32="0.7" /><Friction F32="0.2" /><RollingFriction F32="0.05" /><Plane><HalfSideX F32="5" /><HalfSideY F32="2" /></Plane></HardObject>
    <HardObject UserID="7"><?polyscene name="lid"?><Translation X="5" Y="4.5" Z="2" /><Rotation X="1.2" Y="0.3" Z="-0.4" />
      <Bounce F32="1" /><Plane><HalfSideX F32="5" /><HalfSideY F32="2" /></Plane></HardObject>
  </Primitives>
</PolyPhysicsXml>
"##;

fn round_trip(id: &str) -> Scene {
    let document = Document::from_bytes(BOTH.as_bytes());
    let format = FORMATS.iter().find(|format| format.id == id).expect("a format");
    let bytes = format.export(&document).expect("an export").bytes;
    let back = import(&Document::from_bytes(&bytes), false);
    scene_of(&back).clone()
}

fn assert_same_bodies(back: &Scene, ids: bool) {
    let document = Document::from_bytes(BOTH.as_bytes());
    let before = document.scene().expect("a scene");
    assert_eq!(back.bodies.len(), before.bodies.len());
    for (a, b) in before.bodies.iter().zip(&back.bodies) {
        assert_eq!((&a.shape, a.hidden, a.color), (&b.shape, b.hidden, b.color), "{a:?}\n{b:?}");
        assert!((a.position - b.position).length() < 1e-12, "{a:?}\n{b:?}");
        assert!(rotation_matrix(a.rotation).abs_diff_eq(rotation_matrix(b.rotation), 1e-12), "{a:?}\n{b:?}");
        assert!((a.bounce - b.bounce).abs() < 1e-8, "{a:?}\n{b:?}");
        assert!((a.roughness.friction - b.roughness.friction).abs() < 1e-8, "{a:?}\n{b:?}");
        assert!((a.roughness.rolling - b.roughness.rolling).abs() < 1e-8, "{a:?}\n{b:?}");
        assert!((a.spin - b.spin).length() < 1e-12, "{a:?}\n{b:?}");
        assert_eq!(a.motion, b.motion);
        if ids {
            assert_eq!((a.id, &a.name), (b.id, &b.name));
        }
    }
    assert!((gravity(before) - gravity(back)).length() < 1e-12);
}

#[test]
fn a_round_trip_through_mjcf_keeps_what_both_can_say() {
    let back = round_trip("mjcf");
    assert_same_bodies(&back, true);
    assert_eq!(back.map.size, DVec3::new(10.0, 5.0, 4.0));
    let drag = back.forces.iter().find_map(|force| match force.kind {
        ForceKind::Drag { density } => Some(density),
        _ => None,
    });
    assert_eq!(drag, Some(1.5));
}

#[test]
fn a_round_trip_through_sdf_keeps_what_both_can_say() {
    let back = round_trip("sdf");
    assert_same_bodies(&back, false);
    assert_eq!(back.time_speed, 0.5);
    assert_eq!(body(&back, "red ball").position, DVec3::new(1.5, 2.0, 3.0));
}

/// Symptom: a ball whose geom is beside its body's origin came without that offset, if there was a keyframe. Expected:
/// the centre q·r from the origin, with the origin's velocity and ω × q·r. Cause: a keyframe's place and speed, which are
/// the body's, were taken for those of the geom.
#[test]
fn a_keyframe_places_the_body_and_its_geom_with_it() {
    let file = r#"<mujoco><worldbody>
      <body name="ball" pos="9 9 9"><freejoint/><geom pos="1 0 0" size=".2" condim="1"/></body></worldbody>
      <keyframe><key qpos="5 -5 5 1 0 0 1" qvel="0 1 0 1 0 2"/></keyframe></mujoco>"#;
    let imported = imported(file);
    let ball = body(scene_of(&imported), "ball");
    assert!((ball.position - DVec3::new(5.0, 5.0, 4.0)).length() < 1e-12, "{ball:?}");
    let Motion::Dynamic { velocity, .. } = ball.motion else { panic!("{ball:?}") };
    assert!((velocity - DVec3::new(-2.0, 0.0, -1.0)).length() < 1e-12, "{ball:?}");
    assert!((ball.spin - DVec3::new(0.0, 2.0, -1.0)).length() < 1e-12, "{ball:?}");
}

/// All samples come back from both formats, with as many bodies, in about the time of a reading.
#[test]
fn every_sample_comes_back() {
    for folder in ["scenes", "scenes/hard"] {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        for entry in std::fs::read_dir(folder).expect("scenes") {
            let path = entry.expect("an entry").path();
            if path.extension().is_none_or(|extension| extension != "xml") {
                continue;
            }
            let document = Document::open(&path);
            let before = document.scene().expect("a scene").bodies.len();
            for format in FORMATS.iter().filter(|format| matches!(format.id, "mjcf" | "sdf")) {
                let bytes = format.export(&document).expect("an export").bytes;
                let back = import(&Document::from_bytes(&bytes), false);
                assert_eq!(scene_of(&back).bodies.len(), before, "{} by {}", path.display(), format.id);
            }
        }
    }
}

/// Condim 6 has rolling friction, a lever in m: 7/5 of this program's coefficient times the radius.
#[test]
fn rolling_friction_of_mujoco_becomes_a_coefficient() {
    let text = |floor: &str, ball: &str| {
        format!(
            "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1' {floor}/>
             <body name='ball' pos='0 0 1'><freejoint/><geom size='.5' {ball}/></body></worldbody></mujoco>"
        )
    };
    let rolling = |text: &str, name: &str| body(scene_of(&imported(text)), name).roughness.rolling;
    let file = text("condim='6' friction='1 0 .028'", "condim='6' friction='1 0 .007'");
    assert!((rolling(&file, "ball") - 0.01).abs() < 1e-9);
    // The larger lever counts there, 0.04 as a coefficient: √(0.01 · 0.16) here.
    assert!((rolling(&file, "floor") - 0.16).abs() < 1e-9, "{}", rolling(&file, "floor"));
    let file = text("friction='1 0 .028'", "friction='1 .2 .007'");
    assert_eq!((rolling(&file, "ball"), rolling(&file, "floor")), (0.0, 0.0), "condim 3 has none");
    let said = lines(&imported(&text("", "condim='6' friction='1 .2 .007'")));
    for line in ["approximated: rolling friction of a geom", "dropped: torsional friction of a geom"] {
        assert!(said.contains(line), "{said}");
    }
}
