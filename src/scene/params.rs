//! Every tolerance and limit of the simulation, with its unit, default, reason and effect.
//! [`PARAMS`] is the one table that drives the `Solver` element, the inspector and the help.

/// Authored settings of the core. A file stores only those that differ from the default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimParams {
    pub field_tolerance: f64,
    pub rest_height: f64,
    pub rest_time: f64,
    pub collapse_share: f64,
    pub contact_distance: f64,
    pub core_radius: f64,
    pub static_tile_limit: f64,
    pub dense_step: f64,
    pub stick_speed: f64,
}

impl Default for SimParams {
    fn default() -> Self {
        Self {
            field_tolerance: 1e-8,
            rest_height: 1e-11,
            rest_time: 0.03,
            collapse_share: 1e-6,
            contact_distance: 2e-9,
            core_radius: 1e-6,
            static_tile_limit: 4096.0,
            dense_step: 0.0,
            stick_speed: 0.0,
        }
    }
}

/// So much of the smaller radius bodies of a heap may overlap by for good: the core keeps below it, and what it wrote as the
/// end of a run is a fine start.
pub const HEAP_OVERLAP: f64 = 1e-3;

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
        name: "RestHeight",
        label: "Rest height",
        unit: "radii",
        range: (0.0, 0.1),
        help: "A pressed, inelastic body whose next bounce would be lower than this share of its radius may \
               come to rest at the limit time of its remaining bounces: from 1e-5 m/s on for a radius of \
               half a metre on Earth. At 0 it bounces until that is below the rounding of its position.",
        get: |p| p.rest_height,
        set: |p, v| p.rest_height = v,
    },
    ParamInfo {
        name: "RestTime",
        label: "Rest time",
        unit: "fall times",
        range: (0.0, 10.0),
        help: "Longest sum of remaining flights 2v/(g(1−e)) that is skipped when a body comes to rest, as a \
               share of the time √(2r/g) in which it would fall by its radius. The forces count as constant \
               over that time; the rest event comes at its end. Keeps a nearly elastic body bouncing until \
               the sum is short.",
        get: |p| p.rest_time,
        set: |p, v| p.rest_time = v,
    },
    ParamInfo {
        name: "CollapseShare",
        label: "Collapse share",
        unit: "",
        range: (1e-12, 0.1),
        help: "Two bodies that lose energy in impacts and meet slower than this share of the speed at which \
               they met others shortly before are in an inelastic collapse: what follows is taken as plastic \
               (restitution 0), so that it stays finite. The energy left then is the square of this share. \
               Smaller follows a collapse further and takes longer.",
        get: |p| p.collapse_share,
        set: |p, v| p.collapse_share = v,
    },
    ParamInfo {
        name: "ContactDistance",
        label: "Contact distance",
        unit: "radii",
        range: (1e-12, 1e-2),
        help: "Bodies nearer than this share of the smaller radius at an impact touch: they are resolved as \
               one group. Overlaps at the start are reported above it. Above rounding at map sizes up to \
               1e5 m.",
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
               is captured, and within a hundred times this, or a tenth of its own radius, if air or other bodies \
               take its energy. \
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
    ParamInfo {
        name: "DenseStep",
        label: "Dense step",
        unit: "s",
        range: (0.0, 1.0),
        help: "Length of the steps in which bodies go on that touch too often for events. At 0 it is the \
               largest power of two of at most √(2e-4 r/g), for the smallest radius and the strongest \
               acceleration: about a millisecond for balls of five centimetres on Earth. Impacts among such \
               bodies are off by as much; smaller is more exact and slower.",
        get: |p| p.dense_step,
        set: |p, v| p.dense_step = v,
    },
    ParamInfo {
        name: "StickSpeed",
        label: "Stick speed",
        unit: "m/s",
        range: (0.0, 1e3),
        help: "Closing speed v_s up to which bodies do not rebound, as wet or sticky ones: the restitution \
               becomes e·max(0, 1 − v_s/v). At 0 it does not depend on the speed, as for dry bodies.",
        get: |p| p.stick_speed,
        set: |p, v| p.stick_speed = v,
    },
];
