//! Times the frames of a window in which a run plays: turning the views of a run that is paused, of one that plays, and scrolling
//! through its ledger. What the window does for a frame is told from what drawing adds to it.

use std::fmt;
use std::time::Instant;

use egui::Context;

use super::app::App;
use super::dock::Panel;
use crate::editor::{Action, SessionCommand};
use crate::record::{Lag, RunState};

/// Turned by from frame to frame, so that paused and playing views are drawn anew equally often, radians.
const TURN: f64 = 0.002;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Task {
    Paused,
    Playing,
    Scrolling,
}

const TASKS: [(Task, &str); 3] =
    [(Task::Paused, "paused"), (Task::Playing, "playing"), (Task::Scrolling, "scrolling the ledger")];

/// Does each task for so many frames.
#[derive(Debug)]
pub(super) struct PlayBench {
    frames: u32,
    /// Frames done, of all tasks.
    done: u32,
    last: Option<Instant>,
    turn: Option<Turn>,
    times: PlayTimes,
}

/// One turn of the window, from its beginning.
#[derive(Clone, Copy, Debug)]
struct Turn {
    began: Instant,
    waited_s: f64,
}

/// What was measured of the frames of one task, s; sorted once all are known.
#[derive(Clone, Debug, Default)]
struct Frames {
    /// What the window did itself: looking at the simulation, laying out and describing what is to be drawn, less what its thread
    /// waited for a processor.
    own: Vec<f64>,
    /// From frame to frame, with the drawing.
    whole: Vec<f64>,
}

/// What was measured.
#[derive(Clone, Debug, Default)]
pub struct PlayTimes {
    frames: [Frames; TASKS.len()],
    /// Pictures of the simulation that were published while it played.
    pictures: u64,
    /// Model seconds and events that were simulated, and how far it fell behind at the end.
    played_s: f64,
    events: u64,
    lag: Option<Lag>,
    rows: usize,
}

impl PlayBench {
    pub fn new(frames: u32) -> Self {
        Self { frames, done: 0, last: None, turn: None, times: PlayTimes::default() }
    }

    pub fn has_begun(&self) -> bool {
        self.done > 0
    }

    /// A turn of the window begins.
    pub fn begin_turn(&mut self) {
        self.turn = Some(Turn { began: Instant::now(), waited_s: waited_s() });
    }

    /// What was measured.
    pub fn finish(mut self) -> PlayTimes {
        for frames in &mut self.times.frames {
            frames.own.sort_by(f64::total_cmp);
            frames.whole.sort_by(f64::total_cmp);
        }
        self.times
    }

    /// The turn that ends now was one of a task.
    fn note(&mut self, task: usize) {
        let now = Instant::now();
        let frames = &mut self.times.frames[task];
        if let Some(turn) = self.turn.take() {
            frames.own.push((now - turn.began).as_secs_f64() - (waited_s() - turn.waited_s));
        }
        if let Some(last) = self.last.replace(now) {
            frames.whole.push((now - last).as_secs_f64());
        }
    }
}

impl App {
    /// Measures a frame and prepares the next. Returns whether all is done.
    pub(super) fn bench_playing(&mut self, ctx: &Context, bench: &mut PlayBench) -> bool {
        let frames = bench.frames.max(1);
        if let Some(before) = bench.done.checked_sub(1) {
            bench.note((before / frames) as usize);
        }
        let nth = bench.done % frames;
        let Some((task, _)) = TASKS.get((bench.done / frames) as usize) else { return true };
        bench.done += 1;
        match task {
            Task::Paused => self.views.turn_all(TURN),
            Task::Playing => {
                if nth == 0 {
                    self.start_playing(bench);
                }
                self.views.turn_all(TURN);
                if nth + 1 == frames {
                    self.stop_playing(bench);
                }
            }
            Task::Scrolling => {
                if nth == 0 {
                    self.show_panel(Panel::Events);
                }
                // Spread without a pattern: multiples of the golden ratio.
                self.ledger.scroll_to((0.618_033_988_75 * f64::from(nth)).fract());
            }
        }
        ctx.request_repaint();
        false
    }

    fn start_playing(&mut self, bench: &mut PlayBench) {
        let frame = self.session().frame();
        (bench.times.pictures, bench.times.events) = (frame.revision, frame.ledger.len() as u64);
        bench.times.played_s = frame.time;
        self.perform(Action::Command(SessionCommand::PlayPause));
    }

    fn stop_playing(&mut self, bench: &mut PlayBench) {
        let frame = self.session().frame().clone();
        let times = &mut bench.times;
        times.pictures = frame.revision.saturating_sub(times.pictures);
        times.events = (frame.ledger.len() as u64).saturating_sub(times.events);
        (times.played_s, times.lag, times.rows) =
            (frame.time - times.played_s, frame.lag, frame.ledger.len());
        if frame.state == RunState::Playing {
            self.perform(Action::Command(SessionCommand::PlayPause));
        }
    }
}

/// How long this thread has waited for a processor so far, s: on a machine that others use too, that is theirs. 0 where the system
/// does not tell.
fn waited_s() -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = told.split_whitespace().nth(1).and_then(|text| text.parse::<f64>().ok());
    1e-9 * nanoseconds.unwrap_or(0.0)
}

impl fmt::Display for PlayTimes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for ((_, name), frames) in TASKS.iter().zip(&self.frames) {
            let (own, whole) = (Shares(&frames.own), Shares(&frames.whole));
            writeln!(f, "{name}: the window's own part {own}; whole frames {whole}")?;
        }
        write!(
            f,
            "played {:.3} s with {} events in {} pictures, {} rows recorded",
            self.played_s, self.events, self.pictures, self.rows
        )?;
        match self.lag {
            Some(lag) => write!(f, ", at the end at {:.3} of the speed asked for", lag.share),
            None => write!(f, ", at the speed asked for"),
        }
    }
}

/// Sorted times as text.
struct Shares<'a>(&'a [f64]);

impl fmt::Display for Shares<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = |share: f64| {
            let index = (self.0.len().saturating_sub(1) as f64 * share) as usize;
            1e3 * self.0.get(index).copied().unwrap_or_default()
        };
        write!(f, "median {:.1} ms, 95 % below {:.1} ms, longest {:.1} ms", at(0.5), at(0.95), at(1.0))
    }
}
