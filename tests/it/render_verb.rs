//! The verb `render` through the real program: pictures of every scene, and ways in which it ends badly.

use std::path::Path;
use std::process::{Command, Output};

fn render(arguments: &[&str]) -> Output {
    // No display: it must do without.
    Command::new(env!("CARGO_BIN_EXE_polyscene"))
        .arg("render")
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap()
}

fn complaint(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn every_scene_gives_a_picture_in_which_something_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("scene.png");
    let folders = ["scenes", "scenes/hard"].map(|folder| std::fs::read_dir(folder).unwrap());
    let mut scenes: Vec<_> = folders
        .into_iter()
        .flatten()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "xml"))
        .collect();
    scenes.sort();
    assert!(scenes.len() >= 6);
    for scene in scenes {
        let scene = scene.to_str().unwrap();
        let output =
            render(&[scene, "--force", "-o", out.to_str().unwrap(), "--at", "0.1", "--size", "480x320"]);
        assert!(output.status.success(), "{scene}: {}", complaint(&output));
        let picture = image::open(&out).unwrap().to_rgba8();
        assert_eq!(picture.dimensions(), (480, 320), "{scene}");
        let mut colors: Vec<_> = picture.pixels().map(|pixel| pixel.0).collect();
        colors.sort_unstable();
        colors.dedup();
        assert!(colors.len() > 200, "{scene}: only {} colours", colors.len());
    }
}

#[test]
fn view_time_overlays_and_colours_change_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let draw = |name: &str, options: &[&str]| {
        let out = folder.path().join(name);
        let fixed =
            ["scenes/thesis-appendix-2.xml", "--size", "300x200", "--force", "-o", out.to_str().unwrap()];
        let output = render(&[&fixed, options].concat());
        assert!(output.status.success(), "{options:?}: {}", complaint(&output));
        std::fs::read(out).unwrap()
    };
    let base = draw("base.png", &["--view", "top"]);
    assert_eq!(base, draw("again.png", &["--view", "top"]), "the same picture twice");
    let others: [&[&str]; 6] = [
        &["--view", "front"],
        &["--view", "top", "--at", "1"],
        &["--view", "top", "--overlays", "none"],
        &["--view", "top", "--overlays", "map,tiles"],
        &["--view", "top", "--colors", "light"],
        &["--view", "top", "--zoom", "2"],
    ];
    for options in others {
        assert_ne!(base, draw("other.png", options), "{options:?} changed nothing");
    }
}

#[test]
fn bad_usage_says_the_way_out_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("none.png");
    let out = out.to_str().unwrap();
    let orbit = "scenes/orbit.xml";
    let photo = folder.path().join("none.jpg");
    let cases: [(&[&str], i32, &str); 7] = [
        (
            &[orbit, "-o", photo.to_str().unwrap()],
            2,
            "none.jpg: pictures are PNG files; give a name such as ",
        ),
        (&[orbit, "-o", out, "--overlays", "map,halo"], 2, "`halo`"),
        (&[orbit, "-o", out, "--size", "big"], 2, "1600x1000"),
        (&[orbit, "-o", out, "--size", "4x4"], 2, "16"),
        (&[orbit, "-o", out, "--at", "-1"], 2, "--at"),
        (&["scenes/not-there.xml", "-o", out], 1, "not-there.xml"),
        (&[orbit, "-o", "/no/such/folder/x.png"], 2, "/no/such/folder/x.png"),
    ];
    for (arguments, code, said) in cases {
        let output = render(arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", complaint(&output));
        assert!(complaint(&output).contains(said), "{arguments:?}: {}", complaint(&output));
        assert!(!Path::new(out).exists() && !photo.exists(), "{arguments:?} left a file");
    }
}

/// Small pictures of a scene from above.
fn sequence(out: &Path, options: &[&str]) -> Output {
    let out = out.to_str().unwrap();
    let fixed = ["scenes/thesis-appendix-2.xml", "--view", "top", "--size", "200x120", "-o", out];
    render(&[&fixed, options].concat())
}

fn files(folder: &Path) -> Vec<String> {
    let names = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_sequence_has_the_pictures_of_its_times() {
    let folder = tempfile::tempdir().unwrap();
    let output = sequence(&folder.path().join("a%03d.png"), &["--from", "0.5", "--to", "1.3", "--fps", "4"]);
    assert!(output.status.success(), "{}", complaint(&output));
    assert_eq!(files(folder.path()), ["a000.png", "a001.png", "a002.png", "a003.png"]);
    // Without contacts, of which a picture shows those since the last.
    let plain = ["--overlays", "map", "--force"];
    let output = sequence(
        &folder.path().join("a%03d.png"),
        &[&["--from", "0.5", "--until", "1.3", "--fps", "4"], &plain[..]].concat(),
    );
    assert!(output.status.success(), "{}", complaint(&output));
    for (name, at) in [("a000.png", "0.5"), ("a001.png", "0.75"), ("a002.png", "1"), ("a003.png", "1.25")] {
        let one = folder.path().join("one.png");
        assert!(sequence(&one, &[&["--at", at], &plain[..]].concat()).status.success());
        let of_sequence = std::fs::read(folder.path().join(name)).unwrap();
        assert!(of_sequence == std::fs::read(one).unwrap(), "{name} is not the picture at {at} s");
    }
}

/// A method that steps by Δt is looked at inside its steps where they do not fit the pictures.
#[test]
fn how_many_pictures_are_taken_changes_no_steps() {
    let folder = tempfile::tempdir().unwrap();
    let last = |name: &str, fps: &str| {
        let out = folder.path().join(name);
        std::fs::create_dir(&out).unwrap();
        let options =
            ["--until", "1", "--fps", fps, "--method", "fixed", "--dt", "1/20", "--overlays", "map"];
        let output = sequence(&out, &options);
        assert!(output.status.success(), "{}", complaint(&output));
        let names = files(&out);
        assert_eq!(names[0], "frame-00000.png");
        std::fs::read(out.join(names.last().unwrap())).unwrap()
    };
    let few = last("few", "1");
    assert!(few == last("steps", "10"), "pictures after every second step");
    assert!(few == last("between", "8"), "pictures inside steps");
}

#[test]
fn a_sequence_replaces_nothing_and_says_what_it_needs() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("b2.png"), "somebody's work").unwrap();
    let short = ["--until", "0.1", "--fps", "20"];
    let cases: [(&str, &[&str], &str); 8] = [
        ("b%d.png", &short, "b2.png: give another name, or --force"),
        ("c.png", &short, "frame-%05d.png"),
        ("c%d-%d.png", &short, "frame-%05d.png"),
        ("not-there/", &short, "not-there/frame-00000.png"),
        ("c%d.png", &["--until", "1", "--fps", "0"], "more than 0"),
        ("c%d.png", &["--until", "1", "--fps", "1e9"], "--fps"),
        ("c%d.png", &["--until", "1", "--from", "2"], "must end after it begins"),
        ("c%d.png", &["--until", "1", "--at", "1"], "--at"),
    ];
    for (name, options, said) in cases {
        let output = sequence(&path(name), options);
        assert_eq!(output.status.code(), Some(2), "{name} {options:?}: {}", complaint(&output));
        assert!(complaint(&output).contains(said), "{name} {options:?}: {}", complaint(&output));
        assert_eq!(files(folder.path()), ["b2.png"], "{name} {options:?} left a file");
    }
    let output = sequence(Path::new("-"), &short);
    assert!(complaint(&output).contains("numbered names"), "{}", complaint(&output));
    assert!(sequence(&path("b%d.png"), &[&short[..], &["--force"]].concat()).status.success());
    assert_eq!(files(folder.path()), ["b0.png", "b1.png", "b2.png"]);
    assert!(image::open(path("b2.png")).is_ok());
}

/// What was drawn before a limit stays, whole; a picture of another time than its number says is not drawn.
#[test]
fn a_sequence_that_is_stopped_keeps_what_it_has() {
    let folder = tempfile::tempdir().unwrap();
    let output =
        sequence(&folder.path().join("%d.png"), &["--until", "9", "--fps", "10", "--max-events", "20"]);
    assert_eq!(output.status.code(), Some(4), "{}", complaint(&output));
    let drawn = files(folder.path()).len();
    assert!((1..90).contains(&drawn), "{drawn}");
    assert!(image::open(folder.path().join(format!("{}.png", drawn - 1))).is_ok());
}
