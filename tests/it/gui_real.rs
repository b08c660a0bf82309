//! The real program in a real window on a display in memory, driven as a person would.

use std::io::{BufRead as _, BufReader};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use egui::accesskit::{Node, Role};
use egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_inspection::{Request, Response, protocol};

use super::gui_support::sample_path;

/// Ends with the test, however it ends.
struct Killed(Child);

impl Drop for Killed {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// One window at a time: on a display without a window manager they take each other's keys.
static DISPLAY: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    DISPLAY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A display: the one there is, or one of our own in memory.
fn display() -> (String, Option<Killed>) {
    if let Ok(display) = std::env::var("DISPLAY")
        && !display.is_empty()
    {
        return (display, None);
    }
    let mut server = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", "1400x900x24", "-nolisten", "tcp"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("Xvfb, which scripts/test.sh installs");
    let mut number = String::new();
    BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
    (format!(":{}", number.trim()), Some(Killed(server)))
}

struct Driver {
    stream: TcpStream,
}

impl Driver {
    fn connect(address: &str) -> Self {
        let since = Instant::now();
        loop {
            if let Ok(mut stream) = TcpStream::connect(address) {
                stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
                protocol::read_handshake(&mut stream).unwrap();
                return Self { stream };
            }
            assert!(since.elapsed() < Duration::from_secs(60), "the window did not open");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    fn ask(&mut self, request: &Request) -> Response {
        protocol::write_message(&mut self.stream, request).unwrap();
        protocol::read_message(&mut self.stream).unwrap()
    }

    fn find(&mut self, role: Role, label: &str) -> Option<Node> {
        self.find_if(role, |text| text == label)
    }

    fn find_if(&mut self, role: Role, is_wanted: impl Fn(&str) -> bool) -> Option<Node> {
        let Response::Tree { accesskit: Some(tree), .. } = self.ask(&Request::GetTree) else {
            panic!("no tree of widgets");
        };
        let fits = |node: &Node| {
            node.role() == role && [node.label(), node.value()].into_iter().flatten().any(&is_wanted)
        };
        tree.nodes.into_iter().map(|(_, node)| node).find(|node| fits(node))
    }

    /// Waits until it is there: the simulation has a thread of its own.
    fn wait(&mut self, role: Role, label: &str) -> Node {
        let since = Instant::now();
        loop {
            if let Some(node) = self.find(role, label) {
                return node;
            }
            assert!(since.elapsed() < Duration::from_secs(30), "no {role:?} “{label}”");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// As [`Self::wait`], by how its label begins.
    fn wait_for_start(&mut self, role: Role, start: &str) -> Node {
        let since = Instant::now();
        loop {
            if let Some(node) = self.find_if(role, |text| text.starts_with(start)) {
                return node;
            }
            assert!(since.elapsed() < Duration::from_secs(60), "no {role:?} “{start}…”");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    fn events(&mut self, events: Vec<Event>) {
        assert!(matches!(self.ask(&Request::ApplyEvents { events }), Response::Done));
        self.ask(&Request::Settle { max_steps: 30 });
    }

    fn click(&mut self, role: Role, label: &str) {
        let node = self.wait(role, label);
        self.click_node(&node);
    }

    fn click_node(&mut self, node: &Node) {
        let bounds = node.bounds().expect("a place");
        let pos = Pos2::new(((bounds.x0 + bounds.x1) / 2.0) as f32, ((bounds.y0 + bounds.y1) / 2.0) as f32);
        self.events(vec![Event::PointerMoved(pos)]);
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        // At once: between two repaints of a busy window more time may pass than a click may take.
        let event = |pressed| Event::PointerButton { pos, button, pressed, modifiers };
        self.events(vec![event(true), event(false)]);
    }

    fn key(&mut self, key: Key, modifiers: Modifiers) {
        for pressed in [true, false] {
            let event = Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
            self.events(vec![event]);
        }
    }

    fn type_number(&mut self, label: &str, text: &str) {
        self.click(Role::SpinButton, label);
        self.key(Key::A, Modifiers::COMMAND);
        self.events(vec![Event::Text(text.to_owned())]);
        self.key(Key::Enter, Modifiers::NONE);
    }
}

#[test]
fn a_scene_is_opened_edited_stepped_saved_and_closed() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    std::fs::copy(sample_path("thesis-appendix-2"), &path).unwrap();
    let (display, _server) = display();
    let (mut program, mut driver) = opened(&path, &display);

    driver.click(Role::TreeItem, "5853");
    driver.type_number("Mass", "2,5");
    driver.click(Role::Button, "Next event");
    driver.wait(Role::Label, "5853 – 8855");
    let Response::Screenshot(picture) = driver.ask(&Request::GetScreenshot { pixels_per_point: None }) else {
        panic!("no picture");
    };
    let picture = image::load_from_memory(&picture.bytes).unwrap().to_rgba8();
    let blue = picture.pixels().filter(|pixel| pixel.0[2] > pixel.0[0].saturating_add(80)).count();
    assert!(blue > 2000, "the blue sphere is seen in four views: {blue} pixels");

    driver.key(Key::S, Modifiers::COMMAND);
    driver.wait(Role::Label, "Saved scene.xml");
    let saved = std::fs::read_to_string(&path).unwrap();
    assert!(saved.contains("<Weight F32=\"2,5\" />"), "the comma is kept");
    assert_eq!(saved.matches("<Weight F32=\"1\" />").count(), 2);

    let (status, _) = quit(&mut program, &mut driver);
    assert!(status.success());
}

/// A thousand balls at 64 times their speed are too much for any machine of today.
#[test]
fn playing_that_falls_behind_is_explained() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    let text = std::fs::read_to_string(sample_path("pour-1000")).unwrap();
    let quick = text.replace("<TimeSpeed F32=\"1\" />", "<TimeSpeed F32=\"64\" />");
    assert_ne!(quick, text);
    std::fs::write(&path, quick).unwrap();
    let (display, _server) = display();
    let (mut program, mut driver) = opened(&path, &display);
    driver.wait(Role::TreeItem, "Map");
    driver.key(Key::Space, Modifiers::NONE);
    let behind = driver.wait_for_start(Role::Button, "plays at 0");
    assert!(behind.label().is_some_and(|label| label.ends_with(" of the speed set")), "{behind:?}");
    driver.click_node(&behind);
    driver.wait(Role::Button, "Show the settings of the simulation");
    let (status, _) = quit(&mut program, &mut driver);
    assert!(status.success());
}

/// The program with a scene in a window, and the line to it.
fn opened(scene: &Path, display: &str) -> (Killed, Driver) {
    let folder = scene.parent().unwrap();
    let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let address = format!("127.0.0.1:{port}");
    let program = Command::new(env!("CARGO_BIN_EXE_polyscene"))
        .arg(scene)
        .args(["--window-size", "1280x800"])
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        .env("EGUI_INSPECTION", &address)
        .env("HOME", folder)
        .env("XDG_CONFIG_HOME", folder.join("config"))
        .env("XDG_DATA_HOME", folder.join("data"))
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let program = Killed(program);
    (program, Driver::connect(&address))
}

/// Presses Ctrl+Q: how the program ended, and how long that took.
fn quit(program: &mut Killed, driver: &mut Driver) -> (ExitStatus, Duration) {
    let (key, modifiers) = (Key::Q, Modifiers::COMMAND);
    let quit = Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    let since = Instant::now();
    protocol::write_message(&mut driver.stream, &Request::ApplyEvents { events: vec![quit] }).unwrap();
    loop {
        if let Some(status) = program.0.try_wait().unwrap() {
            return (status, since.elapsed());
        }
        assert!(since.elapsed() < Duration::from_secs(20), "the window does not close");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Symptom: a window whose simulation was inside one long call did not close before that call ended. Here it
/// is the very first: thousands of balls in a single tile, all pairs of which are predicted.
#[test]
fn the_window_closes_while_the_simulation_is_inside_one_call() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    let text = std::fs::read_to_string(sample_path("bounce")).unwrap();
    let mut bodies = String::new();
    for id in 0..4000 {
        let [x, y, z] = [id % 16, id / 16 % 16, id / 256].map(|k| 0.3 + 0.6 * f64::from(k));
        bodies += &format!(
            "<SoftObject UserID=\"{}\"><Translation X=\"{x}\" Y=\"{y}\" Z=\"{z}\"/><InitialVelocity X=\"{y}\" \
             Y=\"{z}\" Z=\"{x}\"/><Sphere><Radius F32=\"0.01\"/></Sphere></SoftObject>",
            id + 1000
        );
    }
    let text = text.replace("</Primitives>", &format!("{bodies}</Primitives>"));
    let (before, rest) = text.split_once("<Tiles").unwrap();
    let (_, after) = rest.split_once("/>").unwrap();
    std::fs::write(&path, format!("{before}<Tiles X=\"1\" Y=\"1\" Z=\"1\"/>{after}")).unwrap();
    let (display, _server) = display();
    let (mut program, mut driver) = opened(&path, &display);
    let (status, took) = quit(&mut program, &mut driver);
    assert!(status.success());
    // A second, and what drawing a last frame in software takes on a busy machine.
    assert!(took < Duration::from_secs(4), "it took {took:?}");
}

#[test]
fn without_a_display_the_editor_says_what_to_do() {
    let output = Command::new(env!("CARGO_BIN_EXE_polyscene"))
        .arg(sample_path("orbit"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("polyscene run") && text.contains("polyscene render"), "{text}");
}

/// The program with a script, in a window on a display: how it ended and what it said.
fn scripted(arguments: &[&str]) -> (Option<i32>, String) {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let (display, _server) = display();
    let since = Instant::now();
    let program = Command::new(env!("CARGO_BIN_EXE_polyscene"))
        .args(arguments)
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        .env("HOME", folder.path())
        .env("XDG_CONFIG_HOME", folder.path().join("config"))
        .env("XDG_DATA_HOME", folder.path().join("data"))
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut program = Killed(program);
    let status = loop {
        if let Some(status) = program.0.try_wait().unwrap() {
            break status;
        }
        assert!(since.elapsed() < Duration::from_secs(60), "{arguments:?} does not end");
        std::thread::sleep(Duration::from_millis(50));
    };
    let mut said = String::new();
    std::io::Read::read_to_string(&mut program.0.stderr.take().unwrap(), &mut said).unwrap();
    (status.code(), said)
}

/// Symptom: `--do add_plane --screenshot` wrote the picture and never ended. Cause: closing asked about the
/// unsaved edit, and a script answers nothing.
#[test]
fn a_script_that_edits_ends_with_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("window.png");
    let (scene, picture_name) = (sample_path("orbit"), picture.to_str().unwrap());
    let (code, said) =
        scripted(&[scene.to_str().unwrap(), "--do", "add_plane", "--screenshot", picture_name]);
    assert_eq!(code, Some(0), "{said}");
    assert!(image::open(&picture).is_ok());
}

#[test]
fn a_picture_of_the_window_never_replaces_its_scene() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, twin) = (folder.path().join("scene.xml"), folder.path().join("twin.png"));
    std::fs::copy(sample_path("orbit"), &scene).unwrap();
    std::fs::hard_link(&scene, &twin).unwrap();
    let before = std::fs::read(&scene).unwrap();
    let (code, said) = scripted(&[scene.to_str().unwrap(), "--screenshot", twin.to_str().unwrap()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("would overwrite the scene"), "{said}");
    assert_eq!(std::fs::read(&scene).unwrap(), before);
}

/// Symptom: `--screenshot window.jpg` wrote a PNG file of that name. Expected: refused before the window opens, as
/// `render --out` refuses it.
#[test]
fn a_picture_of_the_window_is_named_as_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, picture) = (sample_path("orbit"), folder.path().join("window.jpg"));
    let (code, said) = scripted(&[scene.to_str().unwrap(), "--screenshot", picture.to_str().unwrap()]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("window.jpg: pictures are PNG files; give a name such as "), "{said}");
    assert!(!picture.exists());
}

/// Symptom: `--screenshot` of a scene that is not there, or has errors, ended with 0. Expected: exit code 1, and a picture
/// only where there is something to show.
#[test]
fn a_scene_that_does_not_open_is_an_error_of_the_script() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("window.png");
    let (code, said) = scripted(&["no-such.xml", "--screenshot", picture.to_str().unwrap()]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("no-such.xml cannot be opened: "), "{said}");
    assert!(!picture.exists());
    let broken = sample_path("invalid/several-problems");
    let (code, said) = scripted(&[broken.to_str().unwrap(), "--screenshot", picture.to_str().unwrap()]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("error(s)") && picture.exists(), "{said}");
}

/// Symptom: a step waited 120 ms, and what took longer was not seen by the next. Expected: `event:` finds the events
/// of the step before, however long that took; and playing does not keep a picture from being taken.
#[test]
fn a_step_waits_for_the_one_before() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("window.png");
    let (scene, name) = (sample_path("gas"), picture.to_str().unwrap());
    let steps = "dt:20,step_forward,event:100,dt:1/60,play_pause";
    let (code, said) = scripted(&[scene.to_str().unwrap(), "--do", steps, "--screenshot", name]);
    assert_eq!(code, Some(0), "{said}");
    assert!(picture.exists());
}

/// Symptom: `--do study` without `tab:accuracy` before it never ended. Cause: only the panel in sight took what was found.
#[test]
fn a_script_waits_for_its_study_alone() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("window.png");
    let (scene, name) = (sample_path("bounce"), picture.to_str().unwrap());
    let (code, said) = scripted(&[scene.to_str().unwrap(), "--do", "study", "--screenshot", name]);
    assert_eq!(code, Some(0), "{said}");
    assert!(picture.exists());
}

/// Symptom: `--do` was documented nowhere. Expected: docs/scripts.md lists every command.
#[test]
fn the_frames_of_a_run_that_plays_are_measured() {
    let scene = sample_path("gas");
    let (code, said) = scripted(&[scene.to_str().unwrap(), "--bench-play", "10"]);
    assert_eq!(code, Some(0), "{said}");
    for words in
        ["paused: the window's own part median", "playing:", "scrolling the ledger:", "rows recorded"]
    {
        assert!(said.contains(words), "{words} in {said}");
    }
}

#[test]
fn the_documentation_lists_every_step() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scripts.md")).unwrap();
    let line = |row: &polyscene::editor::CommandInfo| {
        format!("| `{}` | {} ▸ {} | {} |\n", row.id, row.menu.label(), row.label, row.help)
    };
    let expected: String = polyscene::editor::COMMANDS.iter().map(line).collect();
    assert!(text.contains(&expected), "the table of commands in docs/scripts.md must be:\n{expected}");
}

/// Symptom: `--do dt:0` and `--do select:nosuch` did nothing and ended with 0; `step_forward*-1` was called an
/// unknown step.
#[test]
fn a_step_that_cannot_be_taken_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("window.png");
    let scene = sample_path("orbit");
    let cases = [
        ("dt:0", "Δt must lie between"),
        ("dt:fast", "is not a number"),
        ("select:nosuch", "no body or force has this name"),
        ("event:99", "events in this Δt"),
        ("step_forward*-1", "the count after * must be a whole number from 1"),
        ("fly", "there is no step `fly`"),
    ];
    for (step, reason) in cases {
        let (code, said) =
            scripted(&[scene.to_str().unwrap(), "--do", step, "--screenshot", picture.to_str().unwrap()]);
        assert_eq!(code, Some(2), "{step}: {said}");
        assert!(said.contains(reason), "{step}: {said}");
        assert!(!picture.exists(), "{step}");
    }
}
