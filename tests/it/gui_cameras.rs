//! Views: viewpoints that are saved with the scene, following a body, looking from one, flying, linked views.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable as _;
use glam::{DVec3, dvec3};
use polyscene::view::Camera;

use super::editor_support::SCENE;
use super::gui_support::Window;

#[test]
fn a_viewpoint_is_saved_with_the_scene_and_gone_back_to() {
    let mut window = Window::bytes(SCENE.as_bytes());
    window.click_role(Role::Button, "Perspective");
    window.type_text("Name of the viewpoint", "from the door");
    let saved = window.harness.state().session().document().viewpoints();
    assert_eq!(saved.len(), 1);
    assert!(saved[0].perspective && saved[0].name == "from the door");
    assert_eq!(window.harness.state().session().undo_label(), Some("Change the viewpoints"));
    window.click_role(Role::Button, "Top");
    let labels: Vec<String> = window.labels();
    assert!(labels.iter().any(|label| label == "from the door"), "{labels:?}");
    window.click_role(Role::Button, "from the door");
    assert!(window.harness.query_all_by_role_and_label(Role::Canvas, "Perspective view").count() == 2);
    window.click_role(Role::Button, "Front");
    window.click("Forget viewpoint from the door");
    assert!(window.harness.state().session().document().viewpoints().is_empty());
}

#[test]
fn a_view_follows_a_body_until_it_is_told_not_to() {
    let mut window = Window::bytes(SCENE.as_bytes());
    window.click_role(Role::TreeItem, "8");
    window.menu("View", "Follow a body");
    assert!(window.has("follows 8 ×"));
    window.key(Key::Period);
    window.click("follows 8 ×");
    assert!(!window.has("follows 8 ×"));
}

impl Window {
    /// Where the camera of a view is, by saving it as a viewpoint.
    fn camera(&mut self, title: &str) -> Camera {
        self.click_role(Role::Button, title);
        self.type_text("Name of the viewpoint", "probe");
        let saved = self.harness.state().session().document().viewpoints();
        let probe = saved.iter().find(|viewpoint| viewpoint.name == "probe").expect("a viewpoint");
        Camera::of_viewpoint(probe)
    }

    fn hold(&mut self, key: Key, turns: usize) {
        for pressed in [true, false] {
            let event =
                Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE };
            self.harness.event(event);
            (0..turns).for_each(|_| self.harness.step());
        }
        self.harness.run();
    }
}

#[test]
fn a_view_looks_from_a_body_along_its_way_and_goes_back() {
    let mut window = Window::bytes(SCENE.as_bytes());
    let before = window.camera("Perspective");
    window.click_role(Role::TreeItem, "8");
    window.menu("View", "Look from a body");
    assert!(window.has("looks from 8 ×"));
    let start = window.camera("Perspective");
    assert!(start.eye().distance(dvec3(7.0, 3.0, 3.0)) < 1e-12, "{start:?}");
    assert!((start.backward() + DVec3::X).length() < 1e-12, "along its velocity: {start:?}");
    (0..4).for_each(|_| window.key(Key::Period));
    let key = window.body("8").key;
    let now = window.frame().bodies.iter().find(|body| body.key == key).cloned().unwrap();
    assert!(now.velocity.y < -0.1, "it falls");
    let moved = window.camera("Perspective");
    assert!(moved.eye().distance(now.position) < 1e-12, "it moves along");
    assert!((moved.backward() + now.velocity.normalize()).length() < 1e-12, "and turns along");
    window.key_with(Modifiers::SHIFT, Key::E);
    assert!(!window.has("looks from 8 ×"));
    assert_eq!(window.camera("Perspective"), before, "back to where it was");
}

#[test]
fn a_view_from_a_body_at_rest_keeps_its_direction_and_can_be_turned() {
    let mut window = Window::bytes(SCENE.as_bytes());
    let before = window.camera("Perspective");
    window.click_role(Role::TreeItem, "7");
    window.key_with(Modifiers::SHIFT, Key::E);
    let start = window.camera("Perspective");
    assert_eq!((start.yaw, start.pitch), (before.yaw, before.pitch));
    let middle = window.view_rect("Perspective view").center();
    window.drag(&[middle, middle + vec2(30.0, 10.0)], PointerButton::Middle, Modifiers::NONE);
    let turned = window.camera("Perspective");
    assert!((turned.yaw - start.yaw).abs() > 0.1 && (turned.pitch - start.pitch).abs() > 0.03, "{turned:?}");
    assert!(turned.eye().distance(DVec3::splat(3.0)) < 1e-12, "the eye stays in the body");
}

#[test]
fn looking_from_nothing_says_what_is_missing() {
    let mut window = Window::bytes(SCENE.as_bytes());
    window.key_with(Modifiers::SHIFT, Key::E);
    assert!(window.has_containing("Select the body to look from first"));
}

#[test]
fn keys_fly_through_the_scene_until_escape() {
    let mut window = Window::bytes(SCENE.as_bytes());
    let before = window.camera("Perspective");
    window.menu("View", "Fly");
    assert!(window.has_containing("maps/s"));
    window.hold(Key::W, 6);
    let middle = window.view_rect("Perspective view").center();
    window.harness.event(Event::PointerMoved(middle));
    window.harness.run();
    window.harness.event(Event::PointerMoved(middle + vec2(40.0, 0.0)));
    window.harness.run();
    window.key(Key::Escape);
    assert!(!window.has_containing("maps/s ×"));
    let after = window.camera("Perspective");
    let way = after.eye() - before.eye();
    assert!(way.length() > 0.05 && (way.normalize() + before.backward()).length() < 1e-9, "ahead: {way}");
    assert!((after.yaw - before.yaw).abs() > 0.05, "the mouse turns: {after:?}");
    // W was for flying alone, and means the handles again
    window.key(Key::Q);
    assert_eq!(window.harness.state().session().undo_label(), Some("Change the viewpoints"));
}

#[test]
fn linked_axis_views_move_and_magnify_together() {
    let mut window = Window::bytes(SCENE.as_bytes());
    let scale = |window: &mut Window, title: &str| {
        let height = window.view_rect(&format!("{title} view")).height();
        window.camera(title).height / f64::from(height)
    };
    let drag = |window: &mut Window| {
        let middle = window.view_rect("Top view").center();
        window.drag(&[middle, middle + vec2(40.0, 20.0)], PointerButton::Middle, Modifiers::NONE);
    };
    let front = window.camera("Front");
    drag(&mut window);
    assert_eq!(window.camera("Front"), front, "each for itself at first");
    window.menu("View", "Link the axis views");
    drag(&mut window);
    let top = window.camera("Top");
    for title in ["Front", "Right"] {
        assert_eq!(window.camera(title).target, top.target, "{title}");
        let (one, other) = (scale(&mut window, title), scale(&mut window, "Top"));
        assert!((one / other - 1.0).abs() < 1e-6, "{title}: {one} {other}");
    }
    let perspective = window.camera("Perspective");
    let middle = window.view_rect("Right view").center();
    window.harness.event(Event::PointerMoved(middle));
    window.harness.run();
    window.harness.event(Event::Zoom(1.5));
    window.harness.run();
    let (one, other) = (scale(&mut window, "Right"), scale(&mut window, "Top"));
    assert!((one / other - 1.0).abs() < 1e-6 && window.camera("Top").height < top.height, "{one} {other}");
    assert_eq!(window.camera("Perspective"), perspective);
    window.click_role(Role::Button, "View");
    assert!(window.has_containing("Link the axis views: on"));
}
