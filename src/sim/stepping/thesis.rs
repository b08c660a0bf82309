//! The search of the method `thesis`: local collision sets through the tiles at the trial end.
//!
//! The sets are made once per Δt. A body that was deflected may leave the tiles of its set and meets
//! nothing there; one that is past a thin body at the trial end never met it. Both are losses of the
//! method and are kept.

use super::limits::StepLimits;
use super::overlap::hit;
use super::register::register;
use super::response::collide;
use crate::sim::body::BodyId;
use crate::sim::candidates::{CandidateSet, candidate_sets};
use crate::sim::event::BodyRef;
use crate::sim::fault::Fault;
use crate::sim::model::Model;
use crate::sim::open_step::{Hit, LocalSet, SetSearch};
use crate::sim::pair::Pair;
use crate::sim::state::State;

impl SetSearch {
    /// Registers all bodies where their trial step ends, and looks for overlaps there.
    pub fn begin(model: &Model, state: &mut State, end: f64) -> Self {
        for body in model.present() {
            register(model, state, body, end);
        }
        let found = candidate_sets(model, state);
        let mut sets: Vec<LocalSet> = found.iter().map(|set| LocalSet::new(model, set)).collect();
        let start = state.now;
        for set in &mut sets {
            set.look(model, state, start, end, None);
        }
        Self { sets }
    }

    pub fn earliest(&self) -> Option<Hit> {
        self.sets.iter().filter_map(LocalSet::earliest).reduce(earlier)
    }

    pub fn resolve(&mut self, model: &Model, state: &mut State, hit: &Hit, end: f64) -> Result<(), Fault> {
        let Some(set) = self.sets.iter_mut().find(|set| set.hits.contains(hit)) else {
            return Err(Fault::internal(hit.time, "a collision is in no local set"));
        };
        set.resolve(model, state, hit, end)
    }
}

fn earlier(a: Hit, b: Hit) -> Hit {
    if b.is_before(&a) { b } else { a }
}

impl LocalSet {
    fn new(model: &Model, set: &CandidateSet) -> Self {
        let index = |body: &BodyRef| match *body {
            BodyRef::Dynamic(index) | BodyRef::Static(index) => index,
        };
        let dynamic: Vec<u32> = set.dynamic.iter().map(index).collect();
        let large = model.static_tiles.large().iter().copied();
        let statics = set.fixed.iter().map(index).chain(large).collect();
        let left = StepLimits::DEFAULT.collisions.saturating_mul(dynamic.len() as u32);
        Self { dynamic, statics, hits: Vec::new(), left }
    }

    fn earliest(&self) -> Option<Hit> {
        self.hits.iter().copied().reduce(earlier)
    }

    /// A single collision concerns its own bodies only. In a multi-collision the whole set is moved to the
    /// earliest, and its trial steps are made anew for the rest of Δt.
    fn resolve(&mut self, model: &Model, state: &mut State, hit: &Hit, end: f64) -> Result<(), Fault> {
        let single = self.hits.len() == 1;
        if single {
            collide(model, state, hit, hit.pair.dynamic())?;
        } else {
            collide(model, state, hit, self.dynamic.iter().copied())?;
        }
        self.left -= 1;
        self.look(model, state, hit.time, end, single.then_some(hit));
        if self.left == 0 && !self.hits.is_empty() {
            self.hits.clear();
            state.counters.given_up += 1;
        }
        Ok(())
    }

    /// Looks for overlaps at the trial end: of all pairs, or of those with a body of `around`.
    fn look(&mut self, model: &Model, state: &mut State, from: f64, end: f64, around: Option<&Hit>) {
        let concerned = |body: u32| around.is_none_or(|around| around.involves(body));
        self.hits.clear();
        for (index, &body) in self.dynamic.iter().enumerate() {
            for &other in &self.dynamic[index + 1..] {
                if concerned(body) || concerned(other) {
                    let pair = Pair::of(body, BodyId::of_dynamic(other));
                    self.hits.extend(hit(model, state, pair, from, end));
                }
            }
            if concerned(body) {
                for &other in &self.statics {
                    let pair = Pair::of(body, BodyId::of_static(other));
                    self.hits.extend(hit(model, state, pair, from, end));
                }
            }
        }
    }
}
