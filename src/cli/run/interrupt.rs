//! Ctrl-C ends a run between two events, so that files end with a whole line; twice ends it at once.

use std::sync::atomic::{AtomicBool, Ordering};

static STOP: AtomicBool = AtomicBool::new(false);

/// The flag that Ctrl-C (or a request to terminate) raises from now on.
pub fn on_interrupt() -> &'static AtomicBool {
    #[allow(clippy::exit, reason = "whoever asks twice does not want to wait for the next event")]
    let stop = || {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    };
    // Without a handler Ctrl-C simply ends the program, which is no reason not to run.
    let _ = ctrlc::set_handler(stop);
    &STOP
}
