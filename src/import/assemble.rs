//! From pieces to a scene: y up, boxes as planes, planes with an end, a map that holds it all.

use compact_str::ToCompactString as _;
use glam::{DMat3, DVec3};

use super::log::Log;
use super::piece::{Piece, PieceShape, Pose, World};
use crate::export::Verdict;
use crate::scene::{Body, Force, ForceKind, Map, Motion, NodeKey, Roughness, Scene, Shape, SimParams};

/// A box of at most this half thickness, in radii of the smallest moving sphere, is taken for a plate.
const PLATE: f64 = 0.02;

/// How far a plane without end reaches, in the size of what lies around it.
const REACH: f64 = 3.0;

/// Radii per tile of the search grid, and the most tiles of an axis.
const TILE: f64 = 4.0;
const MOST_TILES: f64 = 64.0;

/// The scene, and where in the file each of its bodies comes from.
pub(super) fn scene(world: World, log: &mut Log) -> (Scene, Vec<Option<(u32, u32)>>) {
    let World { gravity, density, time_speed, map, pieces } = world;
    let maker = Maker::of(&pieces);
    let (mut bodies, mut origins) = (Vec::new(), Vec::new());
    for piece in &pieces {
        maker.add(piece, &mut bodies, log);
        origins.resize(bodies.len(), piece.origin);
    }
    let (map, shift) = match map {
        Some(size) => (Map { size, tiles: tiles(size, maker.largest) }, DVec3::ZERO),
        None => fitting(&bodies, maker.largest),
    };
    if shift != DVec3::ZERO {
        let [x, y, z] = shift.to_array();
        let how = format!("by ({x}, {y}, {z}) m, so that it lies inside the map, which begins at 0");
        log.note(Verdict::Approximated, "the scene is moved", how, None);
    }
    for body in &mut bodies {
        body.position += shift;
    }
    number(&mut bodies, &pieces);
    let mut forces = Vec::new();
    let mut force = |kind| forces.push(Force::new(forces.len() as i64 + 1, kind));
    if gravity != DVec3::ZERO {
        let position = DVec3::new(0.5 * map.size.x, 0.9 * map.size.y, 0.5 * map.size.z);
        force(ForceKind::GravityPlane { position, acceleration: y_up(gravity) });
    }
    if density > 0.0 {
        force(ForceKind::Drag { density });
    }
    (Scene { map, time_speed, params: SimParams::default(), forces, bodies: bodies.into() }, origins)
}

/// (x, y, z) → (x, z, −y).
fn y_up(v: DVec3) -> DVec3 {
    DVec3::new(v.x, v.z, -v.y + 0.0)
}

/// α, β, γ with R = Rx(α)·Ry(β)·Rz(γ), for world from local in z up.
fn angles(turn: DMat3) -> DVec3 {
    let [x, y, z] = [turn.x_axis, turn.y_axis, turn.z_axis].map(y_up);
    let level = libm::hypot(z.y, z.z);
    let beta = libm::atan2(z.x, level);
    // At β = ±90° only one angle is left of the other two.
    let (alpha, gamma) = if level < 1e-9 {
        (libm::atan2(y.z, y.y), 0.0)
    } else {
        (libm::atan2(-z.y, z.z), libm::atan2(-y.x, x.x))
    };
    DVec3::new(alpha, beta, gamma).to_array().map(without_noise).into()
}

/// A rotation of less than this is rounding of the file's numbers.
fn without_noise(angle: f64) -> f64 {
    if angle.abs() < 1e-12 { 0.0 } else { angle }
}

struct Maker {
    /// Radii of the smallest moving sphere and of the largest, m.
    smallest: f64,
    largest: f64,
    moving: Vec<DVec3>,
    /// How far what lies around reaches from 0, m.
    extent: f64,
}

impl Maker {
    fn of(pieces: &[Piece]) -> Self {
        let radius = |piece: &Piece| match piece.shape {
            PieceShape::Sphere(radius) => Some(radius),
            PieceShape::Plane(_) | PieceShape::Box(_) => None,
        };
        let moving = || pieces.iter().filter(|piece| piece.motion.is_some());
        let smallest = moving().filter_map(radius).fold(f64::INFINITY, f64::min);
        let largest = moving().filter_map(radius).fold(0.0, f64::max);
        let size = |piece: &Piece| match piece.shape {
            PieceShape::Sphere(radius) => radius,
            PieceShape::Box(half) => half.length(),
            PieceShape::Plane(_) => 0.0,
        };
        let reach = |piece: &Piece| piece.pose.place.abs().max_element() + size(piece);
        let extent = pieces.iter().map(reach).fold(0.0, f64::max);
        let extent = if extent > 0.0 { extent } else { 1.0 };
        let largest = if largest > 0.0 { largest } else { 0.05 * extent };
        let moving = moving().map(|piece| piece.pose.place).collect();
        Self { smallest, largest, moving, extent }
    }

    fn add(&self, piece: &Piece, bodies: &mut Vec<Body>, log: &mut Log) {
        match piece.shape {
            PieceShape::Sphere(radius) => bodies.push(body(piece, piece.pose, Shape::Sphere { radius })),
            PieceShape::Plane(drawn) => {
                let reach = nice(REACH * self.extent);
                let [half_x, half_y] = drawn.map(|half| half.max(reach));
                let how =
                    format!("as a bounded one of {half_x} m by {half_y} m to each side, hit from both sides");
                log.note(Verdict::Approximated, "plane without end", how, None);
                bodies.push(body(piece, piece.pose, Shape::Plane { half_x, half_y }));
            }
            PieceShape::Box(half) => self.add_box(piece, half, bodies, log),
        }
    }

    /// A thin box is the plate whose face the moving bodies see; another one its six faces.
    fn add_box(&self, piece: &Piece, half: DVec3, bodies: &mut Vec<Body>, log: &mut Log) {
        let faces = faces(half);
        let thin = faces.iter().min_by(|a, b| a.out.total_cmp(&b.out));
        if let Some(face) = thin.filter(|face| face.out <= PLATE * self.smallest) {
            let normal = piece.pose.turn * face.turn.z_axis;
            let height = |center: &DVec3| normal.dot(*center - piece.pose.place);
            let above = self.moving.iter().any(|center| height(center) >= 0.0);
            let below = self.moving.iter().any(|center| height(center) < 0.0);
            let offset = match (above, below) {
                (true, false) => face.out,
                (false, true) => -face.out,
                _ => 0.0,
            };
            log.note(Verdict::Kept, "thin box that stands still", "as a bounded plane at its face", None);
            bodies.push(face.body(piece, offset));
            return;
        }
        log.note(Verdict::Kept, "box that stands still", "as its six faces, in a group", None);
        for face in faces {
            for (sign, mark) in [(1.0, '+'), (-1.0, '-')] {
                let mut side = face.body(piece, sign * face.out);
                side.group = piece.name.clone().or_else(|| Some("box".to_owned()));
                side.name = Some(format!("{} {mark}{}", piece.name.as_deref().unwrap_or("box"), face.axis));
                side.id = 0;
                bodies.push(side);
            }
        }
    }
}

/// Two opposite sides of a box.
struct Face {
    axis: char,
    /// Box from plane, whose normal is z.
    turn: DMat3,
    half: [f64; 2],
    /// How far it is from the box's centre, m.
    out: f64,
}

fn faces(half: DVec3) -> [Face; 3] {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    let face = |axis, turn, half, out| Face { axis, turn, half, out };
    [
        face('x', DMat3::from_cols(y, z, x), [half.y, half.z], half.x),
        face('y', DMat3::from_cols(z, x, y), [half.z, half.x], half.y),
        face('z', DMat3::IDENTITY, [half.x, half.y], half.z),
    ]
}

impl Face {
    fn body(&self, piece: &Piece, offset: f64) -> Body {
        let pose = piece.pose.then(Pose { place: self.turn.z_axis * offset, turn: self.turn });
        body(piece, pose, Shape::Plane { half_x: self.half[0], half_y: self.half[1] })
    }
}

fn body(piece: &Piece, pose: Pose, shape: Shape) -> Body {
    let motion = match piece.motion {
        Some((mass, velocity)) => Motion::Dynamic { mass, velocity: y_up(velocity) },
        None => Motion::Static,
    };
    Body {
        name: piece.name.clone(),
        color: piece.color,
        hidden: piece.hidden,
        rotation: angles(pose.turn),
        bounce: piece.bounce,
        roughness: Roughness { friction: piece.friction, rolling: piece.rolling, ..Roughness::default() },
        spin: y_up(piece.spin),
        ..Body::new(piece.id.unwrap_or(0), y_up(pose.place), motion, shape)
    }
}

/// Ids that the file says stay, unless two bodies have the same; others get the next free numbers.
fn number(bodies: &mut [Body], pieces: &[Piece]) {
    let mut said: Vec<i64> = pieces.iter().filter_map(|piece| piece.id).collect();
    said.sort_unstable();
    let unique = said.windows(2).all(|pair| pair[0] != pair[1]);
    let mut next = if unique { said.last().map_or(1, |last| last.saturating_add(1)) } else { 1 };
    for (nth, body) in bodies.iter_mut().enumerate() {
        if !unique || body.id == 0 {
            body.id = next;
            next = next.saturating_add(1);
        }
        body.key = NodeKey(nth as u64 + 1);
        body.label = body.id.to_compact_string();
        // A name that only repeats the number is none.
        body.name.take_if(|name| *name == body.label);
    }
}

/// A map that holds all centres, and what to add to their places so that it begins at 0.
fn fitting(bodies: &[Body], radius: f64) -> (Map, DVec3) {
    let low = bodies.iter().map(|body| body.position).fold(DVec3::INFINITY, DVec3::min);
    let reach = |body: &Body| match body.shape {
        Shape::Sphere { radius } => body.position + radius,
        Shape::Plane { .. } | Shape::Unbuilt { .. } => body.position,
    };
    let high = bodies.iter().map(reach).fold(DVec3::ZERO, DVec3::max);
    let up = |value: f64| if value < 0.0 { nice(-value) } else { 0.0 };
    let shift = DVec3::new(up(low.x), up(low.y), up(low.z));
    let least = 4.0 * radius;
    let size = (high + shift).to_array().map(|top| nice(top.max(least))).into();
    (Map { size, tiles: tiles(size, radius) }, shift)
}

fn tiles(size: DVec3, radius: f64) -> [u32; 3] {
    size.to_array().map(|side| (side / (TILE * radius)).ceil().clamp(1.0, MOST_TILES) as u32)
}

/// The next larger of 1, 1.5, 2, 3, 5, 7 times a power of ten.
fn nice(value: f64) -> f64 {
    let power = libm::floor(libm::log10(value));
    let unit = libm::pow(10.0, power);
    let share = value / unit * (1.0 - 1e-12);
    let step = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0].into_iter().find(|step| share <= *step);
    // Below one the power is not exact: write it as a quotient.
    let step = step.unwrap_or(10.0);
    if power < 0.0 { step / libm::pow(10.0, -power) } else { step * unit }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::rotation_matrix;

    #[test]
    fn angles_give_the_rotation_back() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let steps = [-quarter, -0.3, 0.0, 0.7, quarter, 2.9];
        for (x, y, z) in steps.iter().flat_map(|x| steps.iter().flat_map(move |y| steps.map(|z| (*x, *y, z))))
        {
            let turn = rotation_matrix(DVec3::new(x, y, z));
            // As an exporter would write it, z up.
            let z_up = |v: DVec3| DVec3::new(v.x, -v.z, v.y);
            let turned = DMat3::from_cols(z_up(turn.x_axis), z_up(turn.y_axis), z_up(turn.z_axis));
            assert!(rotation_matrix(angles(turned)).abs_diff_eq(turn, 3e-9), "{x} {y} {z}");
        }
    }

    #[test]
    fn nice_numbers_are_short_and_not_smaller() {
        for value in [0.0123, 0.7, 1.0, 3.1, 9.9, 10.0, 123.0] {
            let nice = nice(value);
            assert!(nice >= value && nice <= 2.0 * value && nice.to_string().len() <= 5, "{value} {nice}");
        }
    }
}
