//! The real window's content without a window: the inline runner, no OpenGL, no system dialogs.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2, Rect};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use polyscene::editor::{SAMPLES, Storage};
use polyscene::gui::{App, NoFileDialogs, Parts};
use polyscene::record::{Frame, InlineRunner};
use polyscene::scene::{Body, NodeKey, Scene};
use polyscene::view::{Camera, VIEWS, ViewInput, Viewport, scene_bounds};

use super::editor_support::storage;

pub const SIZE: [f32; 2] = [1280.0, 800.0];

/// The application under test, with a folder of its own.
pub struct Window {
    pub harness: Harness<'static, App>,
    pub folder: tempfile::TempDir,
}

pub fn parts(scene: Option<PathBuf>) -> Parts {
    Parts {
        runner: Box::new(InlineRunner::new()),
        storage: Storage::default(),
        files: Box::new(NoFileDialogs),
        scene,
    }
}

impl Window {
    /// An empty window, as it opens without a file.
    pub fn empty() -> Self {
        Self::with(tempfile::tempdir().unwrap(), None)
    }

    /// A window on a copy of a sample.
    pub fn sample(id: &str) -> Self {
        let sample = SAMPLES.iter().find(|sample| sample.id == id).unwrap();
        Self::bytes(sample.bytes)
    }

    /// A window on a file `scene.xml` with these bytes.
    pub fn bytes(bytes: &[u8]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.xml");
        std::fs::write(&path, bytes).unwrap();
        Self::with(folder, Some(path))
    }

    pub fn thesis() -> Self {
        Self::sample("thesis-appendix-2")
    }

    /// An empty window with settings and recovery files in a folder, as [`super::editor_support::storage`] has them.
    pub fn with_storage(folder: tempfile::TempDir) -> Self {
        let storage = storage(folder.path());
        Self::of(folder, Parts { storage, ..parts(None) })
    }

    fn with(folder: tempfile::TempDir, scene: Option<PathBuf>) -> Self {
        Self::of(folder, parts(scene))
    }

    fn of(folder: tempfile::TempDir, parts: Parts) -> Self {
        let mut harness = Harness::builder()
            .with_size(SIZE)
            .with_max_steps(12)
            .with_accessibility_check(true)
            .build_eframe(move |cc| App::new(cc, parts));
        harness.run();
        Self { harness, folder }
    }

    pub fn path(&self) -> PathBuf {
        self.folder.path().join("scene.xml")
    }

    pub fn scene(&self) -> &Scene {
        self.harness.state().session().scene().expect("a scene")
    }

    pub fn frame(&self) -> &Arc<Frame> {
        self.harness.state().session().frame()
    }

    pub fn body(&self, label: &str) -> &Body {
        self.scene().bodies.iter().find(|body| body.label == label).expect("a body of that label")
    }

    pub fn selected(&self) -> &[NodeKey] {
        self.harness.state().session().selection().keys()
    }

    /// Clicks what has this accessible name.
    pub fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.harness.run();
    }

    pub fn click_role(&mut self, role: Role, label: &str) {
        self.harness.get_by_role_and_label(role, label).click();
        self.harness.run();
    }

    pub fn click_with(&mut self, role: Role, label: &str, modifiers: Modifiers) {
        self.harness.get_by_role_and_label(role, label).click_modifiers(modifiers);
        self.harness.run();
    }

    /// Opens a menu and clicks an entry; entries show their shortcut too, so the name's start is enough.
    pub fn menu(&mut self, menu: &str, entry: &str) {
        self.click_role(Role::Button, menu);
        let found = self.harness.get_all_by_role(Role::Button).find(|node| {
            node.accesskit_node()
                .label()
                .is_some_and(|label| label == entry || label.starts_with(&format!("{entry} ")))
        });
        found.unwrap_or_else(|| panic!("no entry {entry} in the menu {menu}")).click();
        self.harness.run();
    }

    pub fn key(&mut self, key: Key) {
        self.harness.key_press(key);
        self.harness.run();
    }

    pub fn key_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.harness.run();
    }

    /// Replaces a number as a person would: click, type, Enter.
    pub fn type_number(&mut self, label: &str, text: &str) {
        self.click_role(Role::SpinButton, label);
        self.type_over(text);
    }

    pub fn type_text(&mut self, label: &str, text: &str) {
        self.click_role(Role::TextInput, label);
        self.type_over(text);
    }

    fn type_over(&mut self, text: &str) {
        self.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        self.harness.event(Event::Text(text.to_owned()));
        self.harness.run();
        self.key(Key::Enter);
    }

    pub fn has(&self, label: &str) -> bool {
        self.harness.query_by_label(label).is_some()
    }

    pub fn has_containing(&self, text: &str) -> bool {
        self.harness.query_all_by_label_contains(text).next().is_some()
    }

    /// Lets work in the background go on until a text is there.
    pub fn wait_for(&mut self, text: &str) {
        let since = Instant::now();
        while !self.has_containing(text) {
            assert!(since.elapsed() < Duration::from_secs(60), "{text} does not come: {:?}", self.labels());
            std::thread::sleep(Duration::from_millis(10));
            self.harness.step();
        }
        self.harness.run();
    }

    /// All that has a name.
    pub fn labels(&self) -> Vec<String> {
        let nodes = self.harness.query_all_by_label_contains("");
        nodes.filter_map(|node| node.accesskit_node().label()).collect()
    }

    pub fn view_rect(&self, name: &str) -> Rect {
        self.harness.get_by_role_and_label(Role::Canvas, name).rect()
    }

    /// Where a standard view shows a place, before its camera was moved.
    pub fn on_view(&self, index: usize, name: &str, place: glam::DVec3) -> Pos2 {
        let rect = self.view_rect(name);
        let viewport = Viewport::new(rect.width().into(), rect.height().into(), 1.0);
        let input = ViewInput::new(self.scene(), Camera::default(), viewport);
        let camera = VIEWS[index].camera(scene_bounds(&input, None), viewport.aspect());
        let ndc = camera.project(place, viewport.aspect()).unwrap();
        let at = viewport.points(ndc.truncate());
        rect.min + egui::vec2(at.x as f32, at.y as f32)
    }

    pub fn click_at(&mut self, at: Pos2, modifiers: Modifiers) {
        self.harness.event(Event::PointerMoved(at));
        self.harness.run();
        for pressed in [true, false] {
            let button = egui::PointerButton::Primary;
            self.harness
                .event_modifiers(Event::PointerButton { pos: at, button, pressed, modifiers }, modifiers);
            self.harness.step();
        }
        self.harness.run();
    }

    /// Two clicks so soon after each other that they are one double click.
    pub fn double_click_at(&mut self, at: Pos2) {
        self.harness.event(Event::PointerMoved(at));
        self.harness.run();
        // All in one frame: events that are queued get a frame each, a quarter of a second after the one before.
        let (button, modifiers) = (egui::PointerButton::Primary, Modifiers::NONE);
        let event = |pressed| Event::PointerButton { pos: at, button, pressed, modifiers };
        self.harness.input_mut().events.extend([true, false, true, false].map(event));
        self.harness.run();
    }

    /// Presses at one place, goes through others, and releases at the last.
    pub fn drag(&mut self, way: &[Pos2], button: egui::PointerButton, modifiers: Modifiers) {
        self.press(way, button, modifiers);
        let pos = *way.last().unwrap();
        let release = Event::PointerButton { pos, button, pressed: false, modifiers };
        self.harness.event_modifiers(release, modifiers);
        self.harness.run();
    }

    /// As [`Self::drag`] without releasing.
    pub fn press(&mut self, way: &[Pos2], button: egui::PointerButton, modifiers: Modifiers) {
        let pos = way[0];
        self.harness.event(Event::PointerMoved(pos));
        self.harness.step();
        let press = Event::PointerButton { pos, button, pressed: true, modifiers };
        self.harness.event_modifiers(press, modifiers);
        self.harness.step();
        for at in &way[1..] {
            self.harness.event_modifiers(Event::PointerMoved(*at), modifiers);
            self.harness.step();
        }
        self.harness.step();
    }

    pub fn saved(&self) -> String {
        String::from_utf8(std::fs::read(self.path()).unwrap()).unwrap()
    }
}

pub fn sample_path(id: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{id}.xml"))
}
