//! Editing in the window: by typing, by dragging, by commands, with undo.

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable as _;
use glam::DVec3;

use super::gui_support::Window;
use polyscene::scene::Motion;

#[test]
fn numbers_are_typed_with_comma_point_or_fraction() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    for (text, mass) in [("2,5", 2.5), ("0.25", 0.25), ("1/8", 0.125)] {
        window.type_number("Mass", text);
        assert!(matches!(window.body("5853").motion, Motion::Dynamic { mass: m, .. } if m == mass), "{text}");
    }
    window.type_number("Position y", "3.5");
    assert_eq!(window.body("5853").position, DVec3::new(5.0, 3.5, 6.0));
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.body("5853").position.y, 3.0);
    window.key_with(Modifiers::COMMAND, Key::Y);
    assert_eq!(window.body("5853").position.y, 3.5);
    assert!(window.harness.state().session().is_dirty());
}

#[test]
fn leaving_a_number_untouched_changes_no_bit() {
    let mut window = Window::thesis();
    window.type_number_via_take_state();
    let before = window.body("5853").position;
    window.click_role(Role::TreeItem, "5853");
    window.click_role(Role::SpinButton, "Position x");
    window.key(Key::Enter);
    assert_eq!(window.body("5853").position, before);
}

#[test]
fn several_bodies_are_edited_at_once() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    window.click_with(Role::TreeItem, "8945", Modifiers::COMMAND);
    assert_eq!(window.selected().len(), 2);
    let radius = window.harness.get_by_role_and_label(Role::SpinButton, "Radius").value();
    assert_eq!(radius.as_deref(), Some("mixed"));
    window.type_number("Bounce", "0.5");
    assert_eq!((window.body("5853").bounce, window.body("8945").bounce), (0.5, 0.5));
    assert_eq!(window.body("15921").bounce, 1.0);
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!((window.body("5853").bounce, window.body("8945").bounce), (1.0, 1.0));
}

#[test]
fn bodies_are_added_duplicated_deleted() {
    let mut window = Window::thesis();
    window.menu("Add", "Dynamic sphere");
    assert_eq!(window.scene().bodies.len(), 14);
    assert_eq!(window.selected().len(), 1);
    window.key_with(Modifiers::COMMAND, Key::D);
    assert_eq!(window.scene().bodies.len(), 15);
    window.key(Key::Delete);
    assert_eq!(window.scene().bodies.len(), 14);
    for _ in 0..3 {
        window.key_with(Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(window.scene().bodies.len(), 13);
    assert!(!window.harness.state().session().is_dirty());
}

#[test]
fn a_body_is_dragged_in_the_top_view_as_one_undo_point() {
    let mut window = Window::thesis();
    let start = window.on_view(1, "Top view", window.body("15921").position);
    let per_metre = window.on_view(1, "Top view", DVec3::X).x - window.on_view(1, "Top view", DVec3::ZERO).x;
    let way = [start, start + vec2(10.0, 4.0), start + vec2(2.0 * per_metre, 0.0)];
    window.drag(&way, PointerButton::Primary, Modifiers::NONE);
    let moved = window.body("15921").position;
    assert!(moved.distance(DVec3::new(4.0, 2.0, 1.0)) < 0.02, "{moved}");
    assert_eq!(moved.y, 2.0, "height stays to the bit");
    assert_eq!(window.harness.state().session().undo_label(), Some("Move 15921"));
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.body("15921").position, DVec3::new(2.0, 2.0, 1.0));
    assert_eq!(window.harness.state().session().undo_label(), None);
}

#[test]
fn escape_gives_a_drag_up() {
    let mut window = Window::thesis();
    let start = window.on_view(1, "Top view", window.body("15921").position);
    window.press(
        &[start, start + vec2(20.0, 0.0), start + vec2(60.0, 9.0)],
        PointerButton::Primary,
        Modifiers::NONE,
    );
    assert_ne!(window.body("15921").position, DVec3::new(2.0, 2.0, 1.0));
    window.harness.key_press(Key::Escape);
    window.harness.run();
    assert_eq!(window.body("15921").position, DVec3::new(2.0, 2.0, 1.0));
    assert!(!window.harness.state().session().is_dirty());
}

#[test]
fn dragging_snaps_when_asked() {
    let mut window = Window::thesis();
    window.key(Key::G);
    let start = window.on_view(1, "Top view", window.body("15921").position);
    let way = [start, start + vec2(9.0, 9.0), start + vec2(33.3, 21.7)];
    window.drag(&way, PointerButton::Primary, Modifiers::NONE);
    let moved = window.body("15921").position;
    let tenths = moved * 10.0;
    assert!(tenths.distance(tenths.round()) < 1e-9, "{moved}");
    assert_ne!(moved, DVec3::new(2.0, 2.0, 1.0));
}

#[test]
fn a_body_is_renamed_in_the_tree() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    window.key(Key::F2);
    window.harness.event(egui::Event::Text("Big ball".into()));
    window.harness.run();
    window.key(Key::Enter);
    assert_eq!(window.body("5853").name.as_deref(), Some("Big ball"));
    assert!(window.harness.query_by_role_and_label(Role::TreeItem, "Big ball").is_some());
}

#[test]
fn hiding_and_locking_by_the_row() {
    let mut window = Window::thesis();
    window.click("Hide 5853");
    assert!(window.body("5853").hidden);
    window.click("Show 5853");
    assert!(!window.body("5853").hidden);
    window.click("Lock 5853");
    window.click_role(Role::TreeItem, "5853");
    window.key(Key::Delete);
    assert_eq!(window.scene().bodies.len(), 13);
    assert!(window.has_containing("Locked"));
}

#[test]
fn map_and_solver_are_edited() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "Map");
    window.type_number("Size y", "12");
    window.type_number("Tiles z", "37");
    assert_eq!(window.scene().map.size.y, 12.0);
    assert_eq!(window.scene().map.tiles, [10, 10, 37]);
    window.click_role(Role::TreeItem, "Simulation");
    window.type_number("Rest height", "1e-3");
    assert_eq!(window.scene().params.rest_height, 1e-3);
    window.click("Reset Rest height");
    assert_eq!(window.scene().params.rest_height, 1e-11);
    window.type_number("Time speed", "0,5");
    assert_eq!(window.scene().time_speed, 0.5);
}

#[test]
fn forces_are_edited() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "7045");
    window.type_number("Intensity", "-8");
    window.click_role(Role::TreeItem, "9318");
    window.type_number("Acceleration y", "-9,81");
    let kinds: Vec<String> = window.scene().forces.iter().map(|force| format!("{:?}", force.kind)).collect();
    assert!(kinds[0].contains("-9.81") && kinds[1].contains("intensity: -8.0"), "{kinds:?}");
}

impl Window {
    /// Positions with all their digits.
    fn type_number_via_take_state(&mut self) {
        self.key(Key::Period);
        self.menu("Edit", "Take current state as start");
    }
}
