//! A hard case: its scene, the figures demanded of it, and how they are measured.

use super::trial::{Stop, Trial};
use crate::scene::{Document, Scene};

/// Where the scene of a case comes from.
#[derive(Clone, Copy)]
pub enum Source {
    /// A file of the repository: its path below `scenes/`, without `.xml`, and its bytes.
    File(&'static str, &'static [u8]),
    /// Built in code.
    Built(fn() -> Scene),
}

/// One figure that a case measures: smaller is better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    pub name: &'static str,
    /// Empty where dimensionless.
    pub unit: &'static str,
    /// The largest value allowed; infinite for what is reported for orientation only.
    pub limit: f64,
}

/// A scene at which methods fail, with a known outcome.
pub struct Case {
    /// Cases of one subject share a number.
    pub number: u32,
    pub id: &'static str,
    pub title: &'static str,
    /// What the figures are compared with.
    pub reference: &'static str,
    /// What other programs measure on the same case; empty where nobody measured.
    pub peers: &'static str,
    pub source: Source,
    pub demands: &'static [Demand],
    /// Segments the core may begin before it counts as stalled.
    pub budget: u64,
    /// Takes minutes in an unoptimized build.
    pub long: bool,
    pub(super) run: fn(&Trial) -> Result<Vec<f64>, Stop>,
}

/// Enough for the small scenes: counting π to five digits takes 62 833 segments.
pub(super) const SMALL_BUDGET: u64 = 150_000;

/// One measured figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    pub demand: Demand,
    /// NaN when the run did not get so far.
    pub value: f64,
}

impl Figure {
    pub fn held(&self) -> bool {
        self.value <= self.demand.limit || self.demand.limit.is_infinite()
    }
}

/// What came of a case at one Δt.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// s.
    pub dt: f64,
    /// In the order of the case's demands.
    pub figures: Vec<Figure>,
    /// Why the run ended before its end.
    pub stopped: Option<String>,
}

impl CaseResult {
    pub fn held(&self) -> bool {
        self.figures.iter().all(Figure::held)
    }
}

/// Runs a case in steps of Δt and measures its figures.
pub fn measure(case: &Case, dt: f64) -> CaseResult {
    let measured =
        scene_of(case.source).and_then(|scene| (case.run)(&Trial { scene, dt, budget: case.budget }));
    let (values, stopped) = match measured {
        Ok(values) => (values, None),
        Err(stop) => (Vec::new(), Some(stop.to_string())),
    };
    let padded = values.into_iter().chain(std::iter::repeat(f64::NAN));
    let figures = case.demands.iter().zip(padded).map(|(&demand, value)| Figure { demand, value }).collect();
    CaseResult { dt, figures, stopped }
}

pub(super) fn scene_of(source: Source) -> Result<Scene, Stop> {
    match source {
        Source::File(path, bytes) => Document::from_bytes(bytes)
            .scene()
            .cloned()
            .ok_or_else(|| Stop::Scene(format!("{path}.xml has errors"))),
        Source::Built(build) => Ok(build()),
    }
}

/// The source of a file below `scenes/`.
macro_rules! file {
    ($path:literal) => {
        $crate::study::cases::Source::File($path, include_bytes!(concat!("../../../scenes/", $path, ".xml")))
    };
}
pub(super) use file;

/// A demand on a figure, short.
pub(super) const fn at_most(limit: f64, unit: &'static str, name: &'static str) -> Demand {
    Demand { name, unit, limit }
}

/// A figure for orientation, of which nothing is demanded.
pub(super) const fn reported(unit: &'static str, name: &'static str) -> Demand {
    Demand { name, unit, limit: f64::INFINITY }
}
