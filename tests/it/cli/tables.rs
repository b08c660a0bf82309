//! Rows of a run as CSV: columns, filters, what is refused, and the examples of docs/format.md in the shell and in Python.

use std::process::Command;

use super::{BOUNCE, Bench, number, rows};

fn csv(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

#[test]
fn csv_has_the_numbers_of_json() {
    let bench = Bench::with_scene(BOUNCE);
    let run = |options: &[&str]| {
        let outcome =
            bench.polyscene(&[&["run", "scene.xml", "--dt", "0.25", "--until", "3"], options].concat());
        assert_eq!(outcome.code, 0, "{options:?}: {}", outcome.stderr);
        outcome.stdout
    };
    let (json, text) = (rows(&run(&["--events", "-"])), run(&["--events", "-", "--rows", "csv"]));
    let table = csv(&text);
    assert_eq!(table.len(), json.len() + 1);
    for (row, event) in table[1..].iter().zip(&json) {
        for (name, cell) in table[0].iter().zip(row) {
            let value = match name.rsplit_once('_') {
                Some((vector, axis @ ("x" | "y" | "z"))) => {
                    &event[vector][["x", "y", "z"].iter().position(|a| *a == axis).unwrap()]
                }
                _ => &event[*name],
            };
            let same = match value {
                serde_json::Value::Null => cell.is_empty(),
                serde_json::Value::String(text) => text == cell,
                value => number(value) == cell.parse::<f64>().expect("a number"),
            };
            assert!(same, "{name}: {cell} instead of {value}");
        }
    }
    let (json, text) = (rows(&run(&["--states", "-"])), run(&["--states", "-", "--rows", "csv"]));
    let table = csv(&text);
    let spin = ["qx", "qy", "qz", "qw", "wx", "wy", "wz"];
    assert_eq!(table[0], [&["t", "id", "x", "y", "z", "vx", "vy", "vz", "state"], &spin[..]].concat());
    assert!(table[1..].iter().all(|row| row[9..] == [""; 7]), "nothing rubs: {text}");
    for (row, state) in table[1..].iter().zip(&json) {
        let body = &state["bodies"][0];
        let expected = [&state["t"], &body["x"][1], &body["v"][1]].map(number);
        let found = [0, 3, 6].map(|at| row[at].parse::<f64>().expect("a number"));
        assert_eq!((found, row[1], row[8]), (expected, "7", body["state"].as_str().unwrap()));
    }
    // Every key of an event has its columns.
    let event = &rows(&run(&["--events", "-"]))[0];
    let header = csv(&run(&["--events", "-", "--rows", "csv", "--kinds", "rest"])).concat().join(",");
    for key in event.as_object().unwrap().keys() {
        assert!(header.contains(key.as_str()), "{key} in {header}");
    }
}

#[test]
fn states_of_a_ball_that_rubs_have_its_orientation_and_spin() {
    let rough = BOUNCE
        .replace("Version=\"1.0\">", "Version=\"1.1\">")
        .replace(
            "<Weight",
            "<Friction F32=\"0,3\" /><InitialAngularVelocity X=\"0\" Y=\"5\" Z=\"0\" /><Weight",
        )
        .replace("      <Plane>", "      <Friction F32=\"0,3\" />\n      <Plane>");
    let bench = Bench::with_scene(&rough);
    let run = |options: &[&str]| {
        let outcome =
            bench.polyscene(&[&["run", "scene.xml", "--until", "0.5", "--states", "-"], options].concat());
        assert_eq!(outcome.code, 0, "{options:?}: {}", outcome.stderr);
        outcome.stdout
    };
    let (json, text) = (rows(&run(&[])), run(&["--rows", "csv"]));
    let table = csv(&text);
    assert_eq!(table.len(), 3, "{text}");
    // After half a second of 5 rad/s about y.
    let half = 0.5 * 0.5 * 5.0_f64;
    let expected = [0.0, half.sin(), 0.0, half.cos(), 0.0, 5.0, 0.0];
    let numbers: Vec<f64> = table[2][9..].iter().map(|cell| cell.parse().expect("a number")).collect();
    assert!(numbers.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{numbers:?}");
    let body = &json[1]["bodies"][0];
    let of_json = [&body["q"], &body["w"]].map(|values| values.as_array().expect("numbers").clone()).concat();
    assert_eq!(of_json.iter().map(number).collect::<Vec<_>>(), numbers);
}

#[test]
fn rows_are_filtered_by_body_kind_and_column() {
    let two = BOUNCE.replace(
        "    <HardObject",
        "    <SoftObject UserID=\"8\"><?polyscene name=\"high\"?><Translation X=\"2\" Y=\"8\" Z=\"2\" /><Sphere><Radius F32=\"0,5\" /></Sphere></SoftObject>\n    <HardObject",
    );
    let bench = Bench::with_scene(&two);
    let run = |options: &[&str]| bench.polyscene(&[&["run", "scene.xml", "--until", "3"], options].concat());
    let all = csv(&run(&["--events", "-", "--rows", "csv"]).stdout).len();
    let chosen =
        run(&["--events", "impacts.csv", "--bodies", "high", "--kinds", "impact", "--columns", "b,a,t"]);
    assert_eq!(chosen.code, 0, "{}", chosen.stderr);
    let text = bench.read("impacts.csv");
    let table = csv(&text);
    assert_eq!(table[0], ["b", "a", "t"]);
    assert!(table.len() > 1 && table.len() < all);
    assert!(table[1..].iter().all(|row| row[..2] == ["9", "8"]), "{text}");
    let states = rows(&run(&["--states", "-", "--bodies", "8"]).stdout);
    assert!(
        states
            .iter()
            .all(|row| row["bodies"].as_array().unwrap().len() == 1 && row["bodies"][0]["id"] == "8")
    );
    for (options, hint) in [
        (&["--events", "-", "--bodies", "nobody"][..], "no body has the UserID or name nobody"),
        (&["--events", "-", "--kinds", "crash"], "crash is none of impact"),
        (&["--events", "-", "--columns", "t"], "add --rows csv"),
        (&["--events", "x.csv", "--columns", "t,colour"], "colour is none of seq, t, kind"),
        (&["--events", "x.csv", "--states", "y.csv", "--columns", "seq"], "leaves no column"),
        (&["--kinds", "impact"], "--events"),
        (
            &["--columns", "t,a"],
            "--columns is about rows, and none are written: add --states FILE or --events FILE",
        ),
        (&["--bodies", "8"], "--bodies is about rows, and none are written: add --states"),
        (&["--every", "3", "--states", "-"], "--dt <S>"),
        (&["--every", "3", "--dt", "0.1"], "--states <FILE>"),
    ] {
        let refused = run(options);
        assert_eq!((refused.code, refused.stdout.as_str()), (2, ""), "{options:?}: {}", refused.stderr);
        assert!(refused.stderr.contains(hint), "{options:?}: {}", refused.stderr);
    }
}

const TWO: &str = r#"    <SoftObject UserID="8"><?polyscene name="high, &quot;8&quot;"?><Translation X="2" Y="8" Z="2" /><Sphere><Radius F32="0,5" /></Sphere></SoftObject>
    <HardObject"#;

/// Symptom: `replay --events` had fewer columns than `run --events`, and no CSV. Expected: the same rows, to the byte.
#[test]
fn a_replay_writes_the_rows_of_its_run() {
    let bench = Bench::with_scene(&BOUNCE.replace("    <HardObject", TWO));
    let ok = |arguments: &[&str]| {
        let outcome = bench.polyscene(arguments);
        assert_eq!(outcome.code, 0, "{arguments:?}: {}", outcome.stderr);
    };
    let scene = ["scene.xml", "--until", "3", "--dt", "0.3"];
    ok(&[&["record"], &scene[..], &["-o", "run.psrec"]].concat());
    for (file, options) in [
        ("rows.csv", &[][..]),
        ("rows.jsonl", &[]),
        ("impacts.csv", &["--kinds", "impact", "--bodies", "8", "--columns", "t,a_name,dt_index"]),
        ("costs.jsonl", &["--costs"]),
    ] {
        let of_replay = format!("again-{file}");
        ok(&[&["run"], &scene[..], &["--events", file], options].concat());
        ok(&[&["replay", "run.psrec", "--events", &of_replay], options].concat());
        assert_eq!(bench.read(file), bench.read(&of_replay), "{file}");
        assert!(bench.read(file).lines().count() > 1, "{file}");
    }
}

#[test]
fn events_have_the_names_of_their_bodies_and_what_they_took() {
    let bench = Bench::with_scene(&BOUNCE.replace("    <HardObject", TWO));
    let run = |options: &[&str]| {
        let outcome = bench.polyscene(&[&["run", "scene.xml", "--until", "3"], options].concat());
        assert_eq!(outcome.code, 0, "{options:?}: {}", outcome.stderr);
        outcome.stdout
    };
    let json = rows(&run(&["--events", "-"]));
    let of = |id: &str| json.iter().find(|row| row["a"] == id || row["b"] == id).expect("it meets the floor");
    assert!(json.iter().all(|row| row.get("searches").is_none()));
    assert!(of("7").get("a_name").is_none() && of("7").get("b_name").is_none());
    let named = [("a", "a_name"), ("b", "b_name")].map(|(id, name)| (&of("8")[id], &of("8")[name]));
    assert!(named.iter().any(|(id, name)| **id == "8" && **name == "high, \"8\""), "{named:?}");
    let text = run(&["--events", "-", "--rows", "csv"]);
    assert!(text.starts_with("seq,t,kind,a,b,a_name,b_name,point_x,"), "{text}");
    assert!(text.contains(",\"high, \"\"8\"\"\","), "{text}");
    let costs = rows(&run(&["--events", "-", "--costs"]));
    assert!(costs.iter().all(|row| number(&row["searches"]) >= 1.0), "each event is found anew: {costs:?}");
    let table = run(&["--events", "-", "--rows", "csv", "--columns", "seq,searches,dropped"]);
    for (row, json) in csv(&table)[1..].iter().zip(&costs) {
        assert_eq!([row[1], row[2]], [&json["searches"], &json["dropped"]].map(ToString::to_string));
    }
}

/// Blocks of a language in docs/format.md.
fn examples(language: &str) -> Vec<String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/format.md");
    let page = std::fs::read_to_string(path).expect("docs/format.md");
    let mark = format!("```{language}\n");
    let blocks = page.split(&mark).skip(1);
    blocks.map(|block| block.split("```").next().unwrap_or_default().to_owned()).collect()
}

/// With `PYTHON` as the interpreter, or python3.
#[test]
fn the_examples_of_the_documentation_run() {
    let bench = Bench::with_scene(BOUNCE);
    let lines: Vec<_> = examples("sh").concat().lines().map(str::to_owned).collect();
    assert!(lines.len() >= 3);
    for line in lines {
        let words: Vec<_> = line.split_whitespace().skip(1).collect();
        let outcome = bench.polyscene(&words);
        assert_eq!(outcome.code, 0, "{line}: {}", outcome.stderr);
    }
    let interpreter = std::env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
    let python =
        |code: &str| Command::new(&interpreter).args(["-c", code]).current_dir(bench.path("")).output();
    if !python("import pandas").is_ok_and(|output| output.status.success()) {
        println!("skipped: there is no Python with pandas");
        return;
    }
    let examples = examples("python");
    assert!(examples.len() >= 3);
    for example in examples {
        let output = python(&example).expect("Python");
        let (said, complaint) =
            (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success() && !said.trim().is_empty(), "{example}\n{said}\n{complaint}");
    }
}
