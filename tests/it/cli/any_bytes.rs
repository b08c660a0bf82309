//! Whatever bytes a file holds, reading and starting it ends in a list of problems, never in a panic.

use polyscene::cli::{Examined, examine};
use polyscene::scene::Document;
use polyscene::sim::Method;
use proptest::prelude::*;

use super::{BOUNCE, Bench};

/// Words that mean something to the reader, so that damage goes deep.
const WORDS: [&str; 24] = [
    "<",
    ">",
    "/>",
    "\"",
    "&amp;",
    "&#0;",
    "<!--",
    "-->",
    "<![CDATA[",
    "<?polyscene ",
    "<!DOCTYPE a>",
    "1e308",
    "-1",
    "1.234,5",
    "NaN",
    "1e-320",
    "0",
    "99999999999999999999",
    "65536",
    "<Sphere>",
    "<Compound>",
    "UserID=\"7\"",
    "\u{feff}",
    "\0",
];

/// One act of damage: at a share of the file, take some bytes away and put some in.
#[derive(Clone, Debug)]
struct Damage {
    at: f64,
    take: usize,
    put: Vec<u8>,
}

fn damage() -> impl Strategy<Value = Damage> {
    let put = prop_oneof![
        3 => (0..WORDS.len()).prop_map(|word| WORDS[word].as_bytes().to_vec()),
        1 => prop::collection::vec(any::<u8>(), 0..4),
    ];
    (0.0..1.0, prop_oneof![3 => 0..4_usize, 1 => 0..200_usize], put).prop_map(|(at, take, put)| Damage {
        at,
        take,
        put,
    })
}

fn damaged(text: &str, acts: &[Damage]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for act in acts {
        let from = (act.at * bytes.len() as f64) as usize;
        let to = (from + act.take).min(bytes.len());
        bytes.splice(from..to, act.put.iter().copied());
    }
    bytes
}

/// Runs a little of what can run.
fn exercise(examined: Examined) {
    assert!(examined.lines("file").iter().all(|line| !line.contains('\n')));
    assert_eq!(examined.simulation.is_none(), examined.error_count() > 0);
    let Some(mut sim) = examined.simulation else { return };
    sim.begin(0.05);
    for _ in 0..100 {
        if !matches!(sim.next_event(), Ok(Some(_))) {
            break;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_scenes_never_panic(acts in prop::collection::vec(damage(), 1..6)) {
        exercise(examine(Document::from_bytes(&damaged(BOUNCE, &acts)), Method::Exact));
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        exercise(examine(Document::from_bytes(&bytes), Method::Exact));
    }
}

#[test]
fn speeds_beyond_reckoning_are_errors() {
    for speed in ["1E+155", "1E+200", "1E+308"] {
        let bench = Bench::with_scene(
            &BOUNCE.replace(r#"<InitialVelocity X="0""#, &format!(r#"<InitialVelocity X="{speed}""#)),
        );
        let outcome = bench.polyscene(&["run", "scene.xml", "--dt", "50", "--until", "100"]);
        assert_eq!(outcome.code, 1, "{speed}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("error: body 7: "), "{speed}: {}", outcome.stderr);
    }
}

#[test]
fn the_program_ends_with_a_verdict_on_hostile_files() {
    let bench = Bench::new();
    let deep = "<a>".repeat(100_000);
    let files: [(&str, Vec<u8>); 8] = [
        ("empty", vec![]),
        ("zeros", vec![0; 4096]),
        ("deep", deep.into_bytes()),
        ("utf16", b"\xff\xfe<\0".to_vec()),
        ("cut", BOUNCE.as_bytes()[..700].to_vec()),
        ("entity", b"<!DOCTYPE a [<!ENTITY b \"c\">]><a>&b;</a>".to_vec()),
        ("attributes", [b"<PolyPhysicsXml ".to_vec(), b"a=\"1\" ".repeat(10_000), b"/>".to_vec()].concat()),
        ("escape", b"<PolyPhysicsXml Version=\"\x1b[2J\"/>".to_vec()),
    ];
    for (name, bytes) in files {
        bench.write(name, bytes);
        let check = bench.polyscene(&["check", name]);
        assert_eq!(check.code, 1, "{name}: {}", check.stderr);
        assert!(check.stdout.starts_with(name) && !check.stdout.contains('\x1b'), "{name}: {}", check.stdout);
        let run = bench.polyscene(&["run", name, "--dt", "0.1", "--until", "1", "--final", "out.xml"]);
        assert_eq!(run.code, 1, "{name}: {}", run.stderr);
        assert!(!bench.path("out.xml").exists(), "{name}");
    }
}
