//! The handles in the views: found by their names, dragged, typed into, each drag one undo point.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::kittest::Queryable as _;
use glam::{DVec3, dvec3};
use polyscene::scene::{Motion, Shape, rotation_matrix};

use super::editor_support::SCENE;
use super::gui_support::Window;

const PRIMARY: PointerButton = PointerButton::Primary;

impl Window {
    /// The middle of a handle.
    fn knob(&self, name: &str, view: &str) -> Pos2 {
        let label = format!("{name} in {view} view");
        let mut found = self.harness.query_all_by_role_and_label(Role::GraphicsSymbol, &label);
        found.next().unwrap_or_else(|| panic!("no handle {label}")).rect().center()
    }

    fn has_knob(&self, name: &str, view: &str) -> bool {
        let label = format!("{name} in {view} view");
        self.harness.query_all_by_role_and_label(Role::GraphicsSymbol, &label).next().is_some()
    }

    fn drag_knob(&mut self, name: &str, view: &str, way: Vec2, modifiers: Modifiers) {
        let from = self.knob(name, view);
        self.drag(&[from, from + 0.4 * way, from + way], PRIMARY, modifiers);
    }

    /// Takes a handle, types, and takes the number by Enter.
    fn type_into_knob(&mut self, name: &str, view: &str, text: &str) {
        let from = self.knob(name, view);
        let to = from + vec2(14.0, 9.0);
        self.press(&[from, from + vec2(8.0, 3.0), to], PRIMARY, Modifiers::NONE);
        self.harness.event(Event::Text(text.to_owned()));
        self.harness.step();
        self.harness.key_press(Key::Enter);
        self.harness.step();
        let release =
            Event::PointerButton { pos: to, button: PRIMARY, pressed: false, modifiers: Modifiers::NONE };
        self.harness.event(release);
        self.harness.run();
    }

    fn undo_label(&self) -> Option<&str> {
        self.harness.state().session().undo_label()
    }
}

/// A floor 30, moving balls 7 at (3, 3, 3) and 8 at (7, 3, 3), both of radius 0.5.
fn scene() -> Window {
    Window::bytes(SCENE.as_bytes())
}

#[test]
fn an_arrow_moves_along_its_axis_as_one_undo_point() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    let metre = window.on_view(1, "Top view", DVec3::X).x - window.on_view(1, "Top view", DVec3::ZERO).x;
    window.drag_knob("Move along x", "Top", vec2(2.0 * metre, 25.0), Modifiers::NONE);
    let moved = window.body("7").position;
    assert!((moved.x - 5.0).abs() < 0.03, "{moved}");
    assert_eq!((moved.y, moved.z), (3.0, 3.0), "only along x");
    assert_eq!(window.undo_label(), Some("Move 7"));
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.body("7").position, DVec3::splat(3.0));
    assert_eq!(window.undo_label(), None);
}

#[test]
fn a_number_typed_while_dragging_is_exact() {
    let mut window = scene();
    // a click gives the view the keyboard, where Enter means another click
    let at = window.on_view(1, "Top view", DVec3::splat(3.0));
    window.click_at(at, Modifiers::NONE);
    window.type_into_knob("Move along x", "Perspective", "2.5");
    assert_eq!(window.body("7").position, dvec3(5.5, 3.0, 3.0));
    window.type_into_knob("Move in the picture", "Perspective", "y-1/4");
    assert_eq!(window.body("7").position, dvec3(5.5, 2.75, 3.0));
    assert_eq!(window.selected().len(), 1);
}

#[test]
fn a_body_is_dragged_over_the_ground_in_perspective() {
    let mut window = scene();
    let start = window.on_view(0, "Perspective view", DVec3::splat(3.0));
    window.drag(&[start, start + vec2(10.0, 3.0), start + vec2(40.0, 12.0)], PRIMARY, Modifiers::NONE);
    let moved = window.body("7").position;
    assert!(moved.distance(DVec3::splat(3.0)) > 0.2, "{moved}");
    assert_eq!(moved.y, 3.0, "the height stays to the bit");
    assert_eq!(window.selected(), [window.body("7").key]);
}

#[test]
fn a_rectangle_drawn_over_a_selected_floor_selects() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "30");
    let floor = window.body("30").position;
    let from = window.on_view(1, "Top view", dvec3(1.0, 0.0, 1.0));
    let to = window.on_view(1, "Top view", dvec3(4.2, 0.0, 4.4));
    window.drag(&[from, from + vec2(9.0, 9.0), to], PRIMARY, Modifiers::NONE);
    assert_eq!(window.body("30").position, floor, "the floor stays");
    assert_eq!(window.selected(), [window.body("7").key]);
}

#[test]
fn a_right_click_selects_what_it_points_at() {
    let mut window = scene();
    let at = window.on_view(1, "Top view", dvec3(7.0, 3.0, 3.0));
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
    for pressed in [true, false] {
        let button = PointerButton::Secondary;
        window.harness.event(Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE });
        window.harness.step();
    }
    window.harness.run();
    assert_eq!(window.selected(), [window.body("8").key]);
    let delete = window.harness.query_all_by_label_contains("Delete").next();
    assert!(delete.is_some(), "its menu is open");
}

#[test]
fn a_ring_turns_a_plate() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "30");
    window.key(Key::E);
    window.type_into_knob("Turn about z", "Front", "30");
    let floor = window.body("30");
    let normal = rotation_matrix(floor.rotation).z_axis;
    let wanted = dvec3(-0.5, 0.75_f64.sqrt(), 0.0);
    assert!(normal.distance(wanted) < 1e-6, "{normal}");
    assert_eq!(floor.position, dvec3(5.0, 0.0, 5.0));
    assert_eq!(window.undo_label(), Some("Rotate 30"));
}

#[test]
fn several_bodies_turn_about_their_middle() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    window.click_with(Role::TreeItem, "8", Modifiers::COMMAND);
    window.key(Key::E);
    window.type_into_knob("Turn about y", "Top", "90");
    assert_eq!(window.body("7").position, dvec3(5.0, 3.0, 5.0));
    assert_eq!(window.body("8").position, dvec3(5.0, 3.0, 1.0));
    assert!(
        matches!(window.body("8").motion, Motion::Dynamic { velocity, .. } if velocity == dvec3(0.0, 0.0, -1.0)),
        "velocities turn with them"
    );
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.body("8").position, dvec3(7.0, 3.0, 3.0));
}

#[test]
fn knobs_change_sizes() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    window.key(Key::S);
    window.type_into_knob("Change radius", "Top", "0,75");
    assert!(matches!(window.body("7").shape, Shape::Sphere { radius } if radius == 0.75));
    window.click_role(Role::TreeItem, "30");
    window.type_into_knob("Side +x", "Top", "12");
    assert_eq!(window.body("30").shape, Shape::Plane { half_x: 6.0, half_y: 5.0 });
    assert_eq!(window.body("30").position.x, 6.0, "the other side stays");
    window.click_role(Role::TreeItem, "Map");
    window.type_into_knob("Map side y", "Front", "15");
    assert_eq!(window.scene().map.size, dvec3(10.0, 15.0, 10.0));
}

#[test]
fn several_are_scaled_about_the_pivot_that_is_chosen() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    window.click_with(Role::TreeItem, "8", Modifiers::COMMAND);
    window.key(Key::S);
    let radius = |window: &Window, label: &str| match window.body(label).shape {
        Shape::Sphere { radius } => radius,
        _ => panic!("no sphere"),
    };
    window.type_into_knob("Scale", "Top", "1/2");
    assert_eq!((window.body("7").position.x, window.body("8").position.x), (4.0, 6.0), "about the middle");
    assert_eq!((radius(&window, "7"), radius(&window, "8")), (0.25, 0.25));
    assert_eq!(window.undo_label(), Some("Resize 2 objects"));
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.undo_label(), None, "one step");

    window.click("Pivot in the middle");
    window.click_role(Role::Button, "Pivot in the last selected");
    window.type_into_knob("Scale", "Top", "2");
    assert_eq!(window.body("8").position, dvec3(7.0, 3.0, 3.0), "the last stays");
    assert_eq!((window.body("7").position, radius(&window, "7")), (dvec3(-1.0, 3.0, 3.0), 1.0));
    window.key_with(Modifiers::COMMAND, Key::Z);

    window.menu("View", "Pivot in each");
    window.type_into_knob("Scale", "Top", "2");
    assert_eq!(window.body("7").position, DVec3::splat(3.0), "each where it is");
    assert_eq!((radius(&window, "7"), radius(&window, "8")), (1.0, 1.0));
    window.key(Key::E);
    window.type_into_knob("Turn about y", "Top", "90");
    assert_eq!(window.body("8").position, dvec3(7.0, 3.0, 3.0), "turned where it is");
    let Motion::Dynamic { velocity, .. } = window.body("8").motion else { panic!("it moves") };
    assert!(velocity.distance(dvec3(0.0, 0.0, -1.0)) < 1e-15, "{velocity}");
}

#[test]
fn the_tips_of_arrows_set_velocity_and_gravity() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    window.type_into_knob("Tip of the arrow", "Top", "x2");
    let velocity = |window: &Window| match window.body("7").motion {
        Motion::Dynamic { velocity, .. } => velocity,
        Motion::Static => DVec3::ZERO,
    };
    assert_eq!(velocity(&window), dvec3(2.0, 0.0, 0.0));
    window.drag_knob("Tip of the arrow", "Top", vec2(0.0, 40.0), Modifiers::NONE);
    let now = velocity(&window);
    assert!(now.z > 0.2 && now.y == 0.0 && (now.x - 2.0).abs() < 0.1, "{now}");
    assert_eq!(window.undo_label(), Some("Change velocity of 7"));

    window.click_role(Role::TreeItem, "1");
    window.type_into_knob("Tip of the arrow", "Front", "y-1.62");
    let text = format!("{:?}", window.scene().forces[0].kind);
    assert!(text.contains("-1.62"), "{text}");
}

#[test]
fn a_ball_snaps_to_where_it_touches() {
    let mut window = scene();
    let start = window.on_view(1, "Top view", DVec3::splat(3.0));
    let near = window.on_view(1, "Top view", dvec3(6.07, 3.0, 3.02));
    window.drag(&[start, start + vec2(20.0, 0.0), near], PRIMARY, Modifiers::COMMAND);
    let gap = window.body("7").position.distance(window.body("8").position) - 1.0;
    assert!(gap.abs() <= 1e-12, "{gap:e}");
    assert_eq!(window.body("7").position.y, 3.0);
}

#[test]
fn shift_slows_a_drag() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    window.drag_knob("Move along x", "Top", vec2(60.0, 0.0), Modifiers::NONE);
    let fast = window.body("7").position.x - 3.0;
    window.key_with(Modifiers::COMMAND, Key::Z);
    window.drag_knob("Move along x", "Top", vec2(60.0, 0.0), Modifiers::SHIFT);
    let slow = window.body("7").position.x - 3.0;
    assert!(slow > 0.0 && slow < 0.2 * fast, "{slow} against {fast}");
}

#[test]
fn handles_are_hidden_when_nothing_can_be_dragged() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    assert!(window.has_knob("Move along x", "Top"));
    window.key(Key::Q);
    assert!(!window.has_knob("Move along x", "Top"));
    window.key(Key::W);
    window.key(Key::Period);
    assert!(!window.has_knob("Move along x", "Top"), "the ball is not where it starts");
    window.key(Key::R);
    assert!(window.has_knob("Move along x", "Top"));
    window.click("Lock 7");
    assert!(!window.has_knob("Move along x", "Top"), "locked");
}

/// Symptom: dragging one of 10 000 bodies looked for overlaps among all of them in every frame. Expected: the list of
/// problems is made when the hand rests; then, and after the drag, it is right.
#[test]
fn problems_are_looked_for_when_the_hand_rests() {
    let mut window = scene();
    window.click_role(Role::TreeItem, "7");
    let metre = window.on_view(1, "Top view", DVec3::X).x - window.on_view(1, "Top view", DVec3::ZERO).x;
    let from = window.knob("Move along x", "Top");
    let to = from + vec2(3.5 * metre, 0.0);
    window.press(&[from, from + vec2(metre, 0.0), to], PRIMARY, Modifiers::NONE);
    assert!(window.body("7").position.x > 6.2, "it is dragged into ball 8");
    assert!(!window.has_containing("Problems ("), "the hand moves");
    std::thread::sleep(std::time::Duration::from_millis(200));
    window.harness.step();
    assert!(window.has_containing("Problems (1 warning)"), "{:?}", window.labels());

    let away = from + vec2(metre, 0.0);
    window.harness.event(Event::PointerMoved(away));
    window.harness.step();
    window.harness.step();
    assert!(window.has_containing("Problems (1 warning)"), "the hand moves");
    let release =
        Event::PointerButton { pos: away, button: PRIMARY, pressed: false, modifiers: Modifiers::NONE };
    window.harness.event(release);
    window.harness.run();
    assert!(!window.has_containing("Problems ("), "{:?}", window.labels());
}
