//! Candidate sets: bodies connected through shared tiles, found with three stacks (bodies to expand, tiles
//! to look at, bodies collected).
//!
//! Static bodies are collected but never expanded, so at a constant number of them per tile the cost
//! depends on the dynamic bodies alone. Marks of dynamic bodies and tiles last over all sets; those of
//! static bodies only within one, for a wall may matter to several sets.

use std::collections::BTreeSet;

use super::event::BodyRef;
use super::model::Model;
use super::state::State;

/// Bodies that could interact because they share tiles, directly or through other dynamic bodies.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CandidateSet {
    /// In the order found, the seed first.
    pub dynamic: Vec<BodyRef>,
    /// In the order found.
    pub fixed: Vec<BodyRef>,
}

impl CandidateSet {
    /// Pairs to test within the set; two static bodies are none.
    pub fn pair_count(&self) -> usize {
        let n = self.dynamic.len();
        n * n.saturating_sub(1) / 2 + n * self.fixed.len()
    }
}

/// The candidate sets of the bodies where they are registered.
pub(super) fn candidate_sets(model: &Model, state: &State) -> Vec<CandidateSet> {
    let grid = &model.grid;
    sets_by_tile(
        model.present(),
        |body| state.registered[body as usize].tiles().map(|tile| grid.key(tile)).collect(),
        |key| {
            let tile = grid.tile_of_key(key);
            (state.dynamic_tiles.bodies(grid, tile), model.static_tiles.bodies(grid, tile))
        },
    )
}

/// The candidate sets of the dynamic bodies `seeds`. `tiles_of` gives the tiles of a dynamic body;
/// `bodies_in` the dynamic and static bodies in a tile.
fn sets_by_tile(
    seeds: impl Iterator<Item = u32>,
    tiles_of: impl Fn(u32) -> Vec<u64>,
    bodies_in: impl Fn(u64) -> (Vec<u32>, Vec<u32>),
) -> Vec<CandidateSet> {
    let mut used_bodies = BTreeSet::new();
    let mut used_tiles = BTreeSet::new();
    let mut sets = Vec::new();
    for seed in seeds {
        if !used_bodies.insert(seed) {
            continue;
        }
        let mut set = CandidateSet { dynamic: vec![BodyRef::Dynamic(seed)], fixed: Vec::new() };
        let mut used_fixed = BTreeSet::new();
        let mut to_expand = vec![seed];
        let mut tiles = Vec::new();
        while let Some(body) = to_expand.pop() {
            tiles.extend(tiles_of(body).into_iter().filter(|tile| used_tiles.insert(*tile)));
            while let Some(tile) = tiles.pop() {
                let (moving, fixed) = bodies_in(tile);
                for other in moving.iter().copied().filter(|other| used_bodies.insert(*other)) {
                    set.dynamic.push(BodyRef::Dynamic(other));
                    to_expand.push(other);
                }
                let fresh = fixed.iter().copied().filter(|other| used_fixed.insert(*other));
                set.fixed.extend(fresh.map(BodyRef::Static));
            }
        }
        sets.push(set);
    }
    sets
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tiles by body and bodies by tile, as a figure shows them.
    struct Figure {
        moving: Vec<Vec<u64>>,
        fixed: Vec<Vec<u64>>,
    }

    impl Figure {
        fn sets(&self) -> Vec<CandidateSet> {
            let lists = |bodies: &[Vec<u64>], tile: u64| -> Vec<u32> {
                (0u32..)
                    .zip(bodies)
                    .filter(|(_, tiles)| tiles.contains(&tile))
                    .map(|(body, _)| body)
                    .collect()
            };
            let tiles = 0..64;
            let moving: Vec<Vec<u32>> = tiles.clone().map(|tile| lists(&self.moving, tile)).collect();
            let fixed: Vec<Vec<u32>> = tiles.map(|tile| lists(&self.fixed, tile)).collect();
            sets_by_tile(
                0..self.moving.len() as u32,
                |body| self.moving[body as usize].clone(),
                |tile| (moving[tile as usize].clone(), fixed[tile as usize].clone()),
            )
        }
    }

    fn dynamic(ids: &[u32]) -> Vec<BodyRef> {
        ids.iter().map(|id| BodyRef::Dynamic(*id)).collect()
    }

    #[test]
    fn six_bodies_in_sets_of_two_one_and_three_need_four_tests() {
        // Bodies 0 and 1 share tile 1; 2 is alone; 3 and 4 share tile 9, 4 and 5 share tile 10.
        let figure = Figure {
            moving: vec![vec![0, 1], vec![1, 2], vec![5], vec![8, 9], vec![9, 10], vec![10, 11]],
            fixed: vec![],
        };
        let sets = figure.sets();
        assert_eq!(sets.iter().map(|set| set.dynamic.len()).collect::<Vec<_>>(), [2, 1, 3]);
        assert_eq!(sets.iter().map(CandidateSet::pair_count).sum::<usize>(), 4);
    }

    #[test]
    fn a_static_body_is_collected_but_not_expanded_and_may_be_in_two_sets() {
        // 4×4 tiles. A (0) in 0, 1; C (2) in 1, 2; static D in 1, 6; B (1) in 6, 7.
        let figure = Figure { moving: vec![vec![0, 1], vec![6, 7], vec![1, 2]], fixed: vec![vec![1, 6]] };
        let sets = figure.sets();
        assert_eq!(sets.len(), 2);
        assert_eq!(sets[0].dynamic, dynamic(&[0, 2]));
        assert_eq!(sets[1].dynamic, dynamic(&[1]));
        for set in sets {
            assert_eq!(set.fixed, [BodyRef::Static(0)]);
        }
    }

    #[test]
    fn sets_are_the_connected_components() {
        // Against union by brute force over random tilings.
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = move |below: u64| {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            seed % below
        };
        for _ in 0..200 {
            let count = 1 + random(12) as usize;
            let moving: Vec<Vec<u64>> =
                (0..count).map(|_| (0..=random(3)).map(|_| random(24)).collect()).collect();
            let mut component: Vec<usize> = (0..count).collect();
            for _ in 0..count {
                for a in 0..count {
                    for b in 0..count {
                        if moving[a].iter().any(|tile| moving[b].contains(tile)) {
                            let low = component[a].min(component[b]);
                            (component[a], component[b]) = (low, low);
                        }
                    }
                }
            }
            let sets = Figure { moving, fixed: vec![] }.sets();
            for set in &sets {
                let ids: Vec<usize> = set
                    .dynamic
                    .iter()
                    .map(|body| match body {
                        BodyRef::Dynamic(id) | BodyRef::Static(id) => *id as usize,
                    })
                    .collect();
                assert!(ids.iter().all(|id| component[*id] == component[ids[0]]));
            }
            let mut roots = component.clone();
            roots.sort_unstable();
            roots.dedup();
            assert_eq!(sets.len(), roots.len());
        }
    }
}
