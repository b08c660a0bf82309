//! An export on a thread of its own, so that neither a large scene nor its simulation can freeze the window.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

use egui::Context;

use crate::export::{Exported, Format, When};
use crate::scene::Document;

/// An export that is going on. Dropped, it is cancelled.
pub struct ExportJob {
    cancel: Arc<AtomicBool>,
    /// Thousandths.
    done: Arc<AtomicU32>,
    outcome: Receiver<Result<Exported, String>>,
}

/// The window follows this often.
const REPAINT_EVERY: Duration = Duration::from_millis(100);

impl ExportJob {
    pub fn start(ctx: &Context, format: &'static Format, document: Document, when: When) -> Self {
        let (cancel, done) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicU32::new(0)));
        let (sender, outcome) = channel();
        let (ctx, stop, part_done) = (ctx.clone(), cancel.clone(), done.clone());
        std::thread::spawn(move || {
            let mut last = Instant::now();
            let mut go_on = |part: f64, _events: u64| {
                part_done.store((1000.0 * part) as u32, Ordering::Relaxed);
                if last.elapsed() >= REPAINT_EVERY {
                    last = Instant::now();
                    ctx.request_repaint();
                }
                !stop.load(Ordering::Relaxed)
            };
            let exported = format.export_when(&document, when, &mut go_on).map_err(|error| error.to_string());
            // the dialog may be gone by now
            let _ = sender.send(exported);
            ctx.request_repaint();
        });
        Self { cancel, done, outcome }
    }

    /// From 0 to 1.
    pub fn part(&self) -> f32 {
        self.done.load(Ordering::Relaxed) as f32 / 1000.0
    }

    /// The outcome, once it is there.
    pub fn take(&self) -> Option<Result<Exported, String>> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("the export stopped without an answer".into())),
        }
    }
}

impl Drop for ExportJob {
    fn drop(&mut self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}
