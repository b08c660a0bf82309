//! Names for copies and new things: "wall 2" where there is a "wall" already.

use rustc_hash::{FxHashMap, FxHashSet};

/// Numbers from here on are part of a name: they leave no room to count.
const TOO_LARGE: u64 = 1_000_000_000;

/// Names in use.
#[derive(Clone, Debug, Default)]
pub struct Names {
    taken: FxHashSet<String>,
    /// The number to try next behind each stem.
    next: FxHashMap<String, u64>,
}

impl Names {
    pub fn new<'a>(taken: impl Iterator<Item = &'a str>) -> Self {
        Self { taken: taken.map(str::to_owned).collect(), next: FxHashMap::default() }
    }

    /// The name itself, or the next free one: `wall 3` where `wall` and `wall 2` are taken, or for `wall 2`.
    pub fn take(&mut self, name: &str) -> String {
        if self.taken.insert(name.to_owned()) {
            return name.to_owned();
        }
        let (stem, number) = numbered(name);
        let next = self.next.entry(stem.to_owned()).or_insert(2);
        *next = (*next).max(number.saturating_add(1));
        loop {
            let name = format!("{stem} {next}");
            *next = next.saturating_add(1);
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// What a name is without its number, and the number: 1 if it has none.
fn numbered(name: &str) -> (&str, u64) {
    let number = |(stem, digits): (&'_ str, &str)| {
        let is_number = digits.bytes().all(|byte| byte.is_ascii_digit()) && !stem.is_empty();
        is_number.then(|| digits.parse().ok()).flatten().filter(|number| *number < TOO_LARGE)
    };
    let parts = name.rsplit_once(' ');
    match (parts, parts.and_then(number)) {
        (Some((stem, _)), Some(number)) => (stem, number),
        _ => (name, 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_is_taken_gets_the_next_number() {
        let mut names = Names::new(["wall", "wall 3", "7", "a "].into_iter());
        let taken =
            ["floor", "wall", "wall", "wall 3", "wall 9", "wall 9", "7", "a "].map(|name| names.take(name));
        assert_eq!(taken, ["floor", "wall 2", "wall 4", "wall 5", "wall 9", "wall 10", "7 2", "a  2"]);
        let largest = format!("x {}", u64::MAX);
        let mut names = Names::new([largest.as_str()].into_iter());
        assert_eq!(names.take(&largest), format!("{largest} 2"));
    }
}
