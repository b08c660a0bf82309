//! A clock that stands still while its thread waits for a processor that others use.

use std::time::Instant;

pub struct Clock {
    began: Instant,
    waited_s: f64,
}

impl Clock {
    pub fn start() -> Self {
        Self { waited_s: waited_s(), began: Instant::now() }
    }

    /// Seconds since the start in which the thread had a processor, or slept.
    pub fn elapsed(&self) -> f64 {
        let wall = self.began.elapsed().as_secs_f64();
        wall - (waited_s() - self.waited_s)
    }
}

/// How long this thread has waited for a processor so far, s; 0 where the system does not tell.
fn waited_s() -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = told.split_whitespace().nth(1).and_then(|text| text.parse::<f64>().ok());
    1e-9 * nanoseconds.unwrap_or(0.0)
}
