//! What a run is judged by: one table for the diagrams, the text table and the CSV file.

use super::RunFigures;

/// One measure of a run.
pub struct Axis {
    /// Column of the CSV file.
    pub id: &'static str,
    /// What diagrams call it.
    pub title: &'static str,
    /// Head of its column in the text table.
    pub column: &'static str,
    /// Empty where dimensionless.
    pub unit: &'static str,
    pub meaning: &'static str,
    /// Whether it has a diagram of its own, over the wall time.
    pub is_drawn: bool,
    pub get: fn(&RunFigures) -> Option<f64>,
}

/// All measures in the order of the columns.
pub const AXES: &[Axis] = &[
    Axis {
        id: "wall_s_per_s",
        title: "Wall time per simulated second",
        column: "time/s",
        unit: "s",
        meaning: "Median of the timings.",
        is_drawn: false,
        get: |point| point.wall_per_s,
    },
    Axis {
        id: "position_error_m",
        title: "Position error",
        column: "position",
        unit: "m",
        meaning: "Largest distance of any body from the reference at a sample up to the horizon.",
        is_drawn: true,
        get: |point| point.position_error,
    },
    Axis {
        id: "velocity_error_m_per_s",
        title: "Velocity error",
        column: "velocity",
        unit: "m/s",
        meaning: "Largest difference of velocity from the reference at a sample up to the horizon, not at impacts.",
        is_drawn: false,
        get: |point| point.velocity_error,
    },
    Axis {
        id: "energy_residual",
        title: "Energy residual",
        column: "energy",
        unit: "",
        meaning: "Largest change of energy at a sample that no loss accounts for, over the scene's energy.",
        is_drawn: true,
        get: |point| point.energy_residual,
    },
    Axis {
        id: "momentum_residual",
        title: "Momentum residual",
        column: "momentum",
        unit: "",
        meaning: "Largest change of momentum at a sample that no impulse accounts for, over the scene's.",
        is_drawn: true,
        get: |point| Some(point.momentum_residual),
    },
    Axis {
        id: "worst_overlap_m",
        title: "Worst overlap",
        column: "overlap",
        unit: "m",
        meaning: "Deepest overlap of any two bodies at a sample, an event or the end of a Δt.",
        is_drawn: true,
        get: |point| Some(point.worst_overlap),
    },
    Axis {
        id: "missed_or_wrong",
        title: "Missed or wrong impacts",
        column: "missed+wrong",
        unit: "",
        meaning: "Impacts of the reference that the run lacks, and impacts that only the run has, up to the \
                  horizon.",
        is_drawn: true,
        get: |point| Some((point.missed? + point.wrong?) as f64),
    },
    Axis {
        id: "follows_until_s",
        title: "Follows until, higher is better",
        column: "follows until",
        unit: "s",
        meaning: "Last sample up to which every position is within the agreement of the reference.",
        is_drawn: true,
        get: |point| point.follows_until,
    },
];
