//! The text of the file beside the picture: what is selected is in sight, a click selects, changes are listed, pieces are copied.

use egui::Modifiers;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use super::gui_support::Window;

impl Window {
    fn xml(id: &str) -> Self {
        let mut window = Self::sample(id);
        window.click("XML");
        window
    }

    fn click_containing(&mut self, text: &str) {
        let node = self.harness.query_all_by_label_contains(text).next().unwrap_or_else(|| panic!("{text}"));
        node.click();
        self.harness.run();
    }

    /// What was put on the clipboard last.
    fn copied(&self) -> Option<String> {
        let commands = &self.harness.output().platform_output.commands;
        commands.iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        })
    }
}

#[test]
fn what_is_selected_scrolls_into_sight_and_a_line_selects() {
    let mut window = Window::xml("pyramid-hit");
    let last = window.scene().bodies.last().unwrap().clone();
    let text = format!("UserID=\"{}\"", last.id);
    assert!(!window.has_containing(&text), "the file is longer than the panel");
    let key = last.key;
    window.harness.get_by_role_and_label(Role::TextInput, "Filter").click();
    window.harness.run();
    window.type_text("Filter", last.display_name());
    window.click_role(Role::TreeItem, last.display_name());
    assert_eq!(window.selected(), [key]);
    assert!(window.has_containing(&text), "{text} is in sight");
}

#[test]
fn a_click_on_a_line_selects_its_body() {
    let mut window = Window::xml("bounce");
    let first = window.scene().forces[0].key;
    // Seen, so that it can be clicked.
    window.click_role(Role::TreeItem, "Gravity");
    window.key(egui::Key::Escape);
    assert!(window.selected().is_empty());
    window.click_containing("<GravityPlane");
    assert_eq!(window.selected(), [first]);
    let before = window.selected().to_vec();
    window.click_containing("<Forces>");
    assert_eq!(window.selected(), before, "that line is no body");
}

#[test]
fn changes_since_saving_are_listed() {
    let mut window = Window::xml("bounce");
    window.click("Changes");
    assert!(window.has_containing("the file holds this very text"));
    let name = window.scene().bodies.iter().find(|body| body.is_dynamic()).unwrap().display_name().to_owned();
    window.click_role(Role::TreeItem, &name);
    window.type_number("Mass", "3.25");
    assert!(window.has_containing("+ ") && window.has_containing("3.25\""), "{:?}", window.labels());
    assert!(window.has_containing("− "));
    window.key_with(Modifiers::COMMAND, egui::Key::S);
    assert!(window.has_containing("the file holds this very text"));
}

#[test]
fn elements_are_copied_as_they_stand() {
    let mut window = Window::xml("bounce");
    window.click_role(Role::TreeItem, "Gravity");
    window.harness.get_by_label("Copy as XML").click();
    window.harness.step();
    let copied = window.copied();
    window.harness.run();
    let copied = copied.or_else(|| window.copied()).expect("a copy");
    assert!(
        copied.starts_with("<GravityPlane") && copied.trim_end().ends_with("</GravityPlane>"),
        "{copied}"
    );
    assert!(window.saved().contains(copied.trim_end()));
}
