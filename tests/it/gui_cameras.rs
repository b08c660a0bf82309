//! Views: viewpoints that are saved with the scene, following a body, framing.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

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
