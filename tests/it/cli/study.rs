//! `polyscene study`: table, CSV, SVG, JSON; refusals by the option's name; Ctrl-C.

use std::process::Stdio;
use std::time::{Duration, Instant};

use super::{BOUNCE, Bench, number, outcome, rows};

const STUDY: [&str; 10] =
    ["study", "scene.xml", "--until", "2", "--dt", "1/30,1/120", "--repeat", "1", "--samples", "50"];

#[test]
fn table_csv_and_svg_tell_of_every_method() {
    let bench = Bench::with_scene(BOUNCE);
    let outputs = ["--csv", "figures.csv", "--svg", "diagrams.svg"];
    let outcome = bench.polyscene(&[&STUDY[..], &outputs].concat());
    assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""));
    assert!(outcome.stdout.starts_with("scene.xml: speed against error over 2 s\n"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("over the whole 2.000 s"), "{}", outcome.stdout);
    let plain: Vec<String> =
        outcome.stdout.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    for row in ["exact", "thesis 1/30 s", "thesis 1/120 s", "fixed 1/30 s", "fixed 1/120 s"] {
        assert!(plain.iter().any(|line| line.starts_with(row)), "{row}: {}", outcome.stdout);
    }
    assert_eq!(bench.read("figures.csv").lines().count(), 6);
    assert!(bench.read("diagrams.svg").contains("<svg"));
}

#[test]
fn json_is_one_object_on_standard_output() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome = bench.polyscene(&[&STUDY[..], &["--json", "--methods", "fixed,exact"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let [report] = &rows(&outcome.stdout)[..] else { panic!("one line: {}", outcome.stdout) };
    assert_eq!(report["horizon"]["cause"], "whole_run");
    let points = report["points"].as_array().expect("points");
    assert_eq!(points.len(), 3);
    assert!(points[0]["method"] == "exact" && points[0]["dt"].is_null());
    assert!(number(&points[0]["position_error"]) < 1e-10, "{}", points[0]);
    assert!(number(&points[1]["position_error"]) > 1e-8, "{}", points[1]);
}

#[test]
fn what_is_wrong_is_said_by_the_options_name() {
    let bench = Bench::with_scene(BOUNCE);
    let cases: [(&[&str], &str); 10] = [
        (&["--until", "0"], "--until"),
        (&["--methods", "euler"], "possible values: exact, thesis, fixed"),
        (&["--dt", "20"], "--dt must lie between"),
        (&["--tolerances", "0.5"], "--tolerances must lie"),
        (&["--group-steps", "1/0"], "--group-steps must lie"),
        (&["--group-steps", "half"], "such as 0.5 or 1/2"),
        (&["--repeat", "0"], "--repeat must lie"),
        (&["--json", "--csv", "-"], "--json and --csv cannot both write to standard output"),
        (&["--svg", "scene.xml"], "--svg would overwrite the scene"),
        (&["--svg", "missing/a.svg"], "the folder missing does not exist"),
    ];
    for (arguments, hint) in cases {
        let outcome = bench.polyscene(&[&["study", "scene.xml"], arguments].concat());
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(hint), "{arguments:?} should say {hint:?}: {}", outcome.stderr);
    }
    assert_eq!(bench.read("scene.xml"), BOUNCE);
}

#[test]
fn help_gives_a_reason_for_every_knob() {
    let help = Bench::new().polyscene(&["study", "--help"]);
    for knob in polyscene::study::KNOBS {
        assert!(help.stdout.matches(&format!("--{}", knob.name)).count() >= 2, "{}", knob.name);
    }
    assert!(help.stdout.contains("polyscene study scene.xml --until 20 --svg"), "{}", help.stdout);
}

#[cfg(unix)]
#[test]
fn interrupted_it_reports_what_is_done() {
    let bench = Bench::with_scene(BOUNCE);
    let arguments = ["study", "scene.xml", "--until", "1e6", "--samples", "100", "--dt", "1/60"];
    let mut command = bench.command(&arguments);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    std::thread::sleep(Duration::from_millis(1500));
    let started = Instant::now();
    let killed = std::process::Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status();
    assert!(killed.expect("a shell").success());
    let outcome = outcome(child.wait_with_output().expect("an end"));
    assert!(started.elapsed() < Duration::from_secs(10));
    assert_eq!(outcome.code, 130, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("Cancelled"), "{}", outcome.stdout);
    assert!(outcome.stderr.contains("interrupted; the report holds"), "{}", outcome.stderr);
}
