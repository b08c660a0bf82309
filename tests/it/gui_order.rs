//! The order of the scene tree, which is that of the file: by mouse and by keyboard.

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::editor_support::SCENE;
use super::gui_support::Window;

/// The scene with two more bodies at its end, 9 and 10.
fn scene() -> String {
    let start = SCENE.find("    <!-- the second -->").unwrap();
    let end = SCENE.find("  </Primitives>").unwrap();
    let more = ["9", "10"].map(|id| {
        let body = SCENE[start..end].replace("UserID=\"8\"", &format!("UserID=\"{id}\""));
        body.replace("X=\"7\" Y=\"3\"", &format!("X=\"7\" Y=\"{}\"", if id == "9" { 5 } else { 7 }))
            .replace("the second", id)
    });
    [&SCENE[..end], &more.concat(), &SCENE[end..]].concat()
}

fn order(window: &Window) -> Vec<i64> {
    window.scene().bodies.iter().map(|body| body.id).collect()
}

fn bytes(window: &Window) -> String {
    String::from_utf8(window.harness.state().session().document().to_bytes()).unwrap()
}

fn undo_label(window: &Window) -> Option<&str> {
    window.harness.state().session().undo_label()
}

/// Drags a row to the upper (-) or lower (+) part of another, in points from its middle.
fn drag_row(window: &mut Window, from: &str, to: &str, off: f32) {
    let row = |label: &str| window.harness.get_by_role_and_label(Role::TreeItem, label).rect().left_center();
    let (from, to) = (row(from) + vec2(60.0, 0.0), row(to) + vec2(60.0, off));
    window.drag(&[from, from.lerp(to, 0.5), to, to], PointerButton::Primary, Modifiers::NONE);
}

#[test]
fn rows_are_dragged_between_others_in_one_step() {
    let before = scene();
    let mut window = Window::bytes(before.as_bytes());
    assert_eq!(order(&window), [30, 7, 8, 9, 10]);
    drag_row(&mut window, "10", "7", -6.0);
    assert_eq!(order(&window), [30, 10, 7, 8, 9]);
    assert_eq!(undo_label(&window), Some("Move 1 object in the tree"));
    let moved = before.find("    <!-- 10 -->").unwrap()..before.find("  </Primitives>").unwrap();
    let first = before.find("    <SoftObject UserID=\"7\"").unwrap();
    let expected =
        [&before[..first], &before[moved.clone()], &before[first..moved.start], &before[moved.end..]]
            .concat();
    assert_eq!(bytes(&window), expected);
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(bytes(&window), before);
    // several, in the order they have, below another
    window.click_role(Role::TreeItem, "9");
    window.click_with(Role::TreeItem, "7", Modifiers::COMMAND);
    drag_row(&mut window, "9", "10", 6.0);
    assert_eq!(order(&window), [30, 8, 10, 7, 9]);
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(bytes(&window), before);
    // to where it is
    drag_row(&mut window, "8", "7", 6.0);
    drag_row(&mut window, "8", "9", -6.0);
    assert_eq!(undo_label(&window), None);
    // what rests is listed elsewhere
    drag_row(&mut window, "8", "30", 6.0);
    assert_eq!(undo_label(&window), None);
}

#[test]
fn a_row_is_dragged_to_a_place_in_a_group() {
    let mut window = Window::bytes(scene().as_bytes());
    window.click_role(Role::TreeItem, "7");
    window.click_with(Role::TreeItem, "8", Modifiers::COMMAND);
    window.key_with(Modifiers::COMMAND, Key::G);
    window.click("Open group");
    drag_row(&mut window, "10", "8", -6.0);
    assert_eq!(order(&window), [30, 7, 10, 8, 9]);
    assert_eq!(window.body("10").group.as_deref(), Some("group"));
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(order(&window), [30, 7, 8, 9, 10]);
    assert_eq!(window.body("10").group, None, "both in one step");
    // in a group what rests and what moves stand in one list
    drag_row(&mut window, "30", "8", 6.0);
    assert_eq!(order(&window), [7, 8, 30, 9, 10]);
    assert_eq!(window.body("30").group.as_deref(), Some("group"));
}

#[test]
fn the_keyboard_moves_rows_up_and_down() {
    let before = scene();
    let mut window = Window::bytes(before.as_bytes());
    window.click_role(Role::TreeItem, "9");
    window.key_with(Modifiers::COMMAND, Key::ArrowUp);
    assert_eq!(order(&window), [30, 7, 9, 8, 10]);
    window.key_with(Modifiers::COMMAND, Key::ArrowDown);
    assert_eq!(bytes(&window), before);
    window.click_role(Role::TreeItem, "7");
    window.key_with(Modifiers::COMMAND, Key::ArrowUp);
    assert_eq!(bytes(&window), before);
    assert!(window.has_containing("It is the first of its kind already"));
    window.click_with(Role::TreeItem, "9", Modifiers::COMMAND);
    window.key_with(Modifiers::COMMAND, Key::ArrowDown);
    assert_eq!(order(&window), [30, 8, 10, 7, 9], "they are gathered behind the next one");
    assert_eq!(window.selected().len(), 2, "they stay selected");
    window.menu("Edit", "Undo");
    assert_eq!(bytes(&window), before);
}

/// The order is not the simulation's: it goes on as it was, from where it is.
#[test]
fn the_simulation_does_not_notice() {
    let mut window = Window::bytes(scene().as_bytes());
    window.click_role(Role::TreeItem, "9");
    window.key(Key::Period);
    let frame = window.frame().clone();
    assert!(frame.time > 0.0);
    window.key_with(Modifiers::COMMAND, Key::ArrowUp);
    assert_eq!(order(&window), [30, 7, 9, 8, 10]);
    assert!(!window.harness.state().session().needs_reset());
    assert_eq!(window.frame().time.to_bits(), frame.time.to_bits());
    let mut plain = Window::bytes(scene().as_bytes());
    for window in [&mut window, &mut plain] {
        window.key(Key::Home);
        (0..20).for_each(|_| window.key(Key::Period));
    }
    for (a, b) in window.frame().bodies.iter().zip(&plain.frame().bodies) {
        assert_eq!((a.key, a.position, a.velocity), (b.key, b.position, b.velocity));
    }
}

/// The rows of groups, from above.
fn groups(window: &Window) -> Vec<String> {
    let rows = window.harness.query_all_by_role(Role::TreeItem);
    let mut rows: Vec<(f32, String)> = rows
        .filter_map(|row| Some((row.rect().top(), row.accesskit_node().label()?)))
        .filter(|(_, label)| ["a", "b", "c", "d"].contains(&label.as_str()))
        .collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows.into_iter().map(|(_, label)| label).collect()
}

/// Groups stand in the order of the file and are moved with all that is in them: by keys and by mouse, in one step.
#[test]
fn groups_are_put_in_another_order() {
    let mut text = scene();
    for (id, group) in [("30", "b"), ("7", "a/d"), ("8", "c"), ("9", "b"), ("10", "a")] {
        let at = text.find(&format!("UserID=\"{id}\"")).unwrap();
        let at = at + text[at..].find('>').unwrap() + 1;
        text.insert_str(at, &format!("<?polyscene group=\"{group}\"?>"));
    }
    let mut window = Window::bytes(text.as_bytes());
    assert_eq!(order(&window), [30, 7, 8, 9, 10]);
    assert_eq!(groups(&window), ["b", "a", "c"]);
    window.click_role(Role::TreeItem, "c");
    window.key_with(Modifiers::COMMAND, Key::ArrowUp);
    assert_eq!(
        (groups(&window), order(&window)),
        (["b", "c", "a"].map(String::from).into(), vec![30, 8, 7, 9, 10])
    );
    window.key_with(Modifiers::COMMAND, Key::ArrowUp);
    assert_eq!(groups(&window), ["c", "b", "a"]);
    window.key_with(Modifiers::COMMAND, Key::ArrowUp);
    assert!(window.has_containing("It is the first of its kind already"));
    window.key_with(Modifiers::COMMAND, Key::ArrowDown);
    window.key_with(Modifiers::COMMAND, Key::ArrowDown);
    assert_eq!(groups(&window), ["b", "a", "c"]);
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(groups(&window), ["b", "c", "a"], "one step each");

    drag_row(&mut window, "a", "b", -8.0);
    assert_eq!(groups(&window), ["a", "b", "c"]);
    assert_eq!(undo_label(&window), Some("Move 1 group in the tree"));
    drag_row(&mut window, "a", "c", 8.0);
    assert_eq!(groups(&window), ["b", "c", "a"]);
    window.click("Open a");
    assert_eq!(groups(&window), ["b", "c", "a", "d"]);
    // beside a group elsewhere: out of its own
    drag_row(&mut window, "d", "c", -8.0);
    assert_eq!(groups(&window), ["b", "d", "c", "a"]);
    assert_eq!(window.body("7").group.as_deref(), Some("d"));
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.body("7").group.as_deref(), Some("a/d"), "both in one step");
    // in the middle of a row: into that group
    drag_row(&mut window, "c", "b", 0.0);
    assert_eq!(window.body("8").group.as_deref(), Some("b/c"));
}
