//! Pairs of balls that overlap, found in cells as wide as the largest of them.

use glam::DVec3;

/// A ball with its radius, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub at: DVec3,
    pub radius: f64,
}

/// Bits of a coordinate of a cell.
const BITS: u32 = 21;
/// Most cells along an axis: one bit less, so that neighbours of a cell have coordinates too.
const MOST_CELLS: f64 = (1_u32 << (BITS - 1)) as f64;

/// Keys from a cell to the middle ones of the rows of neighbours after it: along y, then along z.
const ROWS: [u64; 4] =
    [1 << BITS, (1 << (2 * BITS)) - (1 << BITS), 1 << (2 * BITS), (1 << (2 * BITS)) + (1 << BITS)];

/// Gives each pair of balls that overlap once, by their places. Cells are sorted so that neighbours along x follow each
/// other, and each row of them is gone through once.
pub(super) fn for_each_overlap(balls: &[Ball], mut give: impl FnMut(u32, u32)) {
    let sorted = sorted_by_cell(balls);
    let mut starts = [0; ROWS.len()];
    for (nth, (key, ball, place)) in sorted.iter().enumerate() {
        let mut look = |from: usize, last: u64| {
            for (_, other, place_of_other) in sorted[from..].iter().take_while(|(key, ..)| *key <= last) {
                let both = ball.radius + other.radius;
                if (other.at - ball.at).length_squared() <= both * both {
                    give(*place, *place_of_other);
                }
            }
        };
        look(nth + 1, key + 1);
        for (start, row) in starts.iter_mut().zip(ROWS) {
            let first = key + row - 1;
            *start += sorted[*start..].iter().take_while(|(key, ..)| *key < first).count();
            look(*start, first + 2);
        }
    }
}

/// The balls with their places, by the keys of their cells.
fn sorted_by_cell(balls: &[Ball]) -> Vec<(u64, Ball, u32)> {
    let (mut low, mut high, mut largest) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0.0_f64);
    for ball in balls {
        (low, high, largest) = (low.min(ball.at), high.max(ball.at), largest.max(ball.radius));
    }
    let width = (2.0 * largest).max((high - low).max_element() / MOST_CELLS);
    let key = |ball: &Ball| {
        let [x, y, z] = ((ball.at - low) / width).to_array().map(|cell| cell as u64 + 1);
        (z << (2 * BITS)) | (y << BITS) | x
    };
    let mut sorted: Vec<(u64, Ball, u32)> =
        (0..).zip(balls).map(|(place, ball)| (key(ball), *ball, place)).collect();
    sorted.sort_unstable_by_key(|(key, _, place)| (*key, *place));
    sorted
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn pairs_are_those_of_trying_all() {
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        // In a cube, in a plane, along a line.
        for size in [DVec3::splat(10.0), DVec3::new(20.0, 0.0, 20.0), DVec3::new(0.0, 1e7, 0.0)] {
            let mut ball =
                || Ball { at: DVec3::new(random(), random(), random()) * size - 3.0, radius: 0.2 + random() };
            let balls: Vec<Ball> = (0..300).map(|_| ball()).collect();
            let mut got = Vec::new();
            for_each_overlap(&balls, |a, b| got.push((a.min(b), a.max(b))));
            let overlap = |a: &Ball, b: &Ball| a.at.distance(b.at) <= a.radius + b.radius;
            let expected: BTreeSet<(u32, u32)> = (0..300_u32)
                .flat_map(|a| (a + 1..300).map(move |b| (a, b)))
                .filter(|(a, b)| overlap(&balls[*a as usize], &balls[*b as usize]))
                .collect();
            assert_eq!(got.len(), expected.len(), "each once");
            assert_eq!(got.into_iter().collect::<BTreeSet<_>>(), expected);
        }
    }
}
