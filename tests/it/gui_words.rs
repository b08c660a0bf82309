//! What the window says back: refused numbers, Escape, snapping, markers that go, names.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use super::gui_support::Window;
use polyscene::scene::Motion;

#[test]
fn numbers_that_make_no_sense_are_refused_in_words() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    for (text, words) in [
        ("abc", "“abc” is not a number"),
        ("1.234,5", "“1.234,5” is not a number"),
        ("1e400", "“1e400” is not a number"),
        ("", "Nothing was typed: the mass"),
        ("-3", "-3 is out of range: the mass must be above 0"),
        ("0", "0 is out of range: the mass"),
    ] {
        if text.is_empty() {
            window.click_role(Role::SpinButton, "Mass");
            window.key_with(egui::Modifiers::COMMAND, Key::A);
            window.key(Key::Backspace);
            window.key(Key::Enter);
        } else {
            window.type_number("Mass", text);
        }
        assert!(window.has_containing(words), "{text}");
        assert!(matches!(window.body("5853").motion, Motion::Dynamic { mass: 1.0, .. }), "{text}");
    }
    assert!(!window.harness.state().session().is_dirty());
}

#[test]
fn counts_have_no_fractions() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "Map");
    let before = window.scene().map.tiles;
    for (text, words) in [("1,5", "1,5 is not a whole number"), ("1e308", "1e308 is out of range")] {
        window.type_number("Tiles x", text);
        assert!(window.has_containing(words), "{text}");
        assert_eq!(window.scene().map.tiles, before);
    }
    window.type_number("Tiles x", "2*3");
    assert_eq!(window.scene().map.tiles[0], 6);
}

#[test]
fn angles_are_typed_in_degrees_too() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "8855");
    for (text, degrees) in [("30°", 30.0), ("-45deg", -45.0), ("pi/3", 60.0)] {
        window.type_number("Rotation β", text);
        let angle = window.body("8855").rotation.y;
        assert!((angle.to_degrees() - degrees).abs() < 1e-9, "{text}: {angle}");
    }
    window.type_number("Position x", "30°");
    assert!(window.has_containing("“30°” is not a number"));
}

#[test]
fn a_wrong_user_id_is_refused_in_words() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    window.type_text("User ID", "ball");
    assert!(window.has_containing("“ball” is not a UserID"));
    assert_eq!(window.body("5853").id, 5853);
}

#[test]
fn escape_leaves_the_field_and_then_the_selection() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    for (role, name) in [(Role::SpinButton, "Mass"), (Role::TextInput, "Name")] {
        window.click_role(role, name);
        window.harness.event(egui::Event::Text("7".into()));
        window.harness.run();
        window.key(Key::Escape);
        assert_eq!(window.selected().len(), 1, "{name}");
        assert_eq!(window.harness.state().session().undo_label(), None, "{name} was changed");
    }
    window.key(Key::Escape);
    assert!(window.selected().is_empty());
}

#[test]
fn snapping_tells_its_state() {
    let mut window = Window::thesis();
    window.key(Key::G);
    assert!(window.has_containing("Snapping is on"));
    window.click_role(Role::Button, "View");
    assert!(window.has_containing("Snap while dragging: on"));
    window.key(Key::Escape);
    window.click_role(Role::Button, "Snap while dragging");
    assert!(window.has_containing("Snapping is off"));
}

#[test]
fn the_marker_of_an_event_goes_when_the_time_moves() {
    for leave in ["Finish this Δt", "Event back", "Step forward", "Play or pause", "Reset"] {
        let mut window = Window::thesis();
        window.click("Next event");
        window.click("5853 – 8855");
        assert!(window.harness.state().session().shown_event().is_some());
        window.harness.get_by_role_and_label(Role::Button, leave).click();
        window.harness.run_steps(3);
        assert!(window.harness.state().session().shown_event().is_none(), "{leave}");
    }
}

#[test]
fn events_are_told_by_names() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    window.type_text("Name", "Anna");
    window.click("Next event");
    assert!(window.has("Anna – 8855"));
}

#[test]
fn a_new_scene_is_empty_at_once() {
    let mut window = Window::thesis();
    window.key_with(egui::Modifiers::COMMAND, Key::N);
    assert!(window.scene().bodies.is_empty());
    assert!(!window.has("Empty scene"));
}
