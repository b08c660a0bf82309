//! What a study is asked: every knob with its unit, default and reason. [`KNOBS`] is the one table that
//! the help and the panel show.

use crate::sim::Method;

/// The knobs of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudySettings {
    /// Model time up to which everything runs, s.
    pub until: f64,
    /// How to step.
    pub methods: Vec<Method>,
    /// Δt of the methods whose result depends on it, s.
    pub dts: Vec<f64>,
    /// Field tolerances of `exact`, where the scene has fields. Empty: the scene's own alone.
    pub tolerances: Vec<f64>,
    /// Steps of stepped groups of `exact` besides the scene's own, as parts of that.
    pub group_steps: Vec<f64>,
    /// Timings of each run.
    pub repeat: u32,
    /// Samples of the whole run at which it is compared.
    pub samples: u32,
    /// Position error of the reference at which comparing with it ends, m.
    pub trusted_error: f64,
    /// Position error up to which a run counts as following the reference, m.
    pub agreement: f64,
    /// Events of one pair this far apart in time, s, besides one Δt, are the same event.
    pub event_window: f64,
    /// Longest wall time for the reference, s.
    pub reference_limit: f64,
    /// Longest wall time for one run, s.
    pub run_limit: f64,
    /// Most events of one run, if there is such a limit.
    pub max_events: Option<u64>,
}

impl Default for StudySettings {
    fn default() -> Self {
        Self {
            until: 10.0,
            methods: Method::ALL.to_vec(),
            dts: [15.0, 30.0, 60.0, 120.0, 240.0, 480.0, 960.0].map(|rate: f64| 1.0 / rate).to_vec(),
            tolerances: vec![1e-3, 1e-5, 1e-7, 1e-9, 1e-11],
            group_steps: Vec::new(),
            repeat: 5,
            samples: 200,
            trusted_error: 1e-6,
            agreement: 1e-3,
            event_window: 1e-3,
            reference_limit: 30.0,
            run_limit: 20.0,
            max_events: None,
        }
    }
}

/// One row of [`KNOBS`].
pub struct Knob {
    /// Option of the command line, without the dashes.
    pub name: &'static str,
    /// What the panel calls it.
    pub label: &'static str,
    /// Empty where dimensionless.
    pub unit: &'static str,
    /// Why the default is what it is.
    pub reason: &'static str,
}

/// All knobs in the order in which they are shown.
pub const KNOBS: &[Knob] = &[
    Knob {
        name: "until",
        label: "Until",
        unit: "s",
        reason: "Model time of every run. 10 s hold some dozens of events of a scene of a few metres; longer \
                 runs of chaotic scenes are compared up to the horizon only.",
    },
    Knob {
        name: "methods",
        label: "Methods",
        unit: "",
        reason: "How to step. All of them, because the comparison is the point.",
    },
    Knob {
        name: "dt",
        label: "Δt list",
        unit: "s",
        reason: "Steps of the methods whose result depends on Δt. From 1/15 s, coarser than any screen, in \
                 halves to 1/960 s: enough to see the order of a method as a slope. exact has no such axis.",
    },
    Knob {
        name: "tolerances",
        label: "Tolerances",
        unit: "",
        reason: "Field tolerances of exact, besides the scene's own. Without point gravity, drag or forces of \
                 your own they change nothing and are left out.",
    },
    Knob {
        name: "group-steps",
        label: "Group steps",
        unit: "",
        reason: "Steps of the groups of exact besides the scene's own, as parts of it: 1/2, 1/4 shows what the \
                 step of a heap is worth. None, since most scenes step nothing; each is a run more.",
    },
    Knob {
        name: "repeat",
        label: "Repeat",
        unit: "",
        reason: "Timings of each run, taken in turn so that a busy moment hits all alike; the median counts. \
                 5 outvote two disturbed ones.",
    },
    Knob {
        name: "samples",
        label: "Samples",
        unit: "",
        reason: "Times at which a run is compared, evenly over the run. 200 are finer than the flights \
                 between most bounces and cost the reference little.",
    },
    Knob {
        name: "trusted-error",
        label: "Trusted error",
        unit: "m",
        reason: "Where the reference's own error estimate reaches this, the comparison of positions and events ends: \
                 the horizon. 1e-6 m is far below what can be seen, and far above rounding.",
    },
    Knob {
        name: "agreement",
        label: "Agreement",
        unit: "m",
        reason: "A run follows the reference as long as every position is within this. 1 mm is about what a \
                 person sees in a scene of a few metres.",
    },
    Knob {
        name: "event-window",
        label: "Event window",
        unit: "s",
        reason: "An event counts as found when one of the same two bodies comes within this (and one Δt) of \
                 it. 1e-3 s distinguishes an impact that is late from one that is missing.",
    },
    Knob {
        name: "reference-limit",
        label: "Reference limit",
        unit: "s",
        reason: "Wall time given to the reference, which looks at all pairs in small steps. After 30 s the \
                 horizon is as far as it came.",
    },
    Knob {
        name: "run-limit",
        label: "Run limit",
        unit: "s",
        reason: "Wall time given to one run, so that a tiny Δt or a pile does not hold up the study. After \
                 20 s the figures are those of the part that was run.",
    },
];

/// A knob that is out of its range.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{name} {complaint}")]
pub struct SettingsError {
    /// As in [`KNOBS`].
    pub name: &'static str,
    pub complaint: &'static str,
}

impl StudySettings {
    /// Refuses what cannot be carried out.
    pub fn check(&self) -> Result<(), SettingsError> {
        let refuse = |name, complaint| Err(SettingsError { name, complaint });
        let is_time = |time: f64| time > 0.0 && time.is_finite();
        if !is_time(self.until) || self.until > 1e9 {
            return refuse("until", "must be more than 0 and at most 1e9 seconds");
        }
        if self.methods.is_empty() {
            return refuse("methods", "must name at least one method");
        }
        if self.methods.iter().any(|method| method.depends_on_dt()) {
            if self.dts.is_empty() {
                return refuse("dt", "must hold at least one Δt for methods that depend on it");
            }
            if !self.dts.iter().all(|&dt| is_time(dt) && dt <= self.until && self.until / dt <= MOST_STEPS) {
                return refuse("dt", "must lie between until/1e9 and until");
            }
        }
        if !self.tolerances.iter().all(|tolerance| (1e-13..=1e-3).contains(tolerance)) {
            return refuse("tolerances", "must lie between 1e-13 and 1e-3");
        }
        if !self.group_steps.iter().all(|part| (MOST_PART.recip()..=MOST_PART).contains(part)) {
            return refuse("group-steps", "must lie between 1/1024 and 1024");
        }
        if !(1..=1000).contains(&self.repeat) {
            return refuse("repeat", "must lie between 1 and 1000");
        }
        if !(1..=100_000).contains(&self.samples) {
            return refuse("samples", "must lie between 1 and 100000");
        }
        let lengths = [
            ("trusted-error", self.trusted_error),
            ("agreement", self.agreement),
            ("event-window", self.event_window),
            ("reference-limit", self.reference_limit),
            ("run-limit", self.run_limit),
        ];
        match lengths.into_iter().find(|(_, value)| !is_time(*value)) {
            Some((name, _)) => refuse(name, "must be a finite number above 0"),
            None => Ok(()),
        }
    }

    /// Time between two samples, s.
    pub fn sample_dt(&self) -> f64 {
        self.until / f64::from(self.samples)
    }
}

/// Group steps of more than so many times the scene's own, or less than its inverse, are a slip of the hand.
const MOST_PART: f64 = 1024.0;

/// Steps are counted without gaps up to here, and nobody waits for more.
const MOST_STEPS: f64 = 1e9;
