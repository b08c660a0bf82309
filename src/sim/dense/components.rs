//! The components of the list: members connected by pairs, each with its pairs in the order in which they are swept.

use super::data::{Component, Dense, Listed, Role};
use super::stepped::{FIXED, Near};

/// Finds the components of a new list, of which these are the forces, N.
pub(super) fn find(dense: &mut Dense, forces: &[f64]) {
    let mut roots = roots(dense);
    let mut components: Vec<Component> = Vec::new();
    // Memory to be used again.
    let mut works = std::mem::take(&mut dense.components).into_iter().map(|component| component.work);
    let mut places: Vec<(u32, u32)> = Vec::with_capacity(dense.members.len());
    for slot in 0..dense.members.len() as u32 {
        let root = root(&mut roots, slot);
        let number = if root == slot {
            components.push(Component { work: works.next().unwrap_or_default(), ..Component::default() });
            components.len() as u32 - 1
        } else {
            places[root as usize].0
        };
        let slots = &mut components[number as usize].slots;
        places.push((number, slots.len() as u32));
        slots.push(slot);
    }
    let is_large = |slot: u32| components[places[slot as usize].0 as usize].slots.len() >= LARGE;
    for index in in_order_of_colours(&dense.pairs, dense.members.len(), is_large) {
        let Listed { pair, slots: [a, b] } = dense.pairs[index as usize];
        let (number, a) = places[a as usize];
        let b = if b == FIXED { FIXED } else { places[b as usize].1 };
        let component = &mut components[number as usize];
        component.near.push(Near { pair, listed: index, a, b, force: forces[index as usize] });
        let is_frozen = |body: u32| matches!(dense.role(body), Role::Frozen(_));
        if b == FIXED && pair.dynamic().any(is_frozen) {
            component.with_frozen.push(index);
        }
    }
    dense.components = components;
}

/// For each member one of its component; the first of a component is its root.
fn roots(dense: &Dense) -> Vec<u32> {
    let mut roots: Vec<u32> = (0..dense.members.len() as u32).collect();
    for listed in &dense.pairs {
        let [a, b] = listed.slots;
        if b != FIXED {
            let (a, b) = (root(&mut roots, a), root(&mut roots, b));
            roots[a.max(b) as usize] = a.min(b);
        }
    }
    roots
}

fn root(roots: &mut [u32], mut slot: u32) -> u32 {
    while roots[slot as usize] != slot {
        roots[slot as usize] = roots[roots[slot as usize] as usize];
        slot = roots[slot as usize];
    }
    slot
}

/// Members from which a component is swept by colours. In the order of its bodies an impulse goes through a column in one
/// sweep, by colours two contacts further; where many are swept the processor's time counts more.
const LARGE: usize = 200;

/// The pairs in their order; those of large components by colours, of which none has a body twice: what follows each
/// other does not wait for each other. The colours are greedy ones, pairs of two members before those of one.
fn in_order_of_colours(pairs: &[Listed], members: usize, is_large: impl Fn(u32) -> bool) -> Vec<u32> {
    let mut taken = vec![0_u64; members];
    let mut colours: Vec<(u32, u32)> = Vec::with_capacity(pairs.len());
    for (index, listed) in (0..).zip(pairs) {
        let [a, b] = listed.slots;
        if !is_large(a) {
            colours.push((0, index));
            continue;
        }
        let others = taken.get(b as usize).copied().unwrap_or_default();
        // Who is in more than 64 pairs has several of the last colour.
        let colour = (!(taken[a as usize] | others)).trailing_zeros().min(63);
        taken[a as usize] |= 1 << colour;
        if let Some(taken) = taken.get_mut(b as usize) {
            *taken |= 1 << colour;
        }
        colours.push((colour + if b == FIXED { 64 } else { 0 }, index));
    }
    colours.sort_unstable();
    colours.into_iter().map(|(_, index)| index).collect()
}
