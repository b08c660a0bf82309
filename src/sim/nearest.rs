//! The nearest motion within bounds: of many bounds from their loads ([`super::loads`]) where these tell it, else by
//! a search along an orthogonal basis ([`super::search`]), which keeps more digits and takes longer.

use glam::DVec3;

use super::link::{Link, Solved};
use super::loads::{Loads, Problem, responses_of};
use super::search::{responses_by_search, search};
use super::tolerance::FEW_LINKS;

/// Turns a motion into the nearest one in which no link enters faster than its limit, and those of `both`
/// neither enter nor leave.
pub(super) fn nearest(links: &[Link], both: &[bool], inverse_mass: &[f64], motion: &mut [DVec3]) -> Solved {
    nearest_from(&mut Loads::default(), links, both, inverse_mass, motion)
}

/// The same, with the loads of a problem like it to start from, which become those of this one.
pub(super) fn nearest_from(
    loads: &mut Loads,
    links: &[Link],
    both: &[bool],
    inverse_mass: &[f64],
    motion: &mut [DVec3],
) -> Solved {
    let met = |k: usize| {
        let excess = links[k].entering(motion) - links[k].limit;
        if both[k] { excess == 0.0 } else { excess <= 0.0 }
    };
    if (0..links.len()).all(met) {
        let sizes = motion.iter().map(|w| w.length()).collect();
        return Solved { multipliers: vec![0.0; links.len()], sizes, is_unmet: false };
    }
    if links.len() > FEW_LINKS {
        let problem = Problem { links, both, inverse_mass };
        if let Some(solved) = loads.bring_within(&problem, motion) {
            return solved;
        }
    }
    let solved = search(links, both, inverse_mass, motion);
    *loads = Loads::from(&solved.multipliers);
    solved
}

/// What a unit of force at each link changes there while all the others of the set hold; where these would
/// hold it alone, what it changes by itself.
pub(super) fn responses(links: &[Link], inverse_mass: &[f64]) -> Vec<f64> {
    if links.len() > FEW_LINKS
        && let Some(responses) = responses_of(links, inverse_mass)
    {
        return responses;
    }
    responses_by_search(links, inverse_mass)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Symptom: not a number, wherever a body of infinite mass took part. Expected: the answer that a static body in
    /// its place gives. Cause: its weight was 1/0, and what it moved 0.
    #[test]
    fn a_body_without_inverse_mass_is_met_as_a_static_one_is() {
        let links = |below: Option<usize>| {
            [
                Link { a: 0, b: below, towards: DVec3::NEG_Y, limit: 0.0 },
                Link { a: 0, b: Some(1), towards: DVec3::Y, limit: 0.0 },
            ]
        };
        let start = [DVec3::new(1.0, -2.0, 0.0), DVec3::Y * -3.0];
        for both in [[false, false], [true, true]] {
            let mut on_static = start;
            let expected = nearest(&links(None), &both, &[0.5, 0.25], &mut on_static);
            let mut on_fixed = [start[0], start[1], DVec3::ZERO];
            let found = nearest(&links(Some(2)), &both, &[0.5, 0.25, 0.0], &mut on_fixed);
            assert_eq!(on_fixed, [on_static[0], on_static[1], DVec3::ZERO]);
            assert_eq!(found.multipliers, expected.multipliers);
            let responses =
                [responses(&links(None), &[0.5, 0.25]), responses(&links(Some(2)), &[0.5, 0.25, 0.0])];
            assert_eq!(responses[0], responses[1]);
        }
    }

    #[test]
    fn between_bodies_that_nothing_moves_no_force_acts() {
        let link = Link { a: 0, b: Some(1), towards: DVec3::X, limit: 0.0 };
        let mut motion = [DVec3::X, DVec3::ZERO];
        let solved = nearest(&[link], &[false], &[0.0, 0.0], &mut motion);
        assert_eq!((motion, solved.multipliers), ([DVec3::X, DVec3::ZERO], vec![0.0]));
    }

    /// Symptom: levelling a jam made energy of rounding. Expected: the motion found is a projection, (v − p)·p = 0 in
    /// the metric of masses, for normals that differ by 2e-9 or more (nearer ones lose digits to dropped bounds).
    /// Cause: a step along what is left of a normal was measured by what the link enters, in which the rounding left
    /// along the others is enlarged.
    #[test]
    fn what_is_found_is_a_projection_for_normals_in_all_but_one_direction() {
        let mut source = Random::new(1);
        let mut random = move || source.range(-1.0, 1.0);
        for case in 0..4000 {
            let apart = libm::exp(-20.0 * f64::from(case % 97) / 97.0);
            let bodies = 2 + case as usize % 4;
            let inverse_mass: Vec<f64> = (0..bodies).map(|_| libm::exp(4.0 * random())).collect();
            let along = DVec3::new(random(), random(), random()).normalize();
            let link = |k: usize, random: &mut dyn FnMut() -> f64| {
                let towards = (along + apart * DVec3::new(random(), random(), random())).normalize();
                Link {
                    a: k % bodies,
                    b: (!k.is_multiple_of(3)).then_some((k + 1) % bodies),
                    towards,
                    limit: 0.0,
                }
            };
            let links: Vec<Link> = (0..2 * bodies).map(|k| link(k, &mut random)).collect();
            let both: Vec<bool> = (0..links.len()).map(|k| k % 2 == case as usize % 2).collect();
            let start: Vec<DVec3> = (0..bodies).map(|_| DVec3::new(random(), random(), random())).collect();
            let mut found = start.clone();
            nearest(&links, &both, &inverse_mass, &mut found);
            let of = |u: &[DVec3], v: &[DVec3]| -> f64 {
                u.iter().zip(v).zip(&inverse_mass).map(|((u, v), inverse)| u.dot(*v) / inverse).sum()
            };
            let (whole, left, across) = (of(&start, &start), of(&found, &found), of(&start, &found));
            assert!((across - left).abs() <= 1e-12 * whole, "case {case}, {apart:e}: {:e}", across - left);
        }
    }

    /// Heaps as contacts make them: what is found from loads, from none or from those of a little before, is what the
    /// search finds.
    #[test]
    fn loads_lead_to_what_the_search_finds() {
        let mut source = Random::new(7);
        let mut random = move || source.range(-1.0, 1.0);
        let (mut found_from_loads, cases) = (0, 400);
        for case in 0..cases {
            let bodies = 4 + case % 12;
            let inverse_mass: Vec<f64> = (0..bodies).map(|_| libm::exp(random())).collect();
            let mut links: Vec<Link> = (0..2 * bodies)
                .map(|k| {
                    let towards = DVec3::new(random(), random() - 2.0, random()).normalize();
                    let (a, b) = (k % bodies, (k * 5 + 1) % bodies);
                    Link { a, b: (a > b).then_some(b), towards, limit: 0.1 * random().max(0.0) }
                })
                .collect();
            let free = vec![DVec3::NEG_Y; bodies];
            let both = vec![case % 3 == 0; links.len()];
            let mut loads = Loads::default();
            for _ in 0..3 {
                let (mut expected, mut motion) = (free.clone(), free.clone());
                search(&links, &both, &inverse_mass, &mut expected);
                let problem = Problem { links: &links, both: &both, inverse_mass: &inverse_mass };
                if loads.bring_within(&problem, &mut motion).is_some() {
                    found_from_loads += 1;
                    for (expected, found) in expected.iter().zip(&motion) {
                        assert!((*expected - *found).length() <= 1e-11, "case {case}: {expected} {found}");
                    }
                }
                for link in &mut links {
                    link.towards =
                        (link.towards + 1e-4 * DVec3::new(random(), random(), random())).normalize();
                }
            }
        }
        assert!(found_from_loads > 2 * cases, "{found_from_loads} of {}", 3 * cases);
    }

    /// Heaps of masses up to 1 : 10⁶: what loads alone tell meets the conditions of Karush, Kuhn and Tucker to the digits
    /// that loads so much larger than the motion leave, and they nearly always tell it.
    #[test]
    fn loads_alone_are_good_enough_where_masses_differ_by_far() {
        let mut source = Random::new(11);
        let mut random = move || source.range(-1.0, 1.0);
        let (mut told, cases) = (0, 300);
        for case in 0..cases {
            let bodies = 4 + case % 24;
            let inverse_mass: Vec<f64> = (0..bodies).map(|_| libm::exp(6.9 * random())).collect();
            let links: Vec<Link> = (0..2 * bodies)
                .map(|k| {
                    let towards = DVec3::new(random(), random() - 2.0, random()).normalize();
                    let (a, b) = (k % bodies, (k * 5 + 1) % bodies);
                    Link { a, b: (a > b).then_some(b), towards, limit: 0.1 * random() }
                })
                .collect();
            let both = vec![false; links.len()];
            let problem = Problem { links: &links, both: &both, inverse_mass: &inverse_mass };
            let mut motion = vec![DVec3::NEG_Y; bodies];
            let Some(loads) = Loads::default().bring_near(&problem, &mut motion) else { continue };
            told += 1;
            let mut made = vec![DVec3::NEG_Y; bodies];
            links.iter().zip(&loads).for_each(|(link, load)| link.push(&mut made, &inverse_mass, *load));
            for (link, load) in links.iter().zip(&loads) {
                let moved = |body: usize| load * inverse_mass[body];
                let size = 1.0 + moved(link.a) + link.b.map_or(0.0, moved);
                let excess = link.entering(&motion) - link.limit;
                assert!(*load >= 0.0 && excess <= 1e-9 * size, "case {case}: {load:e} {excess:e}");
                assert!(*load == 0.0 || excess.abs() <= 1e-9 * size, "case {case}: {load:e} {excess:e}");
            }
            assert!(made.iter().zip(&motion).all(|(made, found)| made.distance(*found) <= 1e-9));
        }
        assert!(told * 10 >= 9 * cases, "{told} of {cases}");
    }

    #[test]
    fn responses_are_the_same_by_either_way() {
        let towards = |k: usize| DVec3::new(libm::sin(k as f64), -1.0, libm::cos(3.0 * k as f64)).normalize();
        let link = |k: usize| Link { a: k, b: k.checked_sub(1), towards: towards(k), limit: 0.0 };
        let links: Vec<Link> = (0..9).map(link).collect();
        let inverse_mass: Vec<f64> = (0..9).map(|k| 1.0 / (1.0 + k as f64)).collect();
        let found = responses_of(&links, &inverse_mass).unwrap();
        for (found, expected) in found.iter().zip(responses_by_search(&links, &inverse_mass)) {
            assert!((found - expected).abs() <= 1e-14 * expected, "{found} {expected}");
        }
    }
}
