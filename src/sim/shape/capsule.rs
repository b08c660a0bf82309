//! A shape of the tests only: what one costs is this file and its line of the table. A capsule, known to the rest
//! of the core by its nearest feature alone.

use glam::DVec3;

use super::convex::Convex;
use super::near::{Feature, Near};

/// All points within `radius` of a line segment through the place of the body.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Capsule {
    /// From the middle to one end of the line, m.
    half: DVec3,
    /// m.
    radius: f64,
}

impl Convex for Capsule {
    fn pair_name(&self) -> &'static str {
        "sphere–capsule"
    }

    fn bounds(&self, at: DVec3) -> (DVec3, DVec3) {
        let reach = self.half.abs() + self.radius;
        (at - reach, at + reach)
    }

    fn touches_box(&self, at: DVec3, low: DVec3, high: DVec3) -> bool {
        let (own_low, own_high) = self.bounds(at);
        own_low.cmple(high).all() && own_high.cmpge(low).all()
    }

    fn nearest(&self, at: DVec3, point: DVec3) -> Near {
        let along = (point - at).dot(self.half) / self.half.length_squared();
        let center = at + along.clamp(-1.0, 1.0) * self.half;
        let to_center = (center - point).length();
        let feature = if along.abs() < 1.0 { Feature::Edge(self.half.normalize()) } else { Feature::Corner };
        Near { distance: to_center - self.radius, towards: (center - point) / to_center, feature, to_center }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Shape;
    use super::*;
    use crate::scene::{Body, Document, Force, ForceKind, Motion, NodeKey, NumberStyle, Scene};
    use crate::sim::body::{self, Identity, Rare};
    use crate::sim::compile::compile;
    use crate::sim::drive;
    use crate::sim::event::{BodyRef, Event, EventKind};
    use crate::sim::method::Method;
    use crate::sim::neighbours::enter;
    use crate::sim::report::ContactState;
    use crate::sim::state::State;
    use crate::sim::tiles::StaticTiles;

    const GRAVITY: f64 = 10.0;
    const RADIUS: f64 = 0.5;
    const MIDDLE: DVec3 = DVec3::new(5.0, 2.0, 5.0);

    fn ball_above(offset: DVec3, bounce: f64) -> Scene {
        let mut scene = Document::new(NumberStyle::Point).scene().cloned().unwrap();
        scene.forces.push(Force {
            key: NodeKey(1_000_001),
            id: 1,
            label: "1".into(),
            name: None,
            group: None,
            hidden: false,
            locked: false,
            kind: ForceKind::GravityPlane {
                position: DVec3::ZERO,
                acceleration: DVec3::new(0.0, -GRAVITY, 0.0),
            },
        });
        let motion = Motion::Dynamic { mass: 2.0, velocity: DVec3::ZERO };
        let ball = Body::new(1, MIDDLE + offset, motion, crate::scene::Shape::Sphere { radius: RADIUS });
        scene.bodies.push(Body { key: NodeKey(1_000_000), bounce, ..ball });
        scene
    }

    /// What happens to a ball that falls on a capsule that lies along z, and how it moves in the end.
    fn fall(offset: DVec3, bounce: f64, until: f64) -> (Vec<Event>, ContactState) {
        let capsule = Capsule { half: DVec3::Z, radius: 0.25 };
        let (mut model, origins) = compile(&ball_above(offset, bounce), Method::Exact).unwrap();
        let identity = Identity::new(NodeKey(2), "2", "2");
        let shape = Shape::Capsule(capsule);
        let body = body::Body::new((2, 0), f64::INFINITY, 1.0, shape, Rare::default());
        model.bodies.push(identity, body, MIDDLE);
        model.static_tiles = StaticTiles::new(&model.grid, &model.bodies, 1000);
        let mut state = State::new(&origins);
        enter(&model, &mut state, 0, 0.0);
        drive::begin_all(&model, &mut state).unwrap();
        state.until = until;
        while drive::advance(&model, &mut state).unwrap() {}
        (state.outbox.iter().copied().collect(), state.contact_state(0, until))
    }

    /// First time at which a ball that falls from rest at `offset` touches a sphere or cylinder there of 0.25 m
    /// whose axis is `across` away from its path.
    fn closed_form(height: f64, across: f64) -> f64 {
        let reach = RADIUS + 0.25;
        (2.0 * (height - (reach * reach - across * across).sqrt()) / GRAVITY).sqrt()
    }

    #[test]
    fn a_ball_bounces_off_the_side_and_off_the_end() {
        for (offset, across) in [
            (DVec3::new(0.3, 2.0, 0.5), 0.3),
            (DVec3::new(0.0, 2.0, 1.4), 0.4),
            (DVec3::new(0.3, 1.5, -1.4), 0.5),
        ] {
            let expected = closed_form(offset.y, across);
            let (events, _) = fall(offset, 1.0, expected + 0.01);
            assert_eq!(events.len(), 1, "{events:?}");
            let hit = events[0];
            assert_eq!((hit.kind, hit.b), (EventKind::Impact, Some(BodyRef::Static(0))));
            assert!((hit.time - expected).abs() <= 1e-13, "{} instead of {expected}", hit.time);
            let turn = hit.vn_before + hit.vn_after;
            assert!(turn.abs() <= 1e-12 && hit.vn_after > 1.0, "{hit:?}");
        }
    }

    #[test]
    fn a_ball_comes_to_rest_on_the_side() {
        let (events, end) = fall(DVec3::new(0.0, 1.0, 0.2), 0.5, 3.0);
        assert!(events.iter().any(|event| event.kind == EventKind::Rest), "{events:?}");
        assert_eq!(end, ContactState::Rest);
    }

    #[test]
    fn a_ball_beside_it_never_meets_it() {
        assert!(fall(DVec3::new(0.7501, 1.0, 0.0), 1.0, 1.0).0.is_empty());
    }
}
