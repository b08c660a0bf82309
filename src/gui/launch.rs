//! Opens the window, and lets scripts use it: commands to carry out, a picture to take, frames to time.

use std::collections::VecDeque;
use std::fmt;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use egui::{Context, ViewportCommand};

use super::app::{App, Parts, TIGHT};
use super::dialogs::NativeFileDialogs;
use super::dock::Panel;
use super::error::GuiError;
use crate::editor::{Action, COMMANDS, Command, Outcome, Storage, ViewCommand};
use crate::record::ThreadRunner;
use crate::render::write_png;
use crate::scene::{check_writable, same_file, shown_path};
use crate::sim::Method;
use crate::view::OVERLAYS;

/// How the window opens.
#[derive(Clone, Debug, Default)]
pub struct Options {
    pub scene: Option<PathBuf>,
    /// Points.
    pub window_size: Option<[u32; 2]>,
    /// Write a picture of the window, then close it.
    pub screenshot: Option<PathBuf>,
    /// Commands to carry out first: ids of [`COMMANDS`], `id*count`, `select:name`, `overlay:id`,
    /// `tab:problems`, `dt:1/60`, `method:thesis`, separated by commas.
    pub steps: Option<String>,
    /// Turn the first view for this many frames and report.
    pub bench_orbit: Option<u32>,
}

/// What the window measured.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// From the call of [`run`] to the first frame, s.
    pub first_frame_s: f64,
    /// Sorted times from frame to frame while the view turned, s.
    pub orbit_s: Vec<f64>,
    /// Repaints in two seconds in which nothing happened.
    pub idle_repaints: u64,
    failure: Option<String>,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
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
    let scripted = options.screenshot.is_some() || options.bench_orbit.is_some();
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
        app.forgetful = scripted;
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    eframe::run_native("PolyScene", native, Box::new(creator))
        .map_err(|error| GuiError::NoWindow(without_source_place(&error.to_string())))?;
    let report = report.lock().unwrap_or_else(PoisonError::into_inner).clone();
    match report.failure {
        Some(reason) => Err(GuiError::Script(reason)),
        None => Ok(report),
    }
}

/// Refuses a picture that cannot be written or would replace the scene, before the window opens.
fn check_screenshot(options: &Options) -> Result<(), GuiError> {
    let Some(path) = &options.screenshot else { return Ok(()) };
    if options.scene.as_ref().is_some_and(|scene| same_file(path, scene)) {
        let text = format!("--screenshot would overwrite the scene {}", shown_path(path));
        return Err(GuiError::Script(text));
    }
    check_writable(path)
        .map_err(|error| GuiError::Script(format!("cannot write {}: {error}", shown_path(path))))
}

/// What a script does with the window, turn by turn.
pub(super) struct Script {
    called: Instant,
    /// Each with its text.
    steps: VecDeque<(Step, String)>,
    screenshot: Option<PathBuf>,
    bench: Option<Bench>,
    wait_until: Option<Instant>,
    report: Arc<Mutex<Report>>,
}

#[derive(Clone, Debug, PartialEq)]
enum Step {
    Command(Command),
    Select(String),
    Dt(String),
    Method(Method),
    Panel(Panel),
    Event(usize),
    /// Runs a study and waits for it.
    Study,
}

struct Bench {
    frames_left: u32,
    last: Option<Instant>,
    times_s: Vec<f64>,
    /// Since when the window rests, and how often it has drawn itself all the same.
    resting: Option<(Instant, u64)>,
}

/// Long enough for the simulation's thread to take a command up.
const PAUSE: Duration = Duration::from_millis(120);

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
        Ok(Self { called, steps, screenshot: options.screenshot.clone(), bench, wait_until: None, report })
    }

    fn tell(&self, change: impl FnOnce(&mut Report)) {
        change(&mut self.report.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

/// A step and how often it is taken: `id*count`.
fn counted_step(text: &str) -> Result<(Step, usize), String> {
    /// More than anyone waits for.
    const MOST: usize = 100_000;
    let (name, count) = match text.rsplit_once('*') {
        Some((name, count)) => (name.trim(), Some(count.trim())),
        None => (text, None),
    };
    let step = step(name).ok_or_else(|| format!("--do: there is no step `{name}`"))?;
    match count.map_or(Ok(1), str::parse) {
        Ok(count @ 1..=MOST) => Ok((step, count)),
        _ => Err(format!("--do {text}: the count after * must be a whole number from 1 to {MOST}")),
    }
}

fn step(text: &str) -> Option<Step> {
    if let Some((kind, value)) = text.split_once(':') {
        return match kind {
            "select" => Some(Step::Select(value.to_owned())),
            "dt" => Some(Step::Dt(value.to_owned())),
            "method" => Some(Step::Method(Method::from_name(value)?)),
            "event" => Some(Step::Event(value.parse().ok()?)),
            "tab" if value == "problems" => Some(Step::Panel(Panel::Problems)),
            "tab" if value == "accuracy" => Some(Step::Panel(Panel::Accuracy)),
            "tab" if value == "events" => Some(Step::Panel(Panel::Events)),
            "overlay" => {
                let index = OVERLAYS.iter().position(|overlay| overlay.id == value)?;
                Some(Step::Command(ViewCommand::ToggleOverlay(index).into()))
            }
            _ => None,
        };
    }
    if text == "study" {
        return Some(Step::Study);
    }
    COMMANDS.iter().find(|row| row.id == text).map(|row| Step::Command(row.command))
}

impl App {
    /// At the end of every turn of the window.
    pub(super) fn run_script(&mut self, ctx: &Context) {
        let Some(mut script) = self.script.take() else { return };
        if self.repaints == 1 {
            let first_frame_s = script.called.elapsed().as_secs_f64();
            script.tell(|report| report.first_frame_s = first_frame_s);
        }
        if self.script_goes_on(ctx, &mut script) {
            self.script = Some(script);
        }
    }

    /// Whether there is something left to do.
    fn script_goes_on(&mut self, ctx: &Context, script: &mut Script) -> bool {
        if script.steps.is_empty() && script.screenshot.is_none() && script.bench.is_none() {
            return false;
        }
        let busy = self.session().is_busy() || self.accuracy.is_running();
        if busy || script.wait_until.is_some_and(|until| Instant::now() < until) {
            ctx.request_repaint_after(Duration::from_millis(10));
            return true;
        }
        // the first turns settle the layout
        if self.repaints < 4 {
            ctx.request_repaint();
            return true;
        }
        if let Some((step, text)) = script.steps.pop_front() {
            if let Err(reason) = self.take_step(ctx, &step) {
                script.tell(|report| report.failure = Some(format!("--do {text}: {reason}")));
                ctx.send_viewport_cmd(ViewportCommand::Close);
                return false;
            }
            // the simulation may have got something to do
            let pause = matches!(step, Step::Command(_));
            script.wait_until = pause.then(|| Instant::now() + PAUSE);
            if script.steps.is_empty() {
                script.wait_until = Some(Instant::now() + 3 * PAUSE);
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
            script.tell(|report| {
                report.orbit_s = bench.times_s;
                report.orbit_s.sort_by(f64::total_cmp);
                report.idle_repaints = idle;
            });
        }
        match script.screenshot.take() {
            Some(path) => take_picture(ctx, path, script.report.clone()),
            None => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
        false
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
                    let force = || scene.forces.iter().find(|force| force.label == *name);
                    body.map(|body| body.key).or_else(|| force().map(|force| force.key))
                });
                let key = key.ok_or("no body or force has this name or ID")?;
                self.perform(Action::AddToSelection(vec![key]))
            }
            Step::Event(index) => {
                let events = &self.session().frame().events;
                let missing = || format!("there are {} events in this Δt, counted from 0", events.len());
                let event = events.get(*index).cloned().ok_or_else(missing)?;
                self.perform(Action::ShowEvent(Some(event)))
            }
            Step::Study => {
                self.run_study(ctx);
                Outcome::Done
            }
        };
        match outcome {
            Outcome::Refused(reason) => Err(reason),
            Outcome::Done => Ok(()),
        }
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
        let written = write_png(&path, picture.as_raw(), [width, height]);
        if let Err(error) = written {
            let mut report = report.lock().unwrap_or_else(PoisonError::into_inner);
            report.failure = Some(format!("cannot write {}: {error}", shown_path(&path)));
        }
        after.send_viewport_cmd(ViewportCommand::Close);
    });
    ctx.request_repaint();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::SessionCommand;

    #[test]
    fn steps_are_read_and_unknown_ones_refused() {
        assert_eq!(step("next_event"), Some(Step::Command(SessionCommand::NextEvent.into())));
        assert_eq!(step("select:5853"), Some(Step::Select("5853".into())));
        assert_eq!(step("tab:problems"), Some(Step::Panel(Panel::Problems)));
        assert_eq!(step("fly"), None);
        assert_eq!(step("overlay:nothing"), None);
        assert_eq!(counted_step("next_event*3"), Ok((Step::Command(SessionCommand::NextEvent.into()), 3)));
        for (text, reason) in [
            ("next_event*-1", "count"),
            ("next_event*0", "count"),
            ("next_event*x", "count"),
            ("fly*2", "`fly`"),
        ] {
            let error = counted_step(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }
}
