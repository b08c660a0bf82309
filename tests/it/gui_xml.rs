//! The text of the file beside the picture: what is selected is in sight, a click selects, changes are listed, pieces are copied,
//! and what is typed is checked and applied.

use egui::Modifiers;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::gui_support::Window;

const FIELD: &str = "Text of the file";

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

    /// Replaces the whole text that is being edited.
    fn type_file(&mut self, text: &str) {
        self.harness.get_by_role_and_label(Role::MultilineTextInput, FIELD).focus();
        self.harness.run();
        self.key_with(Modifiers::COMMAND, egui::Key::A);
        self.harness.event(egui::Event::Paste(text.to_owned()));
        self.harness.run();
    }

    fn edited(&self) -> Option<String> {
        self.harness.query_by_role_and_label(Role::MultilineTextInput, FIELD)?.value()
    }

    fn is_enabled(&self, button: &str) -> bool {
        !self.harness.get_by_role_and_label(Role::Button, button).accesskit_node().is_disabled()
    }

    fn close(&mut self) {
        let viewport = self.harness.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
        viewport.events.push(egui::ViewportEvent::Close);
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

#[test]
fn a_text_is_edited_and_applied_as_one_step_while_the_run_goes_on() {
    let mut window = Window::xml("bounce");
    let before = window.saved();
    let (ball, key) = {
        let ball = window.scene().bodies.iter().find(|body| body.is_dynamic()).unwrap();
        (ball.display_name().to_owned(), ball.key)
    };
    window.click_role(Role::TreeItem, &ball);
    window.key(egui::Key::Period);
    let time = window.frame().time;
    assert!(time > 0.0);
    window.click_role(Role::Button, "Edit text");
    assert!(!window.is_enabled("Apply"), "nothing was changed");
    let new = before.replace("-9,8", "-1,6").replace("-9.8", "-1.6");
    assert_ne!(before, new);
    window.type_file(&new.replace("\r\n", "\n"));
    assert!(window.has("no errors"), "{:?}", window.labels());
    window.click_role(Role::Button, "Apply");
    assert_eq!(String::from_utf8(window.harness.state().session().document().to_bytes()).unwrap(), new);
    assert!(window.edited().is_none(), "the text is read again");
    assert_eq!((window.frame().time, window.selected()), (time, &[key][..]), "run and selection go on");
    let gravity = window.frame().bodies[0].acceleration.y;
    assert!((gravity + 1.6).abs() < 1e-9, "{gravity}");
    window.menu("Edit", "Undo");
    assert_eq!(String::from_utf8(window.harness.state().session().document().to_bytes()).unwrap(), before);
}

/// What is wrong is told while it is typed, never applied, and not lost by a click elsewhere.
#[test]
fn a_text_with_errors_stays_until_it_is_mended_or_reverted() {
    let mut window = Window::xml("bounce");
    let before = window.saved().replace("\r\n", "\n");
    window.click_role(Role::Button, "Edit text");
    let at = before.find("<Weight").or_else(|| before.find("<Translation")).unwrap();
    let wrong = format!("{}<Weight F32=\"heavy\" />{}", &before[..at], &before[at..]);
    let line = before[..at].lines().count();
    window.type_file(&wrong);
    assert!(window.has_containing("error"), "{:?}", window.labels());
    assert!(window.has_containing(&format!("{line}:")), "{line}: {:?}", window.labels());
    assert!(!window.is_enabled("Apply"));

    window.click_role(Role::TreeItem, "Gravity");
    window.click("Problems");
    window.click("XML");
    window.click("Changes");
    window.click("Text");
    assert_eq!(window.edited().as_deref(), Some(&*wrong));
    assert!(!window.harness.state().session().is_dirty());

    // A tag that is never closed is no XML at all.
    window.type_file("<PolyPhysicsXml>");
    assert!(window.has("1 error") && !window.is_enabled("Apply"));
    window.type_file(&before.replace("<Map>", "<Map><!-- mended -->"));
    assert!(window.has("no errors") && window.is_enabled("Apply"));
    window.click_role(Role::Button, "Revert");
    assert!(window.edited().is_none());
    assert!(!window.harness.state().session().is_dirty());

    // Edited elsewhere meanwhile: said, and one undo step leads back.
    window.click_role(Role::Button, "Edit text");
    window.type_file(&before.replace("<Map>", "<Map><!-- mine -->"));
    window.click_role(Role::TreeItem, "Gravity");
    window.key(egui::Key::Delete);
    let deleted = window.harness.state().session().document().to_bytes();
    assert!(window.has_containing("the scene changed meanwhile"), "{:?}", window.labels());
    window.click_role(Role::Button, "Apply");
    assert_eq!(window.scene().forces.len(), 1);
    window.menu("Edit", "Undo");
    assert_eq!(window.harness.state().session().document().to_bytes(), deleted);
}

#[test]
fn a_file_that_is_no_scene_is_mended_in_the_window() {
    let good = String::from_utf8(Window::sample("bounce").saved().into_bytes()).unwrap();
    let mut window = Window::bytes(good.replace("</Map>", "").as_bytes());
    window.click("XML");
    window.click_role(Role::Button, "Edit text");
    assert!(window.has("1 error"), "{:?}", window.labels());
    window.type_file(&good.replace("\r\n", "\n"));
    window.click_role(Role::Button, "Apply");
    assert!(!window.scene().bodies.is_empty());
    window.key(egui::Key::Period);
    assert!(window.frame().time > 0.0, "it runs");
}

/// Symptom: closing the window dropped what was typed in the text. Expected: a question, as before changes are lost.
#[test]
fn closing_the_window_asks_about_text_that_is_not_applied() {
    let mut window = Window::xml("bounce");
    let text = window.saved().replace("\r\n", "\n").replace("<Map>", "<Map><!-- mine -->");
    window.click_role(Role::Button, "Edit text");
    window.close();
    assert!(!window.has("Text not applied"), "nothing was typed");
    window.type_file(&text);
    window.close();
    assert!(window.has("Text not applied"));
    window.click_role(Role::Button, "Cancel");
    assert_eq!(window.edited().as_deref(), Some(&*text));
    window.key_with(Modifiers::COMMAND, egui::Key::N);
    window.click_role(Role::Button, "Discard");
    assert!(window.scene().bodies.is_empty() && window.edited().is_none(), "a new scene, and its text");

    window.click_role(Role::Button, "Edit text");
    let text = window.edited().unwrap().replace("<Map>", "<Map><!-- mine -->");
    window.type_file(&text);
    window.close();
    window.harness.get_all_by_role_and_label(Role::Button, "Apply").last().unwrap().click();
    window.harness.run();
    assert!(window.has("Unsaved changes"));
    window.click_role(Role::Button, "Discard");
    window.close();
    assert!(!window.has("Unsaved changes"), "it was said that they may go");
}

/// A turn in which something is typed and the window is closed.
#[test]
fn the_last_letter_before_closing_is_not_lost() {
    let mut window = Window::xml("bounce");
    window.click_role(Role::Button, "Edit text");
    window.harness.get_by_role_and_label(Role::MultilineTextInput, FIELD).focus();
    window.harness.run();
    window.harness.event(egui::Event::Text(" ".to_owned()));
    window.close();
    assert!(window.has("Text not applied"));
}
