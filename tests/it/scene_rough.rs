//! Friction and spin in files: what an edit writes, and what it takes away again.

use glam::DVec3;
use polyscene::scene::{BodyChange, Document, Edit};

use crate::scene_read::{BALL, FORCES, WALL, read, scene_with};

fn plain() -> String {
    scene_with(FORCES, &format!("{BALL}{WALL}"))
}

fn text(document: &Document) -> String {
    String::from_utf8(document.to_bytes()).unwrap()
}

fn apply(document: &Document, edits: Vec<Edit>) -> Document {
    document.apply(&Edit::All(edits)).unwrap().document
}

/// What 1.1 added goes again where it says nothing: an older tool reads the file as before.
#[test]
fn friction_and_spin_come_into_the_file_and_go_again() {
    let document = read(&plain());
    let key = document.scene().unwrap().bodies[0].key;
    let set = [
        (BodyChange::Friction(0.25), "      <Friction F32=\"0,25\" />\n"),
        (BodyChange::RollingFriction(0.01), "      <RollingFriction F32=\"0,01\" />\n"),
        (BodyChange::Tangential(0.5), "      <Tangential F32=\"0,5\" />\n"),
    ];
    let spin = "      <InitialAngularVelocity X=\"0\" Y=\"2\" Z=\"-1\" />\n";
    let lines: String = set.iter().map(|(_, line)| *line).collect();
    let mut edits: Vec<Edit> = set.into_iter().map(|(change, _)| Edit::Body { key, change }).rev().collect();
    edits.push(Edit::Body { key, change: BodyChange::Spin(DVec3::new(0.0, 2.0, -1.0)) });
    let rough = apply(&document, edits);
    let written = text(&rough);
    let expected = plain()
        .replacen("Version=\"1.0\"", "Version=\"1.1\"", 1)
        .replacen("      <Weight", &format!("{lines}      <Weight"), 1)
        .replacen("      <Sphere>", &format!("{spin}      <Sphere>"), 1);
    assert_eq!(written, expected);
    let gone = [
        BodyChange::Spin(DVec3::ZERO),
        BodyChange::Friction(0.0),
        BodyChange::Tangential(0.0),
        BodyChange::RollingFriction(0.0),
    ];
    let edits = gone.into_iter().map(|change| Edit::Body { key, change }).collect();
    let smooth = text(&apply(&rough, edits));
    assert_eq!(smooth.replacen("Version=\"1.1\"", "Version=\"1.0\"", 1), plain());
    let wall = document.scene().unwrap().bodies[1].key;
    let refused = document.apply(&Edit::Body { key: wall, change: BodyChange::Spin(DVec3::X) });
    assert_eq!(refused.unwrap_err().to_string(), "a static body has no mass and no velocity");
}
