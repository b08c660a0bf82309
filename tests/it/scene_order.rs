//! Elements of a file change their order: with what is written about them, and nothing else changes a byte.

use polyscene::scene::{Document, Edit, EditError, NodeKey, Side};

use crate::scene_edit::text;
use crate::scene_read::{FORCES, read, scene_with};

const LINES: [&str; 4] = [
    "\n    <!-- about a -->\n    <SoftObject UserID=\"1\"><Sphere/></SoftObject> <!-- and a -->",
    "\n    <SoftObject UserID=\"2\"><Sphere/></SoftObject>",
    "\n    <HardObject UserID='3'>\n      <Sphere/>\n    </HardObject>",
    "\n\t<SoftObject  UserID=\"4\"><Sphere/></SoftObject><!-- d -->",
];

/// A file with these lines as its bodies, which begin behind a heading and an empty line.
fn file(lines: &[&str]) -> String {
    let bodies = format!("    <!-- all bodies -->\n{}\n    <!-- the end -->\n", lines.concat());
    scene_with(FORCES, &bodies)
}

fn keys(document: &Document) -> Vec<NodeKey> {
    document.scene().unwrap().bodies.iter().map(|body| body.key).collect()
}

fn ids(document: &Document) -> Vec<i64> {
    document.scene().unwrap().bodies.iter().map(|body| body.id).collect()
}

fn reordered(document: &Document, moved: &[usize], side: Side, anchor: usize) -> Document {
    let keys = keys(document);
    let edit = Edit::Reorder { keys: moved.iter().map(|at| keys[*at]).collect(), side, anchor: keys[anchor] };
    let edited = document.apply(&edit).unwrap();
    assert!(edited.touched.keys.is_empty(), "no body means anything else");
    edited.document
}

#[test]
fn elements_move_with_their_comments_and_all_else_keeps_its_bytes() {
    let [a, b, c, d] = LINES;
    let before = file(&LINES);
    let document = read(&before);
    for (moved, side, anchor, lines) in [
        (&[3][..], Side::Before, 0, [d, a, b, c]),
        (&[0], Side::After, 3, [b, c, d, a]),
        (&[0], Side::Before, 2, [b, a, c, d]),
        (&[1], Side::After, 2, [a, c, b, d]),
        (&[3, 1], Side::Before, 0, [b, d, a, c]),
        (&[0, 2], Side::After, 2, [b, a, c, d]),
        (&[1, 2], Side::Before, 2, [a, b, c, d]),
        (&[1], Side::Before, 1, [a, b, c, d]),
    ] {
        let edited = reordered(&document, moved, side, anchor);
        let expected = file(&lines);
        assert_eq!(text(&edited), expected, "{moved:?} {side:?} {anchor}");
        assert_eq!(ids(&edited), ids(&read(&expected)));
        assert_eq!(text(&document), before);
    }
}

#[test]
fn an_empty_line_stays_where_it_parts_others() {
    let [a, b, c, d] = LINES;
    let apart = format!("\n{c}");
    let document = read(&file(&[a, b, &apart, d]));
    assert_eq!(text(&reordered(&document, &[2], Side::Before, 0)), file(&[c, a, b, "\n", d]));
    assert_eq!(text(&reordered(&document, &[3], Side::After, 1)), file(&[a, b, d, &apart]));
    assert_eq!(text(&reordered(&document, &[2, 3], Side::Before, 2)), text(&document));
    assert_eq!(text(&reordered(&document, &[1, 2], Side::Before, 2)), text(&document));
    assert_eq!(text(&reordered(&document, &[0, 2], Side::Before, 2)), file(&[b, "\n", a, c, d]));
    assert_eq!(text(&reordered(&document, &[3], Side::Before, 2)), file(&[a, b, "\n", d, c]));
}

#[test]
fn files_on_one_line_and_with_other_line_ends_are_ordered_too() {
    let crlf = |text: String| text.replace('\n', "\r\n");
    let [a, b, c, d] = LINES;
    let document = read(&crlf(file(&LINES)));
    assert_eq!(text(&reordered(&document, &[2], Side::Before, 0)), crlf(file(&[c, a, b, d])));
    let flat = |order: [i64; 3]| {
        let body = |id| format!("<SoftObject UserID=\"{id}\"><Sphere/></SoftObject>");
        scene_with("", &order.map(body).concat()).replace('\n', "")
    };
    let document = read(&flat([1, 2, 3]));
    assert_eq!(text(&reordered(&document, &[2], Side::Before, 0)), flat([3, 1, 2]));
}

#[test]
fn moving_there_and_back_gives_the_very_bytes() {
    let before = file(&LINES);
    let there = reordered(&read(&before), &[0], Side::After, 3);
    assert_eq!(text(&reordered(&there, &[3], Side::Before, 0)), before);
}

const THIRD: &str = "<SpaceAverse UserID=\"3\"><Density F32=\"1\"/></SpaceAverse></Forces>";

/// Symptom: three forces and more kept their order, since sums were rounded by it. Expected: it is a matter of the file and the
/// tree alone, and lasts.
#[test]
fn many_forces_are_ordered_too() {
    let document = read(&scene_with(&FORCES.replace("</Forces>", THIRD), ""));
    let ids = |document: &Document| {
        document.scene().unwrap().forces.iter().map(|force| force.id).collect::<Vec<_>>()
    };
    assert_eq!(ids(&document), [9318, 7045, 3]);
    let keys: Vec<NodeKey> = document.scene().unwrap().forces.iter().map(|force| force.key).collect();
    let edit = Edit::Reorder { keys: vec![keys[2]], side: Side::Before, anchor: keys[0] };
    let edited = document.apply(&edit).unwrap();
    assert!(edited.touched.keys.is_empty(), "no force means anything else");
    assert_eq!(ids(&edited.document), [3, 9318, 7045]);
    assert_eq!(ids(&read(&text(&edited.document))), [3, 9318, 7045]);
}

/// Where the order says more than the order: ids given by it.
#[test]
fn an_order_that_would_mean_something_else_is_refused() {
    let refused = |document: &Document, keys: &[NodeKey]| {
        let edit = Edit::Reorder { keys: vec![keys[0]], side: Side::After, anchor: keys[1] };
        match document.apply(&edit) {
            Err(EditError::Invalid(message)) => message,
            other => panic!("{other:?}"),
        }
    };
    let twins = LINES.map(|line| line.replace("UserID=\"2\"", "UserID=\"1\""));
    let document = read(&file(&twins.each_ref().map(String::as_str)));
    assert!(refused(&document, &keys(&document)).contains("of UserID 1 are told apart by their order"));
    reordered(&document, &[3], Side::Before, 0);
    let nameless = LINES.map(|line| line.replace(" UserID=\"1\"", "").replace(" UserID=\"2\"", ""));
    let document = read(&file(&nameless.each_ref().map(String::as_str)));
    assert!(refused(&document, &keys(&document)).contains("without a UserID"));
    let twins = FORCES.replace("</Forces>", &THIRD.replace("UserID=\"3\"", "UserID=\"7045\""));
    for (forces, fine) in [(twins.as_str(), false), (FORCES, true)] {
        let document = read(&scene_with(forces, ""));
        let keys: Vec<NodeKey> = document.scene().unwrap().forces.iter().map(|force| force.key).collect();
        let last = [keys[keys.len() - 1], keys[keys.len() - 2]];
        let edit = Edit::Reorder { keys: vec![last[0]], side: Side::Before, anchor: last[1] };
        assert_eq!(document.apply(&edit).is_ok(), fine, "{forces}");
    }
    let document = read(&file(&LINES));
    let force = document.scene().unwrap().forces[0].key;
    let keys = keys(&document);
    let mixed = Edit::Reorder { keys: vec![force], side: Side::Before, anchor: keys[0] };
    assert!(matches!(document.apply(&mixed), Err(EditError::Invalid(_))));
    let gone = Edit::Reorder { keys: vec![keys[0]], side: Side::Before, anchor: NodeKey(u64::MAX) };
    assert_eq!(document.apply(&gone).unwrap_err(), EditError::Gone);
}
