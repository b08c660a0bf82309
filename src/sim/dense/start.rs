//! What a step begins with: the bodies of a component, where they are, how fast, and what drives them.

use glam::DVec3;

use super::clock::{halved, halvings_by_pull};
use super::data::{Component, Dense, Member};
use super::rub::Law;
use super::stepped::{Contact, Stepped};
use super::tolerance::{MOST_HALVINGS, TURN_IN_A_STEP};
use crate::sim::force;
use crate::sim::geometry::rubbing_of;
use crate::sim::model::Model;
use crate::sim::place::Place;
use crate::sim::state::State;

/// The bodies of a component at a time, with u for steps as long as the last.
pub(super) fn read_bodies(model: &Model, state: &State, dense: &Dense, component: &mut Component, time: f64) {
    let Component { slots, work, .. } = component;
    let members = slots.iter().map(|slot| &dense.members[*slot as usize]);
    work.bodies.clear();
    work.bodies.extend(members.map(|member| body_of(model, state, member, time)));
}

fn body_of(model: &Model, state: &State, member: &Member, time: f64) -> Stepped {
    let path = state.path(member.body);
    let inverse_mass = state.inverse_mass(model, member.body);
    let is_held = inverse_mass == 0.0;
    let x = path.position(time);
    let v = if is_held { DVec3::ZERO } else { path.velocity(time) };
    let halvings_by_pull = halvings_by_pull(model, member.body, time, (x, v));
    let step = halved(model.dense_step, halvings_by_pull);
    let a = if inverse_mass > 0.0 { driven(model, member.body, (x, v), time, step) } else { DVec3::ZERO };
    // Where forces change along the way, the leapfrog's other half of the kick.
    let kick = if member.is_stepped && !is_held {
        0.5 * (time - path.segment.start) * (a - path.segment.a)
    } else {
        DVec3::ZERO
    };
    let stiffness = if is_held || model.is_ballistic() { 0.0 } else { stiffness(model, x, v) };
    let v = v + kick;
    let (drive, radius) = (a.length(), model.radius(member.body));
    let mut body = Stepped {
        body: member.body,
        x,
        v,
        kick,
        u: v,
        a,
        speed: 0.0,
        drive,
        inverse_mass,
        radius,
        stiffness,
        step,
        halvings_by_pull,
    };
    body.take_step(step);
    body
}

/// What the applied forces give a body during a step of length h, m/s². Forces that change faster than that, drag on
/// what is light and the pull where no halving of the step is enough, are taken as an implicit midpoint rule would:
/// a = −κx and −κv give −κx/(1 + ¼h²κ) and −κv/(1 + ½hκ), which no step makes unstable.
fn driven(model: &Model, body: u32, (x, v): (DVec3, DVec3), time: f64, h: f64) -> DVec3 {
    let subject = model.subject(body, time, Place::exact(x), v);
    if model.is_ballistic() {
        return model.applied_acceleration(&subject);
    }
    let of_law = |law: &force::Law| {
        let a = law.force(&subject) / subject.mass;
        match law {
            force::Law::Drag { .. } => {
                let rate = a.length() / v.length().max(f64::MIN_POSITIVE);
                a / (1.0 + 0.5 * h * rate)
            }
            force::Law::Point { center, .. } => {
                let rate = a.length() / (x - *center).length().max(f64::MIN_POSITIVE);
                // Steps become shorter here, as far as they can.
                let shortest = h / f64::from(1_u32 << MOST_HALVINGS);
                let turn = h.min(shortest.max(TURN_IN_A_STEP / rate.sqrt())) * rate.sqrt();
                a / (1.0 + 0.25 * (turn * turn - TURN_IN_A_STEP * TURN_IN_A_STEP).max(0.0))
            }
            force::Law::Uniform { .. } | force::Law::Custom(_) => a,
        }
    };
    model.forces.iter().map(|force| of_law(&force.law)).sum()
}

/// How fast the pull of an attractor changes at a place, 1/s²: G/d³ by its own doing, or (v/d)² where a body falls in.
fn stiffness(model: &Model, x: DVec3, v: DVec3) -> f64 {
    let of_law = |law: &force::Law| match *law {
        force::Law::Point { center, intensity } if intensity != 0.0 => {
            let way = x - center;
            let distance = way.length();
            let rate = -way.dot(v) / (distance * distance);
            (intensity.abs() / (distance * distance * distance)).max(rate.max(0.0) * rate)
        }
        _ => 0.0,
    };
    model.forces.iter().map(|force| of_law(&force.law)).fold(0.0, f64::max)
}

/// The law of a contact with what its friction was; `None` where it does not rub.
pub(super) fn law_of(model: &Model, dense: &Dense, contact: &Contact) -> Option<Law> {
    let roughness = rubbing_of(model, dense.pairs[contact.listed as usize].pair);
    let force = dense.rubs.get(contact.listed as usize).copied().unwrap_or_default();
    (roughness.friction > 0.0).then_some(Law { roughness, force })
}
