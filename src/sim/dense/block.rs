//! The contacts that sweeps get nowhere with, solved together while all others keep their impulses.
//!
//! A light body between heavy ones takes some M/m sweeps, and so does all that goes through it. Few contacts take part:
//! those whose impulses still change, and those beside them.

use glam::DVec3;

use super::rows::Row;
use super::stepped::{FIXED, velocity};
use super::sweep::{System, push};
use super::tolerance::MOST_TOGETHER;
use crate::sim::constraint::enter_none_by_loads;
use crate::sim::link::{Link, renumber};
use crate::sim::loads::Loads;

/// Solves rows together with those that share a body with them, and with those that share one with these, so many `rings`
/// of them as there is room for. Whether there was a solution.
pub(super) fn solve_together(system: &mut System, rows: Vec<usize>, rings: usize) -> bool {
    if rows.is_empty() || rows.len() > MOST_TOGETHER {
        return false;
    }
    let rows = with_rings(system, rows, rings);
    let mut links: Vec<Link> = rows.iter().map(|k| link(system, *k)).collect();
    let bodies = renumber(&mut links);
    let known: Vec<f64> = rows.iter().map(|k| system.impulses[*k]).collect();
    give(system, &rows, &vec![0.0; rows.len()]);
    let mut motion: Vec<DVec3> = bodies.iter().map(|body| velocity(&system.moving[*body])).collect();
    let inverse_mass: Vec<f64> = bodies.iter().map(|body| system.moving[*body][3]).collect();
    let found = enter_none_by_loads(Loads::from(&known), &links, &inverse_mass, &mut motion);
    give(system, &rows, found.as_ref().unwrap_or(&known));
    system.begin_anew();
    found.is_some()
}

/// Rows, in order, with so many rings of those beside them that push, or did before the last sweep.
fn with_rings(system: &System, mut rows: Vec<usize>, rings: usize) -> Vec<usize> {
    let mut is_touched = vec![false; system.moving.len()];
    for _ in 0..rings {
        for body in rows.iter().flat_map(|k| system.rows.row(*k).ends) {
            if let Some(touched) = is_touched.get_mut(body as usize) {
                *touched = true;
            }
        }
        let is_beside = |row: Row| row.ends.iter().any(|body| is_touched.get(*body as usize) == Some(&true));
        let pushes = |k: usize| system.impulses[k] > 0.0 || system.changes[k] != 0.0;
        let wider = (0..system.rows.len())
            .filter(|k| rows.binary_search(k).is_ok() || (pushes(*k) && is_beside(system.rows.row(*k))));
        let wider: Vec<usize> = wider.take(MOST_TOGETHER + 1).collect();
        if wider.len() == rows.len() || wider.len() > MOST_TOGETHER {
            break;
        }
        rows = wider;
    }
    rows
}

/// Gives rows other impulses, and the bodies their velocities by these.
fn give(system: &mut System, rows: &[usize], impulses: &[f64]) {
    for (k, impulse) in rows.iter().zip(impulses) {
        let Row { ends, normal } = system.rows.row(*k);
        let before = std::mem::replace(&mut system.impulses[*k], *impulse);
        push(&mut system.moving, ends, normal, *impulse - before);
    }
}

/// A row as a bound on velocities.
fn link(system: &System, index: usize) -> Link {
    let Row { normal: [x, y, z, _], ends } = system.rows.row(index);
    let [a, b] = ends.map(|body| body as usize);
    let b = (ends[1] != FIXED).then_some(b);
    Link { a, b, towards: DVec3::new(x, y, z), limit: -system.bounds[index] }
}
