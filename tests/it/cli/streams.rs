//! Readers that go away, Ctrl-C and full disks: what was written is always whole lines.

use std::io::{BufRead as _, BufReader};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use polyscene::scene::Document;

use super::{BOUNCE, Bench, number, rows, scenes_folder};

/// Longer than any test waits: 10⁷ rows.
const FOR_EVER: [&str; 6] = ["run", "scene.xml", "--dt", "1e-4", "--until", "1e3"];

#[test]
fn a_closed_pipe_ends_the_run_quietly() {
    let bench = Bench::with_scene(BOUNCE);
    let mut child = bench
        .command(&[&FOR_EVER[..], &["--states", "-"]].concat())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut first = String::new();
    // The reader, and with it the pipe, goes away at the end of the statement.
    BufReader::new(child.stdout.take().expect("a pipe")).read_line(&mut first).expect("a row");
    assert_eq!(rows(&first).len(), 1);
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

/// Starts a run that writes `states.jsonl` and presses Ctrl-C once a row is there: how it ended, what it said.
fn interrupted(bench: &Bench, arguments: &[&str]) -> (Option<i32>, String) {
    interrupted_after(bench, "states.jsonl", arguments)
}

/// The same for a program that writes another file.
fn interrupted_after(bench: &Bench, file: &str, arguments: &[&str]) -> (Option<i32>, String) {
    let child = bench
        .command(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let patience = Instant::now();
    while std::fs::metadata(bench.path(file)).map_or(0, |file| file.len()) == 0 {
        assert!(patience.elapsed() < Duration::from_secs(60), "nothing in {file} in a minute");
        std::thread::sleep(Duration::from_millis(5));
    }
    // The shell's own kill: a small system has no program of that name.
    let killed = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status();
    assert!(killed.is_ok_and(|status| status.success()));
    let output = child.wait_with_output().expect("the program ends");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn ctrl_c_leaves_whole_lines() {
    let bench = Bench::with_scene(BOUNCE);
    let options = ["--every", "1000", "--states", "states.jsonl", "--final", "final.xml"];
    let (code, complaint) = interrupted(&bench, &[&FOR_EVER[..], &options].concat());
    assert_eq!(code, Some(130));
    assert!(complaint.contains("interrupted at t = "), "{complaint}");
    // Symptom: the state it ends with was in no row of --every 1000. Expected: the last row, once.
    let states = rows(&bench.read("states.jsonl"));
    let times: Vec<_> = states.iter().map(|row| number(&row["t"])).collect();
    assert!(times.is_sorted_by(|a, b| a < b), "{times:?}");
    let last = Document::open(&bench.path("final.xml"));
    let y = last.scene().expect("a scene").bodies[0].position.y;
    assert_eq!(y, number(&states.last().expect("a last row")["bodies"][0]["x"][1]));
    // Symptom: --final was not written. Expected: the state reached.
    assert!(bench.read("final.xml").contains("<SoftObject") && bench.read("final.xml") != BOUNCE);
}

#[test]
fn ctrl_c_reaches_a_run_within_a_step_without_events() {
    let orbit = scenes_folder().join("orbit.xml");
    let orbit = orbit.to_str().expect("UTF-8 paths");
    let bench = Bench::new();
    let (code, complaint) =
        interrupted(&bench, &["run", orbit, "--dt", "1e8", "--until", "1e8", "--states", "states.jsonl"]);
    assert_eq!(code, Some(130));
    // A run that does not look at the request in time is ended without a word.
    assert!(complaint.contains("interrupted at t = "), "{complaint}");
}

/// Symptom: Ctrl-C was heard at the next picture only, however far that is. Expected: at once.
#[test]
fn ctrl_c_reaches_a_film_between_two_pictures() {
    let orbit = scenes_folder().join("orbit.xml");
    let orbit = orbit.to_str().expect("UTF-8 paths");
    let bench = Bench::new();
    let film = ["render", orbit, "-o", "f-%02d.png", "--until", "1e8", "--fps", "1e-8", "--size", "64x64"];
    let (code, complaint) = interrupted_after(&bench, "f-00.png", &film);
    assert_eq!(code, Some(130));
    assert!(complaint.contains("interrupted at t = "), "{complaint}");
    assert!(!bench.path("f-01.png").exists());
}

/// Symptom: “what was written so far is complete”, though there was no file.
#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_during_an_export_says_that_nothing_was_written() {
    let gas = scenes_folder().join("gas.xml");
    let bench = Bench::new();
    let child = bench
        .command(&[
            "export",
            gas.to_str().expect("UTF-8 paths"),
            "--to",
            "csv",
            "--at",
            "1e6",
            "-o",
            "gas.csv",
        ])
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let id = child.id();
    // Caught signals as bits, of which the second is that of Ctrl-C.
    let hears = || {
        let status = std::fs::read_to_string(format!("/proc/{id}/status")).unwrap_or_default();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & 2 != 0)
    };
    let patience = Instant::now();
    while !hears() {
        assert!(patience.elapsed() < Duration::from_secs(60), "it does not listen in a minute");
        std::thread::sleep(Duration::from_millis(5));
    }
    let killed = Command::new("sh").args(["-c", &format!("kill -INT {id}")]).status();
    assert!(killed.is_ok_and(|status| status.success()));
    let output = child.wait_with_output().expect("the program ends");
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(130), "{complaint}");
    assert!(complaint.contains("; nothing was written"), "{complaint}");
    assert!(!bench.path("gas.csv").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome =
        bench.polyscene(&["run", "scene.xml", "--dt", "0.1", "--until", "1", "--states", "/dev/full"]);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("cannot write /dev/full"), "{}", outcome.stderr);
}

/// What the simulation finds wrong is told with its place, although the document is given back before it begins: a file is
/// read again for that, what came through a pipe is kept.
#[test]
fn problems_at_the_start_have_their_places_wherever_the_scene_comes_from() {
    let low = BOUNCE.replace(r#"X="5" Y="5""#, r#"X="5" Y="0,25""#);
    let core = "<GravityPoint UserID=\"2\"><Translation X=\"5\" Y=\"5\" Z=\"5\" />\
                <Gravity F32=\"10\" /></GravityPoint>\n    </Forces>";
    let stuck = BOUNCE.replace("</Forces>", core);
    for (scene, code, word) in [(low, 0, "warning: "), (stuck, 1, "error: ")] {
        let bench = Bench::with_scene(&scene);
        let checked = bench.polyscene(&["check", "scene.xml"]).stdout;
        assert!(checked.contains(word) && checked.starts_with("scene.xml:1"), "{checked}");
        let run = |from: &str| {
            let command = format!("{from} --until 0.1 --json");
            let output = Command::new("sh").args(["-c", &command]).current_dir(bench.path(".")).output();
            let output = output.expect("the shell starts");
            (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
        };
        let program = env!("CARGO_BIN_EXE_polyscene");
        for (from, name) in [
            (format!("{program} run scene.xml"), "scene.xml"),
            (format!("{program} run - < scene.xml"), "<stdin>"),
            (format!("cat scene.xml | {program} run /dev/stdin"), "/dev/stdin"),
        ] {
            let (ended, said) = run(&from);
            assert_eq!(ended, Some(code), "{from}: {said}");
            let first = said.lines().next().unwrap_or_default();
            let expected = checked
                .lines()
                .next()
                .map(|line| format!("polyscene: {}", line.replacen("scene.xml", name, 1)));
            assert_eq!(Some(first.to_owned()), expected, "{from}");
        }
    }
}
