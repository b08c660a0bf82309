//! What format 1.1 added: physics that an older reader would silently leave out.

/// Elements of 1.1, by name. The order is that of the list a user sees.
pub(in crate::scene) const NAMES: [&str; 11] = [
    "SpaceAverse",
    "Friction",
    "RollingFriction",
    "Tangential",
    "Material",
    "InitialAngularVelocity",
    "Box",
    "Cylinder",
    "Mesh",
    "Compound",
    "Solver",
];

/// A use of an element of 1.1 and its place.
pub(super) type Use = (&'static str, Option<u32>);

/// Adds an element to the uses if it is one of 1.1.
pub(super) fn note(uses: &mut Vec<Use>, name: &str, at: Option<u32>) {
    uses.extend(NAMES.iter().find(|&&candidate| candidate == name).map(|&name| (name, at)));
}

/// How often a document uses each element of 1.1, and where first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::scene) struct FeatureCounts {
    counts: [u32; NAMES.len()],
    first: [Option<u32>; NAMES.len()],
}

impl FeatureCounts {
    /// Counts an element of 1.1.
    pub fn add(&mut self, (name, at): Use) {
        if let Some(slot) = NAMES.iter().position(|&candidate| candidate == name) {
            if self.counts[slot] == 0 {
                self.first[slot] = at;
            }
            self.counts[slot] += 1;
        }
    }

    /// Name, number and first place of each that is used.
    pub fn used(&self) -> impl Iterator<Item = (&'static str, u32, Option<u32>)> {
        let rows = NAMES.iter().zip(self.counts).zip(self.first);
        rows.filter(|((_, count), _)| *count > 0).map(|((&name, count), first)| (name, count, first))
    }

    pub fn is_empty(&self) -> bool {
        self.counts.iter().all(|&count| count == 0)
    }

    /// Whether some element is used more often than in `before`.
    pub fn exceeds(&self, before: &Self) -> bool {
        self.counts.iter().zip(before.counts).any(|(&now, then)| now > then)
    }
}
