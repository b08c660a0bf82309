//! `--max-events` and `--max-wall`: how much a verb may cost.

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

impl LimitArgs {
    pub fn limits(&self) -> Limits {
        Limits { events: self.max_events, wall: self.wall() }
    }

    pub fn wall(&self) -> Option<Duration> {
        self.max_wall.map(Duration::from_secs_f64)
    }
}
