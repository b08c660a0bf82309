//! Restitution is a product of two numbers here and MuJoCo mixes the two geoms of a contact otherwise: which geoms say
//! what, and which pairs are written out.
//!
//! MuJoCo takes the geom of higher priority, or the one with more damping. So a moving sphere says its own square,
//! b², a static body its product with the commonest moving ones, at a higher priority, and what then differs is a pair.

use crate::scene::{Body, Scene};

/// More pairs than this would be most of the file; the rest is approximated.
const MOST_PAIRS: usize = 100_000;

/// The restitutions of all contacts of a scene.
pub(super) struct Pairs {
    /// Bounce of most moving bodies.
    common: f64,
    /// Index of both bodies, and their restitution.
    pub written: Vec<(usize, usize, f64)>,
    /// How many more pairs there would be.
    pub left_out: usize,
}

/// Bodies with one Bounce.
struct Class {
    bounce: f64,
    members: Vec<usize>,
}

impl Pairs {
    pub fn of(scene: &Scene) -> Self {
        let moving = classes(scene, Body::is_dynamic);
        let fixed = classes(scene, |body| !body.is_dynamic());
        let most = moving.iter().max_by_key(|class| class.members.len());
        let common = most.map_or(1.0, |class| class.bounce);
        let mut pairs = Self { common, written: Vec::new(), left_out: 0 };
        let others = || moving.iter().filter(|class| class.bounce != common);
        for (class, other) in fixed.iter().flat_map(|class| others().map(move |other| (class, other))) {
            pairs.add(class, other);
        }
        for (at, class) in moving.iter().enumerate() {
            for other in &moving[at + 1..] {
                pairs.add(class, other);
            }
        }
        pairs
    }

    /// What a geom says.
    pub fn own(&self, body: &Body) -> f64 {
        let other = if body.is_dynamic() { body.bounce } else { self.common };
        product(body.bounce, other)
    }

    fn add(&mut self, one: &Class, other: &Class) {
        let e = product(one.bounce, other.bounce);
        let count = one.members.len().saturating_mul(other.members.len());
        if self.written.len().saturating_add(count) > MOST_PAIRS {
            self.left_out = self.left_out.saturating_add(count);
            return;
        }
        for &a in &one.members {
            self.written.extend(other.members.iter().map(|&b| (a, b, e)));
        }
    }
}

/// Above 1 an impact would add energy, which damping cannot.
fn product(one: f64, other: f64) -> f64 {
    (one * other).min(1.0)
}

/// In the order of their Bounce.
fn classes(scene: &Scene, wanted: impl Fn(&Body) -> bool) -> Vec<Class> {
    let mut members: Vec<_> = (0..scene.bodies.len()).filter(|&at| wanted(&scene.bodies[at])).collect();
    members.sort_by(|&a, &b| scene.bodies[a].bounce.total_cmp(&scene.bodies[b].bounce));
    let same = |a: &usize, b: &usize| scene.bodies[*a].bounce == scene.bodies[*b].bounce;
    let class = |members: &[usize]| {
        let bounce = scene.bodies[*members.first()?].bounce;
        Some(Class { bounce, members: members.to_vec() })
    };
    members.chunk_by(same).filter_map(class).collect()
}
