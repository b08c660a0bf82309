//! The grid of Δt: where they begin and end.

/// Where the Δt begin and end: tick k at origin + k·Δt, by product, so that no error adds up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StepGrid {
    origin: f64,
    dt: f64,
    ticks: u64,
    /// Number of Δt before `origin`.
    before: u64,
    /// Start and end of the Δt that is open.
    pub(super) open: Option<(f64, f64)>,
}

impl StepGrid {
    pub(super) fn new() -> Self {
        Self { origin: 0.0, dt: 0.0, ticks: 0, before: 0, open: None }
    }

    /// Number of the Δt being looked at.
    pub(super) fn index(&self) -> u64 {
        self.before + self.ticks + u64::from(self.open.is_some())
    }

    /// Where Δt of this length begin to be counted, and the length, s.
    pub(super) fn stretch(&self) -> (f64, f64) {
        (self.origin, self.dt)
    }

    /// How many Δt have ended since they begin to be counted.
    pub(super) fn number(&self) -> u64 {
        self.ticks
    }

    /// Start and end of the Δt being looked at; `None` before the first.
    pub(super) fn span(&self) -> Option<(f64, f64)> {
        let at = |ticks: u64| self.origin + ticks as f64 * self.dt;
        self.open.or_else(|| self.ticks.checked_sub(1).map(|before| (at(before), at(self.ticks))))
    }

    /// The grid as it stood before its last Δt was closed, with that one open from `start` to `end`.
    pub(super) fn reopened(self, start: f64, end: f64) -> Self {
        Self { ticks: self.ticks.saturating_sub(1), open: Some((start, end)), ..self }
    }

    /// Opens the next Δt at `now`; another Δt than before starts the grid anew there.
    pub(super) fn open(&mut self, now: f64, dt: f64) {
        let expected = self.origin + self.ticks as f64 * self.dt;
        if dt != self.dt || now != expected {
            *self = Self { origin: now, dt, ticks: 0, before: self.before + self.ticks, open: None };
        }
        self.open = Some((now, self.origin + (self.ticks + 1) as f64 * self.dt));
    }

    pub(super) fn close(&mut self) {
        self.open = None;
        self.ticks += 1;
    }
}
