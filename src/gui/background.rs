//! Work in the background that the window follows and whose failure it can say.

use egui::Context;

pub use crate::editor::GoOn;
use crate::editor::{Background as Work, Lost};

/// Work that is going on. Dropped, it is cancelled.
pub struct Background<T>(Work<Result<T, String>>);

impl<T: Send + 'static> Background<T> {
    pub fn start(ctx: &Context, work: impl FnOnce(GoOn<'_>) -> Result<T, String> + Send + 'static) -> Self {
        let ctx = ctx.clone();
        Self(Work::start(move || ctx.request_repaint(), work))
    }

    /// From 0 to 1.
    pub fn part(&self) -> f32 {
        self.0.part()
    }

    /// The outcome, once it is there.
    pub fn take(&self) -> Option<Result<T, String>> {
        let outcome = self.0.take()?;
        Some(outcome.unwrap_or_else(|Lost| Err("it stopped without an answer".into())))
    }
}
