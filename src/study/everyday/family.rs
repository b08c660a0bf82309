//! The families of everyday scenes, and the scene of a family, a size, a restitution and a seed.

use std::fmt;

use super::builder::FIRST_OBSTACLE;
use super::recipe::Recipe;
use super::{heaps, rooms};
use crate::scene::Scene;
use crate::study::Random;

/// Scenes of one kind.
pub struct Family {
    pub name: &'static str,
    /// What happens in them.
    pub about: &'static str,
    make: fn(&mut Recipe) -> Scene,
}

/// All families: one line each.
pub const FAMILIES: &[Family] = &[
    Family { name: "hall", about: "dropped far apart into a big room", make: rooms::hall },
    Family { name: "crate", about: "poured into an open box", make: rooms::crate_of_balls },
    Family { name: "tray", about: "one layer in a flat box", make: rooms::tray },
    Family { name: "wedge", about: "between two inclined plates that meet", make: heaps::wedge },
    Family { name: "pegs", about: "through rows of spheres and small plates", make: heaps::pegs },
    Family { name: "hopper", about: "through a slot into a box", make: heaps::hopper },
    Family { name: "mixed", about: "a box of masses up to 1 : 1e6", make: rooms::mixed },
    Family { name: "stack", about: "a pyramid or columns, hit by a ball", make: heaps::stack },
    Family { name: "table", about: "a rack and rolling balls between cushions", make: heaps::table },
    Family { name: "ramp", about: "down an incline into a wall", make: heaps::ramp },
    Family { name: "drag", about: "poured into a box full of air", make: rooms::drag },
    Family { name: "planet", about: "onto a sphere with an attractor in it", make: heaps::planet },
    Family { name: "cluster", about: "together around a bare attractor", make: heaps::cluster },
    Family { name: "gas", about: "a lossy gas without gravity", make: rooms::gas },
];

/// Numbers of balls that are looked at.
pub const SIZES: &[usize] = &[2, 5, 10, 20, 50, 100, 300];
/// Restitutions of a pair that are looked at.
pub const RESTITUTIONS: &[f64] = &[0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0];

/// Names one scene.
#[derive(Clone, Copy)]
pub struct Setup {
    pub family: &'static Family,
    /// Balls.
    pub n: usize,
    /// Restitution of a pair.
    pub e: f64,
    pub seed: u64,
}

impl Setup {
    /// The scene: no overlap at the start, and closed, so that nothing can leave it.
    pub fn scene(&self) -> Scene {
        // The same places at every restitution.
        let named = |mix: u64, byte: u8| mix.wrapping_mul(131).wrapping_add(u64::from(byte));
        let mix = self.family.name.bytes().fold(self.seed, named);
        let random = Random::new(mix.wrapping_add((self.n as u64) << 32));
        (self.family.make)(&mut Recipe { n: self.n, e: self.e, random })
    }

    /// The UserIDs of the plates that close a scene, their normals inwards.
    pub(super) fn walls(scene: &Scene) -> Vec<i64> {
        scene.bodies.iter().map(|body| body.id).filter(|id| *id < FIRST_OBSTACLE).collect()
    }
}

impl fmt::Display for Setup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { family, n, e, seed } = self;
        write!(f, "--family {} --n {n} --e {e} --seed {seed}", family.name)
    }
}
