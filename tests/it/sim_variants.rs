//! Contact scenes from seeds: each ends, gains no energy, overlaps nothing, and closes its books.

use polyscene::scene::{Scene, Shape};
use polyscene::sim::{Progress, Simulation};
use polyscene::study::OverlapMonitor;

use crate::common::contact_scenes::{
    ContactScene, Family, Surroundings, contact_scene, scaled, surrounded, weighted,
};
use crate::common::drive::{Promise, was_stepped};

/// Seeds of each family; the variable `VARIANT_SEEDS` asks for others, such as `1000..2000`.
const SEEDS: u64 = 8;

fn seeds() -> std::ops::Range<u64> {
    let asked = std::env::var("VARIANT_SEEDS").ok();
    let range = asked.as_ref().and_then(|asked| asked.split_once(".."));
    let range = range.and_then(|(from, to)| Some(from.parse().ok()?..to.parse().ok()?));
    range.unwrap_or(0..SEEDS)
}

/// Lengths and times, each over those of a scene of half a metre: from micrometres to thousands of kilometres.
const SIZES: &[(f64, f64)] = &[(1.0, 1.0), (1e-6, 1e-3), (1e-3, 1.0), (1e3, 1.0), (1e6, 1e3)];

/// Calls of `work` before a run counts as stalled.
const MOST_CALLS: u64 = 200_000;
/// Events after which a scene that may have more has been watched long enough.
const ENOUGH_EVENTS: u64 = 5_000;
/// Predictions in one call of `work`.
const PORTION: u32 = 64;
/// Looks at the energy and at all pairs, besides those at events.
const LOOKS: u32 = 100;

/// Largest energy residual that is allowed.
const MOST_LEFT: f64 = 1e-9;

/// Scenes that were wrong once: family, seed and number among its variants.
const ONCE_WRONG: &[(Family, u64, usize)] = &[
    // Seen: "the integrator's step has shrunk to nothing". Cause: a kink of drag nearer to the start of a step than time
    // can tell was another one.
    (Family::Pit, 18, 5),
    // Seen: a look every 3e-8 s at a wall along which a ball falls in air, so that time all but stands still. Cause:
    // it closed by rounding, and when to look again was told from the acceleration in any direction.
    (Family::Slot, 33, 5),
    (Family::Slot, 120, 5),
    // Seen: a residual of 1e-3 in steps in air. Cause: drag was booked by its law along the way, not as it was applied.
    (Family::Slot, 195, 5),
    // Seen: overlaps of 2e-1 and 3e-3 radii and energy won. Cause: sweeps do not get anywhere between masses of 1 : 1e4
    // and more, and a ball between a wall and a heavy one was to part from that as fast as it came.
    (Family::Slot, 38, 6),
    (Family::Slot, 49, 6),
    (Family::Slot, 291, 6),
    // Seen: an overlap of 4e-2 radii with a ball that was not stepped. Cause: when it began its flight it was within
    // reach of the stepped one, and was expected back at that place only.
    (Family::Slot, 943, 0),
];

/// The worst that was seen on the way, each over what is allowed. (The names say so: an overlap of 0.6 of what is allowed was
/// once read as one of 0.6 radii.)
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    events: u64,
    /// Largest climb of the total energy above its lowest value before.
    climb_of_allowed: f64,
    /// Deepest overlap.
    overlap_of_allowed: f64,
    /// Largest energy residual.
    residual_of_allowed: f64,
}

/// Runs a scene and looks at it after every event; an error says why it did not come to its end.
fn watch(scene: &ContactScene) -> Result<Seen, String> {
    let mut sim = Simulation::new(&scene.scene).map_err(|error| format!("{error}: {:?}", error.problems))?;
    let monitor = OverlapMonitor::in_id_order(&scene.scene);
    let at_start = monitor.worst_now(&sim);
    let radius = smallest_radius(&scene.scene);
    let steps = Promise::of_steps(&sim, &scene.scene);
    let (mut seen, mut lowest, mut calls) = (Seen::default(), f64::INFINITY, 0);
    for look in 1..=LOOKS {
        sim.begin(scene.until * f64::from(look) / f64::from(LOOKS));
        loop {
            let progress = sim.work(PORTION).map_err(|fault| fault.to_string())?;
            calls += 1;
            if let Progress::Event(_) = progress {
                seen.events += 1;
            }
            if seen.events > scene.most_events || calls > MOST_CALLS {
                return Err(format!("stalled at t = {} s after {} events", sim.time(), seen.events));
            }
            if progress != Progress::Working {
                let energy = sim.energy();
                let total = energy.total.ok_or("no total energy")?;
                lowest = lowest.min(total);
                let scale = energy.kinetic + energy.potential.unwrap_or(0.0).abs();
                let promise = Promise { overlap: 1e-9 * radius, climb: 1e-11 * scale.max(f64::MIN_POSITIVE) };
                let promise = if was_stepped(&sim) { steps } else { promise };
                let residual = energy.residual.ok_or("no residual")?.abs();
                seen.climb_of_allowed = seen.climb_of_allowed.max((total - lowest) / promise.climb);
                // Steps of a seam may reach into the ball from the start.
                let overlap = (monitor.worst_now(&sim) - at_start) / promise.overlap;
                seen.overlap_of_allowed = seen.overlap_of_allowed.max(overlap);
                seen.residual_of_allowed = seen.residual_of_allowed.max(residual / MOST_LEFT);
            }
            if progress == Progress::Done {
                break;
            }
            if seen.events >= ENOUGH_EVENTS && seen.events < scene.most_events / 4 {
                return Ok(seen);
            }
        }
    }
    Ok(seen)
}

fn smallest_radius(scene: &Scene) -> f64 {
    let radii = scene.bodies.iter().filter(|body| body.is_dynamic()).filter_map(|body| match body.shape {
        Shape::Sphere { radius } => Some(radius),
        _ => None,
    });
    radii.fold(f64::INFINITY, f64::min)
}

/// What is wrong with a scene, if anything.
fn fault_of(scene: &ContactScene) -> Option<String> {
    let seen = match watch(scene) {
        Ok(seen) => seen,
        Err(reason) => return Some(format!("{}: {reason}", scene.what)),
    };
    let worst = [seen.climb_of_allowed, seen.overlap_of_allowed, seen.residual_of_allowed];
    let holds = worst.into_iter().all(|worst| worst <= 1.0);
    (!holds).then(|| format!("{}: {seen:?}", scene.what))
}

/// A scene at every size, in air or in a field, and with masses of some ratio.
fn variants(family: Family, seed: u64) -> Vec<ContactScene> {
    let plain = contact_scene(family, seed);
    let mut variants: Vec<ContactScene> =
        SIZES.iter().map(|(length, time)| scaled(&plain, *length, *time)).collect();
    // One of them for each seed: they take longer.
    let (length, time) = SIZES[seed as usize % SIZES.len()];
    let by = Surroundings::ALL[1 + seed as usize % 3];
    variants.push(scaled(&surrounded(&plain, by), length, time));
    let ratio = [1e2, 1e4, 1e6, 1e9, 1e12][seed as usize % 5];
    variants.push(weighted(&plain, ratio, seed));
    variants
}

/// Every scene of a family ends, gains no energy, overlaps nothing, and closes its books.
fn holds(family: Family) {
    let faults: Vec<String> =
        seeds().flat_map(|seed| variants(family, seed)).filter_map(|scene| fault_of(&scene)).collect();
    assert!(faults.is_empty(), "{} scenes:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn what_was_wrong_once_holds() {
    let scenes =
        ONCE_WRONG.iter().map(|(family, seed, number)| variants(*family, *seed).swap_remove(*number));
    let faults: Vec<String> = scenes.filter_map(|scene| fault_of(&scene)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn seams_hold() {
    holds(Family::Seam);
}

#[test]
fn corners_hold() {
    holds(Family::Corner);
}

#[test]
fn squeezes_hold() {
    holds(Family::Squeeze);
}

#[test]
fn slots_hold() {
    holds(Family::Slot);
}

#[test]
fn pits_hold() {
    holds(Family::Pit);
}

#[test]
fn rows_at_a_wall_hold() {
    holds(Family::WallAndFloor);
}

#[test]
fn bouncy_balls_on_lossy_floors_hold() {
    holds(Family::LossyFloor);
}

#[test]
fn a_seed_gives_the_same_scene_again_and_another_seed_another() {
    for family in Family::ALL {
        let [one, same, other] = [1, 1, 2].map(|seed| contact_scene(family, seed).scene);
        assert_eq!(one, same, "{family:?}");
        assert_ne!(one, other, "{family:?}");
    }
}
