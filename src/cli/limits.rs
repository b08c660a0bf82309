//! `--max-events` and `--max-wall`: how much a verb may cost.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::Args;

use super::number;
use crate::record::Limits;

/// When to stop early, which ends with exit code 4.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct LimitArgs {
    /// Stop right after this many events, with exit code 4
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub max_events: Option<u64>,

    /// Stop after this wall time in seconds, with exit code 4
    #[arg(long, value_name = "SECONDS", value_parser = number::seconds, allow_negative_numbers = true)]
    pub max_wall: Option<f64>,
}

/// Ends the program when it is stuck inside one call long after its wall time, where no look at the clock comes
/// any more. Dropped, it lets the program be.
pub struct Watchdog(Arc<AtomicBool>);

/// Added to the wall time: a look at all overlaps of a large scene, or the writing of its last state, is no
/// reason to end the program.
const PATIENCE: Duration = Duration::from_secs(5);

impl Watchdog {
    fn after(wall: Duration) -> Self {
        let done = Arc::new(AtomicBool::new(false));
        let seen = done.clone();
        std::thread::spawn(move || {
            std::thread::sleep(wall + PATIENCE.max(wall));
            if !seen.load(Ordering::Relaxed) {
                give_up(wall);
            }
        });
        Self(done)
    }
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[allow(clippy::exit, reason = "the run has not looked at the clock in time")]
fn give_up(wall: Duration) -> ! {
    let wall = wall.as_secs_f64();
    super::say(format!("stopped early: its {wall} s of wall time are long over and one step does not end"));
    std::process::exit(4)
}

impl LimitArgs {
    /// To be held until the work is done.
    pub fn watchdog(&self) -> Option<Watchdog> {
        self.wall().map(Watchdog::after)
    }

    pub fn limits(&self) -> Limits {
        Limits { events: self.max_events, wall: self.wall() }
    }

    pub fn wall(&self) -> Option<Duration> {
        self.max_wall.map(Duration::from_secs_f64)
    }
}
