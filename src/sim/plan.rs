//! The plan: what a scene needs, so that nothing else is stored or computed.

use super::force::Law;
use super::model::{FixtureShape, Model};
use super::{Method, Plan};

pub(super) fn plan_of(model: &Model) -> Plan {
    let movers: Vec<_> = model.movers.iter().filter(|mover| mover.present).collect();
    let fixtures: Vec<_> = model.fixtures.iter().filter(|fixture| fixture.present).collect();
    let plates = fixtures.iter().any(|fixture| matches!(fixture.shape, FixtureShape::Plate(_)));
    let spheres = fixtures.iter().any(|fixture| matches!(fixture.shape, FixtureShape::Sphere { .. }));
    let ballistic = model.is_ballistic();
    let lossy =
        movers.iter().any(|mover| mover.bounce < 1.0) || fixtures.iter().any(|fixture| fixture.bounce < 1.0);

    let mut pairs = Vec::new();
    if movers.len() > 1 {
        pairs.push("sphere–sphere");
    }
    if spheres && !movers.is_empty() {
        pairs.push("sphere–static sphere");
    }
    if plates && !movers.is_empty() {
        pairs.push("sphere–plane");
    }

    let mut left_out = vec!["rotation: frictionless spheres keep their spin, whatever it is"];
    if ballistic {
        left_out.push("field integrator: all forces are uniform, flights are parabolas");
    }
    if !model.forces.iter().any(|force| matches!(force.law, Law::Drag { .. })) {
        left_out.push("dissipated work: no drag");
    }
    if !lossy {
        left_out.push("rest after bounces: every bounce keeps its energy");
    } else if model.method != Method::Exact {
        left_out.push("rest after bounces: this method lets bodies bounce for ever");
    }
    Plan {
        dynamic_bodies: movers.len(),
        static_bodies: fixtures.len(),
        motion: if ballistic { "ballistic" } else { "field" },
        pairs,
        lasting_contact: lossy && model.method == Method::Exact,
        left_out,
    }
}
