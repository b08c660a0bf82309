//! Every figure of every hard case within its limit, at a long, a usual and a short Δt; but for those listed.
//! The gases of 10 000 take minutes in this build: `polyscene hard-cases` measures them.

use polyscene::study::cases::{CASES, STEPS, measure};

/// A figure that is out of its limit today: case, figure, what was measured, and why. A line goes when its
/// figure holds; the tests see to it.
const KNOWN_MISSES: &[(&str, &str, &str)] = &[];

/// Stands for all figures of a run that does not reach its end.
const STALLS: &str = "stalls";

/// Measures the cases of these numbers at every Δt and compares what is out of its limit with the list.
fn check(numbers: std::ops::RangeInclusive<u32>) {
    for case in CASES.iter().filter(|case| numbers.contains(&case.number) && !case.long) {
        let mut missed: Vec<(&str, String)> = Vec::new();
        for (dt, _) in STEPS {
            let outcome = measure(case, dt);
            if let Some(why) = &outcome.stopped {
                missed.push((STALLS, why.clone()));
                // the others would take as long to say the same
                break;
            }
            let out = outcome.figures.iter().filter(|figure| !figure.held());
            missed.extend(out.map(|figure| (figure.demand.name, format!("{:e} at Δt {dt} s", figure.value))));
        }
        let known: Vec<&str> =
            KNOWN_MISSES.iter().filter(|(id, ..)| *id == case.id).map(|(_, figure, _)| *figure).collect();
        let new: Vec<_> = missed.iter().filter(|(name, _)| !known.contains(name)).collect();
        assert!(new.is_empty(), "{}: {new:?}", case.id);
        for name in known {
            let still = missed.iter().any(|(missed, _)| *missed == name);
            assert!(still, "{}: {name:?} holds now; drop its line from the list", case.id);
        }
    }
}

#[test]
fn flights_bounces_cradles_and_racks_hold() {
    check(1..=5);
}

#[test]
fn bullets_and_digits_of_pi_hold() {
    check(6..=7);
}

#[test]
fn gases_hold() {
    check(8..=8);
}

#[test]
fn orbits_drag_and_grazing_hold() {
    check(9..=12);
}

#[test]
fn corners_and_contacts_hold() {
    check(13..=14);
}

#[test]
fn collapse_and_stacks_hold() {
    check(15..=15);
}

#[test]
fn balls_that_rub_hold() {
    check(16..=16);
}

#[test]
fn stepped_groups_hold() {
    check(18..=18);
}

#[test]
fn reversal_distance_and_trouble_at_load_hold() {
    check(20..=22);
}

#[test]
fn case_names_are_unique_and_known_misses_name_figures() {
    let mut ids: Vec<&str> = CASES.iter().map(|case| case.id).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), CASES.len());
    assert!(CASES.is_sorted_by_key(|case| case.number));
    for (id, figure, _) in KNOWN_MISSES {
        let case = CASES.iter().find(|case| case.id == *id).unwrap_or_else(|| panic!("no case {id}"));
        assert!(
            *figure == STALLS || case.demands.iter().any(|demand| demand.name == *figure),
            "{id}: {figure}"
        );
    }
}
