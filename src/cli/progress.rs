//! The progress bar of a long simulation, on standard error when that is a terminal.

use std::io::IsTerminal as _;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Shorter runs show no bar.
const LONG: Duration = Duration::from_millis(700);

/// Between two pictures of the bar. Less than between two looks of a run at its outputs, each of which shows it.
const TICK: Duration = Duration::from_millis(50);

/// The bar counts thousandths of the run.
const PARTS: f64 = 1000.0;

pub struct Progress {
    bar: Option<ProgressBar>,
    wanted: bool,
    /// Model time at the end, s.
    until: f64,
    started: Instant,
    /// When it is to be shown next.
    next: Instant,
}

impl Progress {
    /// `is_stdout_taken`: what is written to the same terminal leaves no place for a bar.
    pub fn new(until: f64, is_stdout_taken: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let clash = is_stdout_taken && std::io::stdout().is_terminal();
        let started = Instant::now();
        Self { bar: None, wanted: terminal && !clash, until, started, next: started + LONG }
    }

    /// Called often. Gives the model time reached, s, and the events so far where they are known.
    pub fn show(&mut self, time: f64, events: Option<u64>) {
        if !self.wanted {
            return;
        }
        let now = Instant::now();
        if now < self.next {
            return;
        }
        self.next = now + TICK;
        let elapsed = self.started.elapsed().as_secs_f64();
        let part = (time / self.until).clamp(1e-9, 1.0);
        let bar = self.bar.get_or_insert_with(|| {
            let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(PARTS as u64).with_style(style).with_position((part * PARTS) as u64)
        });
        // The last second tells little about the next: the share done so far is the better guess.
        let events = events.map(|events| format!("{events} events, ")).unwrap_or_default();
        bar.set_message(format!("t = {time:.3} s, {events}about {:.0} s left", elapsed / part - elapsed));
        bar.set_position((part * PARTS) as u64);
    }

    pub fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}
