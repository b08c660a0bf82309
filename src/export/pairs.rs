//! Restitution is a product of two numbers here, frictions are geometric means, and MuJoCo mixes the two geoms of a contact
//! otherwise: which geoms say what, and which pairs are written out.
//!
//! MuJoCo takes the geom of higher priority, or the one with more damping and the larger friction. So a moving sphere
//! says what it has with its like, a static body what it has with the commonest moving ones, at a higher priority, and
//! what then differs is a pair.

use super::contact::rolling_lever;
use crate::scene::{Body, Scene, Shape};

/// More pairs than this would be most of the file; the rest is approximated.
const MOST_PAIRS: usize = 100_000;

/// The restitutions and frictions of all contacts of a scene.
pub(super) struct Pairs {
    /// What most moving bodies have.
    common: Surface,
    /// Index of both bodies, and what they have together.
    pub written: Vec<(usize, usize, Surface)>,
    /// How many more pairs there would be.
    pub left_out: usize,
}

/// Restitution and frictions, of a body or of two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    pub bounce: f64,
    pub friction: f64,
    rolling: f64,
    /// Of what rolls, where anything resists that, m; infinite for what stands still.
    radius: f64,
}

const SMOOTH: Surface = Surface { bounce: 1.0, friction: 0.0, rolling: 0.0, radius: f64::INFINITY };

impl Surface {
    fn of(body: &Body) -> Self {
        let rolling = body.roughness.rolling;
        let radius = match body.shape {
            _ if rolling == 0.0 || !body.is_dynamic() => f64::INFINITY,
            Shape::Sphere { radius } => radius,
            Shape::Plane { .. } | Shape::Unbuilt { .. } => f64::INFINITY,
        };
        Self { bounce: body.bounce, friction: body.roughness.friction, rolling, radius }
    }

    /// Lever of the friction that resists rolling, m; of two balls that of the smaller.
    pub fn lever(&self) -> f64 {
        if self.rolling > 0.0 && self.radius.is_finite() {
            rolling_lever(self.rolling, self.radius)
        } else {
            0.0
        }
    }

    /// With another. Above 1 an impact would add energy, which damping cannot.
    fn with(self, other: Self) -> Self {
        Self {
            bounce: (self.bounce * other.bounce).min(1.0),
            friction: libm::sqrt(self.friction * other.friction),
            rolling: libm::sqrt(self.rolling * other.rolling),
            radius: self.radius.min(other.radius),
        }
    }

    fn in_order(&self, other: &Self) -> std::cmp::Ordering {
        let numbers = |surface: &Self| [surface.bounce, surface.friction, surface.rolling, surface.radius];
        let pairs = numbers(self).into_iter().zip(numbers(other));
        let unequal = pairs.map(|(one, other)| one.total_cmp(&other)).find(|order| order.is_ne());
        unequal.unwrap_or(std::cmp::Ordering::Equal)
    }
}

/// Bodies with one surface.
struct Class {
    surface: Surface,
    members: Vec<usize>,
}

impl Pairs {
    pub fn of(scene: &Scene) -> Self {
        let moving = classes(scene, Body::is_dynamic);
        let fixed = classes(scene, |body| !body.is_dynamic());
        let most = moving.iter().max_by_key(|class| class.members.len());
        let common = most.map_or(SMOOTH, |class| class.surface);
        let mut pairs = Self { common, written: Vec::new(), left_out: 0 };
        let others = || moving.iter().filter(|class| class.surface != common);
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
    pub fn own(&self, body: &Body) -> Surface {
        let own = Surface::of(body);
        own.with(if body.is_dynamic() { own } else { self.common })
    }

    fn add(&mut self, one: &Class, other: &Class) {
        let both = one.surface.with(other.surface);
        let count = one.members.len().saturating_mul(other.members.len());
        if self.written.len().saturating_add(count) > MOST_PAIRS {
            self.left_out = self.left_out.saturating_add(count);
            return;
        }
        for &a in &one.members {
            self.written.extend(other.members.iter().map(|&b| (a, b, both)));
        }
    }
}

/// In the order of their surfaces.
fn classes(scene: &Scene, wanted: impl Fn(&Body) -> bool) -> Vec<Class> {
    let mut members: Vec<_> = (0..scene.bodies.len()).filter(|&at| wanted(&scene.bodies[at])).collect();
    let of = |at: usize| Surface::of(&scene.bodies[at]);
    members.sort_by(|&a, &b| of(a).in_order(&of(b)));
    let same = |a: &usize, b: &usize| of(*a) == of(*b);
    let class = |members: &[usize]| Some(Class { surface: of(*members.first()?), members: members.to_vec() });
    members.chunk_by(same).filter_map(class).collect()
}
