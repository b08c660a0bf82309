//! Scenes written in code, for tests whose numbers should stand beside what is expected of them.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec3, dvec3};
use polyscene::scene::{Body, BodyList, Force, ForceKind, Map, Motion, Scene, Shape, SimParams};

/// An empty map of 10×10×10 m and as many tiles.
pub fn empty() -> Scene {
    Scene {
        map: Map { size: DVec3::splat(10.0), tiles: [10; 3] },
        time_speed: 1.0,
        params: SimParams::default(),
        forces: Vec::new(),
        bodies: BodyList::new(),
    }
}

/// The scene's bodies and forces, each with a key of its own, chained in the order of a file.
pub trait Build: Sized {
    fn scene(&mut self) -> &mut Scene;

    fn tiles(mut self, tiles: [u32; 3]) -> Self {
        self.scene().map.tiles = tiles;
        self
    }

    fn force(mut self, kind: ForceKind) -> Self {
        let id = self.scene().forces.len() as i64 + 1;
        self.scene().forces.push(Force::new(id, kind));
        self
    }

    /// Uniform gravity along y.
    fn gravity(self, acceleration_y: f64) -> Self {
        let acceleration = dvec3(0.0, acceleration_y, 0.0);
        self.force(ForceKind::GravityPlane { position: DVec3::ZERO, acceleration })
    }

    fn attractor(self, position: DVec3, intensity: f64) -> Self {
        self.force(ForceKind::GravityPoint { position, intensity })
    }

    fn air(self, density: f64) -> Self {
        self.force(ForceKind::Drag { density })
    }

    fn body(mut self, body: Body) -> Self {
        self.scene().bodies.push(body);
        self
    }

    /// A dynamic sphere of radius 0.5 m, mass 1 kg and bounce 1: the others set what differs.
    fn ball(self, id: i64, position: DVec3, velocity: DVec3) -> Self {
        self.body(ball(id, position, velocity))
    }

    fn plate(self, id: i64, position: DVec3, rotation: DVec3, half_x: f64, half_y: f64) -> Self {
        self.body(plate(id, position, rotation, half_x, half_y))
    }

    /// A floor at y = 0 around the middle of the map, `half` metres to each side.
    fn floor(mut self, id: i64, half: f64) -> Self {
        let middle = self.scene().map.size / 2.0;
        self.plate(id, dvec3(middle.x, 0.0, middle.z), dvec3(-FRAC_PI_2, 0.0, 0.0), half, half)
    }

    /// Six walls around the map's box (a cube), facing inwards, with the ids from `first_id` on.
    fn walls(mut self, first_id: i64) -> Self {
        let side = self.scene().map.size.x;
        let h = side / 2.0;
        let walls = [
            (dvec3(0.0, h, h), dvec3(0.0, FRAC_PI_2, 0.0)),
            (dvec3(side, h, h), dvec3(0.0, -FRAC_PI_2, 0.0)),
            (dvec3(h, 0.0, h), dvec3(-FRAC_PI_2, 0.0, 0.0)),
            (dvec3(h, side, h), dvec3(FRAC_PI_2, 0.0, 0.0)),
            (dvec3(h, h, 0.0), DVec3::ZERO),
            (dvec3(h, h, side), dvec3(PI, 0.0, 0.0)),
        ];
        walls.into_iter().zip(first_id..).fold(self, |scene, ((p, r), id)| scene.plate(id, p, r, h, h))
    }
}

impl Build for Scene {
    fn scene(&mut self) -> &mut Scene {
        self
    }
}

pub fn ball(id: i64, position: DVec3, velocity: DVec3) -> Body {
    let motion = Motion::Dynamic { mass: 1.0, velocity };
    body(id, position, DVec3::ZERO, motion, Shape::Sphere { radius: 0.5 })
}

pub fn static_ball(id: i64, position: DVec3, radius: f64) -> Body {
    body(id, position, DVec3::ZERO, Motion::Static, Shape::Sphere { radius })
}

pub fn plate(id: i64, position: DVec3, rotation: DVec3, half_x: f64, half_y: f64) -> Body {
    body(id, position, rotation, Motion::Static, Shape::Plane { half_x, half_y })
}

/// Changes of one body, chained.
pub trait Shaped {
    fn bounce(self, bounce: f64) -> Self;
    fn radius(self, radius: f64) -> Self;
    fn mass(self, mass: f64) -> Self;
    fn friction(self, friction: f64) -> Self;
    fn rolling(self, rolling: f64) -> Self;
    fn tangential(self, tangential: f64) -> Self;
    fn spin(self, spin: DVec3) -> Self;
}

impl Shaped for Body {
    fn bounce(mut self, bounce: f64) -> Self {
        self.bounce = bounce;
        self
    }

    fn radius(mut self, radius: f64) -> Self {
        self.shape = Shape::Sphere { radius };
        self
    }

    fn mass(mut self, new_mass: f64) -> Self {
        if let Motion::Dynamic { mass, .. } = &mut self.motion {
            *mass = new_mass;
        }
        self
    }

    fn friction(mut self, friction: f64) -> Self {
        self.roughness.friction = friction;
        self
    }

    fn rolling(mut self, rolling: f64) -> Self {
        self.roughness.rolling = rolling;
        self
    }

    fn tangential(mut self, tangential: f64) -> Self {
        self.roughness.tangential = tangential;
        self
    }

    fn spin(mut self, spin: DVec3) -> Self {
        self.spin = spin;
        self
    }
}

fn body(id: i64, position: DVec3, rotation: DVec3, motion: Motion, shape: Shape) -> Body {
    Body { rotation, ..Body::new(id, position, motion, shape) }
}

/// The scene of the thesis's appendix 2, transcribed apart from the file of that name.
pub fn thesis() -> Scene {
    let plates = [
        (32285, [10.0, 5.0, 5.0], [0.0, -1.570796, 0.0], [5.0, 5.0]),
        (8365, [0.0, 5.0, 5.0], [0.0, 1.570796, 0.0], [5.0, 5.0]),
        (11797, [5.0, 5.0, 10.0], [3.14159, 0.0, 0.0], [5.0, 5.0]),
        (8855, [5.0, 0.0, 5.0], [-1.570796, 0.0, 0.0], [5.0, 5.0]),
        (6334, [5.0, 5.0, 0.0], [0.0, 0.0, 0.0], [5.0, 5.0]),
        (30612, [5.0, 10.0, 5.0], [1.570796, 0.0, 3.141593], [5.0, 5.0]),
        (28100, [5.0, 4.0, 3.0], [0.0, 0.5, 0.0], [1.0, 1.0]),
        (1142, [5.0, 5.0, 8.0], [0.2, 0.0, 0.5], [1.0, 1.0]),
        (281, [7.0, 3.0, 5.0], [0.9, 1.0, 0.3], [2.0, 1.0]),
        (20537, [2.0, 7.0, 5.0], [1.5, 1.0, 1.0], [1.0, 1.5]),
    ];
    let mut scene = empty();
    let acceleration = dvec3(0.0, -3.0, 0.0);
    scene.forces = vec![
        Force::new(9318, ForceKind::GravityPlane { position: dvec3(6.0, 0.0, 3.0), acceleration }),
        Force::new(7045, ForceKind::GravityPoint { position: DVec3::splat(5.0), intensity: 8.0 }),
    ];
    for (id, position, rotation, [half_x, half_y]) in plates {
        scene = scene.plate(id, position.into(), rotation.into(), half_x, half_y);
    }
    scene
        .body(ball(5853, dvec3(5.0, 3.0, 6.0), dvec3(-3.0, -2.0, -4.0)).radius(1.0))
        .body(ball(15921, dvec3(2.0, 2.0, 1.0), DVec3::ZERO).radius(0.5))
        .body(ball(8945, dvec3(8.0, 8.0, 8.0), DVec3::ZERO).radius(0.7))
}
