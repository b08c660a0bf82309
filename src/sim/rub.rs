//! Friction in a single impact: Coulomb's law with Walton's tangential restitution.
//!
//! Impacts of spheres are central: what happens along the normal does not depend on what happens across it, and the slip
//! keeps its direction while the impulse grows. So Newton's, Poisson's and Stronge's restitution agree, and no energy is
//! gained (Walton 1993; measured by Foerster, Louge, Chang & Allia 1994).

use glam::DVec3;

use super::account::angular;
use super::body::BodyId;
use super::exchange::impulse_from_outside;
use super::geometry::{normal_arms, rubbing_of};
use super::model::Model;
use super::pair::Pair;
use super::predict::Gap;
use super::restitution::reduced_mass;
use super::state::State;
use super::tolerance::STILL;
use super::turn::INERTIA;
use crate::scene::Roughness;

/// What an impact does across its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rub {
    /// N·s, on the body whose slip it is.
    pub impulse: DVec3,
    /// Kinetic energy lost, J.
    pub loss: f64,
}

/// J_t = min(μ J_n, (1 + β₀) m_t |s|) against the slip s, with the loss J_t |s| − J_t²/(2 m_t).
pub(super) fn rub(slip: DVec3, pressing: f64, law: &Roughness, tangential_mass: f64) -> Rub {
    let speed = slip.length();
    if speed == 0.0 {
        return Rub { impulse: DVec3::ZERO, loss: 0.0 };
    }
    let size = (law.friction * pressing).min((1.0 + law.tangential) * tangential_mass * speed);
    Rub { impulse: -size / speed * slip, loss: size * (speed - 0.5 * size / tangential_mass) }
}

/// The mass that an impulse across the normal moves, kg: 1/m_t = Σ (1 + 1/k)/m, for the reduced mass of both.
pub(super) fn tangential_mass(reduced_mass: f64) -> f64 {
    INERTIA / (1.0 + INERTIA) * reduced_mass
}

/// Slip of the second body on the first, m/s: velocities of the centres, and spins times radii. What is below the rounding
/// of these is none.
pub(super) fn slip(normal: DVec3, apart: DVec3, turning: DVec3) -> DVec3 {
    // (v_b − v_a) − R_b ω_b×n − R_a ω_a×n, and `turning` is the sum of R ω.
    let slip = (apart - apart.dot(normal) * normal) - turning.cross(normal);
    let size = apart.length() + turning.length();
    if slip.length() <= STILL * size { DVec3::ZERO } else { slip }
}

/// Books the friction of an impact of two bodies whose normal impulse was booked, and gives both their spin. The impulse on
/// the second one, N·s; the first takes the opposite.
pub(super) fn rub_pair(
    model: &Model,
    state: &mut State,
    time: f64,
    pair: Pair,
    gap: &Gap,
    pressing: f64,
) -> DVec3 {
    let law = rubbing_of(model, pair);
    let mut impulse = DVec3::ZERO;
    let mut spins = Vec::new();
    if law.friction > 0.0 {
        let mass = |body: BodyId| if state.is_fixed(body) { f64::INFINITY } else { model.body(body).mass() };
        let moved = reduced_mass(mass(pair.a), mass(pair.b));
        let velocity = |body: BodyId| state.path_of(model, body).velocity(time);
        let arms = normal_arms(model, pair);
        let spin = |body: BodyId| body.dynamic().map_or(DVec3::ZERO, |body| state.spin(body, time));
        let turning = arms[0] * spin(pair.a) + arms[1] * spin(pair.b);
        let slip = slip(gap.normal, velocity(pair.b) - velocity(pair.a), turning);
        let rub = rub(slip, pressing, &law, tangential_mass(moved));
        impulse = rub.impulse;
        state.account.impact_losses.add(rub.loss);
        let given = impulse_from_outside(state, pair, impulse);
        state.account.impulses.add(given);
        for (body, arm) in [(pair.a, arms[0]), (pair.b, arms[1])] {
            if let Some(index) = body.dynamic().filter(|_| !state.is_fixed(body)) {
                let change = spin_change(model, index, arm, gap.normal, impulse);
                spins.push((index, state.spin(index, time) + change));
            }
        }
    }
    let whole = impulse_from_outside(state, pair, pressing * gap.normal + impulse);
    state.account.angular.impulses.add(angular(gap.point, whole));
    for (body, spin) in spins {
        state.give_spin(body, spin);
    }
    impulse
}

/// What an impulse across the normal, on the second body of a contact, does to the spin of one of the two: both turn the
/// same way, (−R_b n) × J on the second and (R_a n) × (−J) on the first.
pub(super) fn spin_change(model: &Model, body: u32, arm: f64, normal: DVec3, impulse: DVec3) -> DVec3 {
    -arm / inertia(model, body) * normal.cross(impulse)
}

/// kg·m².
pub(super) fn inertia(model: &Model, body: u32) -> f64 {
    let radius = model.radius(body);
    INERTIA * model.mass(body) * radius * radius
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn no_impact_gains_or_leaves_the_cone() {
        let mut source = Random::new(3);
        for case in 0..20_000 {
            let mut random = || source.range(0.0, 1.0);
            let friction = if case % 7 == 0 { 1e12 } else { 2.0 * random() };
            let law = Roughness { friction, rolling: 0.0, tangential: random() };
            let slip = DVec3::new(random(), random(), random()) - 0.5;
            let (mass, pressing) = (0.1 + random(), random());
            let Rub { impulse, loss } = rub(slip, pressing, &law, mass);
            assert!(loss >= 0.0 && impulse.length() <= friction * pressing * (1.0 + 1e-15), "{loss}");
            let after = slip + impulse / mass;
            let lost = 0.5 * mass * (slip.length_squared() - after.length_squared());
            assert!((lost - loss).abs() <= 1e-15, "{lost} {loss}");
            assert!(after.length() <= slip.length() * (1.0 + 1e-15));
        }
    }
}
