//! The thresholds of stepped groups, as shares of the bodies' radii, of the acceleration that drives them and of the
//! step. Those that a scene can set are in [`crate::scene::PARAMS`].
//!
//! Each says why it has its value, and what breaks where it is smaller or larger.

// The step.

/// A step may leave so much of the smallest radius unsolved, g·h²: a fifth of the overlap that is allowed. Smaller
/// costs steps, larger overlap.
pub(super) const FALL_IN_A_STEP: f64 = 2e-4;

/// Where nothing drives bodies, they move by at most this part of the smallest radius in a step.
pub(super) const WAY_IN_A_STEP: f64 = 0.02;

/// A step may be halved so often. Errors fall with the square of the step; slim columns need it, and bodies that pass
/// more than a share of their radius in a step.
pub(super) const MOST_HALVINGS: u8 = 10;

/// So often a step is halved for the pull of an attractor, beside those. The step of the scene is so much longer at most
/// than where bodies touch at the attractor's centre: more, and what goes by it waits long elsewhere.
pub(super) const MOST_HALVINGS_BY_PULL: u8 = 4;

/// Halvings after which a step that does not converge is taken as it is: the residual is overlap, which is shown.
pub(super) const MOST_HALVINGS_TO_CONVERGE: u8 = 4;

/// A step that was halved to converge is doubled again after so many that took few sweeps: fewer try in vain what takes
/// the most sweeps, more make short steps for longer.
pub(super) const EASY_STEPS: u8 = 32;

/// Whoever passes more than this part of its radius in a step needs shorter ones: the half-space that keeps bodies
/// apart would be met beside the body.
pub(super) const WAY_OF_RADIUS: f64 = 0.25;

/// Whoever would turn by more than this in a step about an attractor, √(G/d³)·h in radians, or come nearer by this part
/// of the distance, needs shorter ones: the error
/// of a leapfrog turn is a few hundredths of its square.
pub(super) const TURN_IN_A_STEP: f64 = 0.0125;

/// A first step shorter than this part of a step is joined to the next.
pub(super) const SHORTEST_STEP: f64 = 0.125;

/// Times that a step is begun anew because somebody is thrown beyond what the list covers, or wakes what lies still.
/// Each time the list covers more; more tries are needed by none.
pub(super) const MOST_ATTEMPTS: u32 = 8;

// Contacts.

/// Overlap from which bodies need not part, in radii: room to give back what the curvature of a way opened.
pub(super) const ROOM: f64 = 4e-4;

/// Overlap that no step makes, in radii: bodies were put there, and those that come fast part as those that meet, by their
/// restitution. Where it is less, they part as fast as they met, and so get out.
pub(super) const DEEP: f64 = 0.01;

/// Within that room they part at this share of the speed at which they met. At 1 they tremble for ever, at 0 they stay
/// where they overlap.
pub(super) const PARTING: f64 = 0.5;

/// Bodies that meet slower than so many times g·h land: a bounce shorter than twice as many steps is not resolved.
pub(super) const SLOWEST_REBOUND: f64 = 4.0;

/// A pair farther apart than it can come in a step, and this part of the radius, waits until it is seen to meet.
pub(super) const LAZY: f64 = 0.02;

// The sweeps.

/// Sweeps end when the largest change is below this part of the way that a body passes in a step on average: what the
/// solver leaves stays below the motion, so that heaps come to rest.
pub(super) const SHARE_OF_WAY: f64 = 0.1;

/// The same change is never asked to be smaller than this, nor allowed to be larger than the next, in radii.
pub(super) const FINEST: f64 = 2e-6;
pub(super) const COARSEST: f64 = 1e-4;

/// Nor larger than this part of what is left of the overlap budget of a contact, in radii.
pub(super) const BUDGET: f64 = 6e-4;
pub(super) const SHARE_OF_BUDGET: f64 = 0.25;

/// For a contact that has used up its budget the smallest change is this part of the usual one: it parts no more, and
/// what the sweeps leave adds up.
pub(super) const FINEST_OF_DEEP: f64 = 0.1;

/// The conjugate gradient goes on by this part of what Fletcher and Reeves' ratio says. At 1 it overshoots where contacts
/// open and close, and takes a fifth more sweeps in a pile of 1000; at 0.8 it gains less.
pub(super) const SHARE_OF_DIRECTION: f64 = 0.9375;

/// Sweeps before a step is halved.
pub(super) const MOST_SWEEPS: usize = 400;

/// After so many sweeps, and as many again, the contacts that still change are solved together: fewer do so in vain what
/// sweeps would, and more sweep in vain.
pub(super) const SWEEPS_TO_BLOCK: usize = 16;

/// These are the ones that change by more than this part of what is tolerated: less are more contacts, more leave out some
/// that take part.
pub(super) const SLOW: f64 = 0.3;

/// A contact beyond its budget that sinks by more than this in a step, in radii, is solved with those beside it too: what
/// 10⁴ steps leave stays below the budget.
pub(super) const CREEPING: f64 = 2e-8;

/// And so is one that gives more than this part of the energy that a component may gain.
pub(super) const GIVING: f64 = 0.1;

/// Up to so many are solved together, which costs some n³: more take longer than shorter steps.
pub(super) const MOST_TOGETHER: usize = 128;

/// More sweeps follow where a component gains more than this part of the mean m·g·r of its bodies in a step, and has been given
/// more than so many times that since its contacts took as much: impulses in a jam give in one step what they take in
/// another. Less, and jams are swept in vain; more, and it shows.
pub(super) const GAIN: f64 = 1e-5;
pub(super) const MOST_GIVEN: f64 = 10.0;

/// A component that was given so many times that begins a step with this part of the impulses of the step before, until it has
/// lost it again. In a jam impulses may balance each other and bear nothing; sweeps alone keep them for ever, and the larger
/// they are, the more gives what little is left of changes: one jam gave 0.02 m·g·r within 60 steps. Where this begins
/// earlier, at 10 or 100 times, contacts of jams that lose by themselves sink beyond 1e-3 r.
pub(super) const MOST_BEFORE_FADING: f64 = 400.0;
pub(super) const SHARE_IN_A_JAM: f64 = 0.9;

/// But no more than so many sweeps, and none once as many as lie between blocks have left more than half of the gain, as long
/// as not more than so many times that was given.
pub(super) const SWEEPS_AGAINST_GAIN: usize = 100;
pub(super) const MOST_IN_VAIN: f64 = 100.0;

/// A step that gains more than so many times what is allowed has not converged, and is halved in the end: after a hard
/// blow the impulses are so large that what little the sweeps leave counts.
pub(super) const GROSS_GAIN: f64 = 100.0;

// The list of pairs.

/// A body may move by this part of its radius, or by so many steps, before the list is made anew.
pub(super) const SKIN: f64 = 0.1;
pub(super) const SKIN_STEPS: f64 = 6.0;

/// The list is made anew after so many steps at the latest, so that bodies that left are found.
pub(super) const OLDEST_LIST: f64 = 64.0;

// Entering.

/// Impacts of a body, each forgotten by half in four steps, from which its component is stepped if it has so many
/// moving bodies: some 45 a step. Fewer, and small heaps are stepped that come to rest by themselves, and balls
/// squeezed between two others do not rebound; more, and heaps stall for longer.
pub(super) const STRUCK_OFTEN: f64 = 256.0;
pub(super) const HALF_LIFE: f64 = 4.0;
pub(in crate::sim) const SMALLEST_CROWD: usize = 4;

/// Of how many moving bodies a component must be that stands still in time, or costs too much.
pub(super) const LEAST_CROWD: usize = 2;

/// Elastic bodies that squeeze each other part again, after ever so many impacts as their masses differ. Up to eight are
/// followed through them all; among more there is no end to it.
pub(super) const SMALLEST_ELASTIC_CROWD: usize = 9;

/// What it costs to go on from impact to impact grows with the bodies too, and steps cost what they cost: larger components
/// are stepped from so many impacts times bodies on, those of three hundred from an impact a step. That is where their events
/// take longer than real time; four times as many, and they play at a third of it until they enter.
pub(super) const CROWDED: f64 = 2048.0;

/// The same for [`LARGE_ISLAND`] bodies and more where ways are integrated: an impact costs four to ten times as much there,
/// for each of its predictions is searched for on an integrated way, and a step hardly more.
pub(super) const CROWDED_IN_FIELDS: f64 = 512.0;

/// Nobody looks for a crowd around a body that was struck less: in a gas that would be in vain each time.
pub(super) const LEAST_STRUCK: f64 = 4.0;
pub(super) const LEAST_STRUCK_IN_FIELDS: f64 = LEAST_STRUCK * CROWDED_IN_FIELDS / CROWDED;

/// Motions that a body begins in contact, and impacts of it with several at once or in turn, each forgotten by half in
/// [`HALF_LIFE`] steps, from which it is stepped even alone: some 45 a step. A body on a seam, in a pit or a groove may lift
/// off, meet and settle without end while rounding decides which. Fewer, and it is stepped where it gets through; more, and
/// it stalls for longer.
pub(super) const STUCK: f64 = 256.0;

/// What the end of an integrator's step counts for there: on round surfaces there are some in each step of a group.
pub(super) const SHARE_OF_STEP: f64 = 0.5;

/// Such a body stays for so many steps while it lies on something: long enough to come to rest. Then events try again.
pub(super) const STEPS_OF_STUCK: u32 = 512;

/// Lossy impacts of one body at one instant from which its component is stepped, whatever the others say: no endless
/// series of impacts without time can outlive it.
pub(super) const MOST_AT_ONE_INSTANT: u32 = 32;

/// Moving bodies of one lossy impact, or held together, from which they are stepped.
pub(in crate::sim) const LARGE_ISLAND: usize = 64;

/// What it costs to resolve or integrate n lossy bodies together grows with n³: in units of ten, this. Half of it is
/// forgotten in some steps, and from this sum on the bodies are stepped: where thirty are resolved every twenty steps,
/// ten once a step. Less, and small heaps are stepped that events would get through; more, and heaps crawl.
pub(super) const WORK_OF_CUBE: f64 = 1e-3;
pub(super) const HALF_LIFE_OF_WORK: f64 = 64.0;
pub(super) const TOO_MUCH_WORK: f64 = 128.0;

/// Bodies nearer than this, in radii of the smaller, are of one component.
pub(super) const SAME_COMPONENT: f64 = 1e-3;

// Leaving.

/// Steps without a force after which a body that has no other near may leave.
pub(super) const IDLE_STEPS: u32 = 8;

/// Steps over which no body of a component must have moved by more than this part of its radius for it to rest: an
/// acceleration of 3e-3 g would have moved it by twice that.
pub(super) const STILL_STEPS: f64 = 256.0;
pub(super) const STILL: f64 = 1e-2;

/// And the largest kinetic energy of a component at rest, as a part of Σ m·g·r.
pub(super) const STILL_ENERGY: f64 = 1e-5;
