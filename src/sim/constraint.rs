//! Motions of several bodies that touch: the nearest one that enters no surface.
//!
//! With the kinetic metric (masses as weights) the nearest allowed accelerations are the true ones (Gauss's
//! principle of least constraint), and the nearest allowed velocities those after a plastic impact (Moreau).
//! The multipliers λ of the contacts are ≥ 0: contacts only push. [`super::nearest`] finds both.

use glam::DVec3;

use super::link::{Link, Solved};
use super::loads::{Loads, Problem};
use super::nearest::{nearest, nearest_from};

/// Turns a motion into the nearest one that enters no surface faster than its limit.
pub(super) fn enter_none(links: &[Link], inverse_mass: &[f64], motion: &mut [DVec3]) -> Solved {
    nearest(links, &vec![false; links.len()], inverse_mass, motion)
}

/// The same, with the loads of a problem like it to start from.
pub(super) fn enter_none_from(
    loads: &mut Loads,
    links: &[Link],
    inverse_mass: &[f64],
    motion: &mut [DVec3],
) -> Solved {
    nearest_from(loads, links, &vec![false; links.len()], inverse_mass, motion)
}

/// The same from loads alone, to fewer digits where they exceed the motion by far: the loads, or `None` where these do not
/// tell it.
pub(super) fn enter_none_by_loads(
    mut loads: Loads,
    links: &[Link],
    inverse_mass: &[f64],
    motion: &mut [DVec3],
) -> Option<Vec<f64>> {
    loads.bring_near(&Problem { links, both: &vec![false; links.len()], inverse_mass }, motion)
}

/// Turns a motion into the nearest one that neither enters nor leaves: every link is at its limit.
pub(super) fn stay_on(links: &[Link], inverse_mass: &[f64], motion: &mut [DVec3]) -> Solved {
    nearest(links, &vec![true; links.len()], inverse_mass, motion)
}

/// Turns a motion into the nearest one that enters no surface and leaves none that is `held`, with the loads of a problem
/// like it to start from.
pub(super) fn hold_from(
    loads: &mut Loads,
    links: &[Link],
    held: &[bool],
    inverse_mass: &[f64],
    motion: &mut [DVec3],
) -> Solved {
    nearest_from(loads, links, held, inverse_mass, motion)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn floor(a: usize) -> Link {
        Link { a, b: None, towards: DVec3::NEG_Y, limit: 0.0 }
    }

    fn below(a: usize, b: usize) -> Link {
        Link { a, b: Some(b), towards: DVec3::NEG_Y, limit: 0.0 }
    }

    #[test]
    fn a_tower_presses_with_the_weight_above() {
        let links = [floor(0), below(1, 0), below(2, 1)];
        let mut motion = [DVec3::Y * -10.0; 3];
        let forces = enter_none(&links, &[1.0, 0.5, 0.25], &mut motion).multipliers;
        assert_eq!(motion, [DVec3::ZERO; 3]);
        for (force, weight) in forces.iter().zip([70.0, 60.0, 40.0]) {
            assert!((force - weight).abs() <= 1e-12 * weight, "{forces:?}");
        }
    }

    #[test]
    fn contacts_only_push() {
        let links = [floor(0), below(1, 0)];
        let mut motion = [DVec3::Y * -10.0, DVec3::Y * 3.0];
        let forces = enter_none(&links, &[1.0, 1.0], &mut motion).multipliers;
        assert_eq!(motion, [DVec3::ZERO, DVec3::Y * 3.0]);
        assert_eq!(forces[1], 0.0);
    }

    #[test]
    fn contacts_that_depend_on_each_other_share_the_load() {
        let links = [floor(0), floor(0), floor(0), Link { towards: DVec3::X, ..floor(0) }];
        let mut motion = [DVec3::new(-1.0, -10.0, 0.5)];
        let forces = enter_none(&links, &[2.0], &mut motion).multipliers;
        assert!((motion[0] - DVec3::new(-1.0, 0.0, 0.5)).length() <= 1e-15, "{motion:?}");
        assert!((forces.iter().sum::<f64>() - 5.0).abs() <= 1e-12, "{forces:?}");
        let mut motion = [DVec3::new(-1.0, 10.0, 0.5)];
        stay_on(&links, &[2.0], &mut motion);
        assert!((motion[0] - DVec3::new(0.0, 0.0, 0.5)).length() <= 1e-15, "{motion:?}");
    }

    /// Random problems: every answer must meet the conditions of Karush, Kuhn and Tucker, which the nearest
    /// allowed motion alone does.
    #[test]
    fn the_nearest_allowed_motion_is_found() {
        let mut source = Random::new(1);
        let mut random = move || source.range(-1.0, 1.0);
        for case in 0..2000 {
            let bodies = 1 + case % 5;
            let inverse_mass: Vec<f64> = (0..bodies).map(|_| libm::exp(3.0 * random())).collect();
            let links: Vec<Link> = (0..=case % 9)
                .map(|k| {
                    let (a, b) = (k % bodies, (k * 7 + case) % bodies);
                    let towards = DVec3::new(random(), random(), random()).normalize();
                    Link { a, b: (a != b).then_some(b), towards, limit: random().max(0.0) }
                })
                .collect();
            let free: Vec<DVec3> = (0..bodies).map(|_| DVec3::new(random(), random(), random())).collect();
            let mut motion = free.clone();
            let multipliers = enter_none(&links, &inverse_mass, &mut motion).multipliers;
            for (link, multiplier) in links.iter().zip(&multipliers) {
                let excess = link.entering(&motion) - link.limit;
                assert!(*multiplier >= 0.0 && excess <= 1e-11, "case {case}: {multiplier} {excess:e}");
                assert!(*multiplier == 0.0 || excess.abs() <= 1e-11, "case {case}: {multiplier} {excess:e}");
            }
        }
    }
}
