//! `check` prints `file:line:column: severity: text (path); hint`, one problem per line.

use std::io::Write as _;
use std::process::Stdio;

use super::{BOUNCE, Bench, outcome, scene_files, scenes_folder};

#[test]
fn a_sound_scene_prints_nothing_on_stdout() {
    let outcome = Bench::with_scene(BOUNCE).polyscene(&["check", "scene.xml"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (0, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("1 file, 0 errors, 0 warnings"), "{}", outcome.stderr);
}

#[test]
fn every_problem_is_one_line_with_its_place() {
    let bench = Bench::new();
    bench.write("bad.xml", BOUNCE.replace("0,5", "-1").replace("F32=\"2\"", "F32=\"2.000,5\""));
    let outcome = bench.polyscene(&["check", "bad.xml"]);
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    let lines: Vec<&str> = outcome.stdout.lines().collect();
    assert_eq!(lines.len(), 2, "{}", outcome.stdout);
    // In the order of the file: the weight stands before the radius.
    assert!(lines[0].starts_with("bad.xml:17:") && lines[0].contains(": error: "), "{}", lines[0]);
    assert!(lines[1].starts_with("bad.xml:19:") && lines[1].contains(": error: "), "{}", lines[1]);
    assert!(lines[1].contains("(/PolyPhysicsXml/Primitives/SoftObject[7]/Sphere"), "{}", lines[1]);
}

#[test]
fn geometry_at_the_start_is_checked_too() {
    let bench = Bench::new();
    bench.write("low.xml", BOUNCE.replace(r#"X="5" Y="5""#, r#"X="5" Y="0,25""#));
    bench.write("far.xml", BOUNCE.replace(r#"X="5" Y="5""#, r#"X="5" Y="50""#));
    let outcome = bench.polyscene(&["check", "low.xml", "far.xml"]);
    assert_eq!(outcome.code, 0, "warnings are allowed: {}", outcome.stderr);
    let lines: Vec<&str> = outcome.stdout.lines().collect();
    assert_eq!(lines.len(), 2, "{}", outcome.stdout);
    for (line, file, word) in [(lines[0], "low.xml:", "overlap"), (lines[1], "far.xml:", "outside")] {
        assert!(line.starts_with(file) && line.contains(": warning: ") && line.contains(word), "{line}");
        assert!(line[file.len()..].starts_with(|c: char| c.is_ascii_digit()), "no place in {line}");
    }
}

/// Symptom: a ball on an attractor passed the check, and its run ended with "energy NaN". Expected: an error with its
/// line and the way out, and no run. The same for any body that cannot take its first step.
#[test]
fn a_body_that_cannot_begin_is_an_error_with_its_line() {
    let bench = Bench::new();
    let attractor = |gravity: &str| {
        let force = format!(
            "<GravityPoint UserID=\"2\"><Translation X=\"5\" Y=\"5\" Z=\"5\" />\
             <Gravity F32=\"{gravity}\" /></GravityPoint>\n    </Forces>"
        );
        BOUNCE.replace("</Forces>", &force)
    };
    bench.write("on.xml", attractor("10"));
    bench.write("on-repeller.xml", attractor("-10"));
    bench.write(
        "in-core.xml",
        attractor("10").replace(r#"<Translation X="5" Y="5""#, r#"<Translation X="5,0000001" Y="5""#),
    );
    bench.write(
        "strong.xml",
        attractor("1e300").replace(r#"<Translation X="5" Y="5""#, r#"<Translation X="4" Y="5""#),
    );
    for name in ["on.xml", "on-repeller.xml", "strong.xml"] {
        let checked = bench.polyscene(&["check", name]);
        assert_eq!(checked.code, 1, "{name}: {}", checked.stderr);
        let place = format!("{name}:14:5: error: body 7: ");
        assert!(checked.stdout.starts_with(&place) && checked.stdout.contains("; "), "{}", checked.stdout);
        let run = bench.polyscene(&["run", name, "--until", "1", "--json"]);
        assert_eq!((run.code, run.stdout.as_str()), (1, ""), "{name}: {}", run.stderr);
        assert!(run.stderr.contains(&place) && !run.stderr.contains("NaN"), "{}", run.stderr);
    }
}

/// Symptom: "and 5 more overlaps" stood before the first overlap.
#[test]
fn what_sums_up_problems_comes_after_them() {
    let bench = Bench::new();
    let balls: String = (0..30)
        .map(|id| {
            format!(
                "<SoftObject UserID=\"{}\"><Translation X=\"5\" Y=\"{}\" Z=\"5\"/><Sphere><Radius F32=\"0,5\"/></Sphere></SoftObject>",
                id + 100,
                3.0 + 0.01 * f64::from(id)
            )
        })
        .collect();
    bench.write("heap.xml", BOUNCE.replace("</Primitives>", &format!("{balls}</Primitives>")));
    let checked = bench.polyscene(&["check", "heap.xml"]);
    let lines: Vec<&str> = checked.stdout.lines().collect();
    let more = lines.iter().position(|line| line.contains("more overlaps")).expect("more than are listed");
    assert_eq!(more, lines.len() - 1, "{}", checked.stdout);
}

#[test]
fn several_files_share_one_verdict() {
    let bench = Bench::with_scene(BOUNCE);
    bench.write("empty.xml", "");
    let outcome = bench.polyscene(&["check", "scene.xml", "empty.xml", "missing.xml"]);
    assert_eq!(outcome.code, 1);
    let lines: Vec<&str> = outcome.stdout.lines().collect();
    assert_eq!(lines.len(), 2, "{}", outcome.stdout);
    assert!(lines[0].starts_with("empty.xml:1:1: error: "), "{}", lines[0]);
    assert!(lines[1].starts_with("missing.xml: error: "), "{}", lines[1]);
    assert!(outcome.stderr.contains("3 files, 2 errors, 0 warnings"), "{}", outcome.stderr);
}

#[test]
fn standard_input_is_a_file_too() {
    let bench = Bench::new();
    let mut child = bench
        .command(&["check", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    child.stdin.take().expect("a pipe").write_all(b"<nonsense/>").expect("the program reads");
    let outcome = outcome(child.wait_with_output().expect("the program ends"));
    assert_eq!(outcome.code, 1);
    assert!(outcome.stdout.starts_with("<stdin>:1:1: error: "), "{}", outcome.stdout);
}

#[test]
fn the_scenes_that_come_with_the_program_are_sound() {
    let files = scene_files(&scenes_folder());
    assert!(files.len() >= 6, "only {} scenes", files.len());
    let names: Vec<&str> = files.iter().map(|file| file.to_str().expect("UTF-8 paths")).collect();
    let outcome = Bench::new().polyscene(&[&["check"], &names[..]].concat());
    assert_eq!((outcome.code, outcome.stdout.as_str()), (0, ""), "{}", outcome.stderr);
}

#[test]
fn each_invalid_scene_has_an_error_with_its_file() {
    let files = scene_files(&scenes_folder().join("invalid"));
    let names: Vec<&str> = files.iter().map(|file| file.to_str().expect("UTF-8 paths")).collect();
    let outcome = Bench::new().polyscene(&[&["check"], &names[..]].concat());
    assert_eq!(outcome.code, 1);
    for (file, name) in files.iter().zip(&names) {
        let mut own = outcome.stdout.lines().filter(|line| line.starts_with(&format!("{name}:")));
        let is_warning = file.file_name().is_some_and(|name| name.to_string_lossy().starts_with("warning-"));
        let found = own.any(|line| line.contains(": error: "));
        assert_eq!(found, !is_warning, "{name}");
    }
}

#[test]
fn fix_puts_right_what_can_be_in_place_and_says_so() {
    let bench = Bench::new();
    let low = BOUNCE.replace(r#"X="5" Y="5""#, r#"X="5" Y="0,25""#);
    bench.write("low.xml", low.clone());
    let outcome = bench.polyscene(&["check", "--fix", "low.xml"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (0, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("low.xml: pushed overlapping bodies apart"), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("1 file, 0 errors, 0 warnings"), "{}", outcome.stderr);
    let fixed = std::fs::read_to_string(bench.path("low.xml")).unwrap();
    assert_ne!(fixed, low);
    let again = bench.polyscene(&["check", "--fix", "low.xml"]);
    assert!(!again.stderr.contains("pushed"), "{}", again.stderr);
    assert_eq!(std::fs::read_to_string(bench.path("low.xml")).unwrap(), fixed);
}

#[test]
fn fix_writes_elsewhere_and_refuses_what_is_unclear() {
    let bench = Bench::new();
    let far = BOUNCE.replace(r#"X="5" Y="5""#, r#"X="5" Y="50""#);
    bench.write("far.xml", far.clone());
    let outcome = bench.polyscene(&["check", "--fix", "far.xml", "-o", "near.xml"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert_eq!(std::fs::read_to_string(bench.path("far.xml")).unwrap(), far);
    assert_eq!(bench.polyscene(&["check", "near.xml"]).stdout, "");
    for wrong in [
        &["check", "--fix", "-"][..],
        &["check", "--fix", "far.xml", "far.xml", "-o", "x.xml"],
        &["check", "--fix", "far.xml", "-o", "-"],
        &["check", "far.xml", "-o", "x.xml"],
        &["check", "--fix", "far.xml", "-o", "no/such/folder.xml"],
    ] {
        let outcome = bench.polyscene(wrong);
        assert_eq!(outcome.code, 2, "{wrong:?}: {}", outcome.stderr);
    }
    bench.write("broken.xml", "<PolyPhysicsXml");
    assert_eq!(bench.polyscene(&["check", "--fix", "broken.xml"]).code, 1);
    assert_eq!(std::fs::read_to_string(bench.path("broken.xml")).unwrap(), "<PolyPhysicsXml");
}

/// Symptom: `check --fix -o FILE` replaced a file that was there. Expected: it asks for `--force`, as `export` and `record` do.
/// Cause: it wrote without looking.
#[test]
fn fix_replaces_no_other_file_unasked() {
    let bench = Bench::new();
    bench.write("far.xml", BOUNCE.replace(r#"X="5" Y="5""#, r#"X="5" Y="50""#));
    bench.write("notes.txt", "mine");
    let fix = ["check", "--fix", "far.xml", "-o", "notes.txt"];
    let outcome = bench.polyscene(&fix);
    assert!(outcome.code == 2 && outcome.stderr.contains("--force"), "{}", outcome.stderr);
    assert_eq!(std::fs::read_to_string(bench.path("notes.txt")).unwrap(), "mine");
    let outcome = bench.polyscene(&[&fix[..], &["--force"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert_eq!(bench.polyscene(&["check", "notes.txt"]).stdout, "");
    assert_eq!(bench.polyscene(&["check", "--fix", "far.xml", "-o", "far.xml", "--force"]).code, 2);
}

#[test]
fn tiles_and_masses_are_checked_too() {
    let bench = Bench::new();
    let fine =
        BOUNCE.replace("<Tiles X=\"10\" Y=\"10\" Z=\"10\" />", "<Tiles X=\"200\" Y=\"400\" Z=\"200\" />");
    bench.write("fine.xml", fine);
    let outcome = bench.polyscene(&["check", "fine.xml"]);
    assert!(outcome.stdout.contains("200 × 400 × 200 tiles are 16 million"), "{}", outcome.stdout);
    let outcome = bench.polyscene(&["check", "--fix", "fine.xml"]);
    assert!(outcome.stderr.contains("fitted the tiles"), "{}", outcome.stderr);
    assert_eq!(outcome.stdout, "");
}

/// Symptom: a scene that ran with a warning was made one with an error, and written. Cause: what was put right was not looked at.
#[test]
fn a_fix_that_makes_errors_is_not_written() {
    let bench = Bench::new();
    let huge = BOUNCE.replace("<Radius F32=\"0,5\" />", "<Radius F32=\"1e300\" />");
    bench.write("huge.xml", huge.clone());
    assert_eq!(bench.polyscene(&["check", "huge.xml"]).code, 0);
    for fix in [&["check", "--fix", "huge.xml"][..], &["check", "--fix", "huge.xml", "-o", "fixed.xml"]] {
        let outcome = bench.polyscene(fix);
        assert_eq!(outcome.code, 1, "{}", outcome.stderr);
        assert!(
            outcome.stderr.contains("huge.xml: the fix is not written, it would make "),
            "{}",
            outcome.stderr
        );
        assert!(outcome.stderr.contains("1 file not fixed"), "{}", outcome.stderr);
        assert!(!bench.path("fixed.xml").exists());
        assert_eq!(std::fs::read_to_string(bench.path("huge.xml")).unwrap(), huge);
    }
}
