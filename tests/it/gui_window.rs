//! The window as a whole: selecting, stepping, events, overlays, problems, shortcuts, rest.

use std::collections::BTreeSet;

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::gui_support::Window;
use polyscene::editor::{COMMANDS, Menu};
use polyscene::sim::Method;
use polyscene::view::OVERLAYS;

#[test]
fn the_thesis_scene_opens_with_four_views_and_all_bodies() {
    let window = Window::thesis();
    for view in ["Perspective view", "Top view", "Front view", "Right view"] {
        assert!(window.view_rect(view).area() > 20_000.0, "{view}");
    }
    for body in &window.scene().bodies {
        assert!(
            window.harness.query_by_role_and_label(Role::TreeItem, &body.label).is_some(),
            "{}",
            body.label
        );
    }
    assert!(!window.harness.state().session().is_dirty());
}

#[test]
fn a_click_in_a_view_selects_and_the_tree_follows() {
    let mut window = Window::thesis();
    let at = window.on_view(1, "Top view", window.body("8945").position);
    window.click_at(at, Modifiers::NONE);
    assert_eq!(window.selected(), [window.body("8945").key]);
    let row = window.harness.get_by_role_and_label(Role::TreeItem, "8945");
    assert_eq!(row.accesskit_node().toggled(), Some(egui::accesskit::Toggled::True));
    let at = window.on_view(1, "Top view", window.body("5853").position);
    window.click_at(at, Modifiers::COMMAND);
    assert_eq!(window.selected().len(), 2);
    window.key(Key::Escape);
    assert!(window.selected().is_empty());
}

#[test]
fn clicks_at_the_same_place_go_through_what_lies_there() {
    let mut window = Window::thesis();
    let at = window.on_view(1, "Top view", window.body("8945").position);
    let mut seen = BTreeSet::new();
    for _ in 0..3 {
        window.click_at(at, Modifiers::NONE);
        seen.extend(window.selected().iter().copied());
        // two clicks, not a double click
        window.harness.run_steps(30);
    }
    assert!(seen.len() >= 2, "the sphere, and the floor below it");
}

#[test]
fn a_rectangle_selects() {
    let mut window = Window::thesis();
    let rect = window.view_rect("Perspective view");
    let way = [rect.left_top() + vec2(20.0, 40.0), rect.center(), rect.right_bottom() - vec2(20.0, 20.0)];
    window.drag(&way, PointerButton::Primary, Modifiers::NONE);
    let body = window.body("5853").key;
    assert!(window.selected().contains(&body));
    assert!(window.selected().len() > 3);
}

#[test]
fn shift_takes_a_range_of_the_tree() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "5853");
    window.click_with(Role::TreeItem, "8945", Modifiers::SHIFT);
    assert_eq!(window.selected().len(), 3);
}

#[test]
fn the_filter_narrows_the_tree() {
    let mut window = Window::thesis();
    window.key_with(Modifiers::COMMAND, Key::F);
    window.harness.event(egui::Event::Text("sphere".into()));
    window.harness.run();
    assert!(window.harness.query_by_role_and_label(Role::TreeItem, "5853").is_some());
    assert!(window.harness.query_by_role_and_label(Role::TreeItem, "8855").is_none());
}

#[test]
fn stepping_by_dt_and_by_event() {
    let mut window = Window::thesis();
    window.type_text("Δt", "1/10");
    window.click("Step forward");
    assert_eq!((window.frame().dt_index, window.frame().time), (1, 0.1));
    window.click("Next event");
    assert!(window.frame().open_step.is_some());
    let first = window.frame().events.last().unwrap().clone();
    assert!((first.event.time - 0.738_312_832).abs() < 1e-6, "{}", first.event.time);
    window.click("Finish this Δt");
    assert!(window.frame().open_step.is_none());
    window.click("Step back");
    assert_eq!(window.frame().dt_index, 7);
    window.click("Reset");
    assert_eq!(window.frame().time, 0.0);
}

#[test]
fn another_method_starts_again_and_says_so() {
    let mut window = Window::thesis();
    window.click("Step forward");
    window.click_role(Role::ComboBox, "Method");
    window.click_role(Role::Button, "thesis");
    assert_eq!((window.frame().method, window.frame().time), (Method::Thesis, 0.0));
    assert!(window.has_containing("the method is now thesis"));
    assert!(!window.harness.state().session().is_dirty(), "the document does not know of methods");
    window.click("Next event");
    assert_eq!(window.frame().event_count, 1);
    window.click_role(Role::ComboBox, "Method");
    window.click_role(Role::Button, "exact");
    assert_eq!((window.frame().method, window.frame().time), (Method::Exact, 0.0));
}

#[test]
fn a_dt_that_is_none_is_refused_with_the_reason() {
    let mut window = Window::thesis();
    window.type_text("Δt", "fast");
    assert!(window.has_containing("is not a number"));
    assert_eq!(window.harness.state().session().playback().dt_text(), "1/60");
}

#[test]
fn keys_drive_the_transport() {
    let mut window = Window::thesis();
    window.key(Key::Period);
    window.key(Key::Period);
    assert_eq!(window.frame().dt_index, 2);
    window.key(Key::Comma);
    assert_eq!(window.frame().dt_index, 1);
    window.key(Key::N);
    assert_eq!(window.frame().event_count, 1);
    window.key(Key::End);
    assert!(window.frame().open_step.is_none());
    window.key(Key::R);
    assert_eq!(window.frame().time, 0.0);
}

#[test]
fn keys_type_into_a_field_and_do_nothing_else() {
    let mut window = Window::thesis();
    window.key_with(Modifiers::COMMAND, Key::F);
    window.harness.event(egui::Event::Text("n".into()));
    window.key(Key::N);
    window.key(Key::Period);
    assert_eq!((window.frame().event_count, window.frame().dt_index), (0, 0));
}

#[test]
fn a_click_on_an_event_selects_its_bodies_and_marks_the_place() {
    let mut window = Window::thesis();
    window.click("Next event");
    window.click("5853 – 8855");
    let mut wanted = [window.body("5853").key, window.body("8855").key];
    let mut selected = window.selected().to_vec();
    wanted.sort();
    selected.sort();
    assert_eq!(selected, wanted);
    assert!(window.harness.state().session().shown_event().is_some());
}

#[test]
fn the_inspector_shows_start_and_now() {
    let mut window = Window::thesis();
    window.click_role(Role::TreeItem, "15921");
    window.click("Step forward");
    let start = window.harness.get_by_role_and_label(Role::SpinButton, "Position y").value();
    assert_eq!(start.as_deref(), Some("2"));
    let now = window.frame().bodies.iter().find(|body| body.key == window.body("15921").key).unwrap();
    assert!(now.position.y < 2.0);
    assert!(window.has("Kinetic energy") && window.has("Applied force"));
}

#[test]
fn an_edit_that_waits_says_so() {
    let mut window = Window::thesis();
    window.click("Step forward");
    window.click_role(Role::TreeItem, "15921");
    assert!(!window.has_containing("Reset to apply"));
    window.type_number("Velocity x", "1");
    assert!(window.has_containing("Reset to apply"));
    window.key(Key::R);
    assert!(!window.has_containing("Reset to apply"));
}

#[test]
fn overlays_are_switched_in_one_view_alone() {
    let mut window = Window::thesis();
    window.click("Overlays of Top view");
    window.click_role(Role::CheckBox, "Tiles");
    window.key(Key::Escape);
    window.click("Overlays of Front view");
    let tiles = window.harness.get_by_role_and_label(Role::CheckBox, "Tiles");
    assert_eq!(tiles.accesskit_node().toggled(), Some(egui::accesskit::Toggled::False));
}

#[test]
fn views_are_maximised_and_turned() {
    let mut window = Window::thesis();
    let small = window.view_rect("Perspective view").area();
    window.key(Key::M);
    assert!(window.view_rect("Perspective view").area() > 3.0 * small);
    assert!(window.harness.query_by_role_and_label(Role::Canvas, "Top view").is_none());
    window.key(Key::Num2);
    assert!(window.harness.query_by_role_and_label(Role::Canvas, "Top view").is_some());
    window.click("Four views");
    assert!(window.harness.query_by_role_and_label(Role::Canvas, "Right view").is_some());
}

#[test]
fn problems_are_listed_and_fixed() {
    let text =
        String::from_utf8(Window::thesis_bytes()).unwrap().replace("UserID=\"15921\"", "UserID=\"5853\"");
    let mut window = Window::bytes(text.as_bytes());
    assert!(window.has("Problems (1 warnings)") || window.has("Problems (1 warning)"));
    window.harness.get_by_label_contains("Problems (").click();
    window.harness.run();
    window.click_role(Role::Button, "Make IDs unique");
    assert!(window.has("Problems"), "none is left");
    let ids: BTreeSet<i64> = window.scene().bodies.iter().map(|body| body.id).collect();
    assert_eq!(ids.len(), 13);
}

#[test]
fn a_file_with_errors_shows_them_instead_of_views() {
    let window = Window::bytes(b"<PolyPhysicsXml Version=\"1.0\"><Map>");
    assert!(window.has("Show the problems"));
    assert!(window.has_containing("error"));
}

#[test]
fn every_command_is_in_a_menu_or_the_palette() {
    let mut window = Window::thesis();
    for menu in Menu::ALL {
        window.click_role(Role::Button, menu.label());
        let labels: Vec<String> = window
            .harness
            .get_all_by_role(Role::Button)
            .filter_map(|node| node.accesskit_node().label())
            .collect();
        for row in COMMANDS.iter().filter(|row| row.menu == menu) {
            let found = labels.iter().any(|label| label.starts_with(row.label));
            assert!(found, "{} is not in {}: {labels:?}", row.label, menu.label());
        }
        window.key(Key::Escape);
    }
}

#[test]
fn every_command_is_carried_out_by_someone() {
    let mut window = Window::thesis();
    for row in COMMANDS {
        window.key_with(Modifiers::COMMAND, Key::A);
        window.key_with(Modifiers::COMMAND, Key::P);
        window.harness.event(egui::Event::Text(row.label.to_owned()));
        window.harness.step();
        // a debug assertion fails if nobody knows the command
        window.harness.key_press(Key::Enter);
        window.harness.run_steps(2);
        window.harness.key_press(Key::Escape);
        window.harness.run_steps(2);
        let session = window.harness.state().session();
        if session.is_dirty() || session.title() != "scene.xml" || session.is_busy() {
            window = Window::thesis();
        }
    }
}

#[test]
fn the_palette_finds_samples_and_overlays() {
    let mut window = Window::thesis();
    window.key_with(Modifiers::COMMAND, Key::P);
    window.harness.event(egui::Event::Text("newton".into()));
    window.harness.run();
    window.key(Key::Enter);
    assert!(window.harness.state().session().title().contains("cradle"));
    for overlay in OVERLAYS {
        window.key_with(Modifiers::COMMAND, Key::P);
        window.harness.event(egui::Event::Text(format!("Overlay: {}", overlay.label)));
        window.harness.run();
        window.key(Key::Enter);
    }
}

#[test]
fn an_idle_window_rests() {
    let mut window = Window::thesis();
    window.click("Step forward");
    // one pass more than the one asked for would mean that something asks again and again
    assert_eq!(window.harness.run(), 1);
    window.harness.hover_at(pos2(3.0, 3.0));
    assert!(window.harness.run() <= 3);
}

impl Window {
    fn thesis_bytes() -> Vec<u8> {
        std::fs::read(super::gui_support::sample_path("thesis-appendix-2")).unwrap()
    }
}

/// Symptom: at its smallest the tool bar drew its right half over the speeds, and the buttons of problems lay beyond the
/// edge of their panel in a window of 1280 × 720.
#[test]
fn what_a_small_window_shows_can_be_reached() {
    let mut window = Window::thesis();
    window.harness.set_size(vec2(800.0, 500.0));
    window.harness.run_steps(4);
    let bar = |rect: &egui::Rect| rect.center().y > 25.0 && rect.center().y < 58.0;
    let buttons = window.harness.query_all_by_role(Role::Button).map(|node| node.rect());
    let choices = window.harness.query_all_by_role(Role::ComboBox).map(|node| node.rect());
    let rects: Vec<egui::Rect> = buttons.chain(choices).filter(bar).collect();
    assert!(rects.len() > 8, "{rects:?}");
    for (nth, a) in rects.iter().enumerate() {
        assert!(rects[..nth].iter().all(|b| !a.shrink(1.0).intersects(b.shrink(1.0))), "{a:?} in {rects:?}");
    }

    let mut window = Window::empty();
    window.harness.set_size(vec2(1280.0, 720.0));
    window.menu("Add", "Dynamic sphere");
    window.menu("Add", "Dynamic sphere");
    window.type_number("Position x", "5.4");
    window.type_number("Position y", "5");
    window.type_number("Position z", "5");
    window.click("Problems (1 warning)");
    let edge = window.harness.get_by_label("Inspector").rect().left();
    let button = window.harness.get_by_role_and_label(Role::Button, "Push apart").rect();
    assert!(button.right() < edge, "{button:?} beyond {edge}");
}

/// Symptom: at 800 × 500 the errors in the status bar ran out of its right edge. Expected: they are whole, what stands before
/// them gives way. Cause: only the numbers looked at the room there is.
#[test]
fn the_smallest_window_shows_the_errors_whole() {
    let whole = egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(800.0, 500.0));
    let mut window = Window::sample("bin");
    window.harness.set_size(whole.size());
    window.harness.run_steps(4);
    (0..3).for_each(|_| window.key(Key::N));
    let errors = window.harness.get_by_label_contains("Errors: ").rect();
    assert!(whole.contains_rect(errors), "{errors:?}");
}

/// Symptom: in narrow windows undo, what is added, the time and the goals were not in the tool bar. Expected: a menu has them.
#[test]
fn a_narrow_tool_bar_has_the_rest_in_a_menu() {
    for (width, has_time) in [(800.0, false), (1100.0, true), (1280.0, true)] {
        let mut window = Window::thesis();
        window.harness.set_size(vec2(width, 500.0));
        window.harness.run_steps(4);
        let time = window.harness.query_by_role_and_label(Role::TextInput, "t");
        assert_eq!(time.is_some(), has_time, "{width}");
        assert_eq!(window.has("More"), width < 1200.0, "{width}");
        for choice in ["Method", "Speed"] {
            assert!(
                window.harness.query_by_role_and_label(Role::ComboBox, choice).is_some(),
                "{width} {choice}"
            );
        }
        if width > 1200.0 {
            continue;
        }
        window.click("More");
        window.click("Dynamic sphere");
        assert_eq!(window.scene().bodies.len(), 14, "{width}");
        window.click("More");
        window.harness.get_by_label_contains("Undo: ").click();
        window.harness.run();
        assert_eq!(window.scene().bodies.len(), 13, "{width}");
    }
    let mut window = Window::thesis();
    window.harness.set_size(vec2(800.0, 500.0));
    window.harness.run_steps(4);
    window.click("More");
    super::gui_timeline::type_time(&mut window, "0.5");
    assert_eq!(window.frame().time, 0.5);
    window.click("Run");
    window.click("For 10 events");
    assert_eq!(window.frame().event_count, 10);
}

/// Symptom: in a new scene without gravity playing showed nothing, without a word. Expected: it says so and offers gravity.
#[test]
fn a_run_in_which_nothing_can_move_says_so() {
    let mut window = Window::empty();
    window.menu("Add", "Static sphere");
    window.key(Key::Period);
    assert!(window.has_containing("nothing moves"), "there is no moving body");
    window.menu("Add", "Dynamic sphere");
    window.key(Key::R);
    assert!(!window.has_containing("nothing moves"), "it has not begun");
    window.key(Key::Period);
    window.harness.get_by_label_contains("nothing moves").click();
    window.harness.run();
    assert!(window.has("Nothing moves: no gravity, no velocities."));
    window.click("Add gravity");
    assert_eq!((window.scene().forces.len(), window.frame().time), (1, 0.0));
    window.key(Key::Period);
    assert!(!window.has_containing("nothing moves"));
    assert!(window.frame().bodies[0].velocity.y < 0.0);
    let mut window = Window::thesis();
    window.key(Key::Period);
    assert!(!window.has_containing("nothing moves"));
}

/// Symptom: after a step the units of angles and spins were cut off at the edge of the inspector. Cause: the column of what is
/// now pushed them out.
#[test]
fn the_inspector_shows_its_units_whole() {
    let is_unit = |text: &str| ["m", "rad", "m/s", "rad/s", "kg"].contains(&text) || text.starts_with("= ");
    for size in [vec2(1280.0, 720.0), vec2(800.0, 500.0)] {
        let mut window = Window::thesis();
        window.harness.set_size(size);
        window.click_role(Role::TreeItem, "5853");
        (0..3).for_each(|_| window.key(Key::N));
        window.harness.run_steps(4);
        let left = window.harness.get_by_label("Inspector").rect().left();
        let texts = window.harness.query_all_by_role(Role::Label);
        let rects: Vec<_> = texts
            .map(|node| (node.rect(), node.accesskit_node().label().or(node.value())))
            .filter(|(rect, text)| rect.left() > left && text.as_deref().is_some_and(is_unit))
            .collect();
        assert!(rects.len() >= if size.y > 600.0 { 12 } else { 3 }, "{rects:?}");
        for (rect, text) in rects {
            assert!(rect.right() <= size.x - 8.0, "{text:?} at {rect:?} in {size}");
        }
    }
}

#[test]
fn about_says_how_to_report_a_bug() {
    let mut window = Window::thesis();
    window.menu("Help", "About PolyScene");
    for text in [env!("CARGO_PKG_VERSION"), "MIT or Apache-2.0", ".psrec", "Save recording"] {
        assert!(window.has_containing(text), "{text}");
    }
    window.click("Close");
    assert!(!window.has_containing(".psrec"));
}
