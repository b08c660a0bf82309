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
    /// Set by every command that moves the time, cleared by those that go to the start: a frame alone
    /// cannot tell, it may be older than the last command.
    moved: bool,
    /// Frame revision at which a command backwards was sent, the last one to move the time.
    back_since: Option<u64>,
}

impl Default for Playback {
    fn default() -> Self {
        Self {
            dt: 1.0 / 60.0,
            dt_text: "1/60".to_owned(),
            speed: 1.0,
            method: Method::Exact,
            moved: false,
            back_since: None,
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
        !self.moved
    }

    pub(super) fn went_on(&mut self) {
        self.moved = true;
        self.back_since = None;
    }

    pub(super) fn went_back(&mut self, frame: &Frame) {
        self.back_since = Some(frame.revision);
    }

    pub(super) fn went_to_start(&mut self) {
        self.moved = false;
        self.back_since = None;
    }

    /// Looks whether a command backwards has arrived at the start.
    pub(super) fn look_at(&mut self, frame: &Frame) {
        let Some(since) = self.back_since else { return };
        let stands_at_zero = frame.dt_index == 0 && frame.open_step.is_none() && frame.event_count == 0;
        if frame.revision > since && frame.state == RunState::Paused && stands_at_zero {
            self.went_to_start();
        }
    }
}
