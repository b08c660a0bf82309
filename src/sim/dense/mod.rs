//! Stepped groups: bodies that touch too often for events go on in steps of model time, with impulses at the ends of
//! steps only and exact parabolas between.
//!
//! The scheme is Stewart & Trinkle's (1996) and Anitescu & Potra's (1997), on the distances of the bodies, solved by
//! projected Gauss–Seidel sweeps: no step lets a body enter another, and none gains energy, but for what the sweeps
//! leave. It is a regime of bodies, not of the scene: a heap is stepped while what falls towards it flies on from
//! event to event. Steps lie on a grid of model time, so that nothing depends on when somebody looks.
//!
//! `data` is what is stored, `stepped` what a step works on; `activity` decides who enters, `membership` takes them in;
//! `list` keeps who is near whom, found by `cells`, and `components` who goes together; `contact` makes the bounds of a
//! step, and `solve` has them solved: in `converge` by `sweep`s over `rows`, with friction by `rub`, and where few resist
//! by `block`; `group_step` does all that for the bodies that are due, and `rest` finds out who lies still or has left.
//! `view` is what can be seen of it.

mod activity;
mod block;
mod cells;
mod clock;
mod components;
mod contact;
mod converge;
mod data;
mod group_step;
mod list;
mod membership;
mod rest;
mod rows;
#[cfg(target_arch = "x86_64")]
mod rows_avx;
mod rub;
mod solve;
mod start;
mod stepped;
mod sweep;
mod tolerance;
mod view;

pub(super) use activity::{
    is_stuck, least_crowd, least_elastic_crowd, may_be_crowd, note_held, note_impact, note_met, note_too_few,
    note_work,
};
pub(super) use clock::{find_step, set_step, step_at};
pub(super) use data::{Dense, Role};
pub(super) use group_step::{enter, forget_removed, next_step, reach, step, wake_all};
pub(super) use membership::component;
pub(super) use tolerance::{LARGE_ISLAND, SMALLEST_CROWD};
pub(super) use view::{contact_forces, stepped_bodies};
