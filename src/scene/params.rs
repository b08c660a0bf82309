//! Every tolerance and limit of the simulation, with its unit, default, reason and effect.
//! [`PARAMS`] is the one table that drives the `Solver` element, the inspector and the help.

/// Authored settings of the core. A file stores only those that differ from the default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimParams {
    pub field_tolerance: f64,
    pub rest_speed: f64,
    pub rest_time: f64,
    pub contact_duration: f64,
    pub collapse_count: f64,
    pub contact_distance: f64,
    pub core_radius: f64,
    pub static_tile_limit: f64,
}

impl Default for SimParams {
    fn default() -> Self {
        Self {
            field_tolerance: 1e-8,
            rest_speed: 1e-5,
            rest_time: 1e-2,
            contact_duration: 4e-5,
            collapse_count: 32.0,
            contact_distance: 1e-9,
            core_radius: 1e-6,
            static_tile_limit: 4096.0,
        }
    }
}

/// One row of [`PARAMS`].
pub struct ParamInfo {
    /// Attribute of the `Solver` element.
    pub name: &'static str,
    /// What the inspector calls it.
    pub label: &'static str,
    /// Empty where dimensionless.
    pub unit: &'static str,
    /// Smallest and largest value accepted.
    pub range: (f64, f64),
    /// Why the default is what it is, and what breaks when it changes.
    pub help: &'static str,
    pub get: fn(&SimParams) -> f64,
    pub set: fn(&mut SimParams, f64),
}

/// All parameters, in the order in which they are shown and written.
pub const PARAMS: &[ParamInfo] = &[
    ParamInfo {
        name: "FieldTolerance",
        label: "Field tolerance",
        unit: "",
        range: (1e-13, 1e-3),
        help: "Size of the last term of the integrator's acceleration series over the acceleration \
               itself, in one step of a body in a point gravity, drag or custom field. At 1e-8 the \
               series is exact to rounding inside the step; larger is quicker and less exact.",
        get: |p| p.field_tolerance,
        set: |p, v| p.field_tolerance = v,
    },
    ParamInfo {
        name: "RestSpeed",
        label: "Rest speed",
        unit: "m/s",
        range: (0.0, 1.0),
        help: "A pressed, inelastic body whose normal speed after an impact is below this may come to \
               rest at the limit time of its remaining bounces. The bounce left out is at most v²/2g \
               high: 5e-12 m at the default on Earth. At 0 such a body bounces until that \
               is below the rounding of its position.",
        get: |p| p.rest_speed,
        set: |p, v| p.rest_speed = v,
    },
    ParamInfo {
        name: "RestTime",
        label: "Rest time",
        unit: "s",
        range: (0.0, 1.0),
        help: "Longest sum of remaining flights 2v/(g(1−e)) that is skipped when a body comes to rest. \
               The forces count as constant over that time; the rest event comes at its end. Keeps a nearly \
               elastic body bouncing until the sum is short.",
        get: |p| p.rest_time,
        set: |p, v| p.rest_time = v,
    },
    ParamInfo {
        name: "ContactDuration",
        label: "Contact duration",
        unit: "s",
        range: (1e-9, 1.0),
        help: "Impacts of one body that follow each other within this time count as one cascade; see \
               Collapse count. Smaller follows a collapse further and takes longer. Impacts \
               within a thousandth of it are of one instant.",
        get: |p| p.contact_duration,
        set: |p, v| p.contact_duration = v,
    },
    ParamInfo {
        name: "CollapseCount",
        label: "Collapse count",
        unit: "",
        range: (1.0, 1e6),
        help: "Impacts of one cascade that lose energy before the rest of it is taken as plastic \
               (restitution 0), so that an inelastic collapse stays finite. Above the length of chains of \
               touching balls, so that those keep their restitution.",
        get: |p| p.collapse_count,
        set: |p, v| p.collapse_count = v.round(),
    },
    ParamInfo {
        name: "ContactDistance",
        label: "Contact distance",
        unit: "m",
        range: (1e-12, 1e-3),
        help: "Bodies nearer than this at an impact touch: they are resolved as one group. Overlaps at the \
               start are reported above it. Above rounding at map sizes up to 1e5 m.",
        get: |p| p.contact_distance,
        set: |p, v| p.contact_distance = v,
    },
    ParamInfo {
        name: "CoreRadius",
        label: "Core radius",
        unit: "m",
        range: (1e-9, 1.0),
        help: "A body whose centre comes this near to a point attractor is turned back on its line with \
               its energy kept, the limit of ever thinner ellipses. One whose orbit stays within twice this \
               is captured, and within a hundred times this if air or other bodies take its energy. \
               Smaller needs more steps near the centre and loses digits to the potential's depth.",
        get: |p| p.core_radius,
        set: |p, v| p.core_radius = v,
    },
    ParamInfo {
        name: "StaticTileLimit",
        label: "Tiles per static",
        unit: "",
        range: (1.0, 1e6),
        help: "A static body that lies in more tiles than this is kept in one list that every moving body \
               looks through, so that a huge plate does not fill the memory. Changes speed only.",
        get: |p| p.static_tile_limit,
        set: |p, v| p.static_tile_limit = v.round(),
    },
];
