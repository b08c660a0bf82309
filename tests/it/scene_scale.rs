//! A hundred thousand bodies: an edit costs a small part of loading, and what is new agrees with a fresh read.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;
use polyscene::scene::{BodyChange, Document, Edit, Shape};

use crate::scene_edit::same_meaning;
use crate::scene_read::{BALL, read, scene_with};

fn many(count: usize) -> Document {
    let bodies = (0..count).map(|id| BALL.replace("5853", &id.to_string()));
    let document = read(&scene_with("", &bodies.collect::<String>()));
    assert_eq!(document.scene().unwrap().bodies.len(), count);
    document
}

/// The shortest of a few runs: the machine may be busy with other things.
fn shortest(mut run: impl FnMut()) -> Duration {
    let times = (0..5).map(|_| {
        let start = Instant::now();
        run();
        start.elapsed()
    });
    times.min().unwrap()
}

#[test]
fn dragging_one_of_many_bodies_does_not_read_the_file_again() {
    let mut document = many(20_000);
    let bytes = document.to_bytes();
    let load = shortest(|| assert!(!Document::from_bytes(&bytes).has_errors()));
    let key = document.scene().unwrap().bodies[10_000].key;
    let mut x = 0.0;
    let edit = shortest(|| {
        x += 0.1;
        let change = BodyChange::Position(DVec3::new(x, 3.0, 6.0));
        document = document.apply(&Edit::Body { key, change }).unwrap().document;
        assert_eq!(document.scene().unwrap().bodies[10_000].position.x, x);
    });
    assert!(edit * 4 < load, "loading takes {load:?} and an edit {edit:?}");
}

#[test]
fn edits_of_many_bodies_at_once_agree_with_a_fresh_read() {
    let document = many(3000);
    let keys = document.scene().unwrap().bodies.iter().map(|body| body.key).collect::<Vec<_>>();
    let third = keys.iter().copied().step_by(3).collect::<Vec<_>>();
    let shape = BodyChange::Shape(Shape::Sphere { radius: 0.25 });
    let moves = keys.iter().map(|&key| Edit::Body { key, change: BodyChange::Position(DVec3::ONE) });
    let shapes = third.iter().map(|&key| Edit::Body { key, change: shape.clone() });
    let both = Edit::All(moves.chain(shapes).collect());
    let duplicate = Edit::Duplicate { keys: third.clone(), offset: DVec3::X };
    let delete = Edit::Delete { keys: third };
    let mut now = document.clone();
    for (edit, count) in [(both, 3000), (duplicate, 4000), (delete, 3000)] {
        now = now.apply(&edit).unwrap().document;
        assert_eq!(now.scene().unwrap().bodies.len(), count);
        assert!(same_meaning(&now, &Document::from_bytes(&now.to_bytes())));
    }
}

/// A hand moves many bodies from frame to frame: what they mean is there at once, the text when it is asked for.
#[test]
fn many_moves_of_a_hand_write_what_moves_one_by_one_write() {
    let document = many(200);
    let keys = document.scene().unwrap().bodies.iter().map(|body| body.key).collect::<Vec<_>>();
    let position = |at: usize, step: f64| BodyChange::Position(DVec3::new(step, at as f64, 6.0));
    let velocity = |step: f64| BodyChange::Velocity(DVec3::new(0.1, -step, 1.0 / 3.0));
    let frame = |step: f64| {
        let both = |(at, &key): (usize, &_)| {
            [position(at, step), velocity(step)].map(|change| Edit::Body { key, change })
        };
        keys.iter().enumerate().flat_map(both).collect::<Vec<_>>()
    };
    let (mut dragged, mut one_by_one) = (document.clone(), document.clone());
    for step in [0.25, 7.0, 1.0 / 3.0] {
        let edited = dragged.apply(&Edit::All(frame(step))).unwrap();
        assert_eq!(edited.touched.keys.iter().copied().collect::<Vec<_>>(), keys);
        dragged = edited.document;
        assert_eq!(dragged.place_of(keys[7]), document.place_of(keys[7]));
    }
    for edit in frame(1.0 / 3.0) {
        one_by_one = one_by_one.apply(&edit).unwrap().document;
    }
    assert_eq!(dragged.scene(), one_by_one.scene());
    let clone = dragged.clone();
    assert!(dragged.to_bytes() == one_by_one.to_bytes(), "the same text");
    assert!(clone.written().to_bytes() == one_by_one.to_bytes(), "and of a copy");
    assert!(same_meaning(&dragged, &Document::from_bytes(&dragged.to_bytes())));
    let renamed = Edit::Body { key: keys[0], change: BodyChange::Name(Some("a".into())) };
    let renamed = clone.apply(&renamed).unwrap().document;
    assert!(same_meaning(&renamed, &Document::from_bytes(&renamed.to_bytes())));
    let half = Edit::All(frame(2.0).split_off(100));
    let half = clone.apply(&half).unwrap().document;
    assert!(same_meaning(&half, &Document::from_bytes(&half.to_bytes())), "others than before");
    assert!(clone.apply(&Edit::All(frame(f64::NAN))).is_err());
}

/// Symptom: 96 MB of `<a/>` took 4.1 GB of memory. Expected: a file of elements that are shorter than any of the
/// format is refused where that begins to count; the shortest bodies, however many, are not.
#[test]
fn a_file_of_nothing_but_tiny_elements_is_refused_early() {
    for piece in ["<a/>", "<a></a>", "&lt;x", "<?a?>", "<abcdefg/>"] {
        let text = format!("<PolyPhysicsXml Version=\"1.0\">{}</PolyPhysicsXml>", piece.repeat(1_200_000));
        let document = Document::from_bytes(text.as_bytes());
        let [problem] = document.diagnostics() else { panic!("one problem for {piece}") };
        assert!(problem.message.contains("shorter than those of any scene"), "{problem}");
        assert!(problem.position.is_some_and(|(_, column)| column < 9_000_000), "{problem}");
    }
    let body = "<SoftObject UserID=\"1\">\n<Translation X=\"0\" Y=\"0\" Z=\"0\"/>\n<Sphere>\n<Radius F32=\"1\"/>\n\
                </Sphere>\n</SoftObject>\n";
    let map = "<Map><Size X=\"1\" Y=\"1\" Z=\"1\"/><Tiles X=\"1\" Y=\"1\" Z=\"1\"/></Map>";
    let bodies = body.repeat(100_000);
    let text =
        format!("<PolyPhysicsXml Version=\"1.0\">{map}<Primitives>{bodies}</Primitives></PolyPhysicsXml>");
    assert!(!Document::from_bytes(text.as_bytes()).has_errors());
}

/// Bodies are kept as one piece of text until one of them is edited. Whatever stands in one comes back to the byte, and
/// an edit changes nothing else.
#[test]
fn what_stands_in_a_body_comes_back_edited_or_not() {
    let odd = "\u{FEFF}<!-- a --><?x y?><![CDATA[<]]>&amp;<Unknown a='1'><b/></Unknown>";
    let (start, end) = (BALL.find('>').unwrap() + 1, BALL.rfind("</").unwrap());
    for at in [start, end] {
        let body = format!("{}{odd}{}", &BALL[..at], &BALL[at..]);
        let text = scene_with("", &body);
        let document = Document::from_bytes(text.as_bytes());
        assert_eq!(document.to_bytes(), text.as_bytes());
        let key = document.scene().unwrap().bodies[0].key;
        let change = BodyChange::Position(DVec3::new(1.5, 2.5, 3.5));
        let moved = document.apply(&Edit::Body { key, change }).unwrap().document;
        assert_eq!(document.to_bytes(), text.as_bytes());
        let again = Document::from_bytes(&moved.to_bytes());
        assert!(String::from_utf8(moved.to_bytes()).unwrap().contains(odd));
        for document in [&moved, &again] {
            assert_eq!(document.scene().unwrap().bodies[0].position, DVec3::new(1.5, 2.5, 3.5));
            assert_eq!(document.diagnostics().len(), again.diagnostics().len());
        }
        assert_eq!(moved.foreign(), again.foreign());
    }
}

/// Symptom: thirty edits among 100 000 bodies took 610 MB, for each version of the scene had copies of all of them.
#[test]
fn versions_of_a_scene_share_the_bodies_that_did_not_change() {
    let before = many(100);
    let key = before.scene().unwrap().bodies[50].key;
    let edits = [
        Edit::Body { key, change: BodyChange::Position(DVec3::ONE) },
        Edit::Body { key, change: BodyChange::Name(Some("named".into())) },
        Edit::Delete { keys: vec![key] },
    ];
    for edit in edits {
        let after = before.apply(&edit).unwrap().document;
        let shared = |one: &Document, other: &Document| {
            let kept: Vec<_> = other.scene().unwrap().bodies.as_slice().to_vec();
            let bodies = one.scene().unwrap().bodies.as_slice().to_vec();
            bodies.iter().filter(|body| kept.iter().any(|other| Arc::ptr_eq(body, other))).count()
        };
        assert_eq!(shared(&after, &before), 99, "{edit:?}");
    }
}
