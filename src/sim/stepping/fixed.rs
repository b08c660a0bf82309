//! The search of the method `fixed`: overlaps of bodies that share a tile at the end of the step.

use super::limits::StepLimits;
use super::overlap::hit;
use super::register::register;
use super::response::collide;
use crate::sim::fault::Fault;
use crate::sim::model::Model;
use crate::sim::neighbours::near;
use crate::sim::open_step::{Hit, PairSearch};
use crate::sim::pair::Pair;
use crate::sim::state::State;

impl PairSearch {
    pub fn begin(model: &Model, state: &mut State, end: f64) -> Self {
        for body in model.present() {
            register(model, state, body, end);
        }
        let mut search = Self { hits: Vec::new(), collisions: vec![0; model.bodies.dynamic().len()] };
        let start = state.now;
        for body in model.present() {
            search.look(model, state, body, start, end, |other| other > body);
        }
        search
    }

    pub fn earliest(&self) -> Option<Hit> {
        self.hits.iter().copied().reduce(|a, b| if b.is_before(&a) { b } else { a })
    }

    /// Lets the pair bounce and looks anew for what its bodies meet in the rest of the step. A body at its
    /// limit of collisions meets nothing more.
    pub fn resolve(&mut self, model: &Model, state: &mut State, hit: &Hit, end: f64) -> Result<(), Fault> {
        collide(model, state, hit, hit.pair.dynamic())?;
        self.hits.retain(|other| !hit.pair.dynamic().any(|body| other.involves(body)));
        for body in hit.pair.dynamic() {
            register(model, state, body, end);
            self.collisions[body as usize] += 1;
            state.counters.given_up += u64::from(self.collisions[body as usize] == LIMIT);
        }
        let second = hit.pair.second();
        for body in hit.pair.dynamic() {
            // the pair itself is looked at once
            let skip = second.filter(|second| *second == body).map(|_| hit.pair.first());
            self.look(model, state, body, hit.time, end, |other| Some(other) != skip);
        }
        Ok(())
    }

    /// Adds the overlaps of a body with those of its neighbours that are `wanted`.
    fn look(
        &mut self,
        model: &Model,
        state: &mut State,
        body: u32,
        from: f64,
        end: f64,
        wanted: impl Fn(u32) -> bool,
    ) {
        if self.collisions[body as usize] >= LIMIT {
            return;
        }
        for id in near(model, state, body) {
            if let Some(other) = id.dynamic()
                && (!wanted(other) || self.collisions[other as usize] >= LIMIT)
            {
                continue;
            }
            self.hits.extend(hit(model, state, Pair::of(body, id), from, end));
        }
    }
}

const LIMIT: u32 = StepLimits::DEFAULT.collisions;
