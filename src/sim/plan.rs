//! The plan: what a scene needs, so that nothing else is stored or computed.

use std::collections::BTreeSet;

use super::body::Body;
use super::force::Law;
use super::method::Method;
use super::model::Model;
use super::report::Plan;

pub(super) fn plan_of(model: &Model) -> Plan {
    let present = || model.bodies.iter().map(|(_, body)| body).filter(|body| body.present);
    let statics: Vec<&Body> = present().filter(|body| body.is_static()).collect();
    let dynamic_bodies = present().count() - statics.len();
    let ballistic = model.is_ballistic();
    let rubs = rubs(model);
    let spin = rubs && model.method != Method::Thesis;
    let lossy = present().any(|body| body.bounce < 1.0) || model.params.stick_speed > 0.0;

    let mut left_out = Vec::new();
    if !rubs {
        left_out.push("rotation: frictionless spheres keep their spin, whatever it is");
    } else if !spin {
        left_out.push("friction and rotation: this method has none, all bodies slide as if they were smooth");
    }
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
    let lasting_contact = lossy && model.method == Method::Exact;
    // Where nothing drives elastic bodies together, they part for good.
    let is_pressed = lossy || !model.forces.is_empty();
    // A lone body may have to be stepped too: one that slides in a groove, or lies on a seam.
    let least = if spin || lossy && !statics.is_empty() { 1 } else { 2 };
    if dynamic_bodies < least {
        left_out.push("stepped groups: no two moving bodies");
    } else if model.method != Method::Exact {
        left_out.push("stepped groups: this method steps all bodies");
    } else if !is_pressed {
        left_out.push("stepped groups: nothing presses bodies together or takes their energy");
    }
    Plan {
        dynamic_bodies,
        static_bodies: statics.len(),
        motion: if ballistic { "ballistic" } else { "field" },
        pairs: pairs_of(dynamic_bodies, &statics),
        lasting_contact,
        spin,
        stepped_groups: model.method == Method::Exact && dynamic_bodies >= least && is_pressed,
        group_step: model.dense_step,
        left_out,
    }
}

/// Whether two bodies rub that may meet, of which one moves.
fn rubs(model: &Model) -> bool {
    let present = || model.bodies.iter().map(|(_, body)| body).filter(|body| body.present);
    let rough = |body: &&Body| body.roughness().friction > 0.0;
    let moving = present().filter(rough).filter(|body| !body.is_static()).count();
    moving > 0 && present().filter(rough).count() > 1
}

/// Which shapes can meet: of static bodies spheres first, then by name.
fn pairs_of(dynamic_bodies: usize, statics: &[&Body]) -> Vec<&'static str> {
    let mut pairs = Vec::new();
    if dynamic_bodies > 1 {
        pairs.push("sphere–sphere");
    }
    if dynamic_bodies > 0 {
        let name = |body: &&Body| (body.shape.radius() == 0.0, body.shape.convex().pair_name());
        let names: BTreeSet<_> = statics.iter().map(name).collect();
        pairs.extend(names.into_iter().map(|(_, name)| name));
    }
    pairs
}
