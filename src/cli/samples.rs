//! The times at which a run is sampled.

/// Rows are numbered and times are products, so nothing breaks down before; but nobody waits for more.
const MAX_STEPS: f64 = 1e9;

/// A last Δt shorter than this share of Δt is rounding (60 s in steps of 1/60 s) and joins the one before.
const SLIVER: f64 = 1e-6;

/// Sample k is at k·Δt by product, the last exactly at the end asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleGrid {
    /// s; `None` looks at the start and at the end only.
    pub dt: Option<f64>,
    pub until: f64,
    /// How many Δt, at least 1. The last may be shorter.
    pub steps: u64,
}

impl SampleGrid {
    /// Both in seconds, finite and > 0. The error is for the person who typed them.
    pub fn new(dt: Option<f64>, until: f64) -> Result<Self, String> {
        let Some(dt) = dt else { return Ok(Self { dt: None, until, steps: 1 }) };
        if dt > until {
            return Err(format!(
                "--dt {dt:?} is longer than --until {until:?}: there would be no whole step"
            ));
        }
        let count = until / dt;
        if count > MAX_STEPS {
            return Err(format!(
                "--until {until:?} in steps of --dt {dt:?} makes {count:.2e} steps, more than {MAX_STEPS:.0e}: \
                 make --dt larger (results of the method exact do not depend on it)"
            ));
        }
        let whole = count.floor();
        let steps = if count - whole > SLIVER { whole + 1.0 } else { whole };
        Ok(Self { dt: Some(dt), until, steps: steps as u64 })
    }

    /// Model time of sample `k`, s.
    pub fn time(&self, k: u64) -> f64 {
        if k >= self.steps { self.until } else { k as f64 * self.dt.unwrap_or(self.until) }
    }
}
