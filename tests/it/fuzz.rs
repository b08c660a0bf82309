//! Readers against bytes that somebody spoiled: scenes, MJCF, SDF, recordings. No panic, and an answer within a second.
//! `POLYSCENE_FUZZ=1000000` says how many files, `POLYSCENE_FUZZ_SEED` and `POLYSCENE_FUZZ_FROM` which ones.

use std::time::{Duration, Instant};

use polyscene::import::import;
use polyscene::random::Random;
use polyscene::record::{InlineRunner, RecordingFile, RunCommand, Runner as _};
use polyscene::scene::Document;
use polyscene::sim::Method;

/// Files in the tests: some seconds.
const FILES: usize = 4000;

const LONGEST: Duration = Duration::from_secs(1);

const SEEDS: [&str; 6] = [
    include_str!("../../scenes/foreign/balls.mjcf.xml"),
    include_str!("../../scenes/foreign/ball.sdf"),
    include_str!("../../scenes/drag.xml"),
    include_str!("../../scenes/thesis-appendix-2.xml"),
    super::editor_support::SCENE,
    "<mujoco><default><default class=\"a\"><geom size=\"1\"/></default></default><worldbody><body childclass=\"a\"><freejoint/><geom/></body></worldbody></mujoco>",
];

/// Pieces that readers stumble over.
const WORDS: [&str; 28] = [
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?",
    "?>",
    "<!DOCTYPE a [<!ENTITY b \"c\">]>",
    "&lt;",
    "&#0;",
    "&b;",
    "\"",
    "'",
    "/>",
    "</",
    "1e308",
    "-1e308",
    "nan",
    "inf",
    "1e-320",
    "0",
    "-1",
    "99999999999999999999",
    "1,5",
    " ",
    "\0",
    "\u{feff}",
    "\u{202e}",
    "xmlns:a=\"b\"",
];

fn spoil(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len() + 1);
    let end = (at + 1 + random.below(40)).min(bytes.len());
    match random.below(9) {
        0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
        1 if at < bytes.len() => bytes[at] = random.below(256) as u8,
        2 if at < end => drop(bytes.drain(at..end)),
        3 if at < end => {
            let piece = bytes[at..end].to_vec();
            let to = random.below(bytes.len() + 1);
            bytes.splice(to..to, piece);
        }
        4 => bytes.truncate(at),
        5 if at < end => {
            let piece = bytes[at..end].to_vec();
            let many = 1 + random.below(200);
            bytes.splice(at..at, piece.repeat(many));
        }
        6 => {
            let other = SEEDS[random.below(SEEDS.len())].as_bytes();
            let from = random.below(other.len());
            let to = (from + random.below(300)).min(other.len());
            bytes.splice(at..at, other[from..to].iter().copied());
        }
        7 => {
            // A number of the file becomes another.
            let digit = bytes[at.min(bytes.len())..].iter().position(u8::is_ascii_digit);
            if let Some(digit) = digit {
                let word = WORDS[14 + random.below(9)].bytes();
                bytes.splice(at + digit..=at + digit, word);
            }
        }
        _ => drop(bytes.splice(at..at, WORDS[random.below(WORDS.len())].bytes())),
    }
}

/// Time that this thread had on a processor, where the system tells: other work of the machine is not meant.
fn on_processor() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(Duration::from_nanos(text.split(' ').next()?.parse().ok()?))
}

/// A run by thesis steps, whose Δt are in the file.
fn recording() -> String {
    let text = include_bytes!("../../scenes/bounce.xml");
    let document = Document::from_bytes(text);
    let mut runner = InlineRunner::new();
    runner.send(RunCommand::Method(Method::Thesis));
    runner.send(RunCommand::Load(document.scene_shared().expect("a scene")));
    runner.send(RunCommand::Step { dt: 0.125, count: 3 });
    runner.send(RunCommand::Step { dt: 0.1, count: 2 });
    let bytes = runner.recording("bounce.xml", text).and_then(|file| file.to_bytes().ok());
    String::from_utf8(bytes.expect("a file")).expect("UTF-8")
}

/// Reads a recording as far as its commands; whether it is one.
fn is_recording(bytes: &[u8]) -> bool {
    let Ok(file) = RecordingFile::read(bytes) else { return false };
    let Ok(document) = file.document() else { return false };
    RecordingFile::scene(&document).is_ok_and(|scene| file.commands(&scene).is_ok())
}

/// Symptom: a file of some lines that claimed 10¹⁵ Δt took all memory. Cause: they were listed before anything was done.
#[test]
fn a_recording_cannot_claim_more_steps_than_a_run_has() {
    let text = recording();
    assert!(is_recording(text.as_bytes()) && text.contains("\"count\": 3"));
    for count in ["1000000000000000", "18446744073709551615"] {
        let claimed = text.replace("\"count\": 3", &format!("\"count\": {count}"));
        let problem = RecordingFile::read(claimed.as_bytes()).expect_err("too many");
        assert!(problem.to_string().contains("Δt that a run can take"), "{problem}");
    }
    let many = text.replace("\"count\": 3", "\"count\": 90000000").replace("0.125", "1e-300");
    let started = Instant::now();
    assert!(is_recording(many.as_bytes()));
    assert!(started.elapsed() < Duration::from_secs(20), "{:?}", started.elapsed());
}

#[test]
fn spoiled_files_are_read_or_refused_in_time() {
    let number =
        |name: &str, usual| std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual);
    let (files, seed) = (number("POLYSCENE_FUZZ", FILES), number("POLYSCENE_FUZZ_SEED", 1));
    let from = number("POLYSCENE_FUZZ_FROM", 0);
    let recording = recording();
    let mut read = [0_usize; 4];
    let mut longest = Duration::ZERO;
    for file in from..from + files {
        let mut random = Random::new((seed as u64).wrapping_mul(1 << 32) + file as u64);
        let seeds = SEEDS.iter().copied().chain([recording.as_str()]);
        let mut bytes =
            seeds.clone().nth(random.below(SEEDS.len() + 1)).unwrap_or_default().as_bytes().to_vec();
        for _ in 0..=random.below(6) {
            spoil(&mut bytes, &mut random);
        }
        let (started, before) = (Instant::now(), on_processor());
        let outcome = std::panic::catch_unwind(|| {
            let document = Document::from_bytes(&bytes);
            let scene = document.scene().is_some() && !document.has_errors();
            assert_eq!(document.to_bytes(), bytes);
            document.foreign();
            let strict = import(&document, false);
            let lenient = import(&document, true);
            assert!(strict.document.is_some() || !strict.problems.is_empty());
            let back = lenient.document.map(|document| document.has_errors());
            (scene, strict.document.is_some(), back, is_recording(&bytes))
        });
        let took =
            before.and_then(|before| Some(on_processor()? - before)).unwrap_or_else(|| started.elapsed());
        longest = longest.max(took);
        match outcome {
            Ok((scene, strict, lenient, recording)) => {
                read[3] += usize::from(recording);
                assert_ne!(lenient, Some(true), "an import with errors: {}", String::from_utf8_lossy(&bytes));
                read[0] += usize::from(scene);
                read[1] += usize::from(strict);
                read[2] += usize::from(lenient.is_some());
            }
            Err(_) => panic!("file {file} of seed {seed}:\n{}", String::from_utf8_lossy(&bytes)),
        }
        assert!(took < LONGEST, "file {file} of seed {seed}, {} bytes, took {took:?}", bytes.len());
    }
    println!(
        "{files} files: {} scenes, {} imports, {} with things left out, {} recordings; the longest {longest:?}",
        read[0], read[1], read[2], read[3]
    );
    let memory = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let most =
        memory.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok());
    let most_kib: u64 = most.unwrap_or(0);
    println!("at most {most_kib} KiB of memory");
    // In a run of all tests the others' memory counts too.
    assert!(files <= FILES || most_kib < 100 << 10, "{most_kib} KiB");
    assert!(files < FILES || read.iter().all(|count| *count > 0), "mutations leave nothing whole: {read:?}");
}
