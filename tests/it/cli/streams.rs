//! Readers that go away, Ctrl-C and full disks: what was written is always whole lines.

use std::io::{BufRead as _, BufReader};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::{BOUNCE, Bench, rows};

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

#[test]
fn ctrl_c_leaves_whole_lines() {
    let bench = Bench::with_scene(BOUNCE);
    let options = ["--states", "states.jsonl", "--final", "final.xml"];
    let child = bench
        .command(&[&FOR_EVER[..], &options].concat())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let patience = Instant::now();
    while std::fs::metadata(bench.path("states.jsonl")).map_or(0, |file| file.len()) == 0 {
        assert!(patience.elapsed() < Duration::from_secs(60), "no row in a minute");
        std::thread::sleep(Duration::from_millis(5));
    }
    // The shell's own kill: a small system has no program of that name.
    let killed = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status();
    assert!(killed.is_ok_and(|status| status.success()));
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(130));
    assert!(String::from_utf8_lossy(&output.stderr).contains("interrupted at t = "));
    assert!(!rows(&bench.read("states.jsonl")).is_empty());
    assert!(!bench.path("final.xml").exists(), "the end was never reached");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome =
        bench.polyscene(&["run", "scene.xml", "--dt", "0.1", "--until", "1", "--states", "/dev/full"]);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("can't write /dev/full"), "{}", outcome.stderr);
}
