//! Work on a thread of its own, with progress, so that nothing large can freeze the window.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use egui::Context;

/// Work that is going on. Dropped, it is cancelled.
pub struct Background<T> {
    cancel: Arc<AtomicBool>,
    /// Thousandths.
    done: Arc<AtomicU32>,
    outcome: Receiver<Result<T, String>>,
}

/// Hears how much is done, from 0 to 1; work ends soon after it answers `false`.
pub type GoOn<'a> = &'a mut dyn FnMut(f64) -> bool;

/// The window follows this often.
const REPAINT_EVERY: Duration = Duration::from_millis(100);

impl<T: Send + 'static> Background<T> {
    pub fn start(ctx: &Context, work: impl FnOnce(GoOn<'_>) -> Result<T, String> + Send + 'static) -> Self {
        let (cancel, done) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicU32::new(0)));
        let (sender, outcome) = channel();
        let (ctx, stop, part_done) = (ctx.clone(), cancel.clone(), done.clone());
        std::thread::spawn(move || {
            let mut last = Instant::now();
            let made = work(&mut |part| {
                part_done.store((1000.0 * part) as u32, Ordering::Relaxed);
                if last.elapsed() >= REPAINT_EVERY {
                    last = Instant::now();
                    ctx.request_repaint();
                }
                !stop.load(Ordering::Relaxed)
            });
            // who asked may be gone by now
            let _ = sender.send(made);
            ctx.request_repaint();
        });
        Self { cancel, done, outcome }
    }

    /// From 0 to 1.
    pub fn part(&self) -> f32 {
        self.done.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// The outcome, once it is there.
    pub fn take(&self) -> Option<Result<T, String>> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("it stopped without an answer".into())),
        }
    }
}

impl<T> Drop for Background<T> {
    fn drop(&mut self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}
