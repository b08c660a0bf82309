//! How accurate a simulation is and what that costs: references, residuals, work-precision runs.

// The hard cases with their known answers.
pub mod cases;
pub mod closed_form;
// Everyday scenes in families, and what is demanded of all of them.
pub mod everyday;

// What a study is asked, and what it answers.
mod axes;
mod report;
mod settings;

// How it is carried out.
mod candidate;
mod control;
mod hits;
mod measure;
mod overlap;
pub mod reference;
mod run;
mod timing;
mod truth;

// How it is shown.
mod chart;
mod csv;
mod scale;
mod table;
mod text;

pub use crate::random::Random;
pub use axes::{AXES, Axis};
pub use candidate::{Candidate, Marker, look_of};
pub use chart::{ChartError, svg};
pub use control::{Control, StudyProgress};
pub use csv::csv;
pub use hits::{Differences, Onto, PairImpact, compare};
pub use measure::{Limits, measure};
pub use overlap::OverlapMonitor;
pub use report::{Horizon, HorizonCause, RunFigures, Stop, StudyReport};
pub use run::{StudyError, run};
pub use scale::{CurvePoint, Scale, series_of};
pub use settings::{KNOBS, Knob, SettingsError, StudySettings};
pub use table::{Head, row_cells, row_heads, table};
pub use text::{seconds, short};
pub use truth::{Truth, TruthSample};
