//! A study on a thread of its own, so that no scene can freeze the window.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use egui::Context;

use crate::scene::Scene;
use crate::study::{self, Control, StudyProgress, StudyReport, StudySettings};

/// A study that is going on. Dropped, it is cancelled.
pub struct Job {
    shared: Arc<Shared>,
    thread: JoinHandle<()>,
}

struct Shared {
    cancel: AtomicBool,
    progress: Mutex<StudyProgress>,
    outcome: Mutex<Option<Result<StudyReport, String>>>,
}

/// The window follows this often; more would only cost the study time.
const REPAINT_EVERY: Duration = Duration::from_millis(100);

impl Job {
    /// Starts; the window is repainted when there is something new.
    pub fn start(ctx: &Context, scene: Arc<Scene>, name: String, settings: StudySettings) -> Self {
        let shared = Arc::new(Shared {
            cancel: AtomicBool::new(false),
            progress: Mutex::new(StudyProgress { part: 0.0, what: "starting".into() }),
            outcome: Mutex::new(None),
        });
        let (ctx, own) = (ctx.clone(), shared.clone());
        let thread = std::thread::spawn(move || {
            let mut last = Instant::now();
            let mut report = |progress: &StudyProgress| {
                lock(&own.progress).clone_from(progress);
                if last.elapsed() >= REPAINT_EVERY {
                    last = Instant::now();
                    ctx.request_repaint();
                }
            };
            let mut control = Control::new(&own.cancel, &mut report);
            let outcome = study::run(&scene, &name, &settings, &mut control);
            *lock(&own.outcome) = Some(outcome.map_err(|error| error.to_string()));
            ctx.request_repaint();
        });
        Self { shared, thread }
    }

    pub fn progress(&self) -> StudyProgress {
        lock(&self.shared.progress).clone()
    }

    /// Ends the study soon; what is done so far is its outcome.
    pub fn cancel(&self) {
        self.shared.cancel.store(true, Ordering::Relaxed);
    }

    pub fn is_cancelled(&self) -> bool {
        self.shared.cancel.load(Ordering::Relaxed)
    }

    /// The outcome, once it is there.
    pub fn take(&self) -> Option<Result<StudyReport, String>> {
        // asked first: a thread that has ended has left its outcome
        let ended = self.thread.is_finished();
        let outcome = lock(&self.shared.outcome).take();
        outcome.or_else(|| ended.then(|| Err("the study stopped without an answer".into())))
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.cancel();
    }
}

/// What a thread left behind is whole even if it panicked: every change is one assignment.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
