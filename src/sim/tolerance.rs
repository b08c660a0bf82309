//! The thresholds of the core that no scene sets: bounds on rounding, and where a search or an iteration gives up.
//! Those that a scene can set are in [`crate::scene::PARAMS`]; those of the integrators are in `motion`, those of
//! the methods that step by Δt in `stepping`.
//!
//! Each says what it is a part of, why it has its value, and what breaks where it is smaller or larger.

// Geometry.

/// Surfaces at rest against each other to within this part of the coordinates count as touching: a few roundings.
/// Smaller, a body that rests falls through its support by a rounding and hits it again; larger, real gaps close.
pub(super) const TOUCH: f64 = 8.0 * f64::EPSILON;

/// Speeds below this part of the speeds that they are the difference of are rounding. Smaller, a body that glides
/// along a surface seems to hit or leave it now and then; larger, slow approaches are missed.
pub(super) const STILL: f64 = 16.0 * f64::EPSILON;

/// Accelerations below this part of the accelerations that they are the difference of neither press nor part.
/// Smaller, contacts end by rounding; larger, bodies that are driven apart gently stay together.
pub(super) const PRESSURE_ROUNDING: f64 = 1e-12;

/// Spheres whose distance exceeds the sum of their radii by less than this part are not told to miss each other by
/// the quick test: it would be decided by rounding.
pub(super) const SURELY_APART: f64 = 1e-9;

// Search for the time of impact.

/// Steps of conservative advancement before the time reached is handed back, to be looked at again from there.
/// Fewer cost more looks, more let one search last.
pub(super) const MOST_ADVANCES: u32 = 400;

/// A found contact may be off by so many times [`TOUCH`]: what is farther apart was a search that gave up.
/// Smaller, true contacts are looked for again and again; larger, an unfinished search counts as an impact.
pub(super) const FOUND: f64 = 1e3;

/// The time of a contact is known to this part of itself, in which the surfaces come nearer still.
pub(super) const TIME_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A search that led to nothing goes on this much later, s, or [`LATER_ROUNDING`] of the time: the same time would
/// give the same answer. Smaller costs more tries, larger may pass a contact.
pub(super) const LATER: f64 = 1e-9;

/// As [`LATER`], as a part of the time.
pub(super) const LATER_ROUNDING: f64 = 4.0 * f64::EPSILON;

// Tiles.

/// The box of a body in the tiles is larger than the body by this part of the radius: more than a time of impact
/// can be off. Smaller, a neighbour may be overlooked; larger costs more looks.
pub(super) const BOX_MARGIN: f64 = 1e-6;

/// The same, as a part of the coordinates and of the size of a tile.
pub(super) const BOX_ROUNDING: f64 = 1e-12;

// Impact groups.

/// Impacts farther apart than this part of the contact duration are not of one instant, however slow. Smaller,
/// symmetric blows are taken one after the other; larger, blows that come in turn are taken as one.
pub(super) const SAME_INSTANT: f64 = 1e-3;

/// A contact of a group closes if it does so by more than this part of its bodies' speeds.
pub(super) const CLOSING_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Closing speeds below this part of the largest at the start are taken plastically: a 1e-24th of the energy.
/// Smaller, rounds go on about nothing; larger, real bounces are lost.
pub(super) const SMALLEST_SHARE: f64 = 1e-12;

/// What a plastic impact may leave of the largest closing speed before bodies seize: its rounding is far below.
/// Smaller, bodies seize by rounding; larger, wedged bodies enter each other.
pub(super) const LARGEST_REST: f64 = 1e-9;

/// More than any acceleration times two that is worth a thought, m/s²: a coarse sieve for contacts that may
/// settle. Smaller, contacts under larger accelerations bounce on below the rounding of their place; larger costs.
pub(super) const SETTLING_ACCELERATION: f64 = 1e6;

// Islands.

/// Parts of an integrated segment at whose ends the pressure of its contacts is looked at. A step of the
/// integrator is short against the time in which a smooth force turns round twice. Fewer may overlook that a
/// contact parts and is pressed again, more cost.
pub(super) const PRESSURE_SAMPLES: u32 = 8;

// The solver of contact constraints.

/// What still enters below this part of the largest that enters counts as rounding. Smaller, the active set goes
/// round in circles; larger, surfaces enter each other.
pub(super) const ENTERING: f64 = 1e-14;

/// What is left of a motion below this part of what was taken from it is rounding, and would creep.
pub(super) const LEFT_OVER: f64 = 64.0 * f64::EPSILON;

/// By which part the diagonal is raised where contacts share a load that they can't divide. Smaller, the matrix
/// stays singular; larger needs more refinements.
pub(super) const RAISE: f64 = 1e-10;

/// A pivot below this part of its diagonal entry belongs to a contact that depends on those before. Smaller,
/// rounding passes for independence; larger, contacts at small angles are dropped.
pub(super) const DEPENDENT: f64 = 1e-9;

/// Refinements of a solution: each takes a further [`RAISE`] of the error out, so that three leave rounding.
pub(super) const REFINEMENTS: u32 = 3;
