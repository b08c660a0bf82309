//! The transport's settings, and where the simulation stands as far as commands sent can tell.

use super::parse_number;
use crate::record::{Frame, RunState};
use crate::sim::Method;

/// Shortest and longest Δt a person may ask for, s. Below, a step is lost in the rounding of the time;
/// above, one step of a lively scene takes minutes.
const DT_RANGE: (f64, f64) = (1e-9, 1e4);

/// Slowest and fastest playing, in multiples of the scene's own time speed.
const SPEED_RANGE: (f64, f64) = (1.0 / 1024.0, 1024.0);

pub struct Playback {
    dt: f64,
    /// As typed, so that `1/60` stays `1/60`.
    dt_text: String,
    speed: f64,
    method: Method,
    /// Number of the last command that moved the time, and whether it leads to the start: a frame that does not know of it
    /// cannot tell.
    last: (u64, bool),
    /// What the newest frame said of that.
    is_at_start: bool,
}

impl Default for Playback {
    fn default() -> Self {
        Self {
            dt: 1.0 / 60.0,
            dt_text: "1/60".to_owned(),
            speed: 1.0,
            method: Method::Exact,
            last: (0, true),
            is_at_start: true,
        }
    }
}

impl Playback {
    /// Seconds, > 0.
    pub fn dt(&self) -> f64 {
        self.dt
    }

    pub fn dt_text(&self) -> &str {
        &self.dt_text
    }

    /// Multiplies the scene's time speed.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Takes a typed Δt: a number or a fraction, with comma or point. Says what is wrong with any other.
    pub fn set_dt(&mut self, text: &str) -> Result<(), String> {
        let dt = parse_number(text).ok_or_else(|| format!("“{text}” is not a number: try 0.01 or 1/60"))?;
        if !(DT_RANGE.0..=DT_RANGE.1).contains(&dt) {
            return Err(format!("Δt must lie between {:e} s and {:e} s", DT_RANGE.0, DT_RANGE.1));
        }
        self.dt = dt;
        self.dt_text = text.trim().to_owned();
        Ok(())
    }

    pub fn set_speed(&mut self, speed: f64) {
        if speed.is_finite() {
            self.speed = speed.clamp(SPEED_RANGE.0, SPEED_RANGE.1);
        }
    }

    /// How the simulation is stepped.
    pub fn method(&self) -> Method {
        self.method
    }

    pub(super) fn set_method(&mut self, method: Method) {
        self.method = method;
    }

    /// Whether the simulation stands at its start, so that loading an edited scene loses nothing.
    pub fn is_at_start(&self) -> bool {
        self.is_at_start
    }

    /// Notes a command that moves the time; `to_start` where it leads to the start, whatever comes of it.
    pub(super) fn sent(&mut self, command: u64, to_start: bool) {
        self.last = (command, to_start);
        self.is_at_start = to_start;
    }

    /// Takes from a frame that knows of the last command where that has led to.
    pub(super) fn look_at(&mut self, frame: &Frame) {
        let (command, to_start) = self.last;
        if frame.command < command {
            self.is_at_start = to_start;
        } else if frame.state != RunState::Empty {
            let stands = matches!(frame.state, RunState::Paused | RunState::Faulted);
            self.is_at_start = stands && frame.is_at_start();
        }
    }
}
