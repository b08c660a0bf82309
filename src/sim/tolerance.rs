//! The thresholds of the core that no scene sets: bounds on rounding, and where a search or an iteration gives up.
//! Those that a scene can set are in [`crate::scene::PARAMS`]; those of the integrators are in `motion`, those of
//! stepped groups in `dense`, those of the methods that step by Δt in `stepping`.
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

/// Rounding of p²v² − (p·v)² as a part of p²v²: of three sums of three products, their products and the difference, some
/// ten roundings.
pub(super) const CROSS_ROUNDING: f64 = 1e-14;

// Search for the time of impact.

/// Steps of conservative advancement before the time reached is handed back, to be looked at again from there.
/// Fewer cost more looks, more let one search last.
pub(super) const MOST_ADVANCES: u32 = 400;

/// Steps of it after which a search isolates the root, and again after as many. Most searches end sooner; fewer make
/// it slower where it converges, more where it crawls.
pub(super) const ADVANCES_BEFORE_SKIP: u32 = 40;

/// Isolation leads to so many slacks before a contact, from where the search converges. Fewer, and rounding may lead
/// past it; more, and the search may crawl.
pub(super) const SLACKS_BEFORE_CONTACT: f64 = 8.0;

/// Pieces of time that the isolation of one root looks at: some for each halving. Fewer leave roots unfound that the
/// search then looks for, more are needed by none.
pub(super) const MOST_PIECES: u32 = 4096;

/// A found contact may be off by so many times [`TOUCH`]: what is farther apart was a search that gave up.
/// Smaller, true contacts are looked for again and again; larger, an unfinished search counts as an impact.
pub(super) const FOUND: f64 = 1e3;

/// The time of a contact is known to this part of itself, in which the surfaces come nearer still.
pub(super) const TIME_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A search that led to nothing goes on later by this part of the time at least: the same time would give the same
/// answer. Smaller costs more tries, larger may pass a contact.
pub(super) const LATER_ROUNDING: f64 = 4.0 * f64::EPSILON;

// Tiles.

/// The box of a body in the tiles is larger than the body by this part of the radius: more than a time of impact
/// can be off. Smaller, a neighbour may be overlooked; larger costs more looks.
pub(super) const BOX_MARGIN: f64 = 1e-6;

/// The same, as a part of the coordinates and of the size of a tile.
pub(super) const BOX_ROUNDING: f64 = 1e-12;

// Close passes of attractors.

/// A predicted pass of an attractor farther off than so many core radii is none: the search gave up there.
pub(super) const PASSED: f64 = 2.0;

/// A body at the core whose orbit stays within so many core radii can't leave the core by itself: it is captured.
/// Larger would take thin ellipses that are followed well.
pub(super) const BOUND_ALONE: f64 = 2.0;

/// The same for a body that loses energy to air or to others. At a core pass it is not retraced but turned back
/// anew, which is good to the core radius over its apoapsis: below so many core radii a hundredth of the way is
/// the core's own, and turns are so quick that none would end. Smaller follows millions of turns a second.
pub(super) const BOUND_DISTURBED: f64 = 100.0;

/// And for one that others or air disturb, so many of its own radii: it circles hundreds of times a second there. Smaller
/// follows turns that take more time than they last, larger takes orbits that a person sees.
pub(super) const BOUND_OF_RADIUS: f64 = 0.1;

/// A stepped body this near to an attractor, in its own radii, is captured however fast it is: steps can't follow it.
pub(super) const SWALLOWED: f64 = 0.01;

// Impact groups.

/// Bodies that touch do so to within so many times [`TOUCH`] at least, however small the contact distance: below it
/// places are rounded.
pub(super) const TOUCHES: f64 = 4.0;

/// A contact of a group closes if it does so by more than this part of its bodies' speeds.
pub(super) const CLOSING_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Contacts whose directions are at right angles but for this do not act on each other: normals are known to some
/// hundred roundings at best. Smaller, a corner of rotated walls shares one restitution; larger, contacts that act on
/// each other weakly are taken apart.
pub(super) const UNCOUPLED: f64 = 1e-12;

/// A velocity changed by less than this part of the largest of its group has not changed. Smaller, bodies at rest
/// start anew at every blow on a neighbour, for ever; larger, soft blows beside hard ones are lost.
pub(super) const NO_CHANGE: f64 = 64.0 * f64::EPSILON;

/// Rounds of reflections in which contacts that act on each other are thrown back set by set, and how many more for each
/// contact. Then all contacts are taken in each round, which ends soon; and after as many again the rest is taken
/// plastically. A blow goes through a row of n balls in n rounds. Fewer, and a light ball between heavy ones, which is
/// thrown to and fro some π√(M/m) times, is left to rounds that hand the blow on otherwise; more, and an impact at such a
/// ball lasts for long.
pub(super) const ROUNDS: usize = 100;
pub(super) const ROUNDS_PER_CONTACT: usize = 20;

/// Rounds, and more for each contact, before closing speeds that have fallen below the share of a collapse end a group:
/// what a blow needs to get through it and back. Fewer, and a soft blow that has not arrived yet counts as a collapse;
/// more, and a collapse is followed to lower speeds.
pub(super) const ROUNDS_TO_FALL: usize = 4;
pub(super) const ROUNDS_TO_FALL_PER_CONTACT: usize = 2;

/// Levelling the contacts that last may change a velocity by so many times what the strongest acceleration does in the
/// flights left out, for each contact: a ball on a stack takes up what parts in all contacts below. Smaller, bounces in
/// heaps are followed for longer; larger, what carries a body along is stopped.
pub(super) const MOST_LEVELLED: f64 = 2.0;

/// Bounces up to so many times the height of rest are given to the rule that decides about rest: other bodies may press
/// more than what drives the two together. Smaller, a ball under others bounces on; larger costs time.
pub(super) const NEAR_REST: f64 = 2.0;

/// Impacts over which speeds must have fallen for a collapse. Fewer, and a soft touch after a hard blow counts as one;
/// more, and a steep collapse is followed to where its speeds are rounding.
pub(super) const FALLING: u32 = 8;

/// What part of the reference speed of a collapse each impact leaves: it is forgotten after some hundred. Less, and
/// slow collapses are not told from a gas that cools; more, and a body remembers blows of long ago.
pub(super) const MEMORY: f64 = 1.0 - 1.0 / 256.0;

// Friction.

/// Phases of friction and of what it makes close, of one group, before its bodies are stepped instead. A phase closes a
/// fraction of the one before; most groups need three. Fewer, and groups are stepped that end; more cost time.
pub(super) const FRICTION_ROUNDS: usize = 100;

/// Sweeps of one phase, and the change of a velocity, as a part of the fastest, at which they end: some hundred roundings.
/// A larger one breaks the symmetry of a group, a smaller one is never met.
pub(super) const FRICTION_SWEEPS: usize = 1000;
pub(super) const FRICTION_SWEPT: f64 = 1e-15;

/// A slip below this part of the speeds that it is the difference of is none. Smaller, a ball that rolls seems to slip by
/// roundings; larger, slips that are slow beside the ball end too soon.
pub(super) const NO_SLIP: f64 = 64.0 * f64::EPSILON;

/// A slip and what drives it are of one line if they are to this part: then it does not turn. Smaller follows a turn that
/// is rounding, larger leaves out one that is not.
pub(super) const ONE_LINE: f64 = 1e-13;

/// When a slip that turns would end within a time in which friction changes it by this part of the speeds, what is left of
/// it is taken as straight: velocities at its end are exact all the same, and places are off by its square. Larger loses
/// digits, smaller takes more steps.
pub(super) const LAST_OF_SLIP: f64 = 1e-8;

/// And the way that bodies fall meanwhile is this part of their radii at most: turning with their contacts, accelerations
/// change velocities by as much of them. A slip of a few roundings that hardly changes has a long time left. Larger, and
/// contacts part; smaller takes more steps.
pub(super) const LAST_OF_WAY: f64 = 1e-15;

/// Slips that end within this part of the time that is left to the first of them end with it: what is left of them then is
/// this part of [`LAST_OF_SLIP`], a rounding of the speeds. Smaller, slips that end together do so one after the other;
/// larger, those end that have some way to go.
pub(super) const AT_ONCE: f64 = 1e-3;

/// Weight of the square of a load beside that of friction, where forces depend on each other: a ball in a groove is carried
/// by its loads, and rubs no more than it must. Larger, friction carries it too; smaller, rounding decides how loads are
/// shared.
pub(super) const OF_LOADS: f64 = 1e-6;

/// A step along a slip that turns goes so far at most of the way to where that ends: the turn becomes singular there.
/// Larger is cut down by the integrator, smaller takes more steps.
pub(super) const SHARE_OF_SLIP: f64 = 0.75;

/// Contacts of bodies that rub together, at most, that are followed from event to event. More cost the cube of their
/// number; fewer are stepped that need not be.
pub(super) const MOST_GRIPPING: usize = 12;

/// A slip below this part of the speeds has no direction of its own: that is rounding. Smaller, and steps shrink where slips
/// begin; larger, and slips that turn do so late.
pub(super) const START_OF_SLIP: f64 = 1e-9;

/// In a step in which a slip begins it has the direction in which it does while its own differs by less than this: what the
/// above leaves of rounding. And the part of the accelerations below which a slip hardly begins.
pub(super) const AS_IT_BEGAN: f64 = 1e-6;

/// A slip below this part of the speeds has only just begun, and a step in which a body comes less far than this part of its
/// radius is a short one. Where both meet the bodies are stepped: smaller parts take thousands of steps, larger step
/// bodies that could be followed.
pub(super) const JUST_BEGUN: f64 = 1e-2;
pub(super) const STIFF_STEP: f64 = 1e-3;

/// A contact that sticks slips when it is held by more than its friction by this part of it: as it begins to, it is held by
/// just that. Smaller, it slips by roundings as it begins to stick; larger, it slips late by as much.
pub(super) const STICKS_ON: f64 = 1e-12;

// Islands.

/// Parts of an integrated segment at whose ends the pressure of its contacts is looked at. A step of the
/// integrator is short against the time in which a smooth force turns round twice. Fewer may overlook that a
/// contact parts and is pressed again, more cost.
pub(super) const PRESSURE_SAMPLES: u32 = 8;

/// Edges and corners that lie this near to each other, as a part of the distance from which they are seen, are one: a
/// rounding or many. Smaller, an edge passes for another by rounding; larger, the two sides of a narrow plate are one.
pub(super) const SAME_PART: f64 = 1e-9;

/// Of an integrated segment in contact this part at least is gone before it ends where a body rolls on to another part of a
/// shape. Smaller, a body that rolls along the border of two parts goes on by roundings of time; larger, a bend in its
/// way may lie inside a step, which is off by a micrometre then.
pub(super) const LEAST_OF_STEP: f64 = 1e-6;

// The solver of contact constraints.

/// What still enters below this part of the motions that it is the difference of is rounding. Smaller, the active
/// set goes round in circles; larger, surfaces enter each other.
pub(super) const ENTERING: f64 = 16.0 * f64::EPSILON;

/// A normal of which less than this part of its length is left beside others is a combination of them: some hundred
/// roundings. Smaller, rounding passes for a direction; larger, a heavy ball sinks through a light one.
pub(super) const DEPENDENT: f64 = 1e-13;

/// What is left of a motion below this part of what was taken from it is rounding, and would creep.
pub(super) const LEFT_OVER: f64 = 64.0 * f64::EPSILON;

/// A motion below this part of the largest of a problem is none. Without it the loads on bodies that lie still are
/// improved until they are denormal, where scaled masses no longer give scaled bits; larger, soft contacts beside fast
/// ones are lost.
pub(super) const NONE_BESIDE: f64 = f64::EPSILON;

/// Normals of which less than this part is left beside others are of one direction with them: what one carries, the
/// others could. Smaller, a ball beside a seam presses on one of two plates only; larger, a heavy ball on a light one,
/// of which the root of the mass ratio is left, seems to press on the floor.
pub(super) const ONE_DIRECTION: f64 = 1e-9;

/// Part of a normal's length that is a direction of its own where loads are shared: bounds that depend on each other
/// then have one answer, that of the least forces. It is off by the square of this, which is made good afterwards,
/// and by roundings over that square.
pub(super) const SHARING: f64 = 1e-4;

// The same, by loads.

/// Up to so many links the search along an orthogonal basis is as quick as that by loads, and keeps more digits where
/// masses differ. More cost time.
pub(super) const FEW_LINKS: usize = 6;

/// Part of the diagonal by which the matrix of the contacts is made definite. Each step leaves this over what is left
/// of a normal beside others, squared: smaller, rounding decides how bounds that depend on each other share their load;
/// larger, normals that differ little take many steps.
pub(super) const PROXIMAL: f64 = 1e-10;

/// Loads may exceed the motion that they come from so many times: as many roundings the motion is then off by. Less,
/// and steep wedges are searched for in vain first; more, and a heavy ball sinks through a light one.
pub(super) const LOADED: f64 = 1e3;

/// A motion found from loads is a projection to this part of its energy, or it is searched for: smaller searches in vain
/// in every jam, larger makes energy of rounding.
pub(super) const PROJECTED: f64 = 1e-13;

/// What a step with the factor of a problem nearby may leave of what was overstepped, before that of the problem itself
/// is made, which costs some eight steps. Larger takes more steps, smaller makes factors in vain.
pub(super) const STALE: f64 = 0.02;

/// Steps in all, and exchanges of the set, after which loads are given up. Most problems need three of each; fewer
/// lead to a search in vain, more cost time where there is no answer.
pub(super) const MOST_STEPS: u32 = 40;
pub(super) const MOST_EXCHANGES: u32 = 12;

/// The response of a link beside others is told from the matrix of the contacts where more than this part of it is left:
/// it is off by roundings over this. Smaller loses digits, larger costs time.
pub(super) const HELD_ALONE: f64 = 1e-2;
