//! Outputs that cannot or must not be written are refused before the work, in words about the file itself.

use super::{BOUNCE, Bench};

const RUN: [&str; 6] = ["run", "scene.xml", "--dt", "0.1", "--until", "1"];

/// Asks for a refusal that says `hint`.
fn refused(bench: &Bench, arguments: &[&str], hint: &str) {
    let outcome = bench.polyscene(arguments);
    assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
    assert!(outcome.stderr.contains(hint), "{arguments:?} should say {hint:?}: {}", outcome.stderr);
    assert!(!outcome.stderr.contains(".tmp"), "{arguments:?}: {}", outcome.stderr);
    assert_eq!(outcome.stdout, "", "{arguments:?}");
}

#[test]
fn one_file_spelt_in_two_ways_is_one_output() {
    let bench = Bench::with_scene(BOUNCE);
    let absolute = bench.path("y.o");
    for other in ["./y.o", ".//y.o", absolute.to_str().expect("UTF-8 paths")] {
        refused(&bench, &[&RUN[..], &["--events", "y.o", "--states", other]].concat(), "cannot both write");
        refused(&bench, &[&RUN[..], &["--final", "y.o", "--states", other]].concat(), "cannot both write");
    }
    assert!(!absolute.exists());
}

#[test]
fn a_last_state_that_cant_be_written_is_refused_before_the_run() {
    let bench = Bench::with_scene(BOUNCE);
    std::fs::create_dir(bench.path("folder")).expect("a folder");
    let cases = [
        ("folder", "cannot write folder: it is a folder"),
        ("missing/final.xml", "the folder missing does not exist"),
        ("scene.xml/final.xml", "scene.xml is not a folder"),
    ];
    for (target, hint) in cases {
        // Rows appear as soon as the run begins.
        let outputs = ["--final", target, "--states", "states.jsonl"];
        refused(&bench, &[&RUN[..], &outputs].concat(), hint);
        assert!(!bench.path("states.jsonl").exists(), "{target}: the run began");
    }
    let left: Vec<_> = std::fs::read_dir(bench.path(".")).expect("the folder").collect();
    assert_eq!(left.len(), 2, "{left:?}");
}

#[cfg(unix)]
#[test]
fn the_last_state_may_go_to_the_null_device() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome = bench.polyscene(&[&RUN[..], &["--final", "/dev/null"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    use std::os::unix::fs::FileTypeExt as _;
    let kind = std::fs::metadata("/dev/null").expect("the null device").file_type();
    assert!(kind.is_char_device(), "it was replaced");
}

#[cfg(target_os = "linux")]
#[test]
fn the_last_state_may_go_into_an_open_pipe() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome = bench.polyscene(&[&RUN[..], &["--final", "/dev/stderr"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.ends_with("</PolyPhysicsXml>\n"), "{}", outcome.stderr);
}

#[cfg(target_os = "linux")]
#[test]
fn problems_that_cant_be_printed_are_told() {
    let bench = Bench::new();
    bench.write("bad.xml", BOUNCE.replace("0,5", "-1"));
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("the full device");
    let output = bench.command(&["check", "bad.xml"]).stdout(full).output().expect("the program starts");
    let outcome = super::outcome(output);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("cannot write standard output"), "{}", outcome.stderr);
}

#[cfg(feature = "render")]
#[test]
fn a_picture_never_replaces_its_scene() {
    let bench = Bench::with_scene(BOUNCE);
    for out in ["scene.xml", "./scene.xml"] {
        refused(&bench, &["render", "scene.xml", "-o", out], "overwrite the scene");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("scene.xml", bench.path("link.png")).expect("a link");
        refused(&bench, &["render", "scene.xml", "-o", "link.png"], "overwrite the scene");
        refused(&bench, &["render", "link.png", "-o", "scene.xml"], "overwrite the scene");
    }
    assert_eq!(bench.read("scene.xml"), BOUNCE);
}

/// Symptom: `--final` replaced the scene, or another, without a word. Expected: it asks for `--force`, by whatever name
/// the scene is called; a file without bytes is no loss.
#[test]
fn a_last_state_replaces_a_scene_only_by_force() {
    let bench = Bench::with_scene(BOUNCE);
    bench.write("other.xml", "work");
    bench.write("empty.xml", "");
    std::fs::hard_link(bench.path("scene.xml"), bench.path("twin.xml")).expect("a hard link");
    for (target, hint) in [
        ("scene.xml", "--final would overwrite the scene scene.xml; --force"),
        ("twin.xml", "--final would overwrite the scene twin.xml; --force"),
        ("other.xml", "--final would overwrite other.xml: give another name, or --force"),
    ] {
        refused(&bench, &[&RUN[..], &["--final", target]].concat(), hint);
    }
    assert_eq!((bench.read("scene.xml").as_str(), bench.read("other.xml").as_str()), (BOUNCE, "work"));
    let forced = |target| bench.polyscene(&[&RUN[..], &["--final", target, "--force"]].concat());
    for target in ["other.xml", "twin.xml", "scene.xml"] {
        let outcome = forced(target);
        assert_eq!(outcome.code, 0, "{target}: {}", outcome.stderr);
        assert!(bench.read(target).contains("<!-- kept -->") && bench.read(target) != BOUNCE, "{target}");
    }
    assert_eq!(bench.polyscene(&[&RUN[..], &["--final", "empty.xml"]].concat()).code, 0);
}

/// Symptom: `run --states`, `run --events`, `replay --events` and `study --csv` replaced a file that was there. Expected: they ask
/// for `--force`, as all others do.
#[test]
fn rows_and_figures_replace_a_file_only_by_force() {
    let bench = Bench::with_scene(BOUNCE);
    let made = bench.polyscene(&["record", "scene.xml", "--until", "1", "-o", "run.psrec"]);
    assert_eq!(made.code, 0, "{}", made.stderr);
    let study = ["study", "scene.xml", "--until", "0.1", "--methods", "exact", "--repeat", "1"];
    for (verb, option) in [
        (&RUN[..], "--states"),
        (&RUN[..], "--events"),
        (&["replay", "run.psrec"], "--events"),
        (&study, "--csv"),
        (&study, "--svg"),
    ] {
        bench.write("work.csv", "work");
        let arguments = [verb, &[option, "work.csv"]].concat();
        refused(
            &bench,
            &arguments,
            &format!("{option} would overwrite work.csv: give another name, or --force"),
        );
        assert_eq!(bench.read("work.csv"), "work");
        let forced = bench.polyscene(&[&arguments[..], &["--force"]].concat());
        assert_eq!(forced.code, 0, "{arguments:?}: {}", forced.stderr);
        assert_ne!(bench.read("work.csv"), "work");
    }
}

#[cfg(feature = "render")]
#[test]
fn a_picture_may_go_to_standard_output() {
    let bench = Bench::with_scene(BOUNCE);
    let render = ["render", "scene.xml", "--size", "64x48", "--overlays", "none", "-o"];
    let output = bench.command(&[&render[..], &["-"]].concat()).output().expect("the program starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let picture = image::load_from_memory(&output.stdout).expect("a picture");
    assert_eq!((picture.width(), picture.height()), (64, 48));
    assert!(!bench.path("-").exists());
}

#[cfg(feature = "render")]
#[test]
fn a_picture_in_no_folder_is_refused_in_words() {
    let bench = Bench::with_scene(BOUNCE);
    refused(
        &bench,
        &["render", "scene.xml", "-o", "no/x.png"],
        "the folder no does not exist; make it first",
    );
    let film = ["render", "scene.xml", "--until", "1", "--fps", "2", "-o"];
    refused(&bench, &[&film[..], &["no/"]].concat(), "the folder no does not exist; make it first");
    refused(&bench, &[&film[..], &["no"]].concat(), "need a folder that is there");
}

/// Symptom: rows written to a hard link of the scene, or to the file that standard input came from, destroyed
/// the scene. Cause: names were compared, not files.
#[cfg(unix)]
#[test]
fn an_output_that_is_the_scene_by_another_name_is_refused() {
    use std::fs::File;
    let bench = Bench::with_scene(BOUNCE);
    std::fs::hard_link(bench.path("scene.xml"), bench.path("twin")).expect("a hard link");
    std::os::unix::fs::symlink("scene.xml", bench.path("link")).expect("a link");
    for other in ["twin", "link"] {
        for option in ["--states", "--events"] {
            refused(&bench, &[&RUN[..], &[option, other]].concat(), "overwrite the scene");
        }
        for option in ["--csv", "--svg"] {
            refused(&bench, &["study", "scene.xml", option, other], "overwrite the scene");
        }
        let both = [&RUN[..], &["--final", "scene.xml", "--events", other]].concat();
        refused(&bench, &both, "cannot both write");
        for arguments in [
            &["run", "-", "--until", "1", "--states", other][..],
            &["study", "-", "--csv", other],
            #[cfg(feature = "render")]
            &["render", "-", "-o", other],
        ] {
            let scene = File::open(bench.path("scene.xml")).expect("the scene");
            let output = bench.command(arguments).stdin(scene).output().expect("the program starts");
            let outcome = super::outcome(output);
            assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
            assert!(outcome.stderr.contains("overwrite the scene"), "{arguments:?}: {}", outcome.stderr);
        }
    }
    assert_eq!(bench.read("scene.xml"), BOUNCE);
}

/// A run of the program whose files may not grow beyond 4 KiB: what a full disk does, without one.
#[cfg(target_os = "linux")]
fn on_a_full_disk(bench: &Bench, arguments: &[&str]) -> super::Outcome {
    let program = bench.command(arguments);
    let script = "trap '' XFSZ; ulimit -f 8; exec \"$@\"";
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", script, "sh"]).arg(program.get_program()).args(program.get_args());
    shell.current_dir(bench.path("."));
    super::outcome(shell.output().expect("a shell"))
}

/// Symptom: on a full disk the last line of states and events was cut. Expected: whole lines, and exit code 2.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_whole_lines() {
    let bench = Bench::with_scene(BOUNCE);
    let run = ["run", "scene.xml", "--dt", "0.01", "--until", "10", "--states", "states.jsonl"];
    let outcome = on_a_full_disk(&bench, &run);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("cannot write states.jsonl"), "{}", outcome.stderr);
    assert!(super::rows(&bench.read("states.jsonl")).len() > 3);
}

/// Symptom: `study --csv --svg` onto a full disk emptied the old files first. Expected: they stay, and nothing
/// else is left behind.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_keeps_the_old_figures_and_diagrams() {
    let bench = Bench::with_scene(BOUNCE);
    bench.write("a.svg", "old");
    let study = ["study", "scene.xml", "--until", "1", "--repeat", "1", "--dt", "1/30", "--svg", "a.svg"];
    let outcome = on_a_full_disk(&bench, &study);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert_eq!(bench.read("a.svg"), "old");
    let left = std::fs::read_dir(bench.path(".")).expect("the folder").count();
    assert_eq!(left, 2, "the scene and the old picture");
}

#[cfg(target_os = "linux")]
#[test]
fn help_that_cant_be_printed_is_an_error() {
    for arguments in [&["--help"][..], &["run", "--help"], &["--version"]] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("the full device");
        let output = Bench::new().command(arguments).stdout(full).output().expect("the program starts");
        let outcome = super::outcome(output);
        assert_eq!(outcome.code, 2, "{arguments:?}");
        assert!(outcome.stderr.contains("cannot write standard output"), "{}", outcome.stderr);
    }
}

/// Symptom: a program killed while it saved left `.polyscene-….tmp` for ever. Expected: the next save there
/// removes it, and nothing that somebody still writes or that is not ours.
#[test]
fn a_save_removes_what_a_killed_one_left() {
    let bench = Bench::with_scene(BOUNCE);
    let old = std::time::SystemTime::now() - std::time::Duration::from_secs(600);
    let make = |name: &str, time| {
        let file = std::fs::File::create(bench.path(name)).expect("a file");
        file.set_modified(time).expect("a date");
        file
    };
    make(".polyscene-abc.tmp", old);
    make(".polyscene-new.tmp", std::time::SystemTime::now());
    make(".other-abc.tmp", old);
    let held = make(".polyscene-held.tmp", old);
    held.lock().expect("a lock");
    let outcome = bench.polyscene(&[&RUN[..], &["--final", "final.xml"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let there = [".polyscene-abc.tmp", ".polyscene-new.tmp", ".other-abc.tmp", ".polyscene-held.tmp"]
        .map(|name| bench.path(name).exists());
    assert_eq!(there, [false, true, true, true]);
}

/// Symptom: `--final x` overwrote without a word what another program had written to x during the run.
/// Expected: that stays, and the state goes beside it.
#[cfg(unix)]
#[test]
fn a_file_that_changed_during_the_run_is_not_overwritten() {
    let bench = Bench::new();
    let made = std::process::Command::new("mkfifo").arg(bench.path("scene.fifo")).status();
    assert!(made.is_ok_and(|status| status.success()));
    bench.write("x.xml", "before");
    let run = ["run", "scene.fifo", "--until", "1", "--final", "x.xml", "--force"];
    let child = bench.command(&run).stderr(std::process::Stdio::piped()).spawn().expect("the program starts");
    // Opening waits for the program, which by then has looked at x.xml.
    let mut scene = std::fs::OpenOptions::new().write(true).open(bench.path("scene.fifo")).expect("a pipe");
    bench.write("x.xml", "written meanwhile");
    std::io::Write::write_all(&mut scene, BOUNCE.as_bytes()).expect("the scene is read");
    drop(scene);
    let output = child.wait_with_output().expect("the program ends");
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{complaint}");
    assert!(complaint.contains("the last state is in x-2.xml"), "{complaint}");
    assert_eq!(bench.read("x.xml"), "written meanwhile");
    assert!(bench.read("x-2.xml").contains("<SoftObject"));
}

/// Symptom: an energy beyond the largest number was `null` in the summary, without a word.
#[test]
fn an_energy_that_is_no_number_is_told() {
    let bench = Bench::with_scene(
        &BOUNCE
            .replace("Weight F32=\"2\"", "Weight F32=\"1E300\"")
            .replace("InitialVelocity X=\"0\"", "InitialVelocity X=\"1E5\""),
    );
    let outcome = bench.polyscene(&["run", "scene.xml", "--until", "0.1", "--json"]);
    assert!(outcome.stderr.contains("beyond the largest number"), "{}", outcome.stderr);
    let [summary] = &super::rows(&outcome.stdout)[..] else { panic!("one line: {}", outcome.stdout) };
    let warnings = summary["warnings"].as_array().expect("warnings");
    assert!(warnings.iter().any(|text| text.as_str().is_some_and(|text| text.contains("largest number"))));
}

/// Symptom: a scene of another owner, saved by root, became root's. Where the test is not root's it can only
/// see that the mode is kept.
#[cfg(unix)]
#[test]
fn a_saved_file_keeps_its_owner_and_mode() {
    use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _, chown};
    let bench = Bench::with_scene(BOUNCE);
    let path = bench.path("scene.xml");
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o640)).expect("a mode");
    let given = chown(&path, Some(1234), Some(4321)).is_ok();
    let outcome = bench.polyscene(&[&RUN[..], &["--final", "scene.xml", "--force"]].concat());
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    let about = std::fs::metadata(&path).expect("the file");
    assert_eq!(about.mode() & 0o777, 0o640);
    if given {
        assert_eq!((about.uid(), about.gid()), (1234, 4321));
    }
}
