//! Scenes for other programs: every sample in every format, what the reports say, names, axes, and old files.
//! `scripts/consumers.sh` loads the same files into the programs they are for.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

use glam::{DQuat, DVec3};
use polyscene::export::{Aspect, ExportError, FORMATS, Format, Frames, Report, Verdict, When};
use polyscene::scene::{Document, NumberStyle, Viewpoint, rotation_matrix};
use quick_xml::Reader;
use quick_xml::events::Event;
use serde_json::Value;

/// A scene that says everything there is to say.
const ALL: &str = r##"<PolyPhysicsXml Version="1.1">
  <?polyscene views="Eye|perspective|1 2 3|0.5 0.2|4;Plan|parallel|1 2 3|0 1.5707963267948966|4"?>
  <Map><Size X="4" Y="5" Z="6" /><Tiles X="4" Y="5" Z="6" /></Map>
  <Simulation>
    <TimeSpeed F32="0.5" />
    <Forces>
      <GravityPlane UserID="1"><?polyscene name="down"?><Translation X="1" Y="4" Z="1" /><Gravity X="1" Y="-9" Z="2" /></GravityPlane>
      <GravityPlane UserID="2"><Translation X="1" Y="4" Z="1" /><Gravity X="0" Y="-1" Z="0" /></GravityPlane>
      <GravityPoint UserID="3"><?polyscene name="sun"?><Translation X="2" Y="4" Z="2" /><Gravity F32="3" /></GravityPoint>
      <SpaceAverse UserID="4"><Density F32="1.5" /></SpaceAverse>
    </Forces>
    <Solver FieldTolerance="1E-10" />
  </Simulation>
  <Primitives>
    <!-- a comment -->
    <Cone UserID="9" />
    <SoftObject UserID="1">
      <?polyscene name="a &quot;b&quot; &lt;c&gt; \ ::__d, e" group="g/h" color="#ff8000" locked="true"?>
      <Translation X="1" Y="2" Z="3" /><Bounce F32="0.5" /><Material Text="iron" /><Weight F32="2" />
      <InitialVelocity X="1" Y="2" Z="3" /><Sphere><Radius F32="0.25" /></Sphere>
    </SoftObject>
    <SoftObject UserID="2">
      <?polyscene name="world" hidden="true"?>
      <Translation X="3" Y="2" Z="3" /><Bounce F32="0.25" /><Sphere><Radius F32="0.5" /></Sphere>
    </SoftObject>
    <HardObject UserID="3">
      <?polyscene name="world"?>
      <Translation X="2" Y="0" Z="3" /><Rotation X="-1.5707963267948966" Y="0" Z="0" />
      <Plane><HalfSideX F32="2" /><HalfSideY F32="3" /></Plane>
    </HardObject>
  </Primitives>
</PolyPhysicsXml>
"##;

fn format(id: &str) -> &'static Format {
    FORMATS.iter().find(|format| format.id == id).expect("a format")
}

fn text(id: &str, document: &Document) -> String {
    String::from_utf8(format(id).export(document).expect("an export").bytes).expect("UTF-8")
}

fn all() -> Document {
    let document = Document::from_bytes(ALL.as_bytes());
    assert!(!document.has_errors(), "{:?}", document.diagnostics());
    assert_eq!(document.viewpoints().len(), 2);
    document
}

fn all_scene_files() -> Vec<PathBuf> {
    let folders = ["scenes", "scenes/hard"].map(|folder| Path::new(env!("CARGO_MANIFEST_DIR")).join(folder));
    let entries = folders.iter().flat_map(|folder| std::fs::read_dir(folder).expect("a folder of scenes"));
    let files = entries.map(|entry| entry.expect("an entry").path());
    files.filter(|path| path.extension().is_some_and(|extension| extension == "xml")).collect()
}

/// Scenes with what no sample has: everything and nothing.
fn unusual() -> Vec<(String, Document)> {
    let empty = Document::new(NumberStyle::Comma);
    vec![("everything".into(), all()), ("nothing".into(), empty)]
}

#[test]
fn every_sample_is_well_formed_in_every_format_and_quick() {
    let samples =
        all_scene_files().into_iter().map(|path| (path.display().to_string(), Document::open(&path)));
    for (name, document) in samples.chain(unusual()) {
        let bodies = document.scene().expect("a sample without errors").bodies.len();
        for format in FORMATS {
            let (exported, took) = timed(|| format.export(&document));
            let exported = exported.unwrap_or_else(|error| panic!("{name}: {error}"));
            assert!(took < 1.0, "{name} as {}: {took} s", format.id);
            assert_eq!(format.is_binary, format.id == "gltf");
            well_formed(format, &exported.bytes, bodies).unwrap_or_else(|why| panic!("{name}: {why}"));
        }
    }
}

/// What work gives, and its seconds of processor time, where the system tells them: other work of the machine is not meant.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let on_processor = || {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        Some(text.split(' ').next()?.parse::<f64>().ok()? / 1e9)
    };
    let (start, before) = (Instant::now(), on_processor());
    let result = work();
    let took = before.and_then(|before| Some(on_processor()? - before));
    (result, took.unwrap_or_else(|| start.elapsed().as_secs_f64()))
}

fn well_formed(format: &Format, bytes: &[u8], bodies: usize) -> Result<(), String> {
    if format.id == "gltf" {
        let nodes = gltf(bytes)["nodes"].as_array().map_or(0, Vec::len);
        return if nodes >= bodies { Ok(()) } else { Err(format!("{nodes} nodes of {bodies}")) };
    }
    if format.id == "polyphysics-1.0" {
        let document = Document::from_bytes(bytes);
        let read = document.scene().map_or(0, |scene| scene.bodies.len());
        let fine = !document.has_errors() && document.reasons_for_1_1().is_empty() && read == bodies;
        return if fine { Ok(()) } else { Err(format!("{:?}", document.diagnostics())) };
    }
    let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
    match format.id {
        "csv" if text.lines().count() == bodies + 1 && text.ends_with('\n') => Ok(()),
        "usd" if text.starts_with("#usda 1.0\n") && balanced(text) => Ok(()),
        "mjcf" => elements(text, "body").and_then(|found| same(found, bodies)),
        "sdf" => elements(text, "link").and_then(|found| same(found, bodies)),
        other => Err(format!("bad {other}")),
    }
}

fn same(found: usize, expected: usize) -> Result<(), String> {
    if found >= expected { Ok(()) } else { Err(format!("{found} instead of {expected}")) }
}

/// How many elements of a name there are in well-formed XML.
fn elements(text: &str, name: &str) -> Result<usize, String> {
    let mut reader = Reader::from_str(text);
    let mut found = 0;
    loop {
        match reader.read_event().map_err(|error| error.to_string())? {
            Event::Start(tag) | Event::Empty(tag) => {
                found += usize::from(tag.name().as_ref() == name);
                for attribute in tag.attributes() {
                    attribute.map_err(|error| error.to_string())?;
                }
            }
            Event::Eof => return Ok(found),
            _ => {}
        }
    }
}

/// Braces and brackets outside of strings.
fn balanced(text: &str) -> bool {
    let (mut open, mut in_string, mut escaped) = (Vec::new(), false, false);
    for c in text.chars() {
        match c {
            _ if escaped => escaped = false,
            '\\' if in_string => escaped = true,
            '"' => in_string = !in_string,
            _ if in_string => {}
            '{' | '[' | '(' => open.push(c),
            '}' | ']' | ')' => match open.pop() {
                Some(before) if "{}[]()".contains(&format!("{before}{c}")) => {}
                _ => return false,
            },
            _ => {}
        }
    }
    open.is_empty() && !in_string
}

/// The JSON of a binary glTF whose lengths agree.
fn gltf(bytes: &[u8]) -> Value {
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
    assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
    let json: Value = serde_json::from_slice(&bytes[20..20 + number(12)]).expect("JSON");
    let binary = &bytes[20 + number(12)..];
    let length = json["buffers"][0]["byteLength"].as_u64().unwrap_or(0) as usize;
    assert_eq!(length, binary.len().saturating_sub(8));
    for view in json["bufferViews"].as_array().into_iter().flatten() {
        let end =
            view["byteOffset"].as_u64().expect("a place") + view["byteLength"].as_u64().expect("a length");
        assert!(end as usize <= length);
    }
    json
}

/// Each format has a line for each thing that this scene says.
#[test]
fn nothing_is_lost_silently() {
    let document = all();
    for format in FORMATS {
        let Report { lines } = format.export(&document).expect("an export").report;
        let aspects: Vec<_> = lines.iter().map(|line| format!("{:?}", line.aspect)).collect();
        let different: BTreeSet<_> = aspects.iter().cloned().collect();
        assert_eq!(different.len(), 24, "{}: {aspects:?}", format.id);
        assert!(lines.is_sorted_by_key(|line| line.verdict), "{}: losses last", format.id);
        for line in &lines {
            assert!(line.verdict == Verdict::Kept || !line.how.is_empty(), "{line}: no reason");
        }
    }
    let report = format("mjcf").export(&document).expect("an export").report;
    let line = |aspect| report.lines.iter().find(|line| line.aspect == aspect).expect("a line").to_string();
    assert!(line(Aspect::PointGravity).starts_with("dropped: 1 point gravity (sun): "), "{report:?}");
    assert!(line(Aspect::Drag).starts_with("kept: 1 air drag (4): "), "{report:?}");
    assert!(line(Aspect::Bounce).starts_with("approximated: 3 restitutions"), "{report:?}");
}

#[test]
fn a_scene_with_errors_is_not_exported() {
    let broken =
        Document::from_bytes(ALL.replace("F32=\"0.25\" /></Sphere>", "F32=\"-1\" /></Sphere>").as_bytes());
    for format in FORMATS {
        assert!(matches!(format.export(&broken), Err(ExportError::NoScene)), "{}", format.id);
    }
}

/// The map's y is their z, and gravity, velocities and places turn with it.
#[test]
fn robotics_has_z_up() {
    let document = all();
    let mjcf = text("mjcf", &document);
    assert!(mjcf.contains(r#"gravity="1 -2 -10""#) && mjcf.contains(r#"density="1.5""#), "{mjcf}");
    assert!(mjcf.contains(r#"pos="1 -3 2""#) && mjcf.contains(r#"qvel="1 -3 2 0 0 0 "#), "{mjcf}");
    let sdf = text("sdf", &document);
    assert!(sdf.contains("<gravity>1 -2 -10</gravity>"), "{sdf}");
    assert!(sdf.contains("<velocity>1 -3 2 0 0 0</velocity>"), "{sdf}");
    // The floor lies flat: its own normal is up.
    assert!(sdf.contains("<pose>2 -3 0 0 0 0</pose>") || sdf.contains("<pose>2 -3 0 6"), "{sdf}");
    let usd = text("usd", &document);
    assert!(usd.contains("upAxis = \"Y\"") && usd.contains("xformOp:translate = (1, 2, 3)"), "{usd}");
}

#[test]
fn names_are_unique_and_escaped() {
    let document = all();
    let mjcf = text("mjcf", &document);
    assert!(mjcf.contains(r#"name="a &quot;b&quot; &lt;c&gt; \ ::__d, e""#), "{mjcf}");
    assert!(mjcf.contains(r#"<body name="world 2""#) && mjcf.contains(r#"<body name="world 3""#), "{mjcf}");
    let usd = text("usd", &document);
    assert!(usd.contains(r#"displayName = "a \"b\" <c> \\ ::__d, e""#), "{usd}");
    assert!(usd.contains(r#"def Sphere "world""#) && usd.contains(r#"def Mesh "world_2""#), "{usd}");
    let csv = text("csv", &document);
    assert!(csv.contains(r#"1,1,"a ""b"" <c> \ ::__d, e",g/h,dynamic,sphere,1,2,3,"#), "{csv}");
    let sdf = text("sdf", &document);
    assert!(
        sdf.contains(r#"<model name="a &quot;b&quot; &lt;c&gt; \ -__d, e">"#) && !sdf.contains("::"),
        "{sdf}"
    );
}

/// Where a geom cannot say the product for each other one, the pair is written out.
#[test]
fn restitution_of_pairs_is_the_product() {
    let mjcf = text("mjcf", &all());
    // The commoner of two equally common Bounces is the larger; the rest is paired: 0.5 with 0.25 and with 1.
    assert_eq!(elements(&mjcf, "pair").map(|found| found - 1), Ok(2), "{mjcf}");
}

#[test]
fn gltf_has_cameras_and_shared_meshes() {
    let mut document = all();
    document = document
        .apply(&polyscene::scene::Edit::Viewpoints(vec![Viewpoint {
            name: "Front".into(),
            perspective: true,
            target: DVec3::ZERO,
            yaw: 0.0,
            pitch: 0.0,
            height: 2.0 * 0.363_970_234_266_202_4,
        }]))
        .expect("an edit")
        .document;
    let json = gltf(&format("gltf").export(&document).expect("an export").bytes);
    let eye = json["nodes"].as_array().expect("nodes").last().expect("a camera");
    // Looks along −z from a distance of 1.
    assert_eq!(eye["translation"], serde_json::json!([0.0, 0.0, 1.0]));
    assert_eq!(eye["rotation"], serde_json::json!([0.0, 0.0, 0.0, 1.0]));
    // Points and normals of two shapes, and their triangles.
    assert_eq!(json["accessors"].as_array().map(Vec::len), Some(6));
    assert_eq!(json["meshes"].as_array().map(Vec::len), Some(3));
}

#[test]
fn an_old_file_keeps_its_bytes_and_a_new_one_becomes_old() {
    let document = all();
    let old = text("polyphysics-1.0", &document);
    assert!(old.contains("<!-- a comment -->") && old.contains("Version=\"1.0\""), "{old}");
    for new in ["SpaceAverse", "Material", "Solver"] {
        assert!(!old.contains(new), "{new} in {old}");
    }
    let again = Document::from_bytes(old.as_bytes());
    assert_eq!(text("polyphysics-1.0", &again), old);
    let losses =
        |document| format("polyphysics-1.0").export(document).expect("an export").report.losses().count();
    assert_eq!((losses(&document), losses(&again)), (3, 0));
}

#[test]
fn ten_thousand_bodies_take_seconds() {
    let mut scene = all().scene().cloned().expect("a scene");
    let ball = scene.bodies[0].clone();
    for i in 0..10_000_u32 {
        let mut body = ball.clone();
        body.id = 100 + i64::from(i);
        body.bounce = f64::from(i) / 10_000.0;
        scene.bodies.push(body);
    }
    let document = Document::of_scene(&scene, NumberStyle::Point).expect("a document");
    for format in FORMATS {
        let (exported, took) = timed(|| format.export(&document));
        exported.expect("an export");
        assert!(took < 3.0, "{}: {took} s", format.id);
    }
}

/// y of a ball dropped from rest at 5 m onto a floor at 0.5 m, elastic, g = 9.8 m/s²: its period is 2√(2·4.5/9.8) s.
fn height(t: f64) -> f64 {
    let half = (9.0 / 9.8_f64).sqrt();
    let since = (t + half) % (2.0 * half) - half;
    5.0 - 4.9 * since * since
}

const DROP: &str = r#"<PolyPhysicsXml Version="1.0"><Map><Size X="9" Y="9" Z="9" /><Tiles X="9" Y="9" Z="9" /></Map>
<Simulation><Forces><GravityPlane UserID="1"><Translation X="5" Y="9" Z="5" /><Gravity X="0" Y="-9.8" Z="0" /></GravityPlane></Forces></Simulation>
<Primitives><SoftObject UserID="7"><Translation X="5" Y="5" Z="5" /><Sphere><Radius F32="0.5" /></Sphere></SoftObject>
<HardObject UserID="9"><Translation X="5" Y="0" Z="5" /><Rotation X="-1.5707963267948966" Y="0" Z="0" /><Plane><HalfSideX F32="4" /><HalfSideY F32="4" /></Plane></HardObject></Primitives></PolyPhysicsXml>"#;

fn export_when(id: &str, when: When) -> Vec<u8> {
    let document = Document::from_bytes(DROP.as_bytes());
    let exported = format(id).export_when(&document, when, &mut |_, _| true);
    exported.unwrap_or_else(|error| panic!("{id}: {error}")).bytes
}

#[test]
fn a_later_state_is_that_of_the_fall() {
    let text = String::from_utf8(export_when("csv", When::At(2.5))).expect("UTF-8");
    let row: Vec<&str> = text.lines().nth(1).expect("a body").split(',').collect();
    let y: f64 = row[7].parse().expect("a number");
    assert!((y - height(2.5)).abs() < 1e-9, "{y} instead of {}", height(2.5));
    for format in FORMATS {
        assert!(!export_when(format.id, When::At(1.0)).is_empty());
    }
}

#[test]
fn motion_is_sampled_at_its_frames() {
    let frames = Frames { from: 0.25, to: 2.5, fps: 10.0 };
    let text = String::from_utf8(export_when("csv", When::Motion(frames))).expect("UTF-8");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..4], ["t_s", "label", "name", "x_m"]);
    assert_eq!(rows.len(), 1 + 24, "23 tenths from 0.25 s, and the end");
    for row in &rows[1..] {
        let [t, y] = [0, 4].map(|at| row[at].parse::<f64>().expect("a number"));
        assert!((y - height(t)).abs() < 1e-9, "{row:?}");
    }
    let glb = export_when("gltf", When::Motion(frames));
    let json = gltf(&glb);
    let animation = &json["animations"][0];
    assert_eq!(animation["channels"][0]["target"], serde_json::json!({ "node": 0, "path": "translation" }));
    let times = &json["accessors"][animation["samplers"][0]["input"].as_u64().expect("an input") as usize];
    // The ball lands once from 0.25 s to 2.5 s: √(9/9.8) s and three times that are 0.96 s and 2.87 s.
    assert_eq!((&times["count"], &times["max"]), (&serde_json::json!(25), &serde_json::json!([2.25])));
    let usd = String::from_utf8(export_when("usd", When::Motion(frames))).expect("UTF-8");
    assert!(usd.contains("endTimeCode = 22.5") && usd.contains("timeCodesPerSecond = 10"), "{usd}");
    assert!(usd.matches(",\n").count() >= 25 && balanced(&usd), "{usd}");
    let landing = (f64::sqrt(9.0 / 9.8) - 0.25) * 10.0;
    let key =
        usd.lines().find_map(|line| line.trim().strip_prefix(&format!("{landing:.6}")[..6])).expect("a key");
    let y: f64 = key.split(", ").nth(1).expect("y").parse().expect("a number");
    assert!((y - 0.5).abs() < 1e-12, "the ball touches the floor: {key}");
}

/// A ball that rolls over a floor from where it is turned somehow: ω = ŷ × v/r, and its orientation is exp(ω t) after that.
const ROLL: &str = r#"<PolyPhysicsXml Version="1.1"><Map><Size X="9" Y="9" Z="9" /><Tiles X="9" Y="9" Z="9" /></Map>
<Simulation><Forces><GravityPlane UserID="1"><Translation X="5" Y="9" Z="5" /><Gravity X="0" Y="-9.8" Z="0" /></GravityPlane></Forces></Simulation>
<Primitives><SoftObject UserID="7"><Translation X="1" Y="0.5" Z="1" /><Rotation X="0.3" Y="-0.2" Z="0.1" /><Bounce F32="0" /><Friction F32="0.3" />
<InitialVelocity X="1" Y="0" Z="0.5" /><InitialAngularVelocity X="1" Y="0" Z="-2" /><Sphere><Radius F32="0.5" /></Sphere></SoftObject>
<HardObject UserID="9"><Translation X="5" Y="0" Z="5" /><Rotation X="-1.5707963267948966" Y="0" Z="0" /><Bounce F32="0" /><Friction F32="0.3" /><Plane><HalfSideX F32="40" /><HalfSideY F32="40" /></Plane></HardObject></Primitives></PolyPhysicsXml>"#;

fn rolled(time: f64) -> DQuat {
    let start = DQuat::from_mat3(&rotation_matrix(DVec3::new(0.3, -0.2, 0.1)));
    DQuat::from_scaled_axis(time * DVec3::new(1.0, 0.0, -2.0)) * start
}

/// How far apart two orientations are, as 1 − cos of half the angle; q and −q are the same.
fn apart(one: DQuat, other: DQuat) -> f64 {
    1.0 - one.dot(other).abs()
}

#[test]
fn a_ball_that_rolls_turns_in_every_format() {
    let document = Document::from_bytes(ROLL.as_bytes());
    let frames = Frames { from: 0.5, to: 5.0, fps: 2.0 };
    let export = |id| format(id).export_when(&document, When::Motion(frames), &mut |_, _| true);
    let times: Vec<f64> = (0..10).map(|frame| 0.5 + 0.5 * f64::from(frame)).collect();
    let numbers =
        |text: &str| -> Vec<f64> { text.split(',').filter_map(|part| part.trim().parse().ok()).collect() };

    let csv = String::from_utf8(export("csv").expect("an export").bytes).expect("UTF-8");
    let rows: Vec<&str> = csv.lines().collect();
    assert!(rows[0].ends_with(",qx,qy,qz,qw,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s"), "{}", rows[0]);
    assert_eq!(rows.len(), 1 + times.len());
    for (row, time) in rows[1..].iter().zip(&times) {
        let row = numbers(row);
        let [x, y, z, w, spin @ ..] = &row[8..] else { panic!("{row:?}") };
        assert!(apart(DQuat::from_xyzw(*x, *y, *z, *w), rolled(*time)) < 1e-12, "{time} s: {row:?}");
        assert!((DVec3::from_slice(spin) - DVec3::new(1.0, 0.0, -2.0)).length() < 1e-9, "{row:?}");
    }

    let glb = export("gltf").expect("an export").bytes;
    let json = gltf(&glb);
    let animation = &json["animations"][0];
    let channel = &animation["channels"][1];
    assert_eq!(channel["target"], serde_json::json!({ "node": 0, "path": "rotation" }));
    let sampler = &animation["samplers"][channel["sampler"].as_u64().expect("a sampler") as usize];
    let keys = accessor(&glb, &json, &sampler["input"], 1);
    let turns = accessor(&glb, &json, &sampler["output"], 4);
    assert_eq!((keys.len(), turns.len()), (times.len(), times.len()));
    let turns: Vec<_> = turns.iter().map(|q| DQuat::from_xyzw(q[0], q[1], q[2], q[3])).collect();
    for (turn, key) in turns.iter().zip(&keys) {
        assert!(apart(*turn, rolled(0.5 + key[0])) < 1e-6, "{key:?}: {turn}");
    }
    // Over ten radians: without a change of sign a viewer would turn back in between.
    assert!(turns.windows(2).all(|pair| pair[0].dot(pair[1]) > 0.0), "{turns:?}");

    let usd = String::from_utf8(export("usd").expect("an export").bytes).expect("UTF-8");
    let samples = usd.split("xformOp:orient.timeSamples = {").nth(1).expect("samples").lines().skip(1);
    for (line, (code, time)) in samples.zip(times.iter().enumerate()) {
        let (at, quaternion) = line.trim().split_once(": ").expect("a sample");
        assert_eq!(at.parse::<f64>().expect("a code"), code as f64);
        let q = numbers(quaternion.trim_matches(['(', ')', ',']));
        assert!(apart(DQuat::from_xyzw(q[1], q[2], q[3], q[0]), rolled(*time)) < 1e-12, "{line}");
    }
    assert!(balanced(&usd), "{usd}");
}

/// Where nothing rubs nobody knows how a ball is turned: no channel, empty cells.
#[test]
fn a_ball_without_friction_has_no_orientation() {
    let frames = Frames { from: 0.0, to: 1.0, fps: 4.0 };
    let csv = String::from_utf8(export_when("csv", When::Motion(frames))).expect("UTF-8");
    assert!(csv.lines().skip(1).all(|row| row.ends_with(",,,,,,,")), "{csv}");
    let json = gltf(&export_when("gltf", When::Motion(frames)));
    assert_eq!(json["animations"][0]["channels"].as_array().map(Vec::len), Some(1));
    let usd = String::from_utf8(export_when("usd", When::Motion(frames))).expect("UTF-8");
    assert!(!usd.contains("orient.timeSamples"), "{usd}");
}

/// The vectors of an accessor of 32-bit numbers.
fn accessor(glb: &[u8], json: &Value, index: &Value, width: usize) -> Vec<Vec<f64>> {
    let accessor = &json["accessors"][index.as_u64().expect("an index") as usize];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().expect("a view") as usize];
    let json_length = u32::from_le_bytes(glb[12..16].try_into().expect("four bytes")) as usize;
    let at = 20 + json_length + 8 + view["byteOffset"].as_u64().expect("an offset") as usize;
    let count = accessor["count"].as_u64().expect("a count") as usize;
    let numbers = glb[at..at + 4 * width * count].chunks(4);
    let numbers: Vec<f64> =
        numbers.map(|bytes| f64::from(f32::from_le_bytes(bytes.try_into().expect("four")))).collect();
    numbers.chunks(width).map(<[f64]>::to_vec).collect()
}

/// Symptom: files with `inf` in them, which no program reads, and numbers beyond those of 32 bits where the format has these.
#[test]
fn numbers_that_a_format_cannot_hold_are_refused_with_the_body_and_the_value() {
    let (radius, sphere) = ("<Radius F32=\"0.5\" />", "<Sphere>");
    for (from, to, formats, expected) in [
        (radius, "<Radius F32=\"1e300\" />", &["sdf", "mjcf"][..], "body 7: radius 1e300 m and mass "),
        (radius, "<Radius F32=\"1e300\" />", &["usd", "gltf"], "body 7: its radius is 1e300 m, which "),
        (sphere, "<Weight F32=\"1e300\" /><Sphere>", &["usd"], "body 7: its mass is 1e300 kg, which USD"),
        (sphere, "<Weight F32=\"1e-300\" /><Sphere>", &["usd"], "body 7: its mass is 1e-300 kg, which USD"),
        ("<Size X=\"9\"", "<Size X=\"1e300\"", &["mjcf"], "its longest side is 1e300 m, which MuJoCo"),
        ("Y=\"-9.8\"", "Y=\"-1e39\"", &["usd"], "uniform gravity: the sum of all is 1e39 m/s², which USD"),
    ] {
        let document = Document::from_bytes(DROP.replacen(from, to, 1).as_bytes());
        for id in formats {
            let refused = format(id).export(&document);
            let Err(ExportError::Beyond(message)) = refused else { panic!("{id} of {to}: {refused:?}") };
            assert!(message.contains(expected), "{id} of {to}: {message}");
        }
        assert!(format("csv").export(&document).is_ok(), "{to}");
    }
}

#[test]
fn motion_that_cannot_be_is_refused() {
    let document = Document::from_bytes(DROP.as_bytes());
    let export = |id, frames| format(id).export_when(&document, When::Motion(frames), &mut |_, _| true);
    let frames = Frames { from: 0.0, to: 1.0, fps: 60.0 };
    assert!(matches!(export("mjcf", frames), Err(ExportError::NoMotion(_))));
    for (from, to, fps) in
        [(1.0, 1.0, 60.0), (-1.0, 1.0, 60.0), (0.0, 1.0, 0.0), (0.0, f64::NAN, 1.0), (0.0, 1e9, 60.0)]
    {
        assert!(
            matches!(export("gltf", Frames { from, to, fps }), Err(ExportError::Frames(_))),
            "{from} {to} {fps}"
        );
    }
    let stopped = format("csv").export_when(&document, When::At(5.0), &mut |part, _| part < 0.5);
    assert!(matches!(stopped, Err(ExportError::Cancelled { time }) if time < 5.0));
}
