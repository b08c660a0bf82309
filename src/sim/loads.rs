//! The nearest motion within bounds where it can be had from the loads: a dual active set method that exchanges all
//! bounds at once (Bergounioux, Ito & Kunisch 1999), and starts from what it found last.
//!
//! The loads λ ≥ 0 of the bounds that are met, the set, solve A λ = N w − limit with A = N M⁻¹ Nᵀ. They are improved by
//! steps of (A + σ diag A)⁻¹, the proximal point method: bounds that depend on each other do no harm then, and share
//! their load with the least forces. The motion is made from the loads anew after each step, and what it oversteps is
//! the measure: so the factor may be that of a problem nearby, and its rounding does not matter. What rounding makes of
//! the motion itself does: where loads exceed the motion by far (a heavy ball on a light one), or where no loads meet
//! all bounds, there is no answer here, and [`super::nearest`] looks for it by search.

use glam::DVec3;

use super::link::{Link, Solved};
use super::tolerance::{
    ENTERING, HELD_ALONE, LEFT_OVER, LOADED, MOST_EXCHANGES, MOST_STEPS, NONE_BESIDE, PROJECTED, PROXIMAL,
    STALE,
};

/// Loads of one problem, from which that of the next one like it starts: of the same links, a little later.
#[derive(Clone, Debug, Default)]
pub(super) struct Loads {
    /// Of all links.
    multipliers: Vec<f64>,
    /// The links that are at their limits, in order.
    set: Vec<usize>,
    /// Of the set, for this problem or one before.
    factor: Option<Factor>,
}

/// A motion to be brought within bounds.
#[derive(Clone, Copy)]
pub(super) struct Problem<'a> {
    pub links: &'a [Link],
    /// Which links are to be kept from leaving too.
    pub both: &'a [bool],
    pub inverse_mass: &'a [f64],
}

impl Loads {
    /// To start from loads that are known from elsewhere.
    pub fn from(multipliers: &[f64]) -> Self {
        Self { multipliers: multipliers.to_vec(), ..Self::default() }
    }

    /// Turns a motion into the nearest one within the bounds; `None` where that can't be told from the loads.
    pub fn bring_within(&mut self, problem: &Problem<'_>, motion: &mut [DVec3]) -> Option<Solved> {
        let mut at = self.start(problem, motion);
        self.iterate(problem, motion, &mut at)?;
        let most = LOADED * problem.largest(motion);
        let is_overloaded = at.sizes.iter().any(|size| *size > most);
        if is_overloaded || self.defect(problem, &at) > PROJECTED * problem.energy(motion) {
            return None;
        }
        for ((w, found), size) in motion.iter_mut().zip(&at.motion).zip(&at.sizes) {
            *w = if found.length() <= LEFT_OVER * size.max(at.least) { DVec3::ZERO } else { *found };
        }
        Some(Solved { multipliers: self.multipliers.clone(), sizes: at.sizes, is_unmet: false })
    }

    /// The same where digits lost to loads that exceed the motion by far do no harm.
    pub fn bring_near(&mut self, problem: &Problem<'_>, motion: &mut [DVec3]) -> Option<Vec<f64>> {
        let mut at = self.start(problem, motion);
        self.iterate(problem, motion, &mut at)?;
        motion.copy_from_slice(&at.motion);
        Some(self.multipliers.clone())
    }

    /// How far the motion found is from a projection, Σ λ·(N w − limit), J for velocities: the loads enlarge what rounding
    /// leaves.
    fn defect(&self, problem: &Problem<'_>, at: &Under) -> f64 {
        self.set.iter().map(|k| (self.multipliers[*k] * at.excess(problem, *k)).abs()).sum()
    }

    /// The motion under the loads known. Without any, all bounds that are overstepped are of the set.
    fn start(&mut self, problem: &Problem<'_>, free: &[DVec3]) -> Under {
        let count = problem.links.len();
        let is_new = self.multipliers.len() != count;
        if is_new {
            self.multipliers = vec![0.0; count];
        }
        let at = Under::of(problem, &self.multipliers, free);
        let is_in = |k: &usize| {
            problem.both[*k] || self.multipliers[*k] > 0.0 || (is_new && at.oversteps(problem, *k))
        };
        let set: Vec<usize> = (0..count).filter(is_in).collect();
        if self.set != set {
            (self.set, self.factor) = (set, None);
        }
        at
    }

    /// Steps until no bound is overstepped, none of the set is left, and none pulls.
    fn iterate(&mut self, problem: &Problem<'_>, free: &[DVec3], at: &mut Under) -> Option<()> {
        let mut exchanges = 0;
        let (mut is_own, mut last) = (false, f64::INFINITY);
        for _ in 0..MOST_STEPS {
            let mut left: Vec<f64> = self.set.iter().map(|k| at.excess(problem, *k)).collect();
            let is_met = |(k, left): (&usize, &f64)| left.abs() <= at.tolerance(problem, *k);
            let are_met = self.set.iter().zip(&left).all(is_met);
            if !are_met {
                let worst = left.iter().map(|left| left.abs()).fold(0.0, f64::max);
                if self.factor.is_none() || (!is_own && worst > STALE * last) {
                    self.factor = Some(Factor::of(problem, &self.set, PROXIMAL)?);
                    is_own = true;
                }
                last = worst;
                self.factor.as_ref()?.solve(&mut left);
                for (k, more) in self.set.iter().zip(left) {
                    self.multipliers[*k] += more;
                }
                *at = Under::of(problem, &self.multipliers, free);
            }
            // Loads that the factor of another problem leads to say nothing until all is met.
            if are_met || is_own {
                if self.exchange(problem, at) {
                    exchanges += 1;
                    if exchanges > MOST_EXCHANGES {
                        return None;
                    }
                    *at = Under::of(problem, &self.multipliers, free);
                } else if are_met {
                    return Some(());
                }
            }
        }
        None
    }

    /// Takes the links that pull out of the set, which bear no load then, and those that are overstepped into it;
    /// whether there are any.
    fn exchange(&mut self, problem: &Problem<'_>, at: &Under) -> bool {
        let mut of = self.set.iter().copied().peekable();
        let mut set = Vec::with_capacity(self.set.len());
        let mut has_changed = false;
        for k in 0..problem.links.len() {
            let was_in = of.next_if_eq(&k).is_some();
            let pulls = !problem.both[k] && self.multipliers[k] < 0.0;
            let is_in = if was_in { !pulls } else { at.oversteps(problem, k) };
            if is_in {
                set.push(k);
            } else {
                self.multipliers[k] = 0.0;
            }
            has_changed |= was_in != is_in;
        }
        if has_changed {
            (self.set, self.factor) = (set, None);
        }
        has_changed
    }
}

impl Problem<'_> {
    /// Σ m|w|² of the bodies that can move.
    fn energy(&self, motion: &[DVec3]) -> f64 {
        let bodies = motion.iter().zip(self.inverse_mass).filter(|(_, inverse)| **inverse > 0.0);
        bodies.map(|(w, inverse)| w.length_squared() / inverse).sum()
    }

    /// The largest of a motion's and of the limits.
    fn largest(&self, motion: &[DVec3]) -> f64 {
        let limits = self.links.iter().map(|link| link.limit);
        motion.iter().map(|w| w.length()).chain(limits).fold(0.0, f64::max)
    }
}

/// The motion under some loads.
struct Under {
    motion: Vec<DVec3>,
    /// Length of all that each body's motion is the sum of.
    sizes: Vec<f64>,
    /// A motion shorter than this is none beside the others.
    least: f64,
}

impl Under {
    fn of(problem: &Problem<'_>, multipliers: &[f64], free: &[DVec3]) -> Self {
        let mut motion = free.to_vec();
        let mut sizes: Vec<f64> = free.iter().map(|w| w.length()).collect();
        let least = NONE_BESIDE * problem.largest(free);
        for (link, load) in problem.links.iter().zip(multipliers).filter(|(_, load)| **load != 0.0) {
            link.push(&mut motion, problem.inverse_mass, *load);
            sizes[link.a] += load.abs() * problem.inverse_mass[link.a];
            if let Some(b) = link.b {
                sizes[b] += load.abs() * problem.inverse_mass[b];
            }
        }
        Self { motion, sizes, least }
    }

    fn excess(&self, problem: &Problem<'_>, k: usize) -> f64 {
        problem.links[k].entering(&self.motion) - problem.links[k].limit
    }

    fn tolerance(&self, problem: &Problem<'_>, k: usize) -> f64 {
        ENTERING * problem.links[k].size_of(&self.sizes).max(self.least)
    }

    fn oversteps(&self, problem: &Problem<'_>, k: usize) -> bool {
        self.excess(problem, k) > self.tolerance(problem, k)
    }
}

/// What a unit of force at each link changes there while all the others hold, 1/(A⁻¹)ₖₖ; `None` where that is next to
/// nothing for one of them, so that rounding could decide.
pub(super) fn responses_of(links: &[Link], inverse_mass: &[f64]) -> Option<Vec<f64>> {
    let problem = Problem { links, both: &[], inverse_mass };
    let all: Vec<usize> = (0..links.len()).collect();
    let factor = Factor::of(&problem, &all, 0.0)?;
    let response = |k: usize| {
        let mut unit = vec![0.0; links.len()];
        unit[k] = 1.0;
        factor.solve(&mut unit);
        let response = 1.0 / unit[k];
        (response > HELD_ALONE * links[k].response(&links[k], inverse_mass)).then_some(response)
    };
    all.iter().map(|k| response(*k)).collect()
}

/// The triangle L of A + σ diag A = L Lᵀ for the links of a set. Rows are kept from their first entry on, before which
/// L has none either.
#[derive(Clone, Debug)]
struct Factor {
    rows: Vec<Row>,
    entries: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Row {
    /// Column of its first entry.
    first: usize,
    /// Where its entries begin.
    start: usize,
}

impl Factor {
    /// `None` if the links can't be told apart, or nothing moves the bodies of one.
    fn of(problem: &Problem<'_>, set: &[usize], proximal: f64) -> Option<Self> {
        let mut factor = Self { rows: Vec::with_capacity(set.len()), entries: Vec::new() };
        for i in 0..set.len() {
            let link = &problem.links[set[i]];
            let shares = |k: &usize| problem.links[*k].shares_body(link);
            let first = set[..i].iter().position(shares).unwrap_or(i);
            factor.rows.push(Row { first, start: factor.entries.len() });
            for k in &set[first..=i] {
                factor.entries.push(link.response(&problem.links[*k], problem.inverse_mass));
            }
            factor.reduce_last(proximal)?;
        }
        Some(factor)
    }

    /// Turns the last row from one of A into one of L; `None` if nothing is left of its diagonal.
    fn reduce_last(&mut self, proximal: f64) -> Option<()> {
        let i = self.rows.len() - 1;
        let Row { first, start } = self.rows[i];
        let (above, row) = self.entries.split_at_mut(start);
        for j in first..i {
            let Row { first: other, start } = self.rows[j];
            let from = first.max(other);
            let theirs = &above[start + from - other..=start + j - other];
            let (diagonal, theirs) = theirs.split_last()?;
            row[j - first] = (row[j - first] - dot(&row[from - first..j - first], theirs)) / diagonal;
        }
        let (diagonal, before) = row.split_last_mut()?;
        let left = *diagonal * (1.0 + proximal) - dot(before, before);
        *diagonal = left.sqrt();
        (left > 0.0).then_some(())
    }

    /// The row of L up to its diagonal, and that.
    fn row(&self, i: usize) -> (usize, &[f64], f64) {
        let Row { first, start } = self.rows[i];
        let diagonal = start + i - first;
        (first, &self.entries[start..diagonal], self.entries[diagonal])
    }

    /// Replaces a right hand side by the solution.
    fn solve(&self, right: &mut [f64]) {
        for i in 0..right.len() {
            let (first, row, diagonal) = self.row(i);
            right[i] = (right[i] - dot(row, &right[first..i])) / diagonal;
        }
        for i in (0..right.len()).rev() {
            let (first, row, diagonal) = self.row(i);
            right[i] /= diagonal;
            let known = right[i];
            for (value, entry) in right[first..i].iter_mut().zip(row) {
                *value -= known * entry;
            }
        }
    }
}

/// In four sums, which a processor adds at once.
fn dot(left: &[f64], right: &[f64]) -> f64 {
    let (lefts, left) = left.as_chunks::<4>();
    let (rights, right) = right.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (left, right) in lefts.iter().zip(rights) {
        for (sum, (l, r)) in sums.iter_mut().zip(left.iter().zip(right)) {
            *sum += l * r;
        }
    }
    let rest: f64 = left.iter().zip(right).map(|(l, r)| l * r).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
