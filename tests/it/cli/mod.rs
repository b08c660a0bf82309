//! The command line through the real program: how it is started here, and the scenes it is given.

mod any_bytes;
mod check;
mod documents;
mod export;
mod limits;
mod names;
mod outputs;
mod record;
mod run;
mod streams;
mod study;
mod tables;
mod usage;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// A ball of radius 0.5 m dropped from y = 5 m on a floor, g = 9.8 m/s²: it lands at t = √(2·4.5/9.8).
const BOUNCE: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<PolyPhysicsXml Version="1.0">
  <Map>
    <Size X="10" Y="10" Z="10" />
    <Tiles X="10" Y="10" Z="10" />
  </Map>
  <Simulation>
    <Forces>
      <GravityPlane UserID="1"><Translation X="5" Y="9" Z="5" /><Gravity X="0" Y="-9,8" Z="0" /></GravityPlane>
    </Forces>
  </Simulation>
  <Primitives>
    <SoftObject UserID="7">
      <!-- kept -->
      <Translation X="5" Y="5" Z="5" />
      <Bounce F32="1" />
      <Weight F32="2" />
      <InitialVelocity X="0" Y="0" Z="0" />
      <Sphere><Radius F32="0,5" /></Sphere>
    </SoftObject>
    <HardObject UserID="9">
      <Translation X="5" Y="0" Z="5" />
      <Rotation X="-1,5707963267948966" Y="0" Z="0" />
      <Bounce F32="1" />
      <Plane><HalfSideX F32="5" /><HalfSideY F32="5" /></Plane>
    </HardObject>
  </Primitives>
</PolyPhysicsXml>
"#;

/// What a run of the program left behind.
struct Outcome {
    code: i32,
    stdout: String,
    stderr: String,
}

/// The program, without a display, in a folder of its own.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    /// A bench with `scene.xml` holding `text`.
    fn with_scene(text: &str) -> Self {
        let bench = Self::new();
        bench.write("scene.xml", text);
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).expect("a file in the temporary folder");
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).expect("a file that the program wrote")
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_polyscene"));
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null());
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        command
    }

    fn polyscene(&self, arguments: &[&str]) -> Outcome {
        outcome(self.command(arguments).output().expect("the program starts"))
    }
}

fn outcome(output: Output) -> Outcome {
    Outcome {
        code: output.status.code().unwrap_or(-1),
        stdout: String::from_utf8(output.stdout).expect("UTF-8 on standard output"),
        stderr: String::from_utf8(output.stderr).expect("UTF-8 on standard error"),
    }
}

/// Every line as JSON; each must end with a line end.
fn rows(text: &str) -> Vec<Value> {
    assert!(text.is_empty() || text.ends_with('\n'), "the last line is cut: …{:?}", text.lines().last());
    text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e} in {line}"))).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn scenes_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// All `.xml` files right in `folder`, sorted.
fn scene_files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("a folder of scenes")
        .map(|entry| entry.expect("a folder entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "xml"))
        .collect();
    files.sort();
    files
}
