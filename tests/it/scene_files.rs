//! Files as they come: every sample, every encoding, and what saving does to the disk.

use std::fs;
use std::path::{Path, PathBuf};

use polyscene::scene::{BodyChange, Document, Edit, NumberStyle};

use crate::scene_edit::same_meaning;
use crate::scene_read::{BALL, FORCES, WALL, problems, scene_with};

fn samples() -> Vec<PathBuf> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let folders = [scenes.clone(), scenes.join("hard")];
    let entries = folders.iter().filter_map(|folder| fs::read_dir(folder).ok()).flatten();
    let files = entries.map(|entry| entry.unwrap().path());
    let mut files = files.filter(|path| path.extension().is_some_and(|ext| ext == "xml")).collect::<Vec<_>>();
    files.sort();
    files
}

/// Bodies of a large scene that are moved, one edit each.
const MOST: usize = 1100;

#[test]
fn every_sample_loads_round_trips_and_survives_an_edit_and_undo() {
    let samples = samples();
    assert!(samples.len() >= 6);
    for path in samples {
        let bytes = fs::read(&path).unwrap();
        let document = Document::open(&path);
        assert!(!document.has_errors(), "{}: {}", path.display(), problems(&document));
        assert_eq!(document.to_bytes(), bytes, "{}", path.display());
        let scene = document.scene().unwrap();
        let mut now = document.clone();
        // Each edit reads the whole list anew.
        let some = &scene.bodies.as_slice()[..scene.bodies.len().min(MOST)];
        for body in some {
            let change = BodyChange::Position(body.position + glam::DVec3::splat(0.1));
            now = now.apply(&Edit::Body { key: body.key, change }).unwrap().document;
        }
        assert!(same_meaning(&now, &Document::from_bytes(&now.to_bytes())), "{}", path.display());
        for body in some {
            let change = BodyChange::Position(body.position);
            now = now.apply(&Edit::Body { key: body.key, change }).unwrap().document;
        }
        assert_eq!(now.scene(), document.scene(), "{}", path.display());
        assert_eq!(document.to_bytes(), bytes, "{}", path.display());
        let keys = scene.bodies.iter().map(|body| body.key).collect::<Vec<_>>();
        let copied = document.apply(&Edit::Duplicate { keys, offset: glam::DVec3::ONE }).unwrap();
        assert_eq!(copied.document.scene().unwrap().bodies.len(), 2 * scene.bodies.len());
        let deleted = copied.document.apply(&Edit::Delete { keys: copied.added }).unwrap();
        assert_eq!(deleted.document.to_bytes(), bytes, "{}", path.display());
    }
}

/// A scene with Czech letters in a comment, and its declaration.
fn czech(encoding: &str) -> String {
    let scene = scene_with(FORCES, &format!("    <!-- Příliš žluťoučký kůň -->\n{BALL}{WALL}"));
    format!("<?xml version=\"1.0\" encoding=\"{encoding}\"?>\n{scene}").replace('\n', "\r\n")
}

fn utf16(text: &str, order: fn(u16) -> [u8; 2]) -> Vec<u8> {
    text.encode_utf16().flat_map(order).collect()
}

/// Each encoding with a function from text to its bytes.
type Encode = fn(&str) -> Vec<u8>;
const ENCODINGS: [(&str, Encode); 7] = [
    ("utf-8", |text| text.as_bytes().to_vec()),
    ("utf-8", |text| [b"\xEF\xBB\xBF", text.as_bytes()].concat()),
    ("utf-16", |text| [b"\xFF\xFE".to_vec(), utf16(text, u16::to_le_bytes)].concat()),
    ("utf-16", |text| [b"\xFE\xFF".to_vec(), utf16(text, u16::to_be_bytes)].concat()),
    ("utf-16", |text| utf16(text, u16::to_le_bytes)),
    ("windows-1250", |text| encoding_rs::WINDOWS_1250.encode(text).0.into_owned()),
    ("iso-8859-2", |text| encoding_rs::ISO_8859_2.encode(text).0.into_owned()),
];

#[test]
fn every_encoding_comes_back_byte_for_byte_also_after_an_edit() {
    for (label, encode) in ENCODINGS {
        let text = czech(label);
        let document = Document::from_bytes(&encode(&text));
        assert_eq!(problems(&document), "", "{label}");
        assert_eq!(document.to_bytes(), encode(&text), "{label}");
        let key = document.scene().unwrap().bodies[0].key;
        let name = BodyChange::Name(Some("Kůň".into()));
        let edited = document.apply(&Edit::Body { key, change: name }).unwrap().document;
        let open = "\"5853\">\r\n";
        let expected = text.replace(open, &format!("{open}      <?polyscene name=\"Kůň\"?>\r\n"));
        assert_eq!(edited.to_bytes(), encode(&expected), "{label}");
        assert_eq!(edited.place_of(key).0, Some((22, 5)), "{label}");
    }
}

#[test]
fn a_letter_that_the_encoding_lacks_becomes_a_reference() {
    let document = Document::from_bytes(&encoding_rs::WINDOWS_1250.encode(&czech("windows-1250")).0);
    let key = document.scene().unwrap().bodies[0].key;
    let name = BodyChange::Name(Some("球".into()));
    let edited = document.apply(&Edit::Body { key, change: name }).unwrap().document;
    let again = Document::from_bytes(&edited.to_bytes());
    assert_eq!(again.scene().unwrap().bodies[0].name.as_deref(), Some("球"));
}

#[test]
fn bytes_that_are_no_text_are_told_with_their_place() {
    let mut latin = czech("utf-8").into_bytes();
    let at = latin.windows(2).position(|pair| pair == "ř".as_bytes()).unwrap();
    latin[at] = 0xF8;
    let cases: [(&[u8], &str); 4] = [
        (&latin, "21:11: error: the byte 0xF8 is not valid UTF-8"),
        (b"\xFF\xFE<\0a\0\0", "1:3: error: the file ends in the middle of a UTF-16 character"),
        (b"\xFF\xFE<\0\0\xD8a\0", "1:2: error: 0xD800 is half a character of UTF-16"),
        (b"\xFF\xFE\0\0<\0\0\0", "1:1: error: the file is in UTF-32"),
    ];
    for (bytes, problem) in cases {
        let document = Document::from_bytes(bytes);
        assert!(problems(&document).starts_with(problem), "{}", problems(&document));
        assert_eq!(document.to_bytes(), bytes);
        assert!(document.scene().is_none());
    }
}

#[test]
fn saving_replaces_the_file_in_one_go_and_keeps_its_permissions() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    let document = Document::new(NumberStyle::Comma);
    document.save(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), document.to_bytes());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "a temporary file is left");
    let faster = document.apply(&Edit::TimeSpeed(2.0)).unwrap().document;
    #[cfg(unix)]
    {
        use std::os::unix::fs::{PermissionsExt, symlink};
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        let link = folder.path().join("link.xml");
        symlink("scene.xml", &link).unwrap();
        faster.save(&link).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(fs::read(&path).unwrap(), faster.to_bytes());
        fs::set_permissions(&path, fs::Permissions::from_mode(0o440)).unwrap();
        assert!(document.save(&path).is_err(), "a write-protected file is overwritten");
        assert_eq!(fs::read(&path).unwrap(), faster.to_bytes());
    }
    assert!(faster.save(&folder.path().join("missing/scene.xml")).is_err());
    assert!(faster.save(folder.path()).is_err());
}
