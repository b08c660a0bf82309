//! Work on a thread of its own, with progress, so that nothing large can freeze who waits for it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

/// Work that is going on. Dropped, it is cancelled.
#[derive(Debug)]
pub struct Background<R> {
    cancel: Arc<AtomicBool>,
    /// Thousandths.
    done: Arc<AtomicU32>,
    outcome: Receiver<R>,
}

/// Hears how much is done, from 0 to 1; work ends soon after it answers `false`.
pub type GoOn<'a> = &'a mut dyn FnMut(f64) -> bool;

/// A thread ended without an outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lost;

/// Who waits follows this often.
const WAKE_EVERY: Duration = Duration::from_millis(100);

impl<R: Send + 'static> Background<R> {
    /// `wake` is called while it goes on and at its end.
    pub fn start(
        wake: impl Fn() + Send + 'static,
        work: impl FnOnce(GoOn<'_>) -> R + Send + 'static,
    ) -> Self {
        let (cancel, done) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicU32::new(0)));
        let (sender, outcome) = channel();
        let (stop, part_done) = (cancel.clone(), done.clone());
        std::thread::spawn(move || {
            let mut last = Instant::now();
            let made = work(&mut |part| {
                part_done.store((1000.0 * part) as u32, Ordering::Relaxed);
                if last.elapsed() >= WAKE_EVERY {
                    last = Instant::now();
                    wake();
                }
                !stop.load(Ordering::Relaxed)
            });
            // who asked may be gone by now
            let _ = sender.send(made);
            wake();
        });
        Self { cancel, done, outcome }
    }

    /// From 0 to 1.
    pub fn part(&self) -> f32 {
        self.done.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// The outcome, once it is there.
    pub fn take(&self) -> Option<Result<R, Lost>> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(Ok(outcome)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(Lost)),
        }
    }
}

impl<R> Background<R> {
    /// Gives it up; its outcome says so.
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}

impl<R> Drop for Background<R> {
    fn drop(&mut self) {
        self.cancel();
    }
}
