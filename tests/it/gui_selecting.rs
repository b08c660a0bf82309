//! Selecting in the views by drawing: an outline by hand, and what lies behind other bodies.

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::Queryable as _;
use glam::{DVec3, dvec3};

use super::editor_support::SCENE;
use super::gui_support::Window;

impl Window {
    /// Draws in the Top view through places on the ground.
    fn draw_on_top(&mut self, places: &[DVec3], modifiers: Modifiers) {
        let way: Vec<Pos2> = places.iter().map(|place| self.on_view(1, "Top view", *place)).collect();
        self.drag(&way, PointerButton::Primary, modifiers);
    }

    fn selected_labels(&self) -> Vec<&str> {
        let bodies = self.scene().bodies.iter();
        bodies.filter(|body| self.selected().contains(&body.key)).map(|body| body.label.as_str()).collect()
    }
}

/// Around one ball, as (x, z) around its centre.
fn around(center: DVec3) -> Vec<DVec3> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    corners.map(|(x, z)| center + dvec3(x, 0.0, z)).to_vec()
}

#[test]
fn an_outline_selects_what_it_holds_and_may_begin_on_a_body() {
    let mut window = Window::bytes(SCENE.as_bytes());
    let (seven, eight) = (DVec3::splat(3.0), dvec3(7.0, 3.0, 3.0));
    window.draw_on_top(&around(eight), Modifiers::ALT);
    assert_eq!(window.selected_labels(), ["8"]);
    window.draw_on_top(&around(seven), Modifiers::ALT | Modifiers::SHIFT);
    assert_eq!(window.selected_labels(), ["7", "8"], "Shift adds");
    // a hook that goes around 7 and not through its centre, though the rectangle around it would hold it
    let hook = [(2.0, 2.0), (4.0, 2.0), (4.0, 2.3), (2.3, 2.3), (2.3, 4.0), (2.0, 4.0)];
    let hook: Vec<DVec3> = hook.map(|(x, z)| dvec3(x, 3.0, z)).to_vec();
    window.draw_on_top(&hook, Modifiers::ALT);
    assert_eq!(window.selected_labels(), [""; 0]);
    // it began on 7, which stays where it is
    let from_within: Vec<DVec3> = std::iter::once(seven).chain(around(seven)).collect();
    window.draw_on_top(&from_within, Modifiers::ALT);
    assert_eq!(window.body("7").position, seven);
    assert_eq!(window.harness.state().session().undo_label(), None);
}

#[test]
fn what_lies_behind_is_selected_through_or_not() {
    let mut window = Window::bytes(SCENE.as_bytes());
    window.click_role(Role::TreeItem, "7");
    window.type_number("Position x", "7");
    window.type_number("Position y", "5");
    window.draw_on_top(&around(dvec3(7.0, 3.0, 3.0)), Modifiers::ALT);
    assert_eq!(window.selected_labels(), ["7", "8"], "through, as it begins");
    window.menu("View", "Select through: on");
    window.draw_on_top(&around(dvec3(7.0, 3.0, 3.0)), Modifiers::ALT);
    assert_eq!(window.selected_labels(), ["7"], "the upper one alone");
    let corners = around(dvec3(7.0, 3.0, 3.0));
    window.draw_on_top(&[corners[0], corners[2]], Modifiers::NONE);
    assert_eq!(window.selected_labels(), ["7"], "a rectangle alike");
    window.key(Key::Questionmark);
    let help = window.harness.query_all_by_label_contains("Alt + drag").next();
    assert!(help.is_some(), "the list of keys and gestures says it");
}
