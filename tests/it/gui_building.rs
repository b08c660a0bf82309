//! Building in the window, by accessible names: parts, arrays, formulas, groups, problems; a whole scene in few actions.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use polyscene::design::{Extent, TOOLS, gap, troubles};
use polyscene::scene::{Document, Motion};

use super::editor_support::SCENE;
use super::gui_support::Window;

impl Window {
    /// Opens a menu, a submenu and clicks an entry there.
    fn submenu(&mut self, menu: &str, submenu: &str, entry: &str) {
        self.click_role(Role::Button, menu);
        self.open_submenu(submenu);
        self.click_role(Role::Button, entry);
    }

    fn open_submenu(&mut self, submenu: &str) {
        let found = self
            .harness
            .get_all_by_role(Role::Button)
            .find(|node| node.accesskit_node().label().is_some_and(|label| label.starts_with(submenu)));
        found.unwrap_or_else(|| panic!("no submenu {submenu}")).click();
        self.harness.run();
    }

    fn palette(&mut self, query: &str) {
        self.key_with(Modifiers::COMMAND, Key::P);
        self.harness.event(Event::Text(query.to_owned()));
        self.harness.run();
        self.key(Key::Enter);
    }
}

/// At most 25 clicks, drags and typed values from an empty window to a saved scene. Each line is one action, a menu's
/// way down three.
#[test]
fn a_closed_room_with_a_rack_and_a_cue_ball_is_built_and_saved_in_25_actions() {
    let mut window = Window::empty();
    let mut actions = 0;
    let mut did = |count: usize| actions += count;
    window.submenu("Add", "Ready parts", "Room…");
    window.click("Create");
    did(4);
    window.submenu("Add", "Ready parts", "Rack of balls…");
    window.type_number("Ball radius", "0,2");
    window.click_role(Role::CheckBox, "Cue ball");
    window.click("Create");
    did(6);
    window.click_role(Role::TreeItem, "rack");
    window.click("Colour red");
    did(2);
    window.click_role(Role::TreeItem, "cue ball");
    window.click("Colour white");
    window.type_number("Velocity x", "3");
    did(3);
    window.click_role(Role::TreeItem, "room");
    window.type_number("Bounce", "0.8");
    did(2);
    window.key_with(Modifiers::COMMAND, Key::S);
    let path = window.folder.path().join("billiard.xml");
    window.type_text("File name or path", &path.display().to_string());
    did(2);
    assert!(actions <= 25, "{actions} actions");

    let saved = Document::open(&path);
    let scene = saved.scene().expect("a scene was saved");
    assert!(saved.diagnostics().is_empty(), "{:?}", saved.diagnostics());
    assert_eq!(troubles(scene), []);
    let of_group = |group: &str| {
        scene.bodies.iter().filter(|body| body.group.as_deref() == Some(group)).collect::<Vec<_>>()
    };
    let (room, rack) = (of_group("room"), of_group("rack"));
    assert_eq!((room.len(), rack.len(), scene.bodies.len()), (6, 15, 22));
    assert!(room.iter().all(|wall| wall.bounce == 0.8));
    let red = rack[0].color;
    assert!(red.is_some() && rack.iter().all(|ball| ball.color == red));
    let touching = |a: &polyscene::scene::Body, b: &polyscene::scene::Body| {
        gap(a, b).is_some_and(|gap| gap.distance.abs() <= 1e-12)
    };
    let contacts = (0..15).flat_map(|a| (0..a).map(move |b| (a, b)));
    assert_eq!(contacts.filter(|(a, b)| touching(rack[*a], rack[*b])).count(), 30);
    let cue = scene.bodies.iter().find(|body| body.name.as_deref() == Some("cue ball")).expect("a cue ball");
    assert!(matches!(cue.motion, Motion::Dynamic { velocity, .. } if velocity.x == 3.0));
    assert!(cue.color.is_some() && cue.group.is_none());

    // the rack is met as one group
    window.click("Next event");
    let event = window.frame().events.last().expect("the first impact").clone();
    assert!(
        window.frame().bodies.iter().filter(|body| body.velocity.length() > 0.0).count() > 5,
        "{event:?}"
    );
}

#[test]
fn every_tool_is_in_a_menu_and_in_the_palette() {
    let mut window = Window::thesis();
    for (menu, groups) in [("Add", &["Ready parts"][..]), ("Edit", &["Arrange", "Select more", "Put right"])]
    {
        for group in groups {
            window.click_role(Role::Button, menu);
            window.open_submenu(group);
            for tool in TOOLS.iter().filter(|tool| tool.group.label() == *group) {
                assert!(
                    window.harness.query_by_role_and_label(Role::Button, tool.label).is_some(),
                    "{}",
                    tool.id
                );
            }
            window.key(Key::Escape);
            window.key(Key::Escape);
        }
    }
    window.palette("parts funnel");
    assert!(window.has("Create"), "the palette opens the dialog");
}

#[test]
fn a_dialog_says_what_it_will_do_and_why_it_cannot() {
    let mut window = Window::empty();
    window.palette("rack of balls");
    assert!(window.has_containing("Adds 15 objects"));
    window.type_number("Rows", "3");
    assert!(window.has_containing("Adds 6 objects"));
    window.type_number("Rows", "2.5");
    assert!(window.has_containing("Rows must be a whole number"));
    window.type_number("Rows", "0");
    assert!(window.has_containing("Rows must be at least 1"));
    window.key(Key::Enter);
    assert!(window.scene().bodies.is_empty(), "Enter does nothing while it cannot");
    window.type_number("Rows", "2");
    window.key(Key::Enter);
    assert_eq!(window.scene().bodies.len(), 3);
    assert!(!window.has("Create"), "the dialog is gone");
    window.palette("rack of balls");
    window.type_number("Rows", "2");
    assert!(!window.has_containing("would overlap"), "it stands beside the first");
    window.type_number("Place x", "5");
    assert!(window.has_containing("would overlap"), "a place that was typed is kept");
    window.type_number("Rows", "1");
    assert!(window.has_containing("would overlap"));
    window.key(Key::Escape);
    assert!(!window.has("Create"));
    assert_eq!(window.scene().bodies.len(), 3);
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert!(window.scene().bodies.is_empty());
}

#[test]
fn formulas_are_worked_out_once_for_each_of_many() {
    let mut window = Window::empty();
    window.palette("parts: cradle");
    window.click("Create");
    window.click_role(Role::TreeItem, "cradle");
    let before: Vec<f64> = window.scene().bodies.iter().map(|body| body.position.y).collect();
    window.type_number("Position y", "=x+0.5*i");
    window.harness.run_steps(8);
    for (nth, (body, before)) in window.scene().bodies.iter().zip(&before).enumerate() {
        assert_eq!(body.position.y, before + 0.5 * nth as f64, "of ball {nth}");
    }
    window.type_number("Mass", "*3");
    window.harness.run_steps(8);
    assert!(
        window
            .scene()
            .bodies
            .iter()
            .all(|body| matches!(body.motion, Motion::Dynamic { mass, .. } if mass == 3.0))
    );
    window.type_number("Mass", "rand(1,2)");
    assert!(window.has_containing("seed 1"));
    window.type_number("Mass", "-=5");
    assert!(window.has_containing("the mass must be above 0"));
    window.type_number("Velocity x", "sqrt(2)");
    assert!(window.scene().bodies.iter().all(|body| {
        matches!(body.motion, Motion::Dynamic { velocity, .. } if velocity.x == 2f64.sqrt())
    }));
}

#[test]
fn groups_are_folders_of_the_tree() {
    let mut window = Window::empty();
    window.palette("parts: pyramid");
    window.type_number("Layers", "2");
    window.click("Create");
    assert!(!window.has("ball 3"), "a new group is closed");
    window.click("Open pyramid");
    assert!(window.harness.query_by_role_and_label(Role::TreeItem, "ball 3").is_some());
    window.click("Hide group pyramid");
    assert!(window.scene().bodies.iter().all(|body| body.hidden));
    window.click("Show group pyramid");
    window.click("Lock group pyramid");
    assert!(window.scene().bodies.iter().all(|body| body.locked && !body.hidden));
    window.click("Unlock group pyramid");
    window.click("Close pyramid");
    window.click_role(Role::TreeItem, "pyramid");
    assert_eq!(window.selected().len(), 5);
    window.key_with(Modifiers::COMMAND, Key::D);
    assert_eq!(window.scene().bodies.len(), 10);
    assert!(
        window.scene().bodies.as_slice()[5..].iter().all(|body| body.group.as_deref() == Some("pyramid 2"))
    );
    window.key_with(Modifiers::COMMAND, Key::G);
    assert!(
        window.scene().bodies.as_slice()[5..]
            .iter()
            .all(|body| body.group.as_deref() == Some("pyramid 2/group"))
    );
    window.key_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::G);
    assert!(window.scene().bodies.as_slice()[5..].iter().all(|body| body.group.is_none()));
}

#[test]
fn the_filter_selects_what_it_finds_and_is_gone_in_the_next_scene() {
    let mut window = Window::empty();
    window.palette("parts room");
    window.click("Create");
    window.key_with(Modifiers::COMMAND, Key::F);
    window.harness.event(Event::Text("wall".into()));
    window.harness.run();
    window.key(Key::Enter);
    assert_eq!(window.selected().len(), 4);
    window.palette("sample newton");
    window.click("Discard");
    let filter = window.harness.get_by_role_and_label(Role::TextInput, "Filter").value();
    assert!(filter.is_none_or(|text| text.is_empty()));
}

#[test]
fn problems_select_what_they_are_about_and_have_their_fix() {
    let mut window = Window::empty();
    window.menu("Add", "Dynamic sphere");
    window.menu("Add", "Dynamic sphere");
    window.type_number("Position x", "5.4");
    window.type_number("Position y", "5");
    window.type_number("Position z", "5");
    assert!(window.has("Problems (1 warning)"));
    window.click("Problems (1 warning)");
    window.key(Key::Escape);
    window.click_role(Role::Button, "Push apart");
    assert!(window.has("Problems"), "none is left");
    assert_eq!(troubles(window.scene()), []);
    window.click_role(Role::TreeItem, "Map");
    window.type_number("Tiles y", "40000");
    window.click_role(Role::Button, "Fit tiles");
    assert!(window.has("Problems"));
    window.type_number("Tiles y", "40000");
    window.type_number("Size x", "2");
    window.click_role(Role::Button, "Put all right");
    assert!(window.has("Problems"));
    assert!(window.has_containing("enlarged the map"));
    assert_eq!(window.harness.state().session().undo_label(), Some("Put all right"));
}

#[test]
fn arrows_move_the_selection_by_the_snap_step() {
    let mut window = Window::thesis();
    let at = window.on_view(1, "Top view", window.body("15921").position);
    window.click_at(at, Modifiers::NONE);
    window.key(Key::ArrowRight);
    let moved = window.body("15921").position;
    let step = moved.x - 2.0;
    assert!(step > 0.0 && step < 1.0 && moved.y == 2.0 && moved.z == 1.0, "{moved}");
    window.key(Key::ArrowUp);
    assert!((window.body("15921").position.z - (1.0 - step)).abs() < 1e-12, "up the top view is −z");
    window.key_with(Modifiers::COMMAND, Key::Z);
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert!(!window.harness.state().session().is_dirty());
}

/// Symptom: a length of exactly 10 m was taken for a count, and drags left it where it was.
#[test]
fn lengths_of_a_dialog_can_be_dragged_from_any_value() {
    let mut window = Window::empty();
    window.palette("parts: plate facing");
    window.type_number("Width", "10");
    let field = window.harness.get_by_role_and_label(Role::SpinButton, "Width").rect().center();
    let way = [field, field + vec2(3.0, 0.0), field + vec2(6.0, 0.0), field + vec2(9.0, 0.0)];
    window.drag(&way, egui::PointerButton::Primary, Modifiers::NONE);
    window.click("Create");
    let polyscene::scene::Shape::Plane { half_x, .. } = window.scene().bodies[0].shape else {
        panic!("a plate");
    };
    assert!(half_x > 5.0 && half_x < 6.0 && half_x.fract() != 0.0, "{half_x}");
}

/// Drags one row of the tree onto another.
fn drag_row(window: &mut Window, from: &str, to: &str) {
    let row = |label: &str| window.harness.get_by_role_and_label(Role::TreeItem, label).rect();
    let (from, to) = (row(from).left_center() + vec2(60.0, 0.0), row(to).left_center() + vec2(60.0, 0.0));
    window.drag(&[from, from.lerp(to, 0.5), to, to], egui::PointerButton::Primary, Modifiers::NONE);
}

#[test]
fn rows_are_dragged_into_groups_and_out_of_them() {
    let mut window = Window::bytes(SCENE.as_bytes());
    window.click_role(Role::TreeItem, "30");
    window.key_with(Modifiers::COMMAND, Key::G);
    drag_row(&mut window, "7", "group");
    assert_eq!(window.body("7").group.as_deref(), Some("group"));
    let undo = window.harness.state().session().undo_label().map(str::to_owned);
    assert_eq!(undo.as_deref(), Some("Move 1 object into group"));
    // onto what is in the group, and with it what else is selected
    window.click_role(Role::TreeItem, "8");
    window.click_with(Role::TreeItem, "1", Modifiers::COMMAND);
    drag_row(&mut window, "8", "7");
    assert_eq!(window.body("8").group.as_deref(), Some("group"));
    assert_eq!(window.scene().forces[0].group.as_deref(), Some("group"));
    window.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.body("8").group, None, "both in one step");
    drag_row(&mut window, "7", "Static bodies");
    assert_eq!(window.body("7").group, None, "a heading takes it out");
    // a group into another one, and not into itself
    window.click_role(Role::TreeItem, "7");
    window.key_with(Modifiers::COMMAND, Key::G);
    drag_row(&mut window, "group 2", "group");
    assert_eq!(window.body("7").group.as_deref(), Some("group/group 2"));
    drag_row(&mut window, "group", "group 2");
    assert_eq!(window.body("30").group.as_deref(), Some("group"));
    drag_row(&mut window, "group 2", "Forces");
    assert_eq!(window.body("7").group.as_deref(), Some("group 2"));
}

#[test]
fn groups_with_strange_names_are_listed_and_renamed() {
    let deep = "a/".repeat(30_000) + "z";
    let text = include_str!("../../scenes/cradle.xml");
    let at = text.find("<SoftObject").unwrap();
    let end = at + text[at..].find('>').unwrap() + 1;
    for group in [deep.as_str(), "/", "//x//", "  ", "a&#10;b", "\u{202e}abc"] {
        let scene = format!("{}<?polyscene group=\"{group}\"?>{}", &text[..end], &text[end..]);
        let mut window = Window::bytes(scene.as_bytes());
        let rows = window.harness.query_all_by_role(Role::TreeItem).count();
        let folder = window.labels().into_iter().find(|label| label.starts_with("Open "));
        window.click(&folder.expect("a folder that can be opened"));
        assert!(window.harness.query_all_by_role(Role::TreeItem).count() > rows, "{group:.9}");
    }
}

/// Symptom: a name of slashes alone became a group without a name.
#[test]
fn a_group_keeps_its_name_where_the_new_one_is_empty() {
    let mut window = Window::empty();
    window.palette("parts: cradle");
    window.click("Create");
    for (typed, expected) in [("//", "cradle"), (" /toys/ ", "toys")] {
        let row = window.harness.get_all_by_role(Role::TreeItem).find(|node| {
            node.accesskit_node().label().is_some_and(|label| ["cradle", "toys"].contains(&label.as_str()))
        });
        let at = row.expect("the group").rect().center();
        window.double_click_at(at);
        window.type_text("New name", typed);
        assert!(window.scene().bodies.iter().all(|body| body.group.as_deref() == Some(expected)), "{typed}");
    }
}

/// Symptom: a part that was made after another lay in it. Expected: it stands beside it, at a place that the dialog shows.
#[test]
fn a_part_stands_beside_the_one_before() {
    let mut window = Window::empty();
    let place = |window: &Window| {
        let field = window.harness.get_by_role_and_label(Role::SpinButton, "Place z");
        field.value().and_then(|text| text.parse::<f64>().ok()).expect("a number")
    };
    window.palette("parts: block");
    assert_eq!(place(&window), 5.0);
    window.click("Create");
    window.palette("parts: block");
    window.type_number("Width x", "3");
    assert_eq!(place(&window), 7.1, "past the first along z, which is the shorter way");
    window.type_number("Depth z", "2.4");
    assert_eq!(place(&window), 7.3, "it makes room for its size");
    window.click("Create");
    let front = |body: &polyscene::scene::Body| Extent::of(body).min.z;
    let second = window.scene().bodies.iter().skip(6).map(front).fold(f64::INFINITY, f64::min);
    assert!((second - 6.1).abs() < 1e-9, "{second}");
    // a ramp is told its length and angle, or its run and rise
    window.key(Key::Escape);
    window.palette("parts: ramp");
    window.type_number("Length", "4");
    window.type_number("Angle", "30");
    let shown = |label: &str| {
        let field = window.harness.get_by_role_and_label(Role::SpinButton, label);
        field.value().expect("a number")
    };
    assert_eq!((shown("Rise y"), shown("Run x")), ("2".into(), "3.4641016".into()));
    window.type_number("Rise y", "3.4641016");
    window.type_number("Friction", "0.25");
    window.click("Create");
    let ramp = window.scene().bodies.last().expect("a ramp");
    assert!((Extent::of(ramp).size().y - 3.4641016).abs() < 1e-9);
    assert_eq!(ramp.roughness.friction, 0.25);
}
