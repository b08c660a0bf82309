//! The error badge: what it says, and that a click goes to the event it names.

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};

use super::gui_support::Window;

impl Window {
    /// The badge's accessible name.
    fn badge(&self) -> String {
        let badge = self.harness.get_by_label_contains("Errors: ");
        badge.accesskit_node().label().expect("a name")
    }
}

#[test]
fn the_badge_says_how_wrong_and_goes_to_the_worst_event() {
    let mut window = Window::thesis();
    assert!(window.badge().starts_with("Errors: ΔE 0  Δp 0  overlap 0 m  0 events/Δt"), "{}", window.badge());
    window.click_role(Role::ComboBox, "Method");
    window.click_role(Role::Button, "thesis");
    window.type_text("Δt", "1");
    (0..8).for_each(|_| window.click("Step forward"));
    let jump = window.frame().largest_jump.expect("the thesis's stepping drifts");
    assert!(window.badge().ends_with(&format!("go to event {}", jump.event)), "{}", window.badge());
    assert!(window.has(&format!("most at event {}", jump.event)));
    // drift is told by a shape too
    assert!(window.has("warning"));
    assert!(window.frame().events.iter().all(|row| row.event.seq != jump.event), "it lies before this Δt");
    window.click("Problems");
    let badge = window.badge();
    window.click(&badge);
    window.harness.run();
    let shown = window.harness.state().session().shown_event().expect("an event is shown").clone();
    assert_eq!((shown.event.seq, window.frame().event_count), (jump.event, jump.event));
    assert_eq!(window.frame().largest_jump, Some(jump), "it is still the largest up to there");
    assert!(window.selected().contains(&shown.a_key));
    assert!(window.has("Impulse [N·s]"), "the list of events is open");
}

#[test]
fn exact_stays_quiet() {
    let mut window = Window::thesis();
    window.type_text("Δt", "1");
    (0..5).for_each(|_| window.click("Step forward"));
    assert!(!window.has("warning"));
    assert!(window.badge().contains("events/Δt") || window.badge().contains("event/Δt"));
}

#[test]
fn contacts_resolved_together_say_so() {
    let mut window = Window::bytes(include_bytes!("../../scenes/hard/cradle-3.xml"));
    (0..200).for_each(|_| {
        if window.frame().events.len() < 2 {
            window.click("Step forward");
        }
    });
    let group = window.frame().events[0].event.group;
    let together = window.frame().events.iter().filter(|row| row.event.group == group).count();
    assert!(group > 0 && together > 1, "the cradle's contacts share a group");
    assert!(window.has(&format!("impact 1/{together}")));
}

#[test]
fn what_the_scene_does_not_need_is_listed() {
    let window = Window::thesis();
    assert!(!window.frame().plan.left_out.is_empty());
    window.frame().plan.left_out.iter().for_each(|reason| assert!(window.has_containing(reason), "{reason}"));
}

/// Symptom: what a movement had to say was told as an edit that was not applied and waits for a reset. Expected: it is told as it is.
/// Cause: a frame had one field for both.
#[test]
fn back_from_the_first_event_says_why_not() {
    let mut window = Window::thesis();
    window.click("Next event");
    window.click("Event back");
    assert!(window.has_containing("there is no recorded event before this one"));
    assert!(!window.has_containing("Not applied") && !window.has_containing("to apply"));
}
