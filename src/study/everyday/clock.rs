//! Processor time of this thread: on a busy machine the wall clock runs on while the thread waits.

use std::time::{Duration, Instant};

/// A stopwatch of processor time where the system tells it (Linux), of wall time elsewhere.
pub(super) struct Clock {
    started: Instant,
    processor: Option<Duration>,
}

impl Clock {
    pub(super) fn start() -> Self {
        Self { started: Instant::now(), processor: processor_time() }
    }

    pub(super) fn elapsed(&self) -> Duration {
        match (self.processor, processor_time()) {
            (Some(from), Some(to)) => to.saturating_sub(from),
            _ => self.started.elapsed(),
        }
    }

    /// Whether `limit` is over. Costs a look at the wall clock only, as long as that has not got there.
    pub(super) fn is_over(&self, limit: Duration) -> bool {
        self.started.elapsed() >= limit && self.elapsed() >= limit
    }
}

/// The first of the numbers is the time on the processor in ns (Linux, `Documentation/scheduler/sched-stats`).
fn processor_time() -> Option<Duration> {
    let line = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    line.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}
