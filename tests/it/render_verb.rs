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
        let output = render(&[scene, "-o", out.to_str().unwrap(), "--at", "0.1", "--size", "480x320"]);
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
        let fixed = ["scenes/thesis-appendix-2.xml", "--size", "300x200", "-o", out.to_str().unwrap()];
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
    let cases: [(&[&str], i32, &str); 6] = [
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
        assert!(!Path::new(out).exists(), "{arguments:?} left a file");
    }
}
