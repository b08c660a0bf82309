//! Ctrl-C ends a run between two predictions, so that files end with a whole line; twice ends it at once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static INTERRUPT: Interrupt = Interrupt { raised: AtomicBool::new(false), heard: AtomicBool::new(false) };

/// Nobody who asks a program to end waits longer than this for the next look.
const PATIENCE: Duration = Duration::from_secs(2);

/// Whether somebody has asked the program to end.
#[derive(Debug)]
pub struct Interrupt {
    raised: AtomicBool,
    /// What was heard is seen to: the program ends by itself, however long its outputs take to write.
    heard: AtomicBool,
}

impl Interrupt {
    /// Whether to end now. Who is told so ends the program as it should be: nobody else will.
    pub fn is_raised(&self) -> bool {
        let is_raised = self.raised.load(Ordering::Relaxed);
        if is_raised {
            self.heard.store(true, Ordering::Relaxed);
        }
        is_raised
    }

    /// For work that looks at a flag; who is back from it asks [`Self::is_raised`].
    pub fn flag(&self) -> &AtomicBool {
        &self.raised
    }
}

/// What Ctrl-C (or a request to terminate) raises from now on.
pub fn on_interrupt() -> &'static Interrupt {
    // Without a handler Ctrl-C simply ends the program, which is no reason not to run.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPT.raised.swap(true, Ordering::Relaxed) {
            give_up();
        }
        std::thread::spawn(|| {
            std::thread::sleep(PATIENCE);
            if !INTERRUPT.heard.load(Ordering::Relaxed) {
                give_up();
            }
        });
    });
    &INTERRUPT
}

#[allow(clippy::exit, reason = "the run has not looked in time, or was asked twice")]
fn give_up() -> ! {
    std::process::exit(130)
}
