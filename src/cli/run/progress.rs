//! The progress bar of a long run, on standard error when that is a terminal.

use std::io::IsTerminal as _;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::sim::Simulation;

/// Shorter runs show no bar.
const LONG: Duration = Duration::from_millis(700);

/// The bar counts thousandths of the run.
const PARTS: f64 = 1000.0;

pub struct Progress {
    bar: Option<ProgressBar>,
    wanted: bool,
    until: f64,
    started: Instant,
}

impl Progress {
    /// `rows_on_stdout`: rows on the same terminal leave no place for a bar.
    pub fn new(until: f64, rows_on_stdout: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let clash = rows_on_stdout && std::io::stdout().is_terminal();
        Self { bar: None, wanted: terminal && !clash, until, started: Instant::now() }
    }

    pub fn show(&mut self, sim: &Simulation) {
        if !self.wanted || self.started.elapsed() < LONG {
            return;
        }
        let elapsed = self.started.elapsed().as_secs_f64();
        let part = (sim.time() / self.until).clamp(1e-9, 1.0);
        let bar = self.bar.get_or_insert_with(|| {
            let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(PARTS as u64).with_style(style).with_position((part * PARTS) as u64)
        });
        // The last second tells little about the next: the share done so far is the better guess.
        bar.set_message(format!(
            "t = {:.3} s, {} events, about {:.0} s left",
            sim.time(),
            sim.counters().total_events(),
            elapsed / part - elapsed
        ));
        bar.set_position((part * PARTS) as u64);
    }

    pub fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}
