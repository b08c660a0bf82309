//! Ctrl-C ends a run between two predictions, so that files end with a whole line; twice ends it at once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static STOP: AtomicBool = AtomicBool::new(false);

/// Nobody who asks a program to end waits longer than this for the next look.
const PATIENCE: Duration = Duration::from_secs(2);

/// The flag that Ctrl-C (or a request to terminate) raises from now on.
pub fn on_interrupt() -> &'static AtomicBool {
    // Without a handler Ctrl-C simply ends the program, which is no reason not to run.
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            give_up();
        }
        std::thread::spawn(|| {
            std::thread::sleep(PATIENCE);
            give_up();
        });
    });
    &STOP
}

#[allow(clippy::exit, reason = "the run has not looked at the flag in time")]
fn give_up() -> ! {
    std::process::exit(130)
}
