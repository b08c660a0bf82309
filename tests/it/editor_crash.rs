//! A program that is killed while it edits and saves, and a disk that is full: files stay whole, and at most the last interval
//! between two copies is lost. The programs are this test binary again, told by the environment what to do.

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use polyscene::editor::{Action, Addition, Answer, Question, RECOVERY_INTERVAL, Session, SessionCommand};
use polyscene::scene::{BodyChange, Document, Edit, Scene};

use super::editor_support::{BodyNumbers, FakeRunner, SCENE, storage};

/// Where a child works; without it a child does nothing.
const FOLDER: &str = "POLYSCENE_TEST_FOLDER";

/// How often the program is killed, unless `POLYSCENE_KILLS` says.
const KILLS: u32 = 25;

/// Time of the session between two edits.
const PER_EDIT: Duration = Duration::from_millis(100);

fn session(folder: &Path) -> Session {
    Session::with_storage(Box::new(FakeRunner::default()), storage(folder))
}

fn mass(scene: &Scene) -> u64 {
    let body = scene.bodies.iter().find(|body| body.id == 7).expect("body 7");
    body.mass().expect("a mass") as u64
}

/// What is typed, and not applied, after so many edits.
fn draft(count: u64) -> String {
    format!("{count} <not a scene yet>")
}

/// Counts up the mass of a body and in a text that is typed, and saves now and then.
#[test]
fn child_that_edits_and_saves() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let folder = Path::new(&folder);
    let mut session = session(folder);
    while let Some(Question::Recover(_)) = session.question() {
        session.perform(Action::Answer(Answer::Discard));
    }
    session.perform(Action::OpenPath(folder.join("scene.xml")));
    let mut progress = std::fs::File::create(folder.join("progress")).expect("a file");
    let (mut now, start) = (Instant::now(), mass(session.scene().expect("a scene")));
    for count in start + 1.. {
        let key = session.scene().expect("a scene").bodies.iter().find(|body| body.id == 7).expect("7").key;
        let change = BodyChange::Mass(count as f64);
        session.perform(Action::Edit { edit: Edit::Body { key, change }, gesture: None });
        session.perform(Action::KeepDraft(Some(draft(count).into())));
        now += PER_EDIT;
        session.poll(now);
        writeln!(progress, "edit {count}").expect("progress");
        if count % 11 == 0 {
            session.perform(Action::Command(SessionCommand::Save));
            writeln!(progress, "save {count}").expect("progress");
        }
    }
}

/// What the child was sure of: the last edit and the last save.
fn sure(folder: &Path) -> (u64, u64) {
    let text = std::fs::read_to_string(folder.join("progress")).unwrap_or_default();
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    let last = |what: &str| {
        let line = whole.lines().rev().find_map(|line| line.strip_prefix(what));
        line.map_or(0, |count| count.trim().parse().expect("a count"))
    };
    (last("edit"), last("save"))
}

#[test]
fn a_killed_program_loses_no_more_than_the_last_interval() {
    let kills = std::env::var("POLYSCENE_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(KILLS);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.xml");
    std::fs::write(&path, SCENE).expect("the file");
    let mut wait = 1_u64;
    let (mut recovered, mut most_lost) = (0, 0);
    for _ in 0..kills {
        let _ = std::fs::remove_file(folder.path().join("progress"));
        let start = mass(Document::open(&path).scene().expect("a scene"));
        let mut child = Command::new(std::env::current_exe().expect("this program"))
            .args(["editor_crash::child_that_edits_and_saves", "--exact"])
            .env(FOLDER, folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a child");
        let since = Instant::now();
        while sure(folder.path()).0 == 0 && since.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        // Scattered, and the same every time.
        wait = wait.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(Duration::from_micros((wait >> 33) % 90_000));
        child.kill().expect("the child is there");
        child.wait().expect("the child ends");

        let (edited, saved) = sure(folder.path());
        assert!(edited > 0, "the child did nothing");
        let document = Document::open(&path);
        assert!(!document.has_errors(), "a half-written file: {:?}", document.diagnostics());
        let in_file = mass(document.scene().expect("a scene"));
        assert!(in_file >= saved, "{in_file} in the file and {saved} saved");
        let mut next = session(folder.path());
        let (mut found, mut typed) = (in_file, 0);
        if let Some(Question::Recover(_)) = next.question() {
            next.perform(Action::Answer(Answer::Restore));
            found = found.max(mass(next.scene().expect("the copy is whole")));
            let text = next.draft().unwrap_or_default().to_owned();
            typed = text.split(' ').next().and_then(|count| count.parse().ok()).unwrap_or_default();
            assert!(text.is_empty() || text == draft(typed), "a half-written text: {text}");
            recovered += 1;
        }
        let interval = (RECOVERY_INTERVAL.as_millis() / PER_EDIT.as_millis()) as u64;
        most_lost = most_lost.max(edited.saturating_sub(found));
        assert!(edited <= found + interval + 1, "{edited} edits and only {found} found");
        assert!(edited <= typed.max(start) + interval + 1, "{edited} texts and only {typed} found");
        let leftover = std::fs::read_dir(folder.path()).expect("the folder").flatten();
        let names: Vec<_> = leftover.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        assert!(names.len() <= 4 + 1, "files are left behind: {names:?}");
        for name in
            names.iter().filter(|name| !["scene.xml", "progress", "data", "config"].contains(&name.as_str()))
        {
            let _ = std::fs::remove_file(folder.path().join(name));
        }
    }
    println!("{kills} kills, {recovered} with a copy to restore, at most {most_lost} edits lost");
    assert!(recovered > 0, "no kill fell between two saves");
}

/// A scene too large for what is left of the disk.
#[test]
fn child_on_a_full_disk() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let path = Path::new(&folder).join("scene.xml");
    let mut session = session(Path::new(&folder));
    session.perform(Action::OpenPath(path.clone()));
    for _ in 0..60 {
        session.perform(Action::Command(SessionCommand::Add(Addition::SphereStatic)));
    }
    session.take_notices();
    session.perform(Action::Command(SessionCommand::Save));
    session.poll(Instant::now());
    let said: Vec<_> = session.take_notices().into_iter().map(|notice| notice.text).collect();
    assert!(said.iter().any(|text| text.contains("cannot be saved")), "{said:?}");
    assert!(said.iter().any(|text| text.contains("cannot be kept safe")), "{said:?}");
    assert!(session.is_dirty() && session.scene().expect("a scene").bodies.len() == 63);
    assert_eq!(std::fs::read_to_string(&path).expect("the file"), SCENE);
    std::fs::write(Path::new(&folder).join("progress"), "done").expect("a short file");
}

#[cfg(unix)]
#[test]
fn a_full_disk_leaves_the_old_file_and_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("scene.xml"), SCENE).expect("the file");
    let program = std::env::current_exe().expect("this program");
    // Files may not grow beyond 4 KiB: what a full disk does, without one.
    let script = format!(
        "trap '' XFSZ; ulimit -f 4; exec '{}' editor_crash::child_on_a_full_disk --exact",
        program.display()
    );
    let output =
        Command::new("bash").args(["-c", &script]).env(FOLDER, folder.path()).output().expect("bash");
    let said = String::from_utf8_lossy(&output.stdout);
    let done = std::fs::read_to_string(folder.path().join("progress")).unwrap_or_default();
    assert_eq!((output.status.success(), done.as_str()), (true, "done"), "{said}");
    let names: Vec<_> =
        std::fs::read_dir(folder.path()).expect("the folder").flatten().map(|e| e.file_name()).collect();
    assert!(names.iter().all(|name| !name.to_string_lossy().contains("tmp")), "{names:?}");
}
