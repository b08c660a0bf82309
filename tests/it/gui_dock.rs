//! Panels of the window: moved, put behind each other, given room, reset.

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, Rect, vec2};
use egui_kittest::kittest::Queryable as _;

use super::gui_support::Window;

impl Window {
    fn tab(&self, name: &str) -> Rect {
        self.harness.get_by_role_and_label(Role::Button, name).rect()
    }
}

#[test]
fn a_panel_is_put_elsewhere_by_its_tab_and_back_by_reset() {
    let mut window = Window::thesis();
    let (before, inspector) = (window.tab("Problems"), window.tab("Inspector"));
    let onto = inspector.center() + vec2(60.0, 300.0);
    let from = before.center();
    window.drag(&[from, from + vec2(30.0, -30.0), onto, onto], PointerButton::Primary, Modifiers::NONE);
    window.harness.run();
    let moved = window.tab("Problems");
    assert!(moved.left() >= inspector.left() - 1.0, "{moved} is not beside {inspector}");
    window.menu("View", "Reset the panels");
    assert_eq!(window.tab("Problems"), before);
}

#[test]
fn the_lists_keep_their_height_while_stepping() {
    let mut window = Window::thesis();
    let before = window.tab("Problems").top();
    for _ in 0..12 {
        window.key(Key::N);
        assert_eq!(window.tab("Problems").top(), before);
    }
    assert!(window.frame().event_count > 5);
}

#[test]
fn lines_between_panels_are_dragged() {
    let mut window = Window::thesis();
    let before = window.tab("Problems");
    let line = before.left_top() + vec2(150.0, -1.0);
    window.drag(
        &[line, line - vec2(0.0, 20.0), line - vec2(0.0, 90.0)],
        PointerButton::Primary,
        Modifiers::NONE,
    );
    let now = window.tab("Problems");
    assert!((before.top() - now.top() - 90.0).abs() < 3.0, "{before} to {now}");
}

#[test]
fn the_views_take_up_what_the_window_gains() {
    let mut window = Window::thesis();
    let gaps = |window: &Window| {
        let (tree, inspector, lists) = (window.tab("Scene"), window.tab("Inspector"), window.tab("Problems"));
        let size = window.harness.ctx.content_rect();
        (
            window.view_rect("Perspective view").left() - tree.left(),
            size.right() - inspector.left(),
            size.bottom() - lists.top(),
        )
    };
    let before = gaps(&window);
    window.harness.set_size(vec2(1600.0, 1000.0));
    window.harness.run();
    let now = gaps(&window);
    let close = |a: f32, b: f32| (a - b).abs() < 3.0;
    assert!(close(before.0, now.0) && close(before.1, now.1) && close(before.2, now.2), "{before:?} {now:?}");
}
