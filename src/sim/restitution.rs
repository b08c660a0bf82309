//! The law of a single impact: Newton's restitution with the product of both bodies' Bounce.

/// What an impact along the normal does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Blow {
    /// N·s, ≥ 0.
    pub impulse: f64,
    /// Normal speed at which the surfaces part, m/s, ≥ 0.
    pub parting: f64,
    /// Kinetic energy lost, J.
    pub loss: f64,
}

/// Restitution of a pair of bodies.
pub(super) fn of_pair(bounce_a: f64, bounce_b: f64) -> f64 {
    bounce_a * bounce_b
}

/// e(v) = e·max(0, 1 − v_s/v): what is wet does not rebound below a speed v_s (Davis, Rager & Good 2002).
pub(super) fn sticking(restitution: f64, closing: f64, stick_speed: f64) -> f64 {
    if stick_speed == 0.0 {
        return restitution;
    }
    if closing > stick_speed { restitution * (1.0 - stick_speed / closing) } else { 0.0 }
}

/// m_a·m_b/(m_a + m_b), kg: the mass that an impulse moves. One of the two may be infinite.
pub(super) fn reduced_mass(mass_a: f64, mass_b: f64) -> f64 {
    if mass_b.is_infinite() {
        mass_a
    } else if mass_a.is_infinite() {
        mass_b
    } else {
        mass_a * mass_b / (mass_a + mass_b)
    }
}

/// J = μ(1 + e)v_n,  v_n' = e·v_n,  ΔE = ½μ(v_n² − v_n'²), for the reduced mass μ: the mass itself against a
/// static body.
pub(super) fn blow(reduced_mass: f64, restitution: f64, closing: f64) -> Blow {
    let parting = restitution * closing;
    Blow {
        impulse: reduced_mass * (closing + parting),
        parting,
        // as a product, which does not cancel
        loss: 0.5 * reduced_mass * (closing - parting) * (closing + parting),
    }
}
