//! Runs that are stopped early by a limit, that need no Δt, and that would never begin.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use polyscene::scene::Document;

use super::{BOUNCE, Bench, number, rows};

/// Symptom: a run of a scene with endless impacts could only be killed, and then its last state was lost.
/// Expected: `--max-events` ends it right after that event, with every output written and an exit code of its own.
#[test]
fn a_run_ends_after_so_many_events_with_its_state_written() {
    let bench = Bench::with_scene(BOUNCE);
    let outputs = ["--events", "events.jsonl", "--states", "states.jsonl", "--final", "final.xml", "--json"];
    let run = ["run", "scene.xml", "--dt", "0.1", "--until", "1e6", "--max-events", "3"];
    let outcome = bench.polyscene(&[&run[..], &outputs].concat());
    assert_eq!(outcome.code, 4, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("stopped early at t = "), "{}", outcome.stderr);
    let events = rows(&bench.read("events.jsonl"));
    assert_eq!(events.len(), 3);
    let [summary] = &rows(&outcome.stdout)[..] else { panic!("one line: {}", outcome.stdout) };
    assert!(summary["stopped"].as_str().is_some_and(|why| why.contains("3 events")), "{summary}");
    assert_eq!(summary["t"], events[2]["t"]);
    let states = rows(&bench.read("states.jsonl"));
    assert_eq!(states.last().expect("a last row")["t"], events[2]["t"]);
    let last = Document::open(&bench.path("final.xml"));
    let y = last.scene().expect("a scene").bodies[0].position.y;
    assert_eq!(y, number(&states.last().expect("a last row")["bodies"][0]["x"][1]));
}

/// Expected: `--max-wall` ends a run, a study and a picture soon after its time, whatever they are doing.
#[test]
fn the_wall_clock_ends_a_run_and_a_study() {
    let bench = Bench::with_scene(BOUNCE);
    let cases: [&[&str]; 3] = [
        &["run", "scene.xml", "--until", "1e9", "--max-wall", "0.3"],
        &["run", "scene.xml", "--until", "1e3", "--dt", "1e-6", "--max-wall", "0.3", "--method", "thesis"],
        &[
            "study",
            "scene.xml",
            "--until",
            "1000",
            "--dt",
            "1e-6",
            "--max-wall",
            "0.3",
            "--csv",
            "figures.csv",
        ],
    ];
    for arguments in cases {
        let since = Instant::now();
        let outcome = bench.polyscene(arguments);
        assert_eq!(outcome.code, 4, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("0.3 s of wall time"), "{arguments:?}: {}", outcome.stderr);
        assert!(since.elapsed() < Duration::from_secs(5), "{arguments:?} took {:?}", since.elapsed());
    }
    assert!(bench.read("figures.csv").starts_with("method"), "the report of what was done");
    // Symptom: a study that ran out of time said that it was cancelled.
    let study = ["study", "scene.xml", "--until", "1000", "--dt", "1e-6", "--max-wall", "0.3"];
    let text = bench.polyscene(&study).stdout;
    assert!(text.contains("Out of time: this is what was done") && !text.contains("ancelled"), "{text}");
}

#[test]
fn a_study_stops_each_run_after_so_many_events() {
    let bench = Bench::with_scene(BOUNCE);
    let study = ["study", "scene.xml", "--until", "20", "--dt", "1/60", "--repeat", "1", "--max-events", "2"];
    let outcome = bench.polyscene(&[&study[..], &["--json"]].concat());
    assert_eq!(outcome.code, 4, "{}", outcome.stderr);
    let [report] = &rows(&outcome.stdout)[..] else { panic!("one line: {}", outcome.stdout) };
    for point in report["points"].as_array().expect("points") {
        assert_eq!(point["stopped"], "event_limit", "{point}");
        assert_eq!(number(&point["impacts"]), 2.0, "{point}");
    }
}

/// Symptom: `run` demanded a Δt although the method exact gives the same bits for every Δt.
#[test]
fn the_method_exact_needs_no_time_step() {
    let bench = Bench::with_scene(BOUNCE);
    let run = |options: &[&str]| {
        let outcome = bench.polyscene(&[&["run", "scene.xml", "--until", "3.3", "--json"], options].concat());
        assert_eq!(outcome.code, 0, "{}", outcome.stderr);
        rows(&outcome.stdout)[0].clone()
    };
    let (free, stepped) = (run(&["--states", "states.jsonl"]), run(&["--dt", "0.1"]));
    assert_eq!(free["hash"], stepped["hash"]);
    assert!(free["dt"].is_null());
    assert_eq!(rows(&bench.read("states.jsonl")).len(), 2, "the start and the end");
    let outcome = bench.polyscene(&["run", "scene.xml", "--until", "1", "--method", "fixed"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("--dt"), "{}", outcome.stderr);
    let outcome = bench.polyscene(&["run", "scene.xml", "--until", "1"]);
    assert!(outcome.stdout.contains("event by event"), "{}", outcome.stdout);
}

#[cfg(feature = "render")]
#[test]
fn a_picture_can_be_of_any_method_and_of_a_run_that_was_stopped() {
    let bench = Bench::with_scene(BOUNCE);
    let render = ["render", "scene.xml", "--size", "160x120", "--overlays", "none"];
    let outcome =
        bench.polyscene(&[&render[..], &["-o", "e.png", "--at", "1e5", "--max-events", "1"]].concat());
    assert_eq!(outcome.code, 4, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("stopped early at t = 0.9583"), "{}", outcome.stderr);
    assert!(bench.path("e.png").exists(), "the picture of the time reached");
    for method in ["exact", "thesis", "fixed"] {
        let out = format!("{method}.png");
        let options = ["-o", &out, "--at", "30", "--dt", "1/3", "--method", method];
        let outcome = bench.polyscene(&[&render[..], &options].concat());
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{method}");
    }
    let read = |name: &str| std::fs::read(bench.path(name)).expect("a picture");
    assert_ne!(read("exact.png"), read("fixed.png"), "the ball falls through the floor in steps of 1/3 s");
}

#[cfg(feature = "render")]
#[test]
fn a_picture_too_large_for_the_memory_is_refused() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome = bench.polyscene(&["render", "scene.xml", "-o", "x.png", "--size", "16384x16384"]);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("too many for the memory"), "{}", outcome.stderr);
    assert!(!bench.path("x.png").exists());
}

/// Symptom: `check` of 4000 balls at one place took 19 s, of 8000 over a minute: every pair was predicted before
/// the overlaps were even counted. Expected: an error soon, with a number instead of a list.
#[test]
fn thousands_of_bodies_at_one_place_are_refused_at_once() {
    let bench = Bench::new();
    let ball = "<Translation X=\"5\" Y=\"5\" Z=\"5\"/><Sphere><Radius F32=\"0.5\"/></Sphere>";
    let mut bodies = String::new();
    for id in 1..=8000 {
        write!(bodies, "<SoftObject UserID=\"{id}\">{ball}</SoftObject>").expect("a string");
    }
    let (head, rest) = BOUNCE.split_once("<Primitives>").expect("bodies");
    let (_, tail) = rest.split_once("</Primitives>").expect("bodies");
    bench.write("heap.xml", format!("{head}<Primitives>{bodies}</Primitives>{tail}"));
    for arguments in [&["check", "heap.xml"][..], &["run", "heap.xml", "--until", "1", "--events", "e.jsonl"]]
    {
        let since = Instant::now();
        let outcome = bench.polyscene(arguments);
        assert_eq!(outcome.code, 1, "{}", outcome.stderr);
        let said = format!("{}{}", outcome.stdout, outcome.stderr);
        assert!(said.contains("pairs of bodies overlap at the start"), "{said}");
        assert!(said.len() < 10_000, "{} bytes of messages", said.len());
        assert!(since.elapsed() < Duration::from_secs(20), "{arguments:?} took {:?}", since.elapsed());
    }
    assert!(!bench.path("e.jsonl").exists());
}

/// Symptom: a program stuck inside one call, where no look at the clock comes, could only be killed. Here it
/// waits for a scene that never comes.
#[cfg(unix)]
#[test]
fn the_wall_clock_ends_a_program_that_is_stuck() {
    let bench = Bench::new();
    let made = std::process::Command::new("mkfifo").arg(bench.path("scene.fifo")).status();
    assert!(made.is_ok_and(|status| status.success()));
    let since = Instant::now();
    let outcome = bench.polyscene(&["run", "scene.fifo", "--until", "1", "--max-wall", "0.1"]);
    assert_eq!(outcome.code, 4, "{}", outcome.stderr);
    assert!(since.elapsed() < Duration::from_secs(15), "it took {:?}", since.elapsed());
}

/// Symptom: a list of problems as long as the scene has bodies. Expected: the first of each kind and a number.
#[test]
fn problems_of_the_start_are_counted_beyond_the_first() {
    let bench = Bench::new();
    let mut bodies = String::new();
    for id in 100..1100 {
        let place = format!("<Translation X=\"{}\" Y=\"-9\" Z=\"5\"/>", f64::from(id) * 0.5);
        write!(
            bodies,
            "<SoftObject UserID=\"{id}\">{place}<Sphere><Radius F32=\"0.5\"/></Sphere></SoftObject>"
        )
        .expect("a string");
    }
    bench.write("row.xml", BOUNCE.replace("</Primitives>", &format!("{bodies}</Primitives>")));
    let outcome = bench.polyscene(&["check", "row.xml"]);
    assert_eq!(outcome.code, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.lines().count() <= 403, "{}", outcome.stdout.lines().count());
    for counted in ["and 799 more overlaps", "and 800 more bodies start outside the map"] {
        assert!(outcome.stdout.contains(counted), "{counted}");
    }
}

/// A large scene with its simulation takes at most a kibibyte of memory for each ball, its text of 330 bytes included: beyond
/// what a small run takes. Known on Linux only.
#[test]
#[cfg(target_os = "linux")]
fn a_large_run_takes_a_kibibyte_for_each_ball() {
    const BALLS: usize = 40_000;
    let ball = |n: usize| {
        let [x, y, z] = [n % 40, n / 40 % 40, n / 1600].map(|place| 0.125 + 0.25 * place as f64 + 1e-13);
        format!(
            "<SoftObject UserID=\"{}\"><Translation X=\"{x:?}\" Y=\"{y:?}\" Z=\"{z:?}\" /><Rotation X=\"0\" Y=\"0\" Z=\"0\" />\
             <Bounce F32=\"1\" /><Weight F32=\"1\" /><InitialVelocity X=\"0.36534255906004387\" Y=\"-0.8054578292645721\" \
             Z=\"0.46665029713465483\" /><Sphere><Radius F32=\"0.062035049089940016\" /></Sphere></SoftObject>\n",
            n + 1
        )
    };
    let peak = |balls: usize| {
        let all: String = (0..balls).map(ball).collect();
        let bench = Bench::with_scene(&format!(
            "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<PolyPhysicsXml Version=\"1.0\"><Map><Size X=\"10\" Y=\"10\" Z=\"10\" />\
             <Tiles X=\"40\" Y=\"40\" Z=\"40\" /></Map><Primitives>\n{all}</Primitives></PolyPhysicsXml>\n"
        ));
        let mut child =
            bench.command(&["run", "scene.xml", "--until", "0.05"]).spawn().expect("the program starts");
        let status = format!("/proc/{}/status", child.id());
        let mut peak = 0_u64;
        let ended = loop {
            if let Some(ended) = child.try_wait().expect("a child") {
                break ended;
            }
            let lines = std::fs::read_to_string(&status).unwrap_or_default();
            let kib = lines
                .lines()
                .find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok());
            peak = peak.max(kib.unwrap_or(0));
            std::thread::sleep(Duration::from_millis(2));
        };
        assert!(ended.success(), "{ended}");
        peak
    };
    let (small, large) = (peak(10), peak(BALLS));
    let each = 1024.0 * (large as f64 - small as f64) / BALLS as f64;
    assert!(small > 0 && each < 1024.0, "{each} bytes for each ball: {small} KiB and {large} KiB");
}
