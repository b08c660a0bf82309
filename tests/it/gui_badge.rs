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
