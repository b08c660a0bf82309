//! Friction of an impact: Coulomb's law with Walton's tangential restitution.

use glam::DVec3;

use super::flight::INERTIA;
use crate::scene::Roughness;

/// What a pair has of friction: the geometric means.
pub(super) fn mean(a: Roughness, b: Roughness) -> Roughness {
    Roughness {
        friction: (a.friction * b.friction).sqrt(),
        rolling: (a.rolling * b.rolling).sqrt(),
        tangential: (a.tangential * b.tangential).sqrt(),
    }
}

/// The impulse against a slip, N·s, min(μ J_n, (1 + β) m_t |s|) with 1/m_t = (1 + 1/k) Σ 1/m.
pub(super) fn against(slip: DVec3, pressing: f64, law: Roughness, inverse_mass: f64) -> DVec3 {
    let gripping = (1.0 + law.tangential) * slip.length() / ((1.0 + 1.0 / INERTIA) * inverse_mass);
    -(law.friction * pressing).min(gripping) * slip.normalize_or_zero()
}
