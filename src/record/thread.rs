//! The threaded runner: the simulation has a thread of its own, so that no scene can freeze the window.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::lag::{Measured, lag_of};
use super::publish::{Pace, frame_of};
use super::recorder::RunRecorder;
use super::{Frame, RunCommand, RunState, Runner};
use crate::sim::Counters;

/// Events between two looks at the clock and at the commands: in scenes of many bodies each takes milliseconds.
const SLICE: u32 = 8;
/// Time between two frames while it works or plays.
const FRAME_TIME: Duration = Duration::from_millis(16);
/// Parts of the time that go to frames while nobody has looked at the last one, one in so many: a window that draws slowly needs no
/// more than a new one to look at, and the processor itself.
const UNSEEN_SHARE: u32 = 20;
/// How long closing waits for the thread: many slices, and less than a person notices.
const PATIENCE: Duration = Duration::from_millis(200);

/// Runs on a thread of its own until it is dropped. A frame is replaced as a whole, never changed.
#[derive(Debug)]
pub struct ThreadRunner {
    commands: Option<Sender<RunCommand>>,
    /// Ends the thread before it looks at what still waits.
    closing: Arc<AtomicBool>,
    frame: Arc<Published>,
    /// Number of the last command sent.
    sent: u64,
    thread: Option<JoinHandle<()>>,
}

/// The newest frame, and whether anyone has looked at it.
#[derive(Debug, Default)]
struct Published {
    frame: Mutex<Arc<Frame>>,
    is_seen: AtomicBool,
}

impl Published {
    fn set(&self, frame: Arc<Frame>) {
        *self.frame.lock().unwrap_or_else(PoisonError::into_inner) = frame;
        self.is_seen.store(false, Ordering::Relaxed);
    }

    fn get(&self) -> Arc<Frame> {
        self.is_seen.store(true, Ordering::Relaxed);
        self.frame.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl ThreadRunner {
    /// `on_frame` is called from the thread after every new frame: the window asks for a repaint there.
    pub fn new(on_frame: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let (commands, received) = channel();
        let frame = Arc::<Published>::default();
        let closing = Arc::new(AtomicBool::new(false));
        let (shared, ends) = (frame.clone(), closing.clone());
        let thread = std::thread::Builder::new()
            .name("simulation".into())
            .spawn(move || Worker::new(received, shared, Box::new(on_frame)).run(&ends))?;
        Ok(Self { commands: Some(commands), closing, frame, sent: 0, thread: Some(thread) })
    }
}

impl Runner for ThreadRunner {
    fn send(&mut self, command: RunCommand) -> u64 {
        self.sent += 1;
        if let Some(commands) = &self.commands {
            // The thread lives as long as the sender; a failed one has left its last frame to be seen.
            let _ = commands.send(command);
        }
        self.sent
    }

    fn frame(&self) -> Arc<Frame> {
        self.frame.get()
    }

    fn tick(&mut self, _wall_s: f64) {}
}

impl Drop for ThreadRunner {
    /// Waits for the thread to end, but not for long: it may be inside one call that takes minutes, and whoever
    /// closes the window wants to be done. The thread then ends by itself after that call, or with the process.
    fn drop(&mut self) {
        self.closing.store(true, Ordering::Relaxed);
        self.commands = None;
        let Some(thread) = self.thread.take() else { return };
        let since = Instant::now();
        while !thread.is_finished() && since.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

struct Worker {
    commands: Receiver<RunCommand>,
    shared: Arc<Published>,
    /// Number of the last command taken up.
    command: u64,
    /// Whether no frame knows of it yet.
    is_unseen: bool,
    /// Whether the last frame showed the simulation where it stands.
    is_settled_seen: bool,
    on_frame: Box<dyn Fn() + Send>,
    recorder: RunRecorder,
    revision: u64,
    clock: Clock,
}

/// What is measured with the wall clock, for the status bar.
struct Clock {
    last_elapse: Instant,
    last_frame: Instant,
    /// Time, events and Δt when the last measurement began.
    since: (Instant, u64, u64),
    counters: Counters,
    working: Duration,
    /// What making the last frame took.
    publishing: Duration,
    pace: Pace,
}

/// Time over which speeds are averaged.
const PACE_TIME: Duration = Duration::from_millis(500);

impl Worker {
    fn new(commands: Receiver<RunCommand>, shared: Arc<Published>, on_frame: Box<dyn Fn() + Send>) -> Self {
        let now = Instant::now();
        let clock = Clock {
            last_elapse: now,
            last_frame: now,
            since: (now, 0, 0),
            counters: Counters::default(),
            working: Duration::ZERO,
            publishing: Duration::ZERO,
            pace: Pace::default(),
        };
        let recorder = RunRecorder::default();
        Self {
            commands,
            shared,
            command: 0,
            is_unseen: false,
            is_settled_seen: false,
            on_frame,
            recorder,
            revision: 0,
            clock,
        }
    }

    fn run(mut self, closing: &AtomicBool) {
        let mut busy = false;
        loop {
            let received = self.receive(busy);
            if closing.load(Ordering::Relaxed) {
                return;
            }
            let received = match received {
                Received::Command(command) => {
                    self.recorder.command(command);
                    self.command += 1;
                    true
                }
                Received::Nothing => false,
                Received::Closed => return,
            };
            let started = Instant::now();
            self.recorder.elapse((started - self.clock.last_elapse).as_secs_f64());
            self.clock.last_elapse = started;
            let was_working = busy || self.recorder.state() == RunState::Playing;
            busy = self.recorder.work(SLICE);
            self.clock.working += started.elapsed();
            let done = (was_working || received) && !busy && self.recorder.state() != RunState::Playing;
            // What a command has looked up is shown at once, unless making frames takes longer than commands come.
            self.is_unseen |= received;
            let is_looked_up = self.is_unseen && self.clock.last_frame.elapsed() >= self.clock.publishing;
            // While it only looks for what an event cancelled, there is nothing new to see.
            let is_new = !(self.recorder.is_searching() && self.is_settled_seen);
            if done || is_looked_up || ((busy || was_working) && is_new && self.frame_is_due()) {
                self.publish();
            }
        }
    }

    /// Waits for a command when there is nothing to do, and only then.
    fn receive(&self, busy: bool) -> Received {
        if busy {
            return match self.commands.try_recv() {
                Ok(command) => Received::Command(command),
                Err(TryRecvError::Empty) => Received::Nothing,
                Err(TryRecvError::Disconnected) => Received::Closed,
            };
        }
        if self.recorder.state() == RunState::Playing {
            return match self.commands.recv_timeout(Duration::from_millis(2)) {
                Ok(command) => Received::Command(command),
                Err(RecvTimeoutError::Timeout) => Received::Nothing,
                Err(RecvTimeoutError::Disconnected) => Received::Closed,
            };
        }
        self.commands.recv().map_or(Received::Closed, Received::Command)
    }

    /// In large scenes a frame takes longer than a frame's time: at most half of the time goes to them, and less while the last
    /// one still waits to be looked at.
    fn frame_is_due(&self) -> bool {
        let is_seen = self.shared.is_seen.load(Ordering::Relaxed);
        let parts = if is_seen { 1 } else { UNSEEN_SHARE - 1 };
        self.clock.last_frame.elapsed() >= FRAME_TIME.max(parts * self.clock.publishing)
    }

    fn publish(&mut self) {
        let started = Instant::now();
        self.measure();
        self.revision += 1;
        let frame = Arc::new(frame_of(&mut self.recorder, self.revision, self.command, self.clock.pace));
        self.is_settled_seen = frame.is_settled;
        self.shared.set(frame);
        self.is_unseen = false;
        self.clock.last_frame = Instant::now();
        self.clock.publishing = self.clock.last_frame - started;
        (self.on_frame)();
    }

    fn measure(&mut self) {
        let now = Instant::now();
        let (start, events, steps) = self.clock.since;
        let playing = self.recorder.state() == RunState::Playing;
        let wall = (now - start).as_secs_f64();
        if playing && now - start < PACE_TIME {
            return;
        }
        let (played, lost) = self.recorder.take_pace();
        let Some(run) = &self.recorder.run else { return };
        let (new_events, new_steps) = (run.at.event, run.grid.index());
        let worked = self.clock.working.as_secs_f64();
        let stepped = new_steps.saturating_sub(steps);
        if stepped > 0 {
            self.clock.pace.step_wall_s = worked / stepped as f64;
        }
        let gained = new_events.saturating_sub(events) as f64;
        self.clock.pace.events_per_s = if worked > 0.0 { gained / worked } else { 0.0 };
        self.clock.pace.real_speed = if playing { played / wall } else { 0.0 };
        let measured = Measured { before: self.clock.counters, gained: played, lost, events: gained };
        self.clock.pace.lag = if playing { lag_of(run, &measured) } else { None };
        self.clock.counters = run.simulation.counters();
        self.clock.since = (now, new_events, new_steps);
        self.clock.working = Duration::ZERO;
    }
}

enum Received {
    Command(RunCommand),
    Nothing,
    Closed,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Document;

    // Symptom: the speed of a recorded stretch that was played was given as 0, and once as that of the simulation, which stood
    // elsewhere; and nothing was said to be stepped too slowly. Expected: what is shown counts, in both directions.
    #[test]
    fn the_speed_of_playing_is_that_of_what_is_shown() {
        let (_, commands) = channel();
        let mut worker = Worker::new(commands, Arc::default(), Box::new(|| {}));
        let bytes = include_bytes!("../../scenes/bounce.xml");
        let scene = Document::from_bytes(bytes).scene_shared().expect("a scene");
        let dt = 1.0 / 64.0;
        let playing = |worker: &mut Worker, from: f64, speed: f64, wall_s: f64| {
            worker.recorder.command(RunCommand::Seek { dt, time: from });
            worker.recorder.command(RunCommand::Play { dt, speed, range: None });
            for _ in 0..10 {
                worker.recorder.work(1000);
                worker.recorder.elapse(0.1 * wall_s);
            }
            worker.recorder.work(1000);
            let since = Instant::now().checked_sub(PACE_TIME * 2).expect("the clock runs for a second");
            worker.clock.since.0 = since;
            worker.measure();
            (worker.clock.pace.real_speed, worker.clock.pace.lag)
        };
        worker.recorder.command(RunCommand::Load(scene));
        worker.recorder.command(RunCommand::Step { dt, count: 256 });
        worker.recorder.work(100_000);
        for (from, speed) in [(0.5, 1.0), (3.5, -1.0)] {
            let (real_speed, lag) = playing(&mut worker, from, speed, 1.0);
            assert!((real_speed - 1.0).abs() < 0.1, "{real_speed} where 1 second was played in one");
            assert_eq!(lag, None);
        }
        let (real_speed, lag) = playing(&mut worker, 0.5, 1.0, 3.0);
        assert!(real_speed < 2.0 && lag.is_none(), "{real_speed}, {lag:?}: nothing was simulated");
    }

    // Symptom: while a gas of 10 000 ran in a window that drew three times a second, half of the simulation's time went to frames that
    // nobody saw. Expected: a twentieth. Cause: frames were made at a fixed pace.
    #[test]
    fn frames_that_nobody_looks_at_are_made_less_often() {
        let shared = Arc::<Published>::default();
        let (_, commands) = channel();
        let mut worker = Worker::new(commands, shared.clone(), Box::new(|| {}));
        let due = |worker: &mut Worker, since: Duration| {
            let last_frame = Instant::now().checked_sub(since);
            last_frame.is_some_and(|last_frame| {
                worker.clock.last_frame = last_frame;
                worker.frame_is_due()
            })
        };
        worker.clock.publishing = FRAME_TIME;
        shared.set(Arc::default());
        assert!(!due(&mut worker, 2 * FRAME_TIME) && due(&mut worker, 19 * FRAME_TIME));
        shared.get();
        assert!(due(&mut worker, 2 * FRAME_TIME));
    }
}
