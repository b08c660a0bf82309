//! A session whose runner only writes down what it is told, and shows the frames a test gives it.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use polyscene::editor::{Action, Gesture, Outcome, Session, SessionCommand, Storage};
use polyscene::record::{Frame, RunCommand, RunState, Runner};
use polyscene::scene::{Body, BodyChange, Edit, Force, NodeKey};

/// A static floor 30, dynamic spheres 7 and 8, a gravity 1.
pub const SCENE: &str = r#"<PolyPhysicsXml Version="1.0">
  <Map><Size X="10" Y="10" Z="10" /><Tiles X="10" Y="10" Z="10" /></Map>
  <Simulation>
    <TimeSpeed F32="1" />
    <Forces><GravityPlane UserID="1"><Translation X="5" Y="5" Z="5" /><Gravity X="0" Y="-9,8" Z="0" /></GravityPlane></Forces>
  </Simulation>
  <Primitives>
    <HardObject UserID="30"><Translation X="5" Y="0" Z="5" /><Rotation X="-1,570796" Y="0" Z="0" /><Bounce F32="1" /><Plane><HalfSideX F32="5" /><HalfSideY F32="5" /></Plane></HardObject>
    <SoftObject UserID="7"><Translation X="3" Y="3" Z="3" /><Rotation X="0" Y="0" Z="0" /><Bounce F32="1" /><Weight F32="1" /><InitialVelocity X="0" Y="0" Z="0" /><Sphere><Radius F32="0,5" /></Sphere></SoftObject>
    <!-- the second -->
    <SoftObject UserID="8"><Translation X="7" Y="3" Z="3" /><Rotation X="0" Y="0" Z="0" /><Bounce F32="0,5" /><Weight F32="2" /><InitialVelocity X="1" Y="0" Z="0" /><Sphere><Radius F32="0,5" /></Sphere></SoftObject>
  </Primitives>
</PolyPhysicsXml>
"#;

#[derive(Default)]
pub struct Desk {
    sent: Vec<RunCommand>,
    /// How many commands were sent.
    count: u64,
    frame: Arc<Frame>,
}

/// The test's hold on the runner inside a session.
#[derive(Clone, Default)]
pub struct FakeRunner(Rc<RefCell<Desk>>);

impl Runner for FakeRunner {
    fn send(&mut self, command: RunCommand) -> u64 {
        let mut desk = self.0.borrow_mut();
        desk.sent.push(command);
        desk.count += 1;
        desk.count
    }

    fn frame(&self) -> Arc<Frame> {
        self.0.borrow().frame.clone()
    }

    fn tick(&mut self, _wall_s: f64) {}
}

/// A session under test, with its runner, a clock that the test moves, and a folder of its own.
pub struct Bench {
    pub session: Session,
    pub runner: FakeRunner,
    pub now: Instant,
    pub folder: tempfile::TempDir,
}

impl Bench {
    /// An empty session that keeps nothing on the disk.
    pub fn new() -> Self {
        Self::with(tempfile::tempdir().unwrap(), false)
    }

    /// A session that keeps settings and recovery files in `folder`.
    pub fn with_storage(folder: tempfile::TempDir) -> Self {
        Self::with(folder, true)
    }

    fn with(folder: tempfile::TempDir, keeps: bool) -> Self {
        let storage = if keeps { storage(folder.path()) } else { Storage::default() };
        let runner = FakeRunner::default();
        let session = Session::with_storage(Box::new(runner.clone()), storage);
        let mut bench = Self { session, runner, now: Instant::now(), folder };
        bench.show(|frame| frame.state = RunState::Paused);
        bench.session.take_notices();
        bench
    }

    /// Another session with the same storage, in a folder of its own for files.
    pub fn second_window(&self) -> Self {
        let runner = FakeRunner::default();
        let session = Session::with_storage(Box::new(runner.clone()), storage(self.folder.path()));
        Self { session, runner, now: Instant::now(), folder: tempfile::tempdir().unwrap() }
    }

    /// A session with [`SCENE`] open from a file.
    pub fn open() -> Self {
        let mut bench = Self::new();
        let path = bench.file("scene.xml", SCENE);
        bench.act(Action::OpenPath(path));
        assert!(bench.session.scene().is_some(), "{:?}", bench.session.document().diagnostics());
        bench.sent();
        bench.session.take_notices();
        bench
    }

    /// Writes a file in the bench's folder.
    pub fn file(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    pub fn act(&mut self, action: Action) -> Outcome {
        self.session.perform(action)
    }

    pub fn run(&mut self, command: SessionCommand) -> Outcome {
        self.session.perform(Action::Command(command))
    }

    pub fn edit(&mut self, edit: Edit) -> Outcome {
        self.act(Action::Edit { edit, gesture: None })
    }

    pub fn change(&mut self, id: i64, change: BodyChange) -> Outcome {
        let key = self.key(id);
        self.edit(Edit::Body { key, change })
    }

    pub fn drag(&mut self, id: i64, change: BodyChange, gesture: u64) -> Outcome {
        let edit = Edit::Body { key: self.key(id), change };
        self.act(Action::Edit { edit, gesture: Some(Gesture(gesture)) })
    }

    /// Lets wall-clock time pass and the session look around.
    pub fn wait(&mut self, time: Duration) {
        self.now += time;
        self.session.poll(self.now);
    }

    /// Publishes a frame that knows of all commands and differs from the last as `change` says.
    pub fn show(&mut self, change: impl FnOnce(&mut Frame)) {
        let mut frame = (*self.runner.0.borrow().frame).clone();
        frame.revision += 1;
        frame.command = self.runner.0.borrow().count;
        frame.is_settled = true;
        change(&mut frame);
        self.runner.0.borrow_mut().frame = Arc::new(frame);
        self.wait(Duration::ZERO);
    }

    /// Makes one step and shows that it was made.
    pub fn step(&mut self) {
        assert_eq!(self.run(SessionCommand::StepForward), Outcome::Done);
        let dt = self.session.playback().dt();
        self.show(|frame| {
            frame.dt_index += 1;
            frame.time += dt;
            frame.can_step_back = true;
        });
        self.sent();
    }

    /// What the runner was sent since the last call, without the scenes.
    pub fn sent(&self) -> Vec<String> {
        let sent = std::mem::take(&mut self.runner.0.borrow_mut().sent);
        sent.iter()
            .map(|command| match command {
                RunCommand::Load(_) => "Load".to_owned(),
                RunCommand::Edit(edits) => {
                    let name = |edit| {
                        let text = format!("{edit:?}");
                        text.split(['(', ' ']).next().unwrap_or_default().to_owned()
                    };
                    format!("Edit {}", edits.iter().map(name).collect::<Vec<_>>().join(" "))
                }
                other => format!("{other:?}"),
            })
            .collect()
    }

    /// The edits of the running simulation that were sent since the last call.
    pub fn sent_edits(&self) -> Vec<polyscene::sim::SimEdit> {
        let sent = std::mem::take(&mut self.runner.0.borrow_mut().sent);
        let edits = sent.into_iter().filter_map(|command| match command {
            RunCommand::Edit(edits) => Some(edits),
            _ => None,
        });
        edits.flatten().collect()
    }

    /// The scene last loaded.
    pub fn loaded(&self) -> Option<polyscene::scene::Scene> {
        let desk = self.runner.0.borrow();
        desk.sent.iter().rev().find_map(|command| match command {
            RunCommand::Load(scene) => Some((**scene).clone()),
            _ => None,
        })
    }

    pub fn body(&self, id: i64) -> &Body {
        self.session.scene().unwrap().bodies.iter().find(|body| body.id == id).expect("a body of this id")
    }

    pub fn force(&self, id: i64) -> &Force {
        self.session.scene().unwrap().forces.iter().find(|force| force.id == id).expect("a force of this id")
    }

    pub fn key(&self, id: i64) -> NodeKey {
        self.body(id).key
    }

    pub fn notices(&mut self) -> String {
        let notices = self.session.take_notices();
        notices.into_iter().map(|notice| notice.text).collect::<Vec<_>>().join("\n")
    }

    pub fn bytes(&self) -> String {
        String::from_utf8(self.session.document().to_bytes()).unwrap()
    }
}

pub fn storage(folder: &Path) -> Storage {
    Storage { config: Some(folder.join("config")), data: Some(folder.join("data")) }
}

/// Short ways to the numbers of a body.
pub trait BodyNumbers {
    fn mass(&self) -> Option<f64>;
    fn velocity(&self) -> Option<glam::DVec3>;
}

impl BodyNumbers for Body {
    fn mass(&self) -> Option<f64> {
        match self.motion {
            polyscene::scene::Motion::Dynamic { mass, .. } => Some(mass),
            polyscene::scene::Motion::Static => None,
        }
    }

    fn velocity(&self) -> Option<glam::DVec3> {
        match self.motion {
            polyscene::scene::Motion::Dynamic { velocity, .. } => Some(velocity),
            polyscene::scene::Motion::Static => None,
        }
    }
}
