//! Opens the window, and lets scripts use it: commands to carry out, a picture to take, frames to time.

use std::collections::VecDeque;
use std::fmt;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use egui::{Context, ViewportCommand};

use super::app::{App, Parts, TIGHT};
use super::bench::{EditBench, EditTimes};
use super::bench_play::{PlayBench, PlayTimes};
use super::dialogs::NativeFileDialogs;
use super::error::GuiError;
use super::steps::{Step, counted_step};
use crate::design::{TOOLS, free_place, is_place};
use crate::editor::{Action, Outcome, Storage};
use crate::record::ThreadRunner;
use crate::render::{check_png_name, png, write_png};
use crate::scene::{Force, check_writable, same_file, shown_path};

/// How the window opens.
#[derive(Clone, Debug, Default)]
pub struct Options {
    pub scene: Option<PathBuf>,
    /// Points.
    pub window_size: Option<[u32; 2]>,
    /// Write a picture of the window, then close it; `-` is standard output.
    pub screenshot: Option<PathBuf>,
    /// Steps to take first, separated by commas: see docs/scripts.md.
    pub steps: Option<String>,
    /// Turn the first view for this many frames and report.
    pub bench_orbit: Option<u32>,
    /// Select and drag bodies for this many frames each and report.
    pub bench_edit: Option<u32>,
    /// Show a run for this many frames paused, playing and scrolling through its ledger, and report.
    pub bench_play: Option<u32>,
}

/// What the window measured.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// From the call of [`run`] to the first frame, s.
    pub first_frame_s: f64,
    /// Sorted times from frame to frame while the view turned, s.
    pub orbit_s: Vec<f64>,
    /// Of frames in which something was selected or dragged.
    pub edits: Option<EditTimes>,
    /// Of frames in which a run played.
    pub play: Option<PlayTimes>,
    /// Repaints in two seconds in which nothing happened.
    pub idle_repaints: u64,
    failure: Option<Failure>,
}

/// Why a script did not end well.
#[derive(Clone, Debug)]
enum Failure {
    /// A step that cannot be taken, or a picture that cannot be written.
    Script(String),
    /// A scene that cannot be opened or has errors.
    Scene(String),
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(play) = &self.play {
            return write!(f, "first frame after {:.2} s\n{play}", self.first_frame_s);
        }
        if let Some(edits) = &self.edits {
            return write!(f, "first frame after {:.2} s; {edits}", self.first_frame_s);
        }
        let at = |share: f64| {
            let index = (self.orbit_s.len().saturating_sub(1) as f64 * share) as usize;
            1e3 * self.orbit_s.get(index).copied().unwrap_or_default()
        };
        write!(
            f,
            "first frame after {:.2} s; turning a view: median {:.1} ms, 95 % below {:.1} ms; {} repaints in 2 s \
             of rest",
            self.first_frame_s,
            at(0.5),
            at(0.95),
            self.idle_repaints
        )
    }
}

/// Opens the editor and returns when it is closed.
pub fn run(options: Options) -> Result<Report, GuiError> {
    let called = Instant::now();
    let report = Arc::new(Mutex::new(Report::default()));
    let script = Script::new(&options, called, report.clone())?;
    check_screenshot(&options)?;
    let benches = [options.bench_orbit, options.bench_edit, options.bench_play];
    let scripted = options.screenshot.is_some() || benches.iter().any(Option::is_some);
    let size = options.window_size.unwrap_or([1360, 860]).map(|side| side as f32);
    let viewport = egui::ViewportBuilder::default()
        .with_app_id("polyscene")
        .with_title("PolyScene")
        .with_inner_size(size)
        .with_min_inner_size(TIGHT);
    // a window for a script is as if it were the first one: it neither reads nor writes what was remembered
    let persistence_path =
        scripted.then(|| std::env::temp_dir().join(format!("polyscene-{}.ron", std::process::id())));
    let mut native = eframe::NativeOptions {
        viewport,
        persist_window: !scripted && options.window_size.is_none(),
        persistence_path,
        // Nothing that is drawn fades over many pixels, and where the processor draws each step of a pixel is felt.
        dithering: false,
        ..eframe::NativeOptions::default()
    };
    native.glow_options.vsync = !scripted;
    let (scene, wanted) = (options.scene, options.window_size);
    let creator = move |cc: &eframe::CreationContext<'_>| {
        let ctx = cc.egui_ctx.clone();
        if let Some(size) = wanted {
            // a size remembered from an earlier run comes before that of the builder
            ctx.send_viewport_cmd(ViewportCommand::InnerSize(size.map(|side| side as f32).into()));
        }
        let runner = ThreadRunner::new(move || ctx.request_repaint())?;
        let storage = if scripted { Storage::default() } else { Storage::of_user() };
        let files = Box::new(NativeFileDialogs::default());
        let mut app = App::new(cc, Parts { runner: Box::new(runner), storage, files, scene });
        app.script = Some(script);
        let ctx = cc.egui_ctx.clone();
        app.session.watch_disk(move || ctx.request_repaint());
        app.forgetful = scripted;
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    eframe::run_native("PolyScene", native, Box::new(creator))
        .map_err(|error| GuiError::NoWindow(without_source_place(&error.to_string())))?;
    let report = report.lock().unwrap_or_else(PoisonError::into_inner).clone();
    match report.failure {
        Some(Failure::Script(reason)) => Err(GuiError::Script(reason)),
        Some(Failure::Scene(reason)) => Err(GuiError::Scene(reason)),
        None => Ok(report),
    }
}

/// Refuses a picture that is to be no PNG file, cannot be written or would replace the scene, before the window opens.
fn check_screenshot(options: &Options) -> Result<(), GuiError> {
    let Some(path) = options.screenshot.as_ref().filter(|path| !is_stdout(path)) else { return Ok(()) };
    if options.scene.as_ref().is_some_and(|scene| same_file(path, scene)) {
        let text = format!("--screenshot would overwrite the scene {}", shown_path(path));
        return Err(GuiError::Script(text));
    }
    check_png_name(path).map_err(|refusal| GuiError::Script(format!("--screenshot {refusal}")))?;
    check_writable(path)
        .map_err(|error| GuiError::Script(format!("cannot write {}: {error}", shown_path(path))))
}

fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// What a script does with the window, turn by turn.
pub(super) struct Script {
    called: Instant,
    /// The scene that was asked for.
    scene: Option<PathBuf>,
    /// Whether it had taken all up in the turn before: the window shows it now.
    answered: bool,
    /// Each with its text.
    steps: VecDeque<(Step, String)>,
    screenshot: Option<PathBuf>,
    bench: Option<Bench>,
    edits: Option<EditBench>,
    play: Option<PlayBench>,
    wait_until: Option<Instant>,
    report: Arc<Mutex<Report>>,
}

struct Bench {
    frames_left: u32,
    last: Option<Instant>,
    times_s: Vec<f64>,
    /// Since when the window rests, and how often it has drawn itself all the same.
    resting: Option<(Instant, u64)>,
}

/// Long enough for what moves in the window by itself to come to its end: folds, fading marks.
const PAUSE: Duration = Duration::from_millis(360);

/// How long nothing may happen for the count of repaints.
const REST: Duration = Duration::from_secs(2);

impl Script {
    fn new(options: &Options, called: Instant, report: Arc<Mutex<Report>>) -> Result<Self, GuiError> {
        let mut steps = VecDeque::new();
        let texts = options.steps.iter().flat_map(|steps| steps.split(',')).map(str::trim);
        for text in texts.filter(|text| !text.is_empty()) {
            let (step, count) = counted_step(text).map_err(GuiError::Script)?;
            steps.extend(std::iter::repeat_n((step, text.to_owned()), count));
        }
        let bench = options.bench_orbit.map(|frames_left| Bench {
            frames_left,
            last: None,
            times_s: Vec::new(),
            resting: None,
        });
        Ok(Self {
            called,
            scene: options.scene.clone(),
            answered: false,
            steps,
            screenshot: options.screenshot.clone(),
            bench,
            edits: options.bench_edit.map(EditBench::new),
            play: options.bench_play.map(PlayBench::new),
            wait_until: None,
            report,
        })
    }

    /// A turn of the window begins.
    pub(super) fn begin_turn(&mut self) {
        self.play.iter_mut().for_each(PlayBench::begin_turn);
    }

    /// Whether a drag goes on without a button that is held.
    pub(super) fn is_dragging(&self) -> bool {
        self.edits.as_ref().is_some_and(EditBench::is_dragging)
    }

    /// Whether the window does not show yet what the simulation made of all that it was told; `answered`: whether it
    /// has made it.
    fn waits_for_simulation(&mut self, answered: bool) -> bool {
        let answered = std::mem::replace(&mut self.answered, answered);
        !(answered && self.answered)
    }

    fn note(&self, change: impl FnOnce(&mut Report)) {
        change(&mut self.report.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

impl App {
    /// At the end of every turn of the window.
    pub(super) fn run_script(&mut self, ctx: &Context) {
        let Some(mut script) = self.script.take() else { return };
        let measures = script.bench.is_some() || script.edits.is_some() || script.play.is_some();
        if self.repaints == 1 {
            let first_frame_s = script.called.elapsed().as_secs_f64();
            script.note(|report| report.first_frame_s = first_frame_s);
        }
        let goes_on = self.script_goes_on(ctx, &mut script);
        // What a script asks for it waits for; what it measures, and the person after it, see drafts.
        self.views.canvas.draw_in_full(goes_on && !measures);
        if goes_on {
            self.script = Some(script);
        }
    }

    /// Whether there is something left to do.
    fn script_goes_on(&mut self, ctx: &Context, script: &mut Script) -> bool {
        let is_done = script.steps.is_empty()
            && script.screenshot.is_none()
            && script.bench.is_none()
            && script.edits.is_none()
            && script.play.is_none();
        if is_done {
            return false;
        }
        let answered = !self.session().awaits_simulation();
        let busy =
            script.waits_for_simulation(answered) || self.accuracy.is_running() || self.dialogs.are_working();
        let busy = busy || self.views.are_behind();
        // A person who drags does not wait for the simulation.
        let busy = busy
            && !script.edits.as_ref().is_some_and(EditBench::has_begun)
            && !script.play.as_ref().is_some_and(PlayBench::has_begun);
        if busy || script.wait_until.is_some_and(|until| Instant::now() < until) {
            ctx.request_repaint_after(Duration::from_millis(10));
            return true;
        }
        // the first turns settle the layout
        if self.repaints < 4 {
            ctx.request_repaint();
            return true;
        }
        if let Some(reason) = self.missing_scene(script) {
            return fail(ctx, script, Failure::Scene(reason));
        }
        if let Some((step, text)) = script.steps.pop_front() {
            if let Err(reason) = self.take_step(ctx, &step) {
                return fail(ctx, script, Failure::Script(format!("--do {text}: {reason}")));
            }
            script.answered = false;
            if script.steps.is_empty() {
                script.wait_until = Some(Instant::now() + PAUSE);
            }
            ctx.request_repaint();
            return true;
        }
        if let Some(bench) = &mut script.bench
            && !self.bench(ctx, bench)
        {
            return true;
        }
        if let Some(bench) = script.bench.take() {
            let idle = bench.resting.map_or(0, |(_, repaints)| repaints);
            script.note(|report| {
                report.orbit_s = bench.times_s;
                report.orbit_s.sort_by(f64::total_cmp);
                report.idle_repaints = idle;
            });
        }
        if let Some(edits) = &mut script.edits
            && !self.bench_edits(ctx, edits)
        {
            return true;
        }
        if let Some(edits) = script.edits.take() {
            script.note(|report| report.edits = Some(edits.finish()));
        }
        if let Some(play) = &mut script.play
            && !self.bench_playing(ctx, play)
        {
            return true;
        }
        if let Some(play) = script.play.take() {
            script.note(|report| report.play = Some(play.finish()));
        }
        if let Some(reason) = self.errors_of_scene() {
            // The picture shows them, but no script should take them for a success.
            script.note(|report| report.failure = Some(Failure::Scene(reason)));
        }
        match script.screenshot.take() {
            Some(path) => take_picture(ctx, path, script.report.clone()),
            None => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
        false
    }

    /// Why the scene that a script wants is not in the window, if it is not.
    fn missing_scene(&self, script: &Script) -> Option<String> {
        let path = script.scene.as_ref().filter(|_| self.session().opened_count() == 0)?;
        let why = std::fs::File::open(path).err().map_or(String::new(), |error| format!(": {error}"));
        Some(format!("{} cannot be opened{why}", shown_path(path)))
    }

    fn errors_of_scene(&self) -> Option<String> {
        let document = self.session().document();
        let errors = document.diagnostics().iter().filter(|problem| problem.is_error()).count();
        (errors > 0).then(|| format!("the scene in the window has {errors} error(s), see `polyscene check`"))
    }

    /// The error says why the step cannot be taken.
    fn take_step(&mut self, ctx: &Context, step: &Step) -> Result<(), String> {
        let outcome = match step {
            Step::Command(command) => self.execute(ctx, *command),
            Step::Dt(text) => self.perform(Action::SetDt(text.clone())),
            Step::Method(method) => self.perform(Action::SetMethod(*method)),
            Step::Panel(panel) => {
                self.show_panel(*panel);
                Outcome::Done
            }
            Step::Select(name) => {
                let key = self.session().scene().and_then(|scene| {
                    let body =
                        scene.bodies.iter().find(|body| body.display_name() == name || body.label == *name);
                    let force = || {
                        let named =
                            |force: &&Force| force.name.as_ref() == Some(name) || force.label == *name;
                        scene.forces.iter().find(named)
                    };
                    body.map(|body| body.key).or_else(|| force().map(|force| force.key))
                });
                let key = key.ok_or("no body or force has this name or ID")?;
                self.perform(Action::AddToSelection(vec![key]))
            }
            Step::Build(index, others) => self.build(*index, others)?,
            Step::Event(index) => {
                let events = &self.session().frame().events;
                let missing = || format!("there are {} events in this Δt, counted from 0", events.len());
                let event = events.get(*index).cloned().ok_or_else(missing)?;
                self.perform(Action::ShowEvent(Some(event)))
            }
            Step::Study => self.run_study(ctx),
        };
        match outcome {
            Outcome::Refused(reason) => Err(reason),
            Outcome::Done => Ok(()),
        }
    }

    /// Uses a tool as its dialog would.
    fn build(&mut self, index: usize, others: &[(String, f64)]) -> Result<Outcome, String> {
        let tool = TOOLS.get(index).ok_or("there is no such tool")?;
        let given = self.session().given(self.views.eye()).ok_or("there is no scene")?;
        let mut values = tool.defaults(&given);
        for (label, typed) in others {
            let at = tool.inputs.iter().position(|input| input.label == label);
            let (at, value) = at.zip(at.and_then(|at| values.get_mut(at))).ok_or("there is no such input")?;
            *value = *typed;
            tool.follow.iter().for_each(|follow| follow(&mut values, at));
        }
        if !others.iter().any(|(label, _)| is_place(label)) {
            values = free_place(tool, &given, &values);
        }
        let plan = tool.plan(&given, &values)?;
        Ok(self.perform(Action::Apply(plan)))
    }

    /// Turns the first view; `true` when all is measured.
    fn bench(&mut self, ctx: &Context, bench: &mut Bench) -> bool {
        let now = Instant::now();
        if bench.frames_left > 0 {
            if let Some(last) = bench.last.replace(now) {
                bench.times_s.push((now - last).as_secs_f64());
            }
            bench.frames_left -= 1;
            self.views.turn_first(0.02);
            ctx.request_repaint();
            return false;
        }
        match bench.resting {
            None => {
                // the turning still echoes for a frame
                bench.resting = Some((now + PAUSE, 0));
                ctx.request_repaint_after(PAUSE + REST);
                false
            }
            Some((since, repaints)) => {
                let rested = now.saturating_duration_since(since);
                // a timer may be a little early: that repaint is its own
                if !rested.is_zero() && rested < REST.mul_f64(0.95) {
                    bench.resting = Some((since, repaints + 1));
                }
                ctx.request_repaint_after(REST.saturating_sub(rested));
                rested >= REST
            }
        }
    }
}

/// winit's errors name the place in its source where they arose (`os error at FILE:LINE: reason`), which
/// tells a user nothing.
fn without_source_place(message: &str) -> String {
    let reason = message.split_once("os error at ").and_then(|(_, rest)| rest.split_once(".rs:"));
    let reason = reason.and_then(|(_, rest)| rest.split_once(": "));
    reason.map_or(message, |(_, reason)| reason).trim_end_matches('.').into()
}

fn take_picture(ctx: &Context, path: PathBuf, report: Arc<Mutex<Report>>) {
    let after = ctx.clone();
    ctx.request_screenshot(move |picture: Arc<egui::ColorImage>| {
        let [width, height] = picture.size.map(|side| side as u32);
        if let Err(error) = write_picture(&path, picture.as_raw(), [width, height]) {
            let mut report = report.lock().unwrap_or_else(PoisonError::into_inner);
            report.failure = Some(Failure::Script(format!("cannot write {}: {error}", shown_path(&path))));
        }
        after.send_viewport_cmd(ViewportCommand::Close);
    });
    ctx.request_repaint();
}

fn write_picture(path: &Path, rgba: &[u8], size: [u32; 2]) -> std::io::Result<()> {
    if is_stdout(path) {
        let mut stdout = std::io::stdout();
        return stdout.write_all(&png(rgba, size)?).and_then(|()| stdout.flush());
    }
    write_png(path, rgba, size)
}

/// Ends a script, and the window with it.
fn fail(ctx: &Context, script: &Script, failure: Failure) -> bool {
    script.note(|report| report.failure = Some(failure));
    ctx.send_viewport_cmd(ViewportCommand::Close);
    false
}
