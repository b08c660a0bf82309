//! The Accuracy panel: a study on its thread, its figures, its files, and that it rests.

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

use super::gui_support::Window;
use polyscene::study::AXES;

impl Window {
    /// Opens the panel with few and quick runs.
    fn accuracy(id: &str, until: &str) -> Self {
        let mut window = Self::sample(id);
        window.click("Accuracy");
        window.type_text("Until", until);
        window.type_text("Δt list", "1/30, 1/120");
        window.type_text("Repeat", "1");
        window
    }

    fn wait_for_study(&mut self) {
        let since = Instant::now();
        // The click itself takes a turn, in which the button is still there.
        self.harness.step();
        while !self.has("Run study") {
            assert!(since.elapsed() < Duration::from_secs(120), "the study does not end");
            std::thread::sleep(Duration::from_millis(20));
            self.harness.step();
        }
        self.harness.run();
    }
}

#[test]
fn a_study_runs_beside_the_window_and_shows_its_figures() {
    let mut window = Window::accuracy("bounce", "2");
    window.harness.get_by_label("Run study").click();
    window.harness.step();
    window.wait_for_study();
    assert!(window.has_containing("over the whole 2.000 s"));
    // In a narrow panel the figures are below the diagram.
    window.harness.set_size(egui::vec2(1600.0, 1200.0));
    window.harness.run();
    for text in ["exact", "thesis", "fixed", "1/30 s", "1/120 s", "position [m]", "missed"] {
        assert!(window.harness.query_all_by_label(text).next().is_some(), "{text}");
    }
    assert!(window.has("Diagram of position error over wall time"));
    // nothing asks for another turn
    assert_eq!(window.harness.run(), 1);
    window.harness.get_by_role_and_label(Role::ComboBox, "Shown").click();
    window.harness.run();
    for axis in &AXES[1..] {
        assert!(window.has_containing(axis.title), "{}", axis.title);
    }
    window.click_role(Role::Button, "Energy residual");
    assert!(window.has("Diagram of energy residual over wall time"));
}

/// Symptom: a study did not end while another panel lay before that of accuracy, and `--do study` waited for ever.
#[test]
fn a_study_ends_behind_another_panel() {
    let mut window = Window::accuracy("bounce", "1");
    window.harness.get_by_label("Run study").click();
    window.harness.step();
    window.harness.step();
    window.harness.get_by_label_contains("Events (").click();
    let since = Instant::now();
    window.harness.step();
    while window.harness.query_by_label("Accuracy (running)").is_some() {
        assert!(since.elapsed() < Duration::from_secs(60), "the study does not end");
        std::thread::sleep(Duration::from_millis(20));
        window.harness.step();
    }
    window.click("Accuracy");
    assert!(window.has_containing("over the whole 1.000 s"));
}

#[test]
fn figures_of_a_scene_edited_since_say_so() {
    let mut window = Window::accuracy("bounce", "1");
    window.click("Run study");
    window.wait_for_study();
    assert!(!window.has_containing("was edited since"));
    window.menu("Add", "Static sphere");
    assert!(window.has_containing("was edited since"));
    window.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    assert!(!window.has_containing("was edited since"), "undone, it is the scene studied");
}

#[test]
fn a_study_is_cancelled_and_keeps_what_is_done() {
    let mut window = Window::accuracy("gas", "1000");
    window.harness.get_by_label("Run study").click();
    window.harness.step();
    window.harness.step();
    assert!(window.has("Cancel study"));
    assert!(window.has("Accuracy (running)"));
    window.harness.get_by_label("Cancel study").click();
    window.harness.step();
    window.wait_for_study();
    assert!(window.has_containing("Cancelled"));
}

#[test]
fn knobs_that_are_wrong_are_named() {
    let mut window = Window::accuracy("bounce", "2");
    window.type_text("Δt list", "1/30, x");
    assert!(window.has("Δt list is not a number or a list of numbers"));
    window.type_text("Δt list", "5");
    assert!(window.has_containing("Δt list must lie between"));
    window.type_text("Δt list", "0.1; 1/20");
    window.click("exact");
    window.click("thesis");
    window.click("fixed");
    assert!(window.has("Methods must name at least one method"));
}

#[test]
fn reports_are_exported() {
    let mut window = Window::accuracy("bounce", "1");
    window.click("Run study");
    window.wait_for_study();
    for (button, extension, start) in [("Export CSV…", "csv", "method,dt_s"), ("Export SVG…", "svg", "<svg")]
    {
        window.click(button);
        assert!(window.has("Export the study as"), "{button}");
        let path = window.folder.path().join(format!("figures.{extension}"));
        window.type_text("File name or path", path.to_str().unwrap());
        assert!(window.has_containing("Wrote"), "{button}");
        assert!(std::fs::read_to_string(&path).unwrap().starts_with(start), "{button}");
    }
}

#[test]
fn the_panel_is_found_in_the_menu() {
    let mut window = Window::thesis();
    window.menu("View", "Accuracy");
    assert!(window.has("Run study"));
    assert!(window.has_containing("How accurate is this scene"));
}
