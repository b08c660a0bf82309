//! Pairs of balls that overlap, found in cells as wide as the largest of about their size.

use std::collections::BTreeMap;

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

/// Of the balls of a level none is larger than four times another, so that few of the smallest are in a cell: a
/// hierarchical grid (C. Ericson, Real-Time Collision Detection, 7.2).
const BITS_OF_LEVEL: u64 = 2;
/// Smaller balls are in the level of the smallest.
const MOST_LEVELS: u64 = 32;

/// Gives each pair of balls that overlap once, by their places.
pub(super) fn for_each_overlap(balls: &[Ball], mut give: impl FnMut(u32, u32)) {
    let levels = levels(balls);
    for (nth, level) in levels.iter().enumerate() {
        level.for_each_overlap(&mut give);
        for larger in &levels[..nth] {
            for (_, ball, place) in &level.sorted {
                larger.for_each_over(ball, |other| give(*place, other));
            }
        }
    }
}

/// Balls of about one size by their cells, which are as wide as the largest of them.
struct Level {
    low: DVec3,
    width: f64,
    /// With their places, by the keys of their cells.
    sorted: Vec<(u64, Ball, u32)>,
}

/// The balls by size, the largest first.
fn levels(balls: &[Ball]) -> Vec<Level> {
    let exponent = |radius: f64| radius.to_bits() >> (f64::MANTISSA_DIGITS - 1);
    let largest = balls.iter().map(|ball| exponent(ball.radius)).max().unwrap_or(0);
    let mut levels: BTreeMap<u64, Vec<(u64, Ball, u32)>> = BTreeMap::new();
    for (place, ball) in (0..).zip(balls) {
        let level = ((largest - exponent(ball.radius)) / BITS_OF_LEVEL).min(MOST_LEVELS);
        levels.entry(level).or_default().push((0, *ball, place));
    }
    levels.into_values().map(Level::new).collect()
}

impl Level {
    fn new(mut balls: Vec<(u64, Ball, u32)>) -> Self {
        let (mut low, mut high, mut largest) = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0.0_f64);
        for (_, ball, _) in &balls {
            (low, high, largest) = (low.min(ball.at), high.max(ball.at), largest.max(ball.radius));
        }
        let width = (2.0 * largest).max((high - low).max_element() / MOST_CELLS);
        for (key, ball, _) in &mut balls {
            let [x, y, z] = ((ball.at - low) / width).to_array().map(|cell| cell as u64 + 1);
            *key = (z << (2 * BITS)) | (y << BITS) | x;
        }
        balls.sort_unstable_by_key(|(key, _, place)| (*key, *place));
        Self { low, width, sorted: balls }
    }

    /// Pairs among them: cells are sorted so that neighbours along x follow each other, and each row of them is gone through
    /// once.
    fn for_each_overlap(&self, give: &mut impl FnMut(u32, u32)) {
        let mut starts = [0; ROWS.len()];
        for (nth, (key, ball, place)) in self.sorted.iter().enumerate() {
            let mut look = |from: usize, last: u64| {
                for (_, other, place_of_other) in self.upto(from, last) {
                    if overlap(ball, other) {
                        give(*place, *place_of_other);
                    }
                }
            };
            look(nth + 1, key + 1);
            for (start, row) in starts.iter_mut().zip(ROWS) {
                let first = key + row - 1;
                *start += self.sorted[*start..].iter().take_while(|(key, ..)| *key < first).count();
                look(*start, first + 2);
            }
        }
    }

    /// Those that overlap a smaller ball: in its cell and the neighbours.
    fn for_each_over(&self, ball: &Ball, mut give: impl FnMut(u32)) {
        // Those of this level are in cells from 1 on.
        let cell = ((ball.at - self.low) / self.width).floor() + 1.0;
        let [x, y, z] = cell.to_array().map(|middle| {
            let ends = [middle - 1.0, middle + 1.0].map(|end| end.clamp(0.0, 2.0 * MOST_CELLS - 1.0) as u64);
            ends[0]..=ends[1]
        });
        for z in z {
            for y in y.clone() {
                let row = (z << (2 * BITS)) | (y << BITS);
                let from = self.sorted.partition_point(|(key, ..)| *key < row | x.start());
                for (_, other, place) in self.upto(from, row | x.end()) {
                    if overlap(ball, other) {
                        give(*place);
                    }
                }
            }
        }
    }

    fn upto(&self, from: usize, last: u64) -> impl Iterator<Item = &(u64, Ball, u32)> {
        self.sorted[from..].iter().take_while(move |(key, ..)| *key <= last)
    }
}

fn overlap(one: &Ball, other: &Ball) -> bool {
    let both = one.radius + other.radius;
    (other.at - one.at).length_squared() <= both * both
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
            let mut balls: Vec<Ball> = (0..300).map(|_| ball()).collect();
            // Few are large, and some small.
            for ball in balls.iter_mut().step_by(60) {
                ball.radius *= 20.0;
            }
            balls.iter_mut().skip(1).step_by(5).for_each(|ball| ball.radius *= 1e-2);
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
