//! Balls at random places where they overlap nothing.

use std::collections::BTreeMap;

use glam::DVec3;

use super::inputs::{MOST, around};
use crate::design::builder::{Ball, Builder};
use crate::design::extent::Extent;
use crate::design::gap::gap;
use crate::design::place::of_map;
use crate::design::tool::{Input, Kind, Tool, ToolGroup};
use crate::random::Random;
use crate::scene::{Body, BodyList, Motion, Shape};

/// Places tried for each ball: random places fill about a third of a box before most tries fail.
const TRIES: usize = 200;

/// Balls in a row that find no place before the box counts as full; without it many more than find room keep the
/// window waiting.
const MISSES: usize = 8;

const LENGTH: Kind = Kind::Number(1e-9, 1e9);

pub const FILL: Tool = Tool {
    id: "fill",
    label: "Fill with balls…",
    group: ToolGroup::Arrange,
    help: "Adds balls at random places in the map, or in the box around the selection, where they overlap nothing",
    inputs: &[
        Input {
            label: "Balls",
            unit: "",
            help: "How many",
            kind: Kind::Whole(1.0, MOST as f64),
            default: |_| 50.0,
        },
        Input {
            label: "Smallest radius",
            unit: "m",
            help: "Radii lie between these two",
            kind: LENGTH,
            default: |given| of_map(given, 0.02),
        },
        Input {
            label: "Largest radius",
            unit: "m",
            help: "Radii lie between these two",
            kind: LENGTH,
            default: |given| of_map(given, 0.04),
        },
        Input {
            label: "Mass of a largest ball",
            unit: "kg",
            help: "Of a ball with the largest radius; smaller ones have less, by their volume",
            kind: LENGTH,
            default: |_| 1.0,
        },
        Input {
            label: "Ball bounce",
            unit: "",
            help: "1 loses nothing",
            kind: Kind::Number(0.0, 1.0),
            default: |_| 1.0,
        },
        Input {
            label: "Speed",
            unit: "m/s",
            help: "Of each, in a random direction",
            kind: Kind::Number(0.0, 1e9),
            default: |_| 0.0,
        },
        Input {
            label: "Seed",
            unit: "",
            help: "Another seed gives other places",
            kind: Kind::Whole(0.0, 1e15),
            default: |_| 1.0,
        },
    ],
    follow: None,
    enabled: |_| Ok(()),
    plan: |given, values| {
        let [small, large] = ["Smallest radius", "Largest radius"].map(|label| values.number(label));
        if small > large {
            return Err("The smallest radius is larger than the largest".into());
        }
        let wanted = values.count("Balls");
        let mut random = Random::new(values.number("Seed") as u64);
        let mut taken = Taken::new(&given.scene.bodies, large);
        let within = around(given);
        let mut builder = Builder::part(given, "filling");
        let (mut found, mut misses) = (0, 0);
        for _ in 0..wanted {
            let radius = digits(random.range(small, large), large);
            let share = radius / large;
            let Some(at) = free_place(&mut random, &taken, within, radius) else {
                misses += 1;
                if misses == MISSES {
                    break;
                }
                continue;
            };
            misses = 0;
            taken.add(at, radius);
            builder.ball(
                "ball",
                &Ball {
                    at,
                    radius,
                    mass: values.number("Mass of a largest ball") * (share * share * share),
                    velocity: direction(&mut random) * values.number("Speed"),
                    bounce: values.number("Ball bounce"),
                },
            );
            found += 1;
        }
        let mut plan = builder.finish(format!("Fill with {found} balls"));
        if found < wanted {
            plan.remark = Some(format!("{found} of {wanted} found room"));
        }
        if found == 0 { Err("There is no room for a ball of that size".into()) } else { Ok(plan) }
    },
};

fn free_place(random: &mut Random, taken: &Taken, within: Extent, radius: f64) -> Option<DVec3> {
    let (low, high) = (within.min + radius, within.max - radius);
    if low.cmpgt(high).any() {
        return None;
    }
    (0..TRIES).find_map(|_| {
        let at = DVec3::from_array([0, 1, 2].map(|axis| {
            let place = random.range(low[axis], high[axis]);
            digits(place, within.size()[axis]).clamp(low[axis], high[axis])
        }));
        taken.is_free(at, radius).then_some(at)
    })
}

/// To a millionth of `scale` or so: places that a person can read.
fn digits(value: f64, scale: f64) -> f64 {
    let unit = libm::exp10(libm::floor(libm::log10(scale)) - 5.0);
    // Divided rather than multiplied, so that 0.1234 is the nearest number to 1234/10000.
    let per = libm::round(1.0 / unit);
    if per > 1.0 { (value * per).round() / per } else { value }
}

/// A direction, all alike: by height and angle on the sphere (Archimedes).
fn direction(random: &mut Random) -> DVec3 {
    let height = random.range(-1.0, 1.0);
    let angle = random.range(0.0, std::f64::consts::TAU);
    let out = libm::sqrt(1.0 - height * height);
    DVec3::new(out * libm::cos(angle), height, out * libm::sin(angle))
}

/// What a new ball must not overlap: balls of its size in cells, all else in a list.
struct Taken {
    cell: f64,
    cells: BTreeMap<[i64; 3], Vec<(DVec3, f64)>>,
    others: Vec<Body>,
}

impl Taken {
    fn new(bodies: &BodyList, largest: f64) -> Self {
        let mut taken = Self { cell: 2.0 * largest, cells: BTreeMap::new(), others: Vec::new() };
        for body in bodies {
            match body.shape {
                Shape::Sphere { radius } if radius <= largest => taken.add(body.position, radius),
                _ => taken.others.push(body.clone()),
            }
        }
        taken
    }

    fn cell_of(&self, at: DVec3) -> [i64; 3] {
        (at / self.cell).to_array().map(|place| place.floor() as i64)
    }

    fn add(&mut self, at: DVec3, radius: f64) {
        let cell = self.cell_of(at);
        self.cells.entry(cell).or_default().push((at, radius));
    }

    fn is_free(&self, at: DVec3, radius: f64) -> bool {
        let [x, y, z] = self.cell_of(at);
        let beside = |place: i64, nth: i64| place.saturating_add(nth % 3 - 1);
        let cells = (0..27).map(|nth| [beside(x, nth), beside(y, nth / 3), beside(z, nth / 9)]);
        let near = cells.filter_map(|cell| self.cells.get(&cell)).flatten();
        let mut ball = Body::new(0, at, Motion::Static, Shape::Sphere { radius });
        ball.position = at;
        near.into_iter().all(|(other, size)| at.distance(*other) >= radius + size)
            && self.others.iter().all(|other| gap(&ball, other).is_none_or(|gap| gap.distance >= 0.0))
    }
}
