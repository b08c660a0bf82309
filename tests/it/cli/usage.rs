//! Bad arguments are refused with exit code 2 and the way out; help is complete.

use polyscene::record::{COST_COLUMNS, EVENT_COLUMNS};
use polyscene::sim::EventKind;

use super::{BOUNCE, Bench};

#[test]
fn bad_arguments_are_refused_with_the_way_out() {
    let bench = Bench::with_scene(BOUNCE);
    let cases: [(&[&str], &str); 23] = [
        (&["run", "scene.xml"], "--until"),
        (&["run", "scene.xml", "--dt", "1"], "--until"),
        (&["run", "scene.xml", "--dt", "0", "--until", "1"], "more than 0"),
        (&["run", "scene.xml", "--dt", "-1", "--until", "1"], "more than 0"),
        (&["run", "scene.xml", "--dt", "NaN", "--until", "1"], "finite"),
        (&["run", "scene.xml", "--dt", "1/0", "--until", "1"], "finite"),
        (&["run", "scene.xml", "--dt", "1", "--until", "inf"], "finite"),
        (&["run", "scene.xml", "--dt", "1e308", "--until", "1e308"], "at most 1e9 seconds"),
        (&["render", "scene.xml", "-o", "x.png", "--at", "1.1e9"], "at most 1e9 seconds"),
        (&["render", "scene.xml", "-o", "x.png", "--at", "-1"], "0 or more"),
        (&["run", "scene.xml", "--dt", "0,1", "--until", "1"], "decimal point"),
        (&["run", "scene.xml", "--dt", "fast", "--until", "1"], "1/60"),
        (&["run", "scene.xml", "--dt", "2", "--until", "1"], "longer than --until"),
        (&["run", "scene.xml", "--dt", "1e-12", "--until", "1"], "make --dt larger"),
        (&["run", "scene.xml", "--dt", "1", "--until", "1", "--every", "0"], "--every"),
        (&["run", "scene.xml", "--dt", "1", "--until", "1", "--method", "euler"], "exact"),
        (&["run", "scene.xml", "--until", "1", "--method", "thesis"], "--dt"),
        (&["run", "scene.xml", "--until", "1", "--max-events", "0"], "--max-events"),
        (&["run", "scene.xml", "--until", "1", "--max-wall", "-1"], "more than 0"),
        (&["everyday", "--e", "-1"], "from 0 to 1"),
        (&["everyday", "--n", "-1"], "1..="),
        (&["check"], "FILE"),
        (&["scene.xml", "run"], "run"),
    ];
    for (arguments, hint) in cases {
        let outcome = bench.polyscene(arguments);
        assert_eq!(outcome.code, 2, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(hint), "{arguments:?} should mention {hint:?}: {}", outcome.stderr);
        assert_eq!(outcome.stdout, "", "{arguments:?}");
    }
}

#[test]
fn outputs_must_not_clash_nor_destroy_the_scene() {
    let bench = Bench::with_scene(BOUNCE);
    let run = ["run", "scene.xml", "--dt", "0.1", "--until", "1"];
    let cases: [(&[&str], &str); 5] = [
        (&["--states", "-", "--json"], "--json and --states"),
        (&["--states", "-", "--events", "-"], "--states and --events"),
        (&["--states", "both", "--events", "both"], "--states and --events"),
        (&["--events", "./scene.xml"], "overwrite the scene"),
        (&["--states", "no/such/folder/file"], "cannot write no/such/folder/file"),
    ];
    for (outputs, hint) in cases {
        let outcome = bench.polyscene(&[&run, outputs].concat());
        assert_eq!(outcome.code, 2, "{outputs:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(hint), "{outputs:?}: {}", outcome.stderr);
    }
    assert_eq!(bench.read("scene.xml"), BOUNCE);
}

#[test]
fn help_names_every_verb_option_and_kind_of_event() {
    let bench = Bench::new();
    let help = bench.polyscene(&["--help"]);
    assert_eq!(help.code, 0);
    for word in ["run", "check", "render", "SCENE", "Exit codes"] {
        assert!(help.stdout.contains(word), "{word} is missing:\n{}", help.stdout);
    }

    let help = bench.polyscene(&["run", "--help"]).stdout;
    let options = [
        "--dt",
        "--until",
        "--every",
        "--method",
        "--states",
        "--events",
        "--final",
        "--force",
        "--json",
        "--max-events",
        "--max-wall",
    ];
    let states = ["slide, roll", "\"q\"", "\"w\""];
    let columns =
        EVENT_COLUMNS.iter().chain(COST_COLUMNS).map(|column| column.name.trim_end_matches(['x', 'y', 'z']));
    let words = options.into_iter().chain(states).chain(EventKind::ALL.map(EventKind::name)).chain(columns);
    for word in words {
        assert!(help.contains(word), "{word} is missing:\n{help}");
    }

    assert_eq!(bench.polyscene(&["--version"]).stdout, format!("polyscene {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn without_a_display_the_editor_names_the_verbs_that_need_none() {
    let bench = Bench::with_scene(BOUNCE);
    let outcome = bench.polyscene(&["scene.xml"]);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(!outcome.stderr.contains(".rs"), "no place in somebody's source: {}", outcome.stderr);
    for word in ["polyscene run", "polyscene render"] {
        assert!(outcome.stderr.contains(word), "{}", outcome.stderr);
    }
}
