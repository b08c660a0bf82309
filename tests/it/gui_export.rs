//! Scenes for other programs out of the window and theirs into it: the dialog, its preview, the file written, and what is said.

use egui::Key;
use egui::accesskit::Role;

use super::gui_support::Window;

const MJCF: &str = r#"<mujoco><worldbody>
<geom type="plane" size="3 3 .1"/>
<body name="one" pos="1 2 3"><freejoint/><geom size=".2"/></body>
<body name="door"><joint type="hinge"/><geom size=".1"/></body>
</worldbody></mujoco>"#;

impl Window {
    /// Opens the dialog for a format.
    fn export(&mut self, format: &str) {
        self.menu("File", "Export…");
        self.click_role(Role::RadioButton, format);
        self.wait_for(" kept");
    }
}

#[test]
fn the_dialog_previews_the_losses_and_writes_the_file() {
    let mut window = Window::sample("drag");
    window.export("Gazebo (SDF 1.9)");
    assert!(
        window.has_containing("dropped") && window.has_containing("there is no drag of air without a plugin")
    );
    window.click_role(Role::RadioButton, "MuJoCo (MJCF)");
    window.wait_for("blunt drag coefficient");
    window.click_role(Role::Button, "Choose a file…");
    assert!(window.has("Export the scene as"));
    window.type_text("File name or path", "out");
    let written = std::fs::read_to_string(window.folder.path().join("out.mjcf.xml")).unwrap();
    assert!(written.contains("<mujoco"), "{written}");
    assert!(window.has_containing("Exported"));
    assert!(!window.harness.state().session().is_dirty());
}

#[test]
fn the_scene_itself_is_not_replaced_by_an_export() {
    let mut window = Window::sample("bounce");
    let before = window.saved();
    window.export("PolyPhysicsXml 1.0");
    window.click_role(Role::Button, "Choose a file…");
    window.type_text("File name or path", "scene.xml");
    window.click_role(Role::Button, "Save");
    assert!(window.has_containing("is the scene itself"), "{:?}", window.labels());
    assert_eq!(window.saved(), before);
}

#[test]
fn this_moment_and_the_motion_are_exported() {
    let mut window = Window::sample("bounce");
    window.key(Key::Period);
    let position = window.frame().bodies[0].position;
    window.export("Table of bodies (CSV)");
    let label = window.labels().into_iter().find(|label| label.starts_with("This moment, t = ")).unwrap();
    window.click_role(Role::RadioButton, &label);
    window.wait_for(" kept");
    window.click_role(Role::Button, "Choose a file…");
    window.type_text("File name or path", "now.csv");
    let table = std::fs::read_to_string(window.folder.path().join("now.csv")).unwrap();
    assert!(table.contains(&format!(",{},", position.y)), "{table}");

    window.export("glTF 2.0, binary");
    window.click_role(Role::RadioButton, "The motion");
    window.wait_for("straight lines between the frames");
    window.type_number("To", "-1");
    window.wait_for("the motion must end after it begins");
    window.type_number("To", "0.5");
    window.type_number("Frames per second", "20");
    window.wait_for("11 frames");
    window.click_role(Role::Button, "Choose a file…");
    window.type_text("File name or path", "motion.glb");
    let bytes = std::fs::read(window.folder.path().join("motion.glb")).unwrap();
    assert!(String::from_utf8_lossy(&bytes).contains("animations"));
}

#[test]
fn escape_leaves_the_dialog() {
    let mut window = Window::sample("bounce");
    window.export("USD with physics, text");
    window.key(Key::Escape);
    assert!(!window.has("Export the scene"));
}

#[test]
fn a_file_of_mujoco_is_opened_after_asking_what_to_leave_out() {
    let mut window = Window::thesis();
    let file = window.folder.path().join("balls.xml");
    std::fs::write(&file, MJCF).unwrap();
    let open = |window: &mut Window| {
        window.key_with(egui::Modifiers::COMMAND, Key::O);
        window.type_text("File name or path", "balls.xml");
    };
    open(&mut window);
    assert!(window.has("Not all can be imported") && window.has_containing("a joint that is not free"));
    window.click_role(Role::Button, "Cancel");
    assert_eq!(window.harness.state().session().title(), "scene.xml");
    open(&mut window);
    window.click_role(Role::Button, "Open without it");
    assert!(window.has("Imported balls.xml") && window.has_containing("a joint that is not free"));
    window.click_role(Role::Button, "Close");
    assert_eq!(window.harness.state().session().title(), "balls");
    assert!(window.harness.state().session().is_dirty(), "it is not a file of ours yet");
    assert!(window.harness.state().session().path().is_none());
    assert!(window.body("2").name.as_deref() == Some("one"), "{:?}", window.scene().bodies);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), MJCF);
}

/// Symptom: the motion that was exported was not the one on the screen when the run had been edited on its way. Expected: the
/// places at the frames, bit for bit as the run had them. Cause: the scene was simulated anew from its start.
#[test]
fn the_motion_is_that_of_the_run_with_its_edits() {
    let mut window = Window::sample("bounce");
    let fps = 40.0;
    let mut seen = Vec::new();
    for nth in 0..=40 {
        if nth == 10 {
            window.click_role(Role::TreeItem, "Gravity");
            window.type_number("Acceleration y", "-3");
        }
        super::gui_timeline::type_time(&mut window, &format!("{}", f64::from(nth) / fps));
        seen.push(window.frame().bodies[0].position.y);
    }
    window.menu("File", "Export…");
    window.click_role(Role::RadioButton, "Table of bodies (CSV)");
    window.click_role(Role::RadioButton, "The motion");
    window.wait_for("Looked up in what this run has recorded");
    window.type_number("Frames per second", "40");
    window.wait_for("41 frames");
    window.click_role(Role::Button, "Choose a file…");
    window.type_text("File name or path", "motion.csv");
    let table = std::fs::read_to_string(window.folder.path().join("motion.csv")).unwrap();
    let found: Vec<f64> =
        table.lines().skip(1).map(|row| row.split(',').nth(4).unwrap().parse().unwrap()).collect();
    assert_eq!(found, seen);
    let fallen = 0.5 * 9.8;
    assert!((seen[0] - seen[40]).abs() < fallen, "the edit counts");

    window.menu("File", "Export…");
    window.click_role(Role::RadioButton, "Table of bodies (CSV)");
    window.click_role(Role::RadioButton, "The motion");
    window.type_number("To", "2");
    window.wait_for("Simulated anew from the start: this run is recorded from 0 s to 1 s");
}
