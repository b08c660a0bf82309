//! The event queue: what is predicted to happen next. Order is (time, kind, bodies), never the order of
//! insertion, so the same predictions give the same run.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::body::BodyId;
use super::pair::Pair;

/// What is predicted. The order of the variants breaks ties in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// The body's segment ends: a new one is due.
    SegmentEnd,
    /// The body leaves the tiles it is registered in.
    LeaveTiles,
    /// A body comes within the core radius of point attractor `b`.
    CorePass,
    /// The last of the skipped bounces of two bodies on each other would end.
    Settled,
    /// Two bodies in lasting contact part.
    ContactEnd,
    /// A body comes near a stepped one.
    Reach,
    /// Two bodies touch.
    Impact,
}

/// A prediction, good as long as the bodies it was made for have not changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Predicted {
    /// Model time, s.
    pub time: f64,
    pub kind: Kind,
    /// A dynamic body.
    pub a: u32,
    /// The other body; [`BodyId::NONE`] where it is about one alone. A point attractor has its number among the
    /// forces, as a static body.
    pub b: BodyId,
    /// Number of the segment of `a`, and of `b` where that is a dynamic body, at the prediction.
    pub stamp_a: u32,
    pub stamp_b: u32,
}

impl Predicted {
    /// The two bodies of a kind that is about two.
    pub fn pair(&self) -> Pair {
        Pair::of(self.a, self.b)
    }

    fn key_order(&self, other: &Self) -> Ordering {
        match self.time.total_cmp(&other.time) {
            Ordering::Equal => self.tie_order(other),
            order => order,
        }
    }

    /// Ties of time and kind: what is between dynamic bodies first.
    #[cold]
    fn tie_order(&self, other: &Self) -> Ordering {
        self.kind
            .cmp(&other.kind)
            .then(self.b.is_static().cmp(&other.b.is_static()))
            .then(self.a.cmp(&other.a))
            .then(self.b.cmp(&other.b))
            .then(self.stamp_a.cmp(&other.stamp_a))
            .then(self.stamp_b.cmp(&other.stamp_b))
    }
}

/// Reversed, so that the heap's greatest entry is the earliest.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry(Predicted);

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.key_order(&self.0)
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What is near in time lies in a heap, the rest in no order at all (the two ends of a ladder queue: Tang, Goh
/// & Thng 2005). Most predictions are overtaken by an earlier impact of one of their bodies while they are far
/// off, and so are never sorted; and the heap is small enough for the processor's fast memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Queue {
    near: BinaryHeap<Entry>,
    far: Vec<Entry>,
    /// The earliest of `far` when it was made, or earlier: what comes before it belongs to `near`. `None`
    /// while `far` is empty.
    horizon: Option<Entry>,
    /// Size at which stale entries are swept out.
    sweep_at: usize,
    /// Size of `near` at which some of it is sent to `far`.
    spill_at: usize,
}

/// Below this size the order is left to the heap alone.
const SMALLEST_SWEEP: usize = 1024;

/// Of this many entries the earliest goes to the heap.
const SHARE: usize = 16;

impl Queue {
    /// All predictions, in no order, with those that hold no more.
    pub fn iter(&self) -> impl Iterator<Item = &Predicted> {
        self.near.iter().chain(&self.far).map(|Entry(predicted)| predicted)
    }

    pub fn push(&mut self, predicted: Predicted) {
        let entry = Entry(predicted);
        // Entries are ordered in reverse: the later is the lesser.
        if self.horizon.is_some_and(|horizon| entry <= horizon) {
            self.far.push(entry);
        } else {
            self.near.push(entry);
        }
    }

    /// The earliest prediction that still holds, if it is not after `until`.
    pub fn pop(
        &mut self,
        until: f64,
        dropped: &mut u64,
        mut holds: impl FnMut(&Predicted) -> bool,
    ) -> Option<Predicted> {
        loop {
            let Some(Entry(next)) = self.near.peek().copied() else {
                if self.far.is_empty() {
                    return None;
                }
                self.divide(&mut holds);
                continue;
            };
            if next.time > until {
                return None;
            }
            self.near.pop();
            if holds(&next) {
                return Some(next);
            }
            *dropped += 1;
        }
    }

    /// Sweeps stale entries out when there may be more of them than of good ones.
    pub fn tidy(&mut self, holds: impl FnMut(&Predicted) -> bool) {
        if self.len() >= self.sweep_at.max(SMALLEST_SWEEP)
            || self.near.len() >= self.spill_at.max(SMALLEST_SWEEP)
        {
            self.divide(holds);
        }
    }

    fn len(&self) -> usize {
        self.near.len() + self.far.len()
    }

    /// Drops all stale entries and divides the others anew into near and far.
    fn divide(&mut self, mut holds: impl FnMut(&Predicted) -> bool) {
        self.far.extend(self.near.drain());
        self.far.retain(|entry| holds(&entry.0));
        let near = (self.far.len() / SHARE).max(SMALLEST_SWEEP / 4).min(self.far.len());
        let later = self.far.len() - near;
        self.horizon = (later > 0).then(|| *self.far.select_nth_unstable(later - 1).1);
        self.near.extend(self.far.drain(later..));
        self.sweep_at = 2 * self.len();
        self.spill_at = 4 * near;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn predicted(time: f64, a: u32, stamp_a: u32) -> Predicted {
        Predicted { time, kind: Kind::Impact, a, b: BodyId::of_dynamic(a + 1), stamp_a, stamp_b: 0 }
    }

    const BODIES: usize = 2000;

    /// Random pushes, pops and changes of stamps, against a list that is searched anew each time; of so many bodies that most
    /// of what is predicted lies in no order.
    #[test]
    fn gives_what_a_searched_list_gives() {
        let mut source = Random::new(1);
        let mut random = move |below: usize| source.below(below);
        let mut queue = Queue::default();
        let mut list: Vec<Predicted> = Vec::new();
        let mut stamps = [0_u32; BODIES];
        let (mut popped, mut pushed_far, mut ran_out) = (0, 0, 0);
        for step in 0..60_000 {
            // It fills, and is emptied, by turns.
            let pushes = if step / 6000 % 2 == 0 { 12 } else { 3 };
            match random(16) {
                kind if kind < pushes => {
                    let body = random(BODIES) as u32;
                    // Few different times, so that ties are common.
                    let next = predicted(random(40) as f64 * 0.25, body, stamps[body as usize]);
                    let far = queue.far.len();
                    queue.push(next);
                    pushed_far += queue.far.len() - far;
                    list.push(next);
                }
                kind if kind == pushes => stamps[random(BODIES)] += 1,
                _ => {
                    let until = random(60) as f64 * 0.25;
                    let holds = |p: &Predicted| stamps[p.a as usize] == p.stamp_a;
                    list.retain(holds);
                    let first = list.iter().copied().filter(|p| p.time <= until).min_by(Predicted::key_order);
                    let far = queue.far.len();
                    assert_eq!(queue.pop(until, &mut 0, holds), first);
                    ran_out += usize::from(queue.far.len() < far);
                    if let Some(first) = first {
                        let at = list.iter().position(|p| *p == first).unwrap();
                        list.remove(at);
                        popped += 1;
                    }
                    queue.tidy(holds);
                }
            }
        }
        let exercised = [popped, pushed_far, ran_out];
        assert!(
            popped > 1000 && pushed_far > 1000 && ran_out > 10,
            "the test must exercise the queue: {exercised:?}"
        );
    }

    #[test]
    fn order_of_insertion_does_not_matter() {
        let events = [predicted(1.0, 3, 0), predicted(1.0, 1, 0), predicted(0.5, 9, 0), predicted(1.0, 2, 0)];
        let order = |indices: [usize; 4]| {
            let mut queue = Queue::default();
            indices.into_iter().for_each(|index| queue.push(events[index]));
            std::iter::from_fn(|| queue.pop(9.0, &mut 0, |_| true)).map(|p| p.a).collect::<Vec<_>>()
        };
        assert_eq!(order([0, 1, 2, 3]), [9, 1, 2, 3]);
        assert_eq!(order([3, 2, 1, 0]), [9, 1, 2, 3]);
    }

    /// A body that touches another and a wall at once meets the other first, whatever their numbers.
    #[test]
    fn at_one_time_what_is_between_dynamic_bodies_comes_first() {
        let mut queue = Queue::default();
        let wall = Predicted { b: BodyId::of_static(0), ..predicted(1.0, 2, 0) };
        [wall, predicted(1.0, 7, 0), predicted(1.0, 2, 0)].into_iter().for_each(|p| queue.push(p));
        let order = std::iter::from_fn(|| queue.pop(1.0, &mut 0, |_| true)).map(|p| (p.a, p.b.is_static()));
        assert_eq!(order.collect::<Vec<_>>(), [(2, false), (7, false), (2, true)]);
    }

    #[test]
    fn stale_entries_do_not_pile_up() {
        let mut queue = Queue::default();
        for stamp in 0..200_000 {
            queue.push(predicted(1e6, 0, stamp));
            queue.tidy(|p| p.stamp_a == stamp);
        }
        assert!(queue.len() <= 2 * SMALLEST_SWEEP, "{}", queue.len());
    }
}
